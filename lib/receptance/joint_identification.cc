#include "receptance/joint_identification.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "dynamics/noise.h"
#include "receptance/joint_starts.h"

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

// On how many lines and in how many steps starts are tried, and how many are carried to the end.
constexpr Eigen::Index kTrialLines = 800;
constexpr std::size_t kFinalists = 3;
constexpr int kTrialSteps = 15, kFinalSteps = 200;
constexpr int kBoundRounds = 8;         // sets of values held at their bounds
constexpr double kShareFloor = 0.01;    // of the weights that look at every line by its share
constexpr double kDampingShare = 1e-3;  // of k / w: a damping below this is nearly none
constexpr double kMostDeviation = 0.3;  // of a value that is identifiable
constexpr double kNormal95 = 1.96;
constexpr double kLeastInformation = 1e-14;  // of the values together, each in its own scale
constexpr Eigen::Index kAround = 12;         // lines on either side that say what variance to expect
constexpr std::size_t kEnoughAround = 4;     // of them
constexpr double kLeastVariance = 0.3;       // of a line, over the expected one
constexpr double kMostRelative = 1e9;        // deviation that is stated
constexpr double kRounding = 1e-14;          // share of the curve's size below which nothing is noise
constexpr double kWhite = 2;                 // correlation length up to which a residual is noise
constexpr double kBoundShare = 1e-9;         // distance in logarithms at which a value lies on its bound

// The solver's coordinates: log k, and log (c + s), which goes through c = 0, with s a small share of k / w.
class LogJoint {
 public:
  LogJoint(const ToolJoint& near, double omega)
      : offset_{0, kDampingShare * near.k1 / omega, 0, kDampingShare * near.k2 / omega} {}
  double to(std::size_t i, double value) const { return std::log(value + offset_[i]); }
  double from(std::size_t i, double u) const { return std::exp(u) - offset_[i]; }
  double slope(std::size_t i, double value) const { return value + offset_[i]; }

 private:
  JointValues offset_;
};

// Derivatives of the residual (real and imaginary part) by the four values.
Eigen::Matrix<double, 2, 4> derivatives(const TipLine& line, const Tip& tip, JointObjective objective) {
  std::array<Complex, 4> by = {tip.by_k1, Complex(0, line.omega) * tip.by_k1, tip.by_k2,
                               Complex(0, line.omega) * tip.by_k2};
  Eigen::Matrix<double, 2, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    if (objective == JointObjective::kAmplitude) by[i] = (std::conj(tip.h) * by[i]).real() / std::abs(tip.h);
    result.col(i) << line.weight * by[i].real(), line.weight * by[i].imag();
  }
  return result;
}

class TipCost : public ceres::CostFunction {
 public:
  TipCost(const TipLines& lines, const LogJoint& coordinates, JointObjective objective)
      : lines_(lines), coordinates_(coordinates), objective_(objective) {
    set_num_residuals(static_cast<int>(2 * lines.size()));
    mutable_parameter_block_sizes()->push_back(4);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    JointValues values;
    for (std::size_t i = 0; i < 4; ++i) values[i] = std::max(0.0, coordinates_.from(i, parameters[0][i]));
    const ToolJoint joint = joint_of(values);
    for (std::size_t n = 0; n < lines_.size(); ++n) {
      const Tip tip = tip_of(lines_[n], joint);
      Complex residual;
      if (!std::isfinite(residual_of(lines_[n], tip, objective_, residual))) return false;
      residuals[2 * n] = residual.real();
      residuals[2 * n + 1] = residual.imag();
      if (jacobians == nullptr || jacobians[0] == nullptr) continue;
      const Eigen::Matrix<double, 2, 4> by = derivatives(lines_[n], tip, objective_);
      for (std::size_t i = 0; i < 4; ++i) {
        const double slope = coordinates_.slope(i, values[i]);
        jacobians[0][8 * n + i] = slope * by(0, i);
        jacobians[0][8 * n + 4 + i] = slope * by(1, i);
      }
    }
    return true;
  }

 private:
  const TipLines& lines_;
  const LogJoint& coordinates_;
  JointObjective objective_;
};

// Values that the bounds hold back are taken out of the problem, one set after the other: a step that is
// only cut at them may not descend.
JointStart refined(const TipLines& lines, const ToolJoint& start, const JointBounds& bounds,
                   JointObjective objective, int steps) {
  const LogJoint coordinates(start, middle_of(lines));
  const JointValues first = values_of(within(start, bounds));
  std::array<double, 4> u{}, least{}, most{};
  for (std::size_t i = 0; i < 4; ++i) {
    least[i] = coordinates.to(i, bounds.least[i]);
    most[i] = coordinates.to(i, bounds.most[i]);
    u[i] = std::clamp(coordinates.to(i, first[i]), least[i], most[i]);
  }
  static const auto silent = FLAGS_minloglevel = google::GLOG_FATAL;  // a library that prints is a bug
  static_cast<void>(silent);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = steps;
  options.function_tolerance = 1e-15;
  options.gradient_tolerance = 0;
  options.parameter_tolerance = 1e-14;
  options.max_num_line_search_step_size_iterations = 0;  // at bounds: a step is cut, or made shorter
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  std::vector<int> held;
  for (int round = 0; round < kBoundRounds; ++round) {
    ceres::Problem problem;
    problem.AddResidualBlock(new TipCost(lines, coordinates, objective), nullptr, u.data());
    std::vector<double> slope(4);
    problem.Evaluate({}, nullptr, nullptr, &slope, nullptr);
    std::vector<int> holding;
    for (int i = 0; i < 4; ++i) {
      const std::size_t at = i;
      problem.SetParameterLowerBound(u.data(), i, least[at]);
      problem.SetParameterUpperBound(u.data(), i, most[at]);
      if ((u[at] - least[at] < kBoundShare && slope[at] > 0) ||
          (most[at] - u[at] < kBoundShare && slope[at] < 0))
        holding.push_back(i);
    }
    if (holding.size() == 4 || (round > 0 && holding == held)) break;
    held = holding;
    if (!held.empty()) problem.SetManifold(u.data(), new ceres::SubsetManifold(4, held));
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
  }
  JointValues values;
  for (std::size_t i = 0; i < 4; ++i) {
    values[i] = std::clamp(coordinates.from(i, u[i]), bounds.least[i], bounds.most[i]);
    if (u[i] - least[i] < kBoundShare) values[i] = bounds.least[i];
    if (most[i] - u[i] < kBoundShare) values[i] = bounds.most[i];
  }
  const ToolJoint joint = joint_of(values);
  return {joint, cost_of(lines, joint, objective)};
}

JointStart best_joint(const TipLines& lines, const JointBounds& bounds, JointObjective objective) {
  const TipLines few = thinned(lines, kTrialLines);
  std::vector<JointStart> trials = joint_starts(lines, bounds, objective);
  // A few lines on sharp peaks may outweigh all others: once more with every line by its share.
  TipLines by_share = lines;
  for (TipLine& line : by_share)
    line.weight = 1 / std::max(std::abs(line.measured), kShareFloor / line.weight);
  for (const JointStart& start : joint_starts(by_share, bounds, objective)) trials.push_back(start);
  for (JointStart& trial : trials) trial = refined(few, trial.joint, bounds, objective, kTrialSteps);
  trials = best_of(std::move(trials), kFinalists);
  for (JointStart& trial : trials) trial = refined(lines, trial.joint, bounds, objective, kFinalSteps);
  return best_of(std::move(trials), 1).front();
}

// ---- noise and verdict ----

Eigen::VectorXcd model_of(const TipLines& lines, const ToolJoint& joint) {
  Eigen::VectorXcd model(lines.size());
  for (Eigen::Index i = 0; i < model.size(); ++i) {
    model[i] = tip_of(lines[i], joint).h;
  }
  return model;
}

// Minus the mean log-likelihood of a residual whose noise is of that size on each line but for a factor.
double surprise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size) {
  const Eigen::ArrayXd square = size.array().square();
  return std::log((residual.cwiseAbs2().array() / square).mean()) + square.log().mean();
}

// Standard deviations of the values that are not at a bound. `known_noise`: the weights are 1 / deviation.
void set_deviations(const TipLines& lines, const JointBounds& bounds, JointObjective objective,
                    bool known_noise, JointEstimate& estimate) {
  const JointValues values = values_of(estimate.joint);
  for (std::size_t i = 0; i < 4; ++i)
    estimate.at_bound[i] = values[i] <= bounds.least[i] || values[i] >= bounds.most[i];
  // Information about the values, each over its own size. Those at a bound count as unknown too: a bound that
  // holds one of them tells nothing of the others.
  Eigen::Vector4d size;
  for (std::size_t i = 0; i < 4; ++i) size[i] = values[i] > 0 ? values[i] : 1;
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Eigen::VectorXcd residual(lines.size());
  double floor = 0;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const Tip tip = tip_of(lines[n], estimate.joint);
    residual_of(lines[n], tip, objective, residual[n]);
    const Eigen::Matrix<double, 2, 4> by = derivatives(lines[n], tip, objective) * size.asDiagonal();
    information += by.transpose() * by;
    floor += std::norm(kRounding * lines[n].weight * lines[n].measured);
  }
  // Of each real number: a line brings two, or one amplitude. A residual that hangs together over lines
  // brings less than its length.
  const double parts = objective == JointObjective::kAmplitude ? 1 : 2;
  const double numbers = parts * static_cast<double>(lines.size());
  double variance = std::max(residual.squaredNorm(), floor) / std::max(1.0, numbers - 4.0) *
                    dynamics::correlation_length(residual);
  if (known_noise) variance = std::max(variance, 1 / parts);
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  // What the lines do not tell apart has next to no information, not none: its deviation is then very large.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(scale.asDiagonal() * information *
                                                                  scale.asDiagonal());
  const Eigen::MatrixXd inverse =
      directions.eigenvectors() *
      directions.eigenvalues().cwiseMax(kLeastInformation).cwiseInverse().asDiagonal() *
      directions.eigenvectors().transpose();
  for (std::size_t i = 0; i < 4; ++i) {
    if (estimate.at_bound[i]) continue;
    const Eigen::Index at = i;
    const double relative = std::min(std::sqrt(variance * inverse(at, at)) * scale[at], kMostRelative);
    estimate.deviation[i] = relative * values[i];
    estimate.identifiable[i] = relative <= kMostDeviation * (1 - kNormal95 * relative);
  }
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A given variance, but for lines that claim to be far surer than the lines around them, as a coherence
// rounded to 1 does: these count as little surer. Empty where nothing is known.
Eigen::VectorXd believed(const Eigen::VectorXd& variance) {
  std::vector<double> all;
  for (const double v : variance) {
    if (v > 0) all.push_back(v);
  }
  if (all.empty()) return {};
  const double usual = median_of(all);
  Eigen::VectorXd result = variance;
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    std::vector<double> around;
    const Eigen::Index last = std::min(i + kAround, variance.size() - 1);
    for (Eigen::Index k = std::max<Eigen::Index>(0, i - kAround); k <= last; ++k) {
      if (variance[k] > 0) around.push_back(variance[k]);
    }
    const double expected = around.size() > kEnoughAround ? median_of(around) : usual;
    result[i] = std::max(variance[i], kLeastVariance * expected);
  }
  return result;
}

void check(const JointData& data, const JointBounds& bounds) {
  if (data.tip.size() < kLeastJointLines) {
    throw InvalidArgument(std::to_string(data.tip.size()) +
                          " lines in common with the assembly: expected at least " +
                          std::to_string(kLeastJointLines));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(bounds.least[i] < bounds.most[i] && bounds.least[i] >= kLeastBound[i] &&
          bounds.most[i] <= kLargestBound))
      throw InvalidArgument("bounds: expected increasing ones from 1e-20 (k1, k2) or 0 (c1, c2) to 1e20");
  }
}

}  // namespace

JointValues values_of(const ToolJoint& joint) { return {joint.k1, joint.c1, joint.k2, joint.c2}; }

ToolJoint joint_of(const JointValues& values) { return {values[0], values[1], values[2], values[3]}; }

JointEstimate identify_joint(const JointData& data, const JointBounds& bounds, JointObjective objective) {
  check(data, bounds);
  TipLines lines;
  for (Eigen::Index i = 0; i < data.tip.size(); ++i) {
    lines.emplace_back(data.plane[i], data.omega_rad_per_s[i], data.tip[i]);
  }
  const double size = data.tip.norm() / std::sqrt(static_cast<double>(data.tip.size()));
  if (!(size > 0)) throw NoAnswer("the measured tip does not move: expected a receptance other than 0");
  // The paper's objective has no weights, whatever is known of the noise.
  const Eigen::VectorXd variance =
      objective == JointObjective::kComplex ? believed(data.variance) : Eigen::VectorXd();
  const bool known = variance.size() > 0;
  const double least_variance = std::pow(kRounding * size, 2);
  const auto weigh = [&](const auto& variance_of) {
    for (std::size_t n = 0; n < lines.size(); ++n) {
      lines[n].weight = 1 / std::sqrt(std::max(variance_of(n), least_variance));
    }
  };
  weigh([&](Eigen::Index n) { return known ? variance[n] : size * size; });

  JointStart best = best_joint(lines, bounds, objective);
  if (!std::isfinite(best.cost)) throw NoAnswer("no joint within the bounds gives a finite receptance");
  if (!known && objective == JointObjective::kComplex) {
    // The noise may be a share of the value. Then the fit that says so leaves white noise and is likelier.
    const Eigen::VectorXcd model = model_of(lines, best.joint);
    const Eigen::VectorXd same = Eigen::VectorXd::Constant(data.tip.size(), size);
    const double expected = surprise(model - data.tip, same);
    if ((model - data.tip).norm() > kRounding * data.tip.norm() &&
        surprise(model - data.tip, model.cwiseAbs()) < expected) {
      weigh([&](Eigen::Index n) { return std::norm(model[n]); });
      const JointStart share = refined(lines, best.joint, bounds, objective, kFinalSteps);
      const Eigen::VectorXcd of_share = model_of(lines, share.joint);
      const Eigen::VectorXd noise = of_share.cwiseAbs();
      if (surprise(of_share - data.tip, noise) < expected &&
          dynamics::correlation_length((of_share - data.tip).cwiseQuotient(noise.cast<Complex>())) < kWhite) {
        best = share;
      } else {
        weigh([&](Eigen::Index) { return size * size; });
      }
    }
  }

  JointEstimate estimate;
  estimate.joint = best.joint;
  set_deviations(lines, bounds, objective, known, estimate);
  const Eigen::VectorXcd model = model_of(lines, best.joint);
  estimate.residual = (model - data.tip).norm() / data.tip.norm();
  estimate.objective = objective == JointObjective::kAmplitude
                           ? (model.cwiseAbs() - data.tip.cwiseAbs()).norm()
                           : (model - data.tip).norm();
  return estimate;
}

}  // namespace stablecut::receptance
