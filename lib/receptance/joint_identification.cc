#include "receptance/joint_identification.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "dynamics/noise.h"
#include "numerics/order_statistics.h"
#include "receptance/joint_search.h"

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

constexpr double kMostDeviation = 0.3;        // of a value that is identifiable
constexpr double kNormal95 = 1.96;            // standard deviations to either end of a 95 % interval
constexpr double kLeastInformation = 1e-14;   // least eigenvalue of the scaled information matrix
constexpr double kMostRelative = 1e9;         // largest standard deviation over its value that is stated
constexpr Eigen::Index kNeighbours = 12;      // lines on either side that say what variance to expect
constexpr std::size_t kEnoughNeighbours = 4;  // with no more of them the median of all lines is expected
constexpr double kLeastVariance = 0.3;        // of a line, over the expected one
constexpr double kRounding = 1e-14;           // of the curve's size: residuals below it are no noise
constexpr double kWhite = 2;                  // correlation length up to which a residual counts as white
constexpr double kNoFit = 0.5;                // residual above which no joint explains the tip
constexpr double kPoorFit = 0.1;              // residual above which the fit is poor

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

// ---- noise ----

// The given variance, but raised where a line claims to be far surer than the lines around it, as a coherence
// rounded to 1 does. Empty where nothing is known.
Eigen::VectorXd credible(const Eigen::VectorXd& variance) {
  std::vector<double> all;
  for (const double v : variance) {
    if (v > 0) all.push_back(v);
  }
  if (all.empty()) return {};
  const double usual = numerics::median(all);
  Eigen::VectorXd result = variance;
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    std::vector<double> around;
    const Eigen::Index last = std::min(i + kNeighbours, variance.size() - 1);
    for (Eigen::Index k = std::max<Eigen::Index>(0, i - kNeighbours); k <= last; ++k) {
      if (variance[k] > 0) around.push_back(variance[k]);
    }
    const double expected = around.size() > kEnoughNeighbours ? numerics::median(around) : usual;
    result[i] = std::max(variance[i], kLeastVariance * expected);
  }
  return result;
}

void weigh(TipLines& lines, const Eigen::VectorXd& variance, double least_variance) {
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const Eigen::Index line = n;
    lines[n].weight = 1 / std::sqrt(std::max(variance[line], least_variance));
  }
}

Eigen::VectorXcd model_of(const TipLines& lines, const ToolJoint& joint) {
  Eigen::VectorXcd model(lines.size());
  for (Eigen::Index i = 0; i < model.size(); ++i) {
    model[i] = tip_of(lines[i], joint).h;
  }
  return model;
}

// Minus the mean logarithm of the likelihood of a residual whose standard deviation is `size` on each line,
// up to a common factor, for the likeliest factor.
double minus_log_likelihood(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size) {
  const Eigen::ArrayXd square = size.array().square();
  return std::log((residual.cwiseAbs2().array() / square).mean()) + square.log().mean();
}

// With an unknown noise, `best` is the fit for a noise that is the same on all lines (of variance `size`^2).
// The fit for a noise that is a share of the value takes its place where its residual is likelier, and white;
// the lines then keep its weights.
void try_noise_by_share(TipLines& lines, const Eigen::VectorXcd& measured, double size, double least_variance,
                        const JointBounds& bounds, JointCandidate& best) {
  const Eigen::VectorXd same = Eigen::VectorXd::Constant(measured.size(), size);
  const Eigen::VectorXcd model = model_of(lines, best.joint);
  const double to_beat = minus_log_likelihood(model - measured, same);
  if (!((model - measured).norm() > kRounding * measured.norm() &&
        minus_log_likelihood(model - measured, model.cwiseAbs()) < to_beat))
    return;
  weigh(lines, model.cwiseAbs2(), least_variance);
  const JointCandidate by_share = converged_joint(lines, best.joint, bounds, JointObjective::kComplex);
  const Eigen::VectorXcd its_model = model_of(lines, by_share.joint);
  const Eigen::VectorXd noise = its_model.cwiseAbs();
  if (minus_log_likelihood(its_model - measured, noise) < to_beat &&
      dynamics::correlation_length((its_model - measured).cwiseQuotient(noise.cast<Complex>())) < kWhite) {
    best = by_share;
  } else {
    weigh(lines, same.cwiseAbs2(), least_variance);
  }
}

// ---- what the lines tell of the values ----

// Inverse of the information matrix with its rows and columns scaled by `scale`. A combination of the values
// that the lines do not tell gets next to no information in place of none: a very large deviation.
Eigen::Matrix4d inverse_of_scaled(const Eigen::Matrix4d& information, const Eigen::Vector4d& scale) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> combinations(scale.asDiagonal() * information *
                                                                    scale.asDiagonal());
  return combinations.eigenvectors() *
         combinations.eigenvalues().cwiseMax(kLeastInformation).cwiseInverse().asDiagonal() *
         combinations.eigenvectors().transpose();
}

// Standard deviations, and which values are identifiable. `known_noise`: the weights are 1 / deviation, else
// 1 / deviation up to a common factor.
void set_deviations(const TipLines& lines, const JointBounds& bounds, JointObjective objective,
                    bool known_noise, JointEstimate& estimate) {
  const JointValues values = values_of(estimate.joint);
  for (std::size_t i = 0; i < 4; ++i)
    estimate.at_bound[i] = values[i] <= bounds.least[i] || values[i] >= bounds.most[i];
  // Information about the values, each over its own size. Those at a bound count as unknown, too: that one of
  // them stopped there tells nothing about the others.
  Eigen::Vector4d size;
  for (std::size_t i = 0; i < 4; ++i) size[i] = values[i] > 0 ? values[i] : 1;
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Eigen::VectorXcd residual(lines.size());
  double floor = 0;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const Tip tip = tip_of(lines[n], estimate.joint);
    residual_of(lines[n], tip, objective, residual[n]);
    const Eigen::Matrix<double, 2, 4> by = residual_derivatives(lines[n], tip, objective) * size.asDiagonal();
    information += by.transpose() * by;
    floor += std::norm(kRounding * lines[n].weight * lines[n].measured);
  }
  // Variance of one real number; a line brings two of them, or one amplitude. A residual that is correlated
  // over lines brings fewer independent ones [Bayley1946].
  const double parts = objective == JointObjective::kAmplitude ? 1 : 2;
  const double numbers = parts * static_cast<double>(lines.size());
  double variance = std::max(residual.squaredNorm(), floor) / std::max(1.0, numbers - 4.0) *
                    dynamics::correlation_length(residual);
  if (known_noise) variance = std::max(variance, 1 / parts);
  const Eigen::Vector4d scale = information.diagonal().cwiseMax(kAboveZero).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix4d inverse = inverse_of_scaled(information, scale);
  for (std::size_t i = 0; i < 4; ++i) {
    if (estimate.at_bound[i]) continue;
    const Eigen::Index at = i;
    const double relative = std::min(std::sqrt(variance * inverse(at, at)) * scale[at], kMostRelative);
    estimate.deviation[i] = relative * values[i];
    estimate.identifiable[i] = relative <= kMostDeviation * (1 - kNormal95 * relative);
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
  // The published objective has no weights, whatever is known of the noise.
  const Eigen::VectorXd variance =
      objective == JointObjective::kComplex ? credible(data.variance) : Eigen::VectorXd();
  const bool known = variance.size() > 0;
  const double least_variance = std::pow(kRounding * size, 2);
  weigh(lines, known ? variance : Eigen::VectorXd::Constant(data.tip.size(), size * size), least_variance);

  JointCandidate best = best_joint(lines, bounds, objective);
  if (!std::isfinite(best.cost)) throw NoAnswer("no joint within the bounds gives a finite receptance");
  if (!known && objective == JointObjective::kComplex)
    try_noise_by_share(lines, data.tip, size, least_variance, bounds, best);

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

std::vector<JointFinding> findings_of(const JointEstimate& estimate, const JointBounds& bounds,
                                      JointObjective objective) {
  using Kind = JointFinding::Kind;
  const JointBounds widest;
  bool told = false;
  for (std::size_t i = 0; i < 4; ++i) {
    const bool chosen = bounds.least[i] > widest.least[i] || bounds.most[i] < widest.most[i];
    told = told || estimate.identifiable[i] || (estimate.at_bound[i] && chosen);
  }
  std::vector<JointFinding> findings;
  if (objective != JointObjective::kAmplitude && estimate.residual > kNoFit)
    findings.push_back({Kind::kUnexplained, 0, estimate.residual});
  if (!told) findings.push_back({Kind::kNothingTold});
  if (estimate.residual > kPoorFit) findings.push_back({Kind::kPoorFit, 0, estimate.residual});
  const JointValues values = values_of(estimate.joint);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (estimate.at_bound[i]) {
      findings.push_back({Kind::kAtBound, i, values[i]});
    } else if (!estimate.identifiable[i]) {
      findings.push_back({Kind::kNotIdentifiable, i, estimate.deviation[i] / values[i]});
    }
  }
  return findings;
}

}  // namespace stablecut::receptance
