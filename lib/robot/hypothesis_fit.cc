#include "robot/hypothesis_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "numerics/order_statistics.h"
#include "robot/compliance_fit.h"
#include "robot/given_poses.h"
#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kMostTested = 1000;  // samples
constexpr double kGolden = 0.6180339887498949;
constexpr double kHidden =
    1e-3;  // of the largest size of a column: it is misalignment, as in identifiability
constexpr int kMostFolds = 12;
constexpr int kMostSteps = 12;                // of a fitted vector
constexpr double kVectorStep = 1e-4;          // m or rad: of differences
constexpr double kSettledStep = 1e-4;         // m or rad
constexpr double kMostOffset = 1;             // m
constexpr double kMostTurn = 60 * kPi / 180;  // rad: beyond, a right angle is nearer

// Multiples of the golden ratio spread evenly, whatever period the samples have.
std::vector<LoadSample> thinned(const std::vector<LoadSample>& samples) {
  const double share = kMostTested / static_cast<double>(samples.size());
  std::vector<LoadSample> kept;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const double place = kGolden * static_cast<double>(s);
    if (place - std::floor(place) < share) kept.push_back(samples[s]);
  }
  return kept;
}

double most_of(const Hypothesis& hypothesis) {
  return hypothesis.kind == Hypothesis::Kind::kRotated ? kMostTurn : kMostOffset;
}

SampleGroups poses_of(std::vector<LoadSample> samples) {
  std::vector<JointAngles> angles;
  for (const LoadSample& sample : samples) angles.push_back(sample.angles);
  if (looks_like_radians(angles)) {
    for (LoadSample& sample : samples) sample.angles *= 180 / kPi;
  }
  return groups_by_pose(samples);
}

}  // namespace

// A c = b, rows divided by their deviations.
struct HypothesisFits::System {
  Eigen::MatrixXd a;  // [rows x springs], and a column for each number of a fitted vector
  Eigen::VectorXd b;
  std::vector<int> pose;       // of each row
  std::vector<bool> rotation;  // of each row
};

HypothesisFits::HypothesisFits(const Robot& robot, const std::vector<LoadSample>& samples,
                               const std::array<bool, 3>& components)
    : robot_(robot),
      samples_(thinned(samples)),
      components_(components),
      poses_(poses_of(samples_)),
      springs_(springs_of(robot, ElasticModel::kThreeAxis)) {
  for (const ElasticModel model :
       {ElasticModel::kJointsOnly, ElasticModel::kBase, ElasticModel::kThreeAxis}) {
    std::vector<Eigen::Index> columns;
    for (const Spring& spring : springs_of(robot, model))
      columns.push_back(std::find(springs_.begin(), springs_.end(), spring) - springs_.begin());
    models_.push_back(columns);
  }
  const ComplianceEquations joints = compliance_equations(robot, joint_springs(), samples_, components);
  per_std_ = fit_compliances(joints, false).std.cwiseInverse();
  int count = 0;
  for (Eigen::Index i = 0; i < joints.b.size(); ++i) {
    if (joints.rotation[i]) continue;
    size_m_ += joints.b[i] * joints.b[i];
    ++count;
  }
  size_m_ = std::sqrt(size_m_ / std::max(count, 1));
}

HypothesisFits::System HypothesisFits::system_with(const Hypothesis& hypothesis) const {
  Robot robot = robot_;
  std::vector<LoadSample> samples = samples_;
  apply(hypothesis, robot, samples);
  const ComplianceEquations equations = compliance_equations(robot, springs_, samples, components_);
  System system{
      per_std_.asDiagonal() * equations.a, per_std_.cwiseProduct(equations.b), {}, equations.rotation};
  for (Eigen::Index k = 0; k < system.a.cols(); ++k) {
    if (equations.a.col(k).norm() < kHidden * equations.largest.col(k).norm()) system.a.col(k).setZero();
  }
  for (const int sample : equations.sample) system.pose.push_back(poses_.of_sample[sample]);
  return system;
}

NormalEquations HypothesisFits::normal_of(const System& system,
                                          const std::vector<Eigen::Index>& columns) const {
  std::vector<bool> not_negative;
  for (const Eigen::Index column : columns)
    not_negative.push_back(column < static_cast<Eigen::Index>(springs_.size()));
  return {system.a(Eigen::all, columns), system.b, not_negative};
}

PosePredictions HypothesisFits::predictions(const System& system,
                                            const std::vector<Eigen::Index>& columns) const {
  const NormalEquations normal = normal_of(system, columns);
  const auto count = static_cast<Eigen::Index>(columns.size());
  const Eigen::VectorXd residual = normal.residual(count);
  const int folds = std::min(kMostFolds, poses_.count);
  std::vector<std::vector<Eigen::Index>> rows(folds);
  for (std::size_t i = 0; i < system.pose.size(); ++i)
    rows[system.pose[i] % folds].push_back(static_cast<Eigen::Index>(i));
  const Eigen::VectorXd error = normal.left_out(count, rows);
  PosePredictions fit;
  fit.square = Eigen::VectorXd::Zero(poses_.count);
  Eigen::VectorXd rows_of_pose = Eigen::VectorXd::Zero(poses_.count);
  for (std::size_t i = 0; i < system.pose.size(); ++i) {
    fit.square[system.pose[i]] += std::pow(error[static_cast<Eigen::Index>(i)], 2);
    rows_of_pose[system.pose[i]] += 1;
  }
  fit.square = fit.square.cwiseQuotient(rows_of_pose);
  fit.rows_per_pose = rows_of_pose.mean();
  double sum = 0;
  int deflections = 0;
  for (std::size_t i = 0; i < system.pose.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (system.rotation[i]) continue;
    sum += std::pow(residual[row] / per_std_[row], 2);
    ++deflections;
  }
  fit.residual_m = std::sqrt(sum / std::max(deflections, 1));
  return fit;
}

// Gauss and Newton's steps in the vector, with the compliances free in each, from where it stands. Leaves
// what the vector changes, per m or rad, in the last columns of the system.
void HypothesisFits::fit_vector(Hypothesis& hypothesis, System& system,
                                const std::vector<Eigen::Index>& springs) const {
  const auto n = static_cast<Eigen::Index>(springs_.size());
  const int unknowns = hypothesis.unknowns();
  std::vector<Eigen::Index> columns = springs;
  for (int k = 0; k < unknowns; ++k) columns.push_back(n + k);
  for (int i = 0; i < kMostSteps; ++i) {
    system = system_with(hypothesis);
    const Eigen::MatrixXd part = system.a(Eigen::all, springs);
    const Eigen::VectorXd compliance =
        bounded_least_squares(part, system.b, std::vector<bool>(springs.size(), true));
    const Eigen::VectorXd here = part * compliance - system.b;
    system.a.conservativeResize(Eigen::NoChange, n + unknowns);
    for (int k = 0; k < unknowns; ++k) {
      Hypothesis moved = hypothesis;
      moved.vector[k] += kVectorStep;
      const System there = system_with(moved);
      system.a.col(n + k) = (there.a(Eigen::all, springs) * compliance - there.b - here) / kVectorStep;
    }
    const Eigen::VectorXd step = normal_of(system, columns).solution(columns.size()).tail(unknowns);
    if (step.norm() < kSettledStep) return;
    hypothesis.vector.head(unknowns) += step;
    if (!(hypothesis.vector.norm() < most_of(hypothesis))) return;
  }
}

PosePredictions HypothesisFits::with(const Hypothesis& hypothesis) const {
  PosePredictions best;
  Hypothesis changed = hypothesis;
  System system = system_with(hypothesis);
  for (const std::vector<Eigen::Index>& springs : models_) {
    std::vector<Eigen::Index> columns = springs;
    if (hypothesis.unknowns() > 0) {
      fit_vector(changed, system, springs);
      if (!(changed.vector.norm() < most_of(changed))) return best;
      for (int k = 0; k < hypothesis.unknowns(); ++k)
        columns.push_back(static_cast<Eigen::Index>(springs_.size()) + k);
    }
    PosePredictions fit = predictions(system, columns);
    fit.hypothesis = changed;
    if (best.square.size() == 0 || fit.square.mean() < best.square.mean()) best = fit;
  }
  return best;
}

Eigen::VectorXd log_gains(const PosePredictions& one, const PosePredictions& other) {
  const auto usual = [](const PosePredictions& fit) {
    return numerics::median(std::vector<double>(fit.square.begin(), fit.square.end()));
  };
  const double least = std::max(std::min(usual(one), usual(other)), std::numeric_limits<double>::min());
  return ((one.square.array() + least) / (other.square.array() + least)).log();
}

}  // namespace stablecut::robot
