// Robots and tasks that the robot room's tests share.
#pragma once

#include <random>

#include "base/units.h"
#include "numerics/random.h"
#include "robot/pose_task.h"
#include "robot/robot.h"

namespace stablecut::robot::fixtures {

/// The KUKA KR360 R2830 of Yi et al. with its 210 mm coaxial tool, as in testdata/kr360.json.
inline Robot kr360() {
  struct Row {
    double a_mm, alpha_deg, d_mm, sign, offset_deg, min_deg, max_deg;
  };
  constexpr Row kRows[] = {{0, 0, 1045, -1, 0, -185, 185},  {500, 90, 0, -1, 0, -130, 20},
                           {1300, 0, 0, -1, 90, -100, 144}, {-55, 90, 1025, -1, 0, -350, 350},
                           {0, -90, 0, -1, 0, -120, 120},   {0, -90, -290, 1, 0, -350, 350}};
  Robot robot;
  for (std::size_t j = 0; j < kJoints; ++j) {
    const Row& row = kRows[j];
    Joint& joint = robot.joints[j];
    joint.name = std::string("A") + static_cast<char>('1' + j);
    joint.a_m = metres_from_mm(row.a_mm);
    joint.set_alpha(radians_from_degrees(row.alpha_deg));
    joint.d_m = metres_from_mm(row.d_mm);
    joint.theta_sign = row.sign;
    joint.theta_offset_rad = radians_from_degrees(row.offset_deg);
    joint.min_rad = radians_from_degrees(row.min_deg);
    joint.max_rad = radians_from_degrees(row.max_deg);
  }
  robot.flange.linear() << -1, 0, 0, 0, 1, 0, 0, 0, -1;
  robot.tool.translation() << 0, 0, 0.21;
  return robot;
}

inline Robot with_tool_offset(Robot robot, double x_m) {
  robot.tool.translation().x() += x_m;
  return robot;
}

/// The paper's joint stiffness identified on the working plane (eq. 13), N m/rad.
inline JointAngles k_theta_2d() {
  return (JointAngles() << 6.89e6, 4.53e6, 3.40e6, 2.13e6, 1.27e6, 6.32e5).finished();
}

using numerics::uniform;

/// About as much as the joints of the KR360 yield, each spring another value.
inline double random_compliance(const Spring& spring, std::mt19937_64& generator) {
  return spring.kind == Spring::Kind::kBase ? uniform(generator, 1e-8, 1e-7) : uniform(generator, 5e-8, 1e-6);
}

inline Elasticity random_elasticity(const Robot& robot, ElasticModel model, std::mt19937_64& generator) {
  Elasticity elasticity{springs_of(robot, model), {}};
  elasticity.compliance.resize(static_cast<Eigen::Index>(elasticity.springs.size()));
  for (std::size_t k = 0; k < elasticity.springs.size(); ++k)
    elasticity.compliance[k] = random_compliance(elasticity.springs[k], generator);
  return elasticity;
}

/// Inside all limits.
inline JointAngles random_angles(const Robot& robot, std::mt19937_64& generator) {
  JointAngles angles;
  do {
    for (int j = 0; j < kJoints; ++j)
      angles[j] = uniform(generator, robot.joints[j].min_rad, robot.joints[j].max_rad);
  } while (limit_margin_rad(robot, angles) < 0);
  return angles;
}

/// One straight tooth of four, up milling to 60 to 120 degrees: forces as the cutting force model has them.
inline CutLoad random_cut(std::mt19937_64& generator) {
  const double exit = uniform(generator, kPi / 3, 2 * kPi / 3), size = uniform(generator, 100, 600);
  const double across = uniform(generator, 0.2, 0.6), axial = uniform(generator, 0, 0.2);
  const int steps = 90;
  CutLoad cut;
  cut.depth_m = 1e-3;
  cut.turning_n.resize(3, steps);
  for (int i = 0; i < steps; ++i) {
    const double s = std::sin(exit * i / (steps - 1)), c = std::cos(exit * i / (steps - 1));
    cut.turning_n.col(i) = size * s * Eigen::Vector3d(-c - across * s, s - across * c, axial);
  }
  cut.mean_n = 0.8 * cut.turning_n.rowwise().mean();
  cut.walls.push_back({true, cut.turning_n.leftCols(4)});
  return cut;
}

/// Its forces instead of any other, with a feed across a tool axis that is near the vertical.
inline void with_cut(StiffnessTask& task, std::mt19937_64& generator) {
  task.cut = std::make_shared<CutLoad>(random_cut(generator));
  task.feed = Eigen::Vector3d(uniform(generator, -1, 1), uniform(generator, -1, 1), 0.2);
  task.force_n.reset();
  task.force_in_tool = false;
}

inline Eigen::Isometry3d random_frame(std::mt19937_64& generator, double size_m) {
  const auto normal = [&] { return numerics::unit_normal(generator); };
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const double w = normal(), x = normal(), y = normal(), z = normal();
  frame.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  for (double& value : frame.translation()) value = uniform(generator, -size_m, size_m);
  return frame;
}

/// The KR360 as a FANUC would measure it: angle 3 against the horizontal, with the range of joint 3 against
/// the upper arm as its coupled range. Both robots take the same poses.
inline Robot coupled_kr360() {
  Robot robot = kr360();
  Joint& third = robot.joints[2];
  third.coupling = {1, -1};
  third.coupled_min_rad = third.min_rad;
  third.coupled_max_rad = third.max_rad;
  third.min_rad -= robot.joints[1].half_range_rad() * 2 + 1;
  third.max_rad += robot.joints[1].half_range_rad() * 2 + 1;
  return robot;
}

/// Another robot with a spherical wrist: random lengths, offsets, senses, a tilted, shifted base, and coupled
/// axes.
inline Robot random_robot(unsigned seed) {
  std::mt19937_64 generator(seed);
  const auto sign = [&] { return generator() & 1 ? 1.0 : -1.0; };
  Robot robot = kr360();
  auto& j = robot.joints;
  for (auto& joint : j) {
    joint.theta_sign = sign();
    joint.theta_offset_rad = uniform(generator, -kPi, kPi);
    joint.min_rad = uniform(generator, -kPi, -1);
    joint.max_rad = uniform(generator, 1, 2 * kPi);
  }
  j[0].a_m = uniform(generator, -0.3, 0.3);
  j[0].set_alpha(uniform(generator, -1, 1));
  j[1].a_m = uniform(generator, -0.4, 0.4);
  j[1].set_alpha(seed % 3 == 0 ? uniform(generator, 0.5, 2.5) : sign() * kPi / 2);
  j[1].d_m = uniform(generator, -0.2, 0.2);
  j[2].a_m = uniform(generator, 0.3, 1.2);
  j[2].set_alpha(seed % 2 == 0 ? 0 : kPi);
  j[2].d_m = uniform(generator, -0.1, 0.1);
  j[3].a_m = uniform(generator, -0.2, 0.2);
  j[3].set_alpha(seed % 5 == 0 ? uniform(generator, 0.4, 2.6) : sign() * kPi / 2);
  j[3].d_m = uniform(generator, 0.3, 1.1);
  j[4].set_alpha(sign() * kPi / 2);
  j[5].set_alpha(sign() * kPi / 2);
  j[5].d_m = uniform(generator, -0.4, 0.4);
  robot.tool.linear() =
      Eigen::AngleAxisd(uniform(generator, -3, 3), Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  robot.tool.translation() << uniform(generator, -0.3, 0.3), uniform(generator, -0.3, 0.3), 0.2;
  robot.base = random_frame(generator, 1);
  if (seed % 2 == 1) {
    j[2].coupling = {1, sign()};
    j[2].coupled_min_rad = uniform(generator, -kPi, -1);
    j[2].coupled_max_rad = uniform(generator, 1, 2 * kPi);
  }
  if (seed % 4 == 1) {
    j[4].max_rad = 2;  // below a full turn, so that the ratio need not be whole
    j[5].coupling = {4, uniform(generator, -2, 2)};
  }
  return robot;
}

/// Tool straight down at a height (m), whole plane, all redundancy angles, 588.6 N down (the paper's 60 kg).
inline PoseTask tool_down(const Robot& robot, double height_m, std::string_view index,
                          double limit_margin_deg) {
  PoseTask task;
  task.plane.origin.z() = height_m;
  const auto reach = plane_reach(robot, task.plane, task.tool_axis);
  task.x = {reach.x.from, reach.x.to, 64};
  task.y = {reach.y.from, reach.y.to, 64};
  task.redundancy = {-kPi, kPi - kPi / 36, 72};
  task.stiffness.index = &stiffness_index(index);
  task.stiffness.force_n = Eigen::Vector3d(0, 0, -588.6);
  task.elasticity = joints_only(k_theta_2d().cwiseInverse());
  task.limit_margin_rad = radians_from_degrees(limit_margin_deg);
  task.singularity_margin = 0.01;
  return task;
}

}  // namespace stablecut::robot::fixtures
