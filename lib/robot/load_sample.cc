#include "robot/load_sample.h"

#include <algorithm>

namespace stablecut::robot {
namespace {

constexpr double kLeastPlausible = 1e-6, kMostPlausible = 0.02;  // m, of the largest deflection

}  // namespace

ComplianceEquations compliance_equations(const Robot& robot, const std::vector<LoadSample>& samples,
                                         const std::array<bool, 3>& components) {
  struct Row {
    Eigen::Matrix<double, 1, kJoints> a, largest;
    double b, std;
  };
  ComplianceEquations equations;
  std::vector<Row> rows;
  bool with_std = true;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const LoadSample& sample = samples[s];
    const RobotPose pose = robot_pose(robot, sample.angles);
    const Eigen::Vector3d force_point = pose.flange * sample.force_point;
    const Eigen::Vector3d measuring_point = pose.flange * sample.measuring_point;
    const auto at_force = translational_jacobian(pose, force_point);
    const auto at_measurement = translational_jacobian(pose, measuring_point);
    const JointAngles torque =
        at_force.transpose() * sample.force_n + pose.axis.transpose() * sample.moment_n_m;
    JointAngles largest_torque, lever;
    for (int j = 0; j < kJoints; ++j) {
      largest_torque[j] =
          (force_point - pose.point.col(j)).norm() * sample.force_n.norm() + sample.moment_n_m.norm();
      lever[j] = (measuring_point - pose.point.col(j)).norm();
    }
    const auto add = [&](const auto& direction, const auto& largest, double measured,
                         const std::optional<Eigen::Vector3d>& std, int component, bool rotation) {
      Row row;
      row.a = direction.cwiseProduct(torque.transpose());
      row.largest = largest.cwiseProduct(largest_torque).transpose();
      row.b = measured;
      row.std = std ? (*std)[component] : 0;
      with_std = with_std && std;
      rows.push_back(row);
      equations.sample.push_back(static_cast<int>(s));
      equations.rotation.push_back(rotation);
    };
    for (int d = 0; d < 3; ++d) {
      if (components[d]) {
        add(at_measurement.row(d), lever, sample.deflection_m[d], sample.deflection_std_m, d, false);
      }
    }
    for (int d = 0; d < 3 && sample.rotation_rad; ++d) {
      add(pose.axis.row(d), JointAngles(JointAngles::Ones()), (*sample.rotation_rad)[d],
          sample.rotation_std_rad, d, true);
    }
  }
  const Eigen::Index count = rows.size();
  equations.a.resize(count, kJoints);
  equations.largest.resize(count, kJoints);
  equations.b.resize(count);
  if (with_std) equations.std.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Row& row = rows[i];
    equations.a.row(i) = row.a;
    equations.largest.row(i) = row.largest;
    equations.b[i] = row.b;
    if (with_std) equations.std[i] = row.std;
  }
  return equations;
}

double largest_deflection(const std::vector<LoadSample>& samples) {
  double largest = 0;
  for (const LoadSample& sample : samples) largest = std::max(largest, sample.deflection_m.norm());
  return largest;
}

bool plausible_deflection(double largest_m) {
  return largest_m == 0 || (largest_m >= kLeastPlausible && largest_m <= kMostPlausible);
}

}  // namespace stablecut::robot
