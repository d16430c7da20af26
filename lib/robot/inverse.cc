#include "robot/inverse.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr double kLengthTolerance = 1e-9;  // m
constexpr double kAngleTolerance = 1e-9;   // sine or cosine of an angle between axes
constexpr double kSameSolution = 1e-9;     // rad

// The controller angle nearest to 0 inside the limits.
double nearest_to_zero(const Joint& joint) { return std::clamp(0.0, joint.min_rad, joint.max_rad); }

}  // namespace

std::optional<UnsupportedGeometry> unsupported_geometry(const Robot& robot) {
  const auto& j = robot.joints;
  const auto parallel = [&](int i) { return std::abs(j[i].sin_alpha()) <= kAngleTolerance; };
  const auto square = [&](int i) { return std::abs(j[i].cos_alpha()) <= kAngleTolerance; };
  const auto none = [](double length) { return std::abs(length) <= kLengthTolerance; };
  if (parallel(1)) return UnsupportedGeometry{1, DhParameter::kAlpha, GeometryRule::kShoulderNotParallel};
  if (!parallel(2)) return UnsupportedGeometry{2, DhParameter::kAlpha, GeometryRule::kElbowParallel};
  if (none(j[2].a_m)) return UnsupportedGeometry{2, DhParameter::kA, GeometryRule::kUpperArm};
  if (none(std::hypot(j[3].a_m, j[3].d_m * j[3].sin_alpha())))
    return UnsupportedGeometry{3, DhParameter::kD, GeometryRule::kForearm};
  if (!none(j[4].a_m)) return UnsupportedGeometry{4, DhParameter::kA, GeometryRule::kWristCentre};
  if (!none(j[4].d_m)) return UnsupportedGeometry{4, DhParameter::kD, GeometryRule::kWristCentre};
  if (!none(j[5].a_m)) return UnsupportedGeometry{5, DhParameter::kA, GeometryRule::kWristCentre};
  for (const int i : {4, 5}) {
    if (!square(i)) return UnsupportedGeometry{i, DhParameter::kAlpha, GeometryRule::kWristSquare};
  }
  return std::nullopt;
}

InverseKinematics::InverseKinematics(const Robot& robot)
    : frame6_from_tool_(robot.tool_in_frame6().inverse()), home_from_base_(Eigen::Isometry3d::Identity()) {
  if (const auto bad = unsupported_geometry(robot)) {
    throw InvalidArgument("joint " + robot.joints[bad->joint].name +
                          ": no analytic inverse kinematics for this geometry");
  }
  const auto& j = robot.joints;
  for (const Joint& joint : j) {
    if (!std::isfinite(joint.half_range_rad()))
      throw InvalidArgument("joint " + joint.name + ": expected finite limits");
  }
  ArmConstants& k = constants_;
  k.cos_alpha1 = j[1].cos_alpha();
  k.sin_alpha1 = j[1].sin_alpha();
  k.a1 = j[1].a_m;
  k.a2 = j[2].a_m;
  k.elbow_sense = j[2].cos_alpha();
  k.cos_alpha3 = k.elbow_sense * j[3].cos_alpha();
  k.sin_alpha3 = k.elbow_sense * j[3].sin_alpha();
  k.along_axis2 = j[1].d_m + k.elbow_sense * (j[2].d_m + j[3].d_m * j[3].cos_alpha());
  // The wrist centre in frame 3 is (a3, -d4 sin(alpha3)) across axis 3; mirrored where axis 3 runs against
  // axis 2.
  const double bend_x = j[3].a_m, bend_y = -k.elbow_sense * j[3].d_m * j[3].sin_alpha();
  k.forearm = std::hypot(bend_x, bend_y);
  k.cos_bend = bend_x / k.forearm;
  k.sin_bend = bend_y / k.forearm;
  k.wrist4 = j[4].sin_alpha() > 0 ? 1 : -1;
  k.wrist5 = j[5].sin_alpha() > 0 ? 1 : -1;
  k.d6 = j[5].d_m;
  k.coupled = std::any_of(j.begin(), j.end(), [](const Joint& joint) { return joint.coupling.has_value(); });
  for (int i = 0; i < kJoints; ++i) {
    k.sign[i] = j[i].theta_sign;
    k.offset[i] = j[i].theta_offset_rad;
    k.least[i] = j[i].min_rad;
    k.most[i] = j[i].max_rad;
    const AngleRange range{j[i].min_rad, j[i].max_rad};
    k.middle[i] = range.middle_rad();
    k.half_range[i] = range.half_range_rad();
    k.follows[i] = j[i].coupling ? j[i].coupling->follows : -1;
    k.ratio[i] = j[i].coupling ? j[i].coupling->ratio : 0;
    k.coupled_least[i] = j[i].coupled_min_rad;
    k.coupled_most[i] = j[i].coupled_max_rad;
  }
  set_free_angles(nearest_to_zero(j[0]), nearest_to_zero(j[3]));
  Eigen::Isometry3d home_from_frame0 = Eigen::Isometry3d::Identity();
  const double c = j[0].cos_alpha(), s = j[0].sin_alpha();
  home_from_frame0.linear() << 1, 0, 0, 0, c, s, 0, -s, c;
  home_from_frame0.translation() << -j[0].a_m, 0, -j[0].d_m;
  home_from_base_ = home_from_frame0 * robot.base.inverse();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) k.home[row][column] = home_from_base_.linear()(row, column);
    k.home_shift[row] = home_from_base_.translation()[row];
  }
}

void InverseKinematics::set_free_angles(double angle1, double angle4) {
  ArmConstants& k = constants_;
  const double theta1 = k.sign[0] * angle1 + k.offset[0], theta4 = k.sign[3] * angle4 + k.offset[3];
  k.cos_free1 = std::cos(theta1);
  k.sin_free1 = std::sin(theta1);
  k.cos_free4 = std::cos(theta4);
  k.sin_free4 = std::sin(theta4);
}

ArmTarget InverseKinematics::target_of(const Eigen::Isometry3d& tool) const {
  const Eigen::Isometry3d frame6 = tool * frame6_from_tool_;
  ArmTarget target;
  for (int i = 0; i < 3; ++i) {
    target.x[i] = frame6.linear()(i, 0);
    target.z[i] = frame6.linear()(i, 2);
    target.origin[i] = frame6.translation()[i];
  }
  return target;
}

std::vector<InverseSolution> InverseKinematics::solve(const Eigen::Isometry3d& tool) const {
  ArmLanes lanes;
  solve_arms(constants_, target_of(tool), lanes);
  std::vector<InverseSolution> solutions;
  for (int b = 0; b < kBranches; ++b) {
    if (!std::isfinite(lanes.limit_margin[b])) continue;
    InverseSolution solution{{}, b, lanes.limit_margin[b]};
    for (int i = 0; i < kJoints; ++i) solution.angles[i] = lanes.angle[i][b];
    const bool repeated = std::any_of(solutions.begin(), solutions.end(), [&](const InverseSolution& other) {
      return (other.angles - solution.angles).lpNorm<Eigen::Infinity>() < kSameSolution;
    });
    if (!repeated) solutions.push_back(solution);
  }
  return solutions;
}

std::vector<InverseSolution> InverseKinematics::solve(const Eigen::Isometry3d& tool,
                                                      const JointAngles& free) const {
  InverseKinematics other = *this;
  other.set_free_angles(free[0], free[3]);
  return other.solve(tool);
}

std::vector<JointAngles> copies_within_limits(const Robot& robot, const JointAngles& angles,
                                              double margin_rad) {
  // Each copy holds controller angles up to the joint that is looked at, and turns from there on.
  std::vector<JointAngles> copies{joint_turns(robot, most_central_copies(robot, angles))};
  for (int j = 0; j < kJoints; ++j) {
    std::vector<JointAngles> next;
    for (JointAngles copy : copies) {
      if (const auto& c = robot.joints[j].coupling) copy[j] -= c->ratio * copy[c->follows];
      const AngleRange range = robot.range(j, copy);
      const double least = range.min_rad + margin_rad, most = range.max_rad - margin_rad;
      for (double turn = std::ceil((least - copy[j]) / kTwoPi); copy[j] + turn * kTwoPi <= most; ++turn) {
        next.push_back(copy);
        next.back()[j] += turn * kTwoPi;
      }
    }
    copies = std::move(next);
  }
  return copies;
}

}  // namespace stablecut::robot
