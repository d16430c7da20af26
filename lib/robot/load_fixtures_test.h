// Load samples with known stiffness that the tests of identification and plans share.
#pragma once

#include <string>
#include <vector>

#include "robot/identification.h"
#include "robot/inverse.h"
#include "robot/robot_fixtures_test.h"

namespace stablecut::robot::fixtures {

struct Setup {
  std::vector<JointAngles> poses;
  std::vector<Eigen::Vector3d> loads;
  Eigen::Vector3d force_point{0, 0, 0.21}, measuring_point{0, 0, 0.21};
  bool rotations = false;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

inline const Eigen::Vector3d kDown(0, 0, -588.6);
inline const std::vector<Eigen::Vector3d> kThreeLoads = {{600, 0, 0}, {0, 600, 0}, {0, 0, -600}};

// Tool straight down on a grid of a plane, or of a cube: the first branch inside the limits.
inline std::vector<JointAngles> tool_down_poses(const Robot& robot, std::vector<double> heights) {
  const InverseKinematics inverse(robot);
  std::vector<JointAngles> poses;
  for (const double z : heights) {
    for (const double x : {1.2, 1.5, 1.8}) {
      for (const double y : {-0.6, -0.2, 0.3, 0.7}) {
        for (const auto& s : inverse.solve(tool_frame({x, y, z}, -Eigen::Vector3d::UnitZ(), 0.3 * x))) {
          if (s.limit_margin_rad < 0) continue;
          poses.push_back(s.angles);
          break;
        }
      }
    }
  }
  return poses;
}

inline std::vector<JointAngles> random_poses(const Robot& robot, int count, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::vector<JointAngles> poses;
  while (static_cast<int>(poses.size()) < count) poses.push_back(random_angles(robot, generator));
  return poses;
}

// Exact measurements of the 2D stiffness.
inline std::vector<LoadSample> samples_of(const Robot& robot, const Setup& setup) {
  std::vector<LoadSample> samples;
  const JointAngles c = k_theta_2d().cwiseInverse();
  for (const JointAngles& angles : setup.poses) {
    for (const Eigen::Vector3d& load : setup.loads) {
      LoadSample sample;
      sample.angles = angles;
      sample.force_n = load;
      sample.moment_n_m = setup.moment;
      sample.force_point = setup.force_point;
      sample.measuring_point = setup.measuring_point;
      const RobotPose pose = robot_pose(robot, angles);
      const Matrix6d at_load = jacobian(pose, pose.flange * sample.force_point);
      const Matrix6d at_measurement = jacobian(pose, pose.flange * sample.measuring_point);
      Eigen::Matrix<double, 6, 1> wrench;
      wrench << load, setup.moment;
      const Eigen::Matrix<double, 6, 1> movement =
          at_measurement * c.cwiseProduct(at_load.transpose() * wrench);
      sample.deflection_m = movement.head<3>();
      if (setup.rotations) sample.rotation_rad = movement.tail<3>();
      samples.push_back(sample);
    }
  }
  return samples;
}

inline void add_noise(std::vector<LoadSample>& samples, double std_m, double std_rad,
                      std::mt19937_64& generator) {
  for (LoadSample& sample : samples) {
    for (double& value : sample.deflection_m) value += std_m * numerics::unit_normal(generator);
    if (!sample.rotation_rad) continue;
    for (double& value : *sample.rotation_rad) value += std_rad * numerics::unit_normal(generator);
  }
}

inline std::string identified(const Identification& found) {
  std::string joints;
  for (int j = 0; j < kJoints; ++j) joints += found.identified(j) ? static_cast<char>('1' + j) : '-';
  return joints;
}

inline double worst_error(const Identification& found) {
  double worst = 0;
  for (int j = 0; j < kJoints; ++j) {
    if (found.identified(j)) worst = std::max(worst, std::abs(found.compliance[j] * k_theta_2d()[j] - 1));
  }
  return worst;
}

}  // namespace stablecut::robot::fixtures
