#include "robot/hypotheses.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "numerics/distributions.h"
#include "robot/given_poses.h"
#include "robot/hypothesis_fit.h"

namespace stablecut::robot {
namespace {

using Kind = Hypothesis::Kind;

constexpr int kForearm = 2;  // index of axis 3, which controllers may count from the horizontal
constexpr double kUsualStiffness[kJoints] = {1.0e5, 1.0e5, 1.0e5,
                                             2e4,   2e4,   2e4};  // N m/rad at a reach of 1 m
constexpr double kWholeTurn = 1e-14;  // of an entry of a rotation: right angles stay exact
constexpr double kFarBetter = 0.15;   // least mean logarithm of a pose's squared error, without over with
constexpr double kLeastGain[] = {9, 9, 9, 10};        // of the log-likelihood, by numbers fitted
constexpr double kChance[] = {0.03, 0.01, 0, 0.003};  // of Student's test over the poses, likewise
constexpr double kWorse = 0.05;  // tail by which a hypothesis is significantly worse than another
constexpr int kLeastPoses = 4;
constexpr double kMisfit = 1.0 / 3;               // of the deflection: the residual of a misfit
constexpr double kSoftest = 0.32, kStiffest = 5;  // of the usual stiffness

void turn(const Eigen::Matrix3d& by, LoadSample& sample) {
  const auto turn_deviations = [&](std::optional<Eigen::Vector3d>& std) {
    if (std) std = (by.cwiseAbs2() * std->cwiseAbs2()).cwiseSqrt();
  };
  sample.deflection_m = by * sample.deflection_m;
  if (sample.rotation_rad) sample.rotation_rad = by * *sample.rotation_rad;
  turn_deviations(sample.deflection_std_m);
  turn_deviations(sample.rotation_std_rad);
}

// The wrist's distance from axis 1 with the arm stretched: the reach that makers state.
double reach_of(const Robot& robot) {
  double reach = 0;
  for (int j = 1; j < 5; ++j)
    reach += j < 3 ? std::abs(robot.joints[j].a_m) : std::hypot(robot.joints[j].a_m, robot.joints[j].d_m);
  return reach;
}

bool far_better(const PosePredictions& now, const PosePredictions& fit) {
  const int fitted = fit.hypothesis.unknowns();
  const Eigen::VectorXd gains = log_gains(now, fit);
  return gains.mean() > kFarBetter && gains.sum() * fit.rows_per_pose / 2 > kLeastGain[fitted] &&
         numerics::mean_above_zero(gains, kChance[fitted]);
}

}  // namespace

Eigen::Matrix3d turn_by(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (!(angle > 0)) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
  for (double& entry : turn.reshaped()) {
    if (std::abs(entry - std::nearbyint(entry)) < kWholeTurn) entry = std::nearbyint(entry);
  }
  return turn;
}

void apply(const Hypothesis& hypothesis, Robot& robot, std::vector<LoadSample>& samples) {
  switch (hypothesis.kind) {
    case Kind::kNone:
      return;
    case Kind::kSign:
      robot.joints[hypothesis.joint].theta_sign *= -1;
      return;
    case Kind::kCoupling:
      robot.joints[hypothesis.joint].coupling =
          hypothesis.ratio == 0 ? std::nullopt
                                : std::optional(Coupling{hypothesis.follows, hypothesis.ratio});
      return;
    case Kind::kTurned:
    case Kind::kRotated: {
      const Eigen::Matrix3d by = turn_by(hypothesis.vector);
      for (LoadSample& sample : samples) turn(by, sample);
      return;
    }
    case Kind::kRadians:
      for (LoadSample& sample : samples) sample.angles *= 180 / kPi;
      return;
    case Kind::kLoadPoint:
      for (LoadSample& sample : samples) sample.force_point += hypothesis.vector;
      return;
    case Kind::kOwnWeight:
      for (LoadSample& sample : samples) sample.with_own_weight = true;
      return;
    case Kind::kLength: {
      Joint& joint = robot.joints[hypothesis.joint];
      double& length = std::abs(joint.a_m) > std::abs(joint.d_m) ? joint.a_m : joint.d_m;
      length += std::copysign(hypothesis.vector[0], hypothesis.vector[0] * length);
      return;
    }
    case Kind::kDeflectionUnit:
      for (LoadSample& sample : samples) {
        sample.deflection_m *= hypothesis.factor;
        if (sample.deflection_std_m) *sample.deflection_std_m *= hypothesis.factor;
      }
      return;
    case Kind::kForceUnit:
      for (LoadSample& sample : samples) {
        sample.force_n *= hypothesis.factor;
        sample.moment_n_m *= hypothesis.factor;
      }
      return;
  }
}

std::vector<Hypothesis> hypotheses(const Robot& robot, const std::vector<LoadSample>& samples,
                                   const HypothesisOptions& options) {
  std::vector<Hypothesis> list;
  for (int j = 0; j < kJoints; ++j) list.push_back({.kind = Kind::kSign, .joint = j});
  for (int j = 1; j < kJoints; ++j) {
    const auto& stated = robot.joints[j].coupling;
    if (!stated && j != kForearm) continue;
    const int follows = stated ? stated->follows : j - 1;
    for (const double ratio : {1.0, -1.0, 0.0}) {
      if (ratio != (stated ? stated->ratio : 0.0))
        list.push_back({.kind = Kind::kCoupling, .joint = j, .follows = follows, .ratio = ratio});
    }
  }
  if (options.components == std::array{true, true, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double angle : {kPi / 2, -kPi / 2, kPi})
        list.push_back({.kind = Kind::kTurned, .vector = angle * Eigen::Vector3d::Unit(axis)});
    }
    list.push_back({.kind = Kind::kRotated});
  }
  std::vector<JointAngles> angles;
  for (const LoadSample& sample : samples) angles.push_back(sample.angles);
  if (looks_like_radians(angles)) list.push_back({.kind = Kind::kRadians});
  list.push_back({.kind = Kind::kLoadPoint});
  if (std::any_of(robot.joints.begin(), robot.joints.end(),
                  [](const Joint& j) { return j.mass.has_value(); }))
    list.push_back({.kind = Kind::kOwnWeight});
  for (const int j : {kForearm, kForearm + 1}) list.push_back({.kind = Kind::kLength, .joint = j});
  for (const double factor : options.deflection_factors)
    list.push_back({.kind = Kind::kDeflectionUnit, .factor = factor});
  for (const double factor : options.force_factors)
    list.push_back({.kind = Kind::kForceUnit, .factor = factor});
  return list;
}

StiffnessOfReach stiffness_of_reach(const Robot& robot, const std::vector<LoadSample>& samples,
                                    const HypothesisOptions& options) {
  StiffnessOfReach result;
  result.reach_m = reach_of(robot);
  const ComplianceEquations equations =
      compliance_equations(robot, joint_springs(), samples, options.components);
  const Eigen::VectorXd usual = Eigen::VectorXd::Map(kUsualStiffness, kJoints) * std::pow(result.reach_m, 3);
  const Eigen::VectorXd expected = equations.a * usual.cwiseInverse();
  double expected_squares = 0, measured_squares = 0;
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    if (equations.rotation[i]) continue;
    expected_squares += expected[i] * expected[i];
    measured_squares += equations.b[i] * equations.b[i];
  }
  if (!(expected_squares > 0) || !(measured_squares > 0)) return result;
  result.ratio = std::sqrt(expected_squares / measured_squares);
  result.usual = *result.ratio > kSoftest && *result.ratio < kStiffest;
  if (result.usual) return result;
  double best = std::abs(std::log(*result.ratio));
  for (const Hypothesis& unit : hypotheses(robot, samples, options)) {
    if (!unit.of_unit()) continue;
    const double factor = unit.kind == Kind::kForceUnit ? unit.factor : 1 / unit.factor;
    const double distance = std::abs(std::log(*result.ratio * factor));
    if (distance >= best) continue;
    best = distance;
    result.unit = unit;
  }
  return result;
}

Hypothesis fitted(const Hypothesis& hypothesis, const Robot& robot, const std::vector<LoadSample>& samples,
                  const HypothesisOptions& options) {
  if (hypothesis.unknowns() == 0) return hypothesis;
  const PosePredictions fit = HypothesisFits(robot, samples, options.components).with(hypothesis);
  return fit.square.size() > 0 ? fit.hypothesis : hypothesis;
}

std::vector<BetterFit> better_fits(const Robot& robot, const std::vector<LoadSample>& samples,
                                   const HypothesisOptions& options) {
  const HypothesisFits fits(robot, samples, options.components);
  const PosePredictions now = fits.with({});
  if (fits.poses() < kLeastPoses || fits.exact(now)) return {};
  std::vector<Hypothesis> tried = hypotheses(robot, samples, options);
  std::erase_if(tried, [](const Hypothesis& hypothesis) { return hypothesis.of_unit(); });
  std::vector<PosePredictions> better;
  for (const Hypothesis& hypothesis : tried) {
    const PosePredictions fit = fits.with(hypothesis);
    if (fit.square.size() > 0 && far_better(now, fit)) better.push_back(fit);
  }
  if (better.empty()) return {};
  const auto gain = [&](const PosePredictions& fit) { return log_gains(now, fit).mean(); };
  std::stable_sort(better.begin(), better.end(),
                   [&](const auto& one, const auto& other) { return gain(one) > gain(other); });
  const PosePredictions best = better.front();
  std::erase_if(better, [&](const PosePredictions& fit) {
    return numerics::mean_above_zero(log_gains(fit, best), kWorse);
  });
  std::stable_partition(better.begin(), better.end(),
                        [](const PosePredictions& fit) { return fit.hypothesis.unknowns() == 0; });
  std::vector<BetterFit> result;
  for (const PosePredictions& fit : better) {
    const Eigen::VectorXd gains = log_gains(now, fit);
    result.push_back({fit.hypothesis, now.residual_m, fit.residual_m,
                      static_cast<int>((gains.array() > 0).count()), fits.poses()});
  }
  return result;
}

bool misfit(double residual_m, double deflection_m) { return residual_m > kMisfit * deflection_m; }

}  // namespace stablecut::robot
