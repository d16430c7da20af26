#include "robot/load_sample.h"

#include <algorithm>

namespace stablecut::robot {
namespace {

constexpr double kLeastPlausible = 1e-6, kMostPlausible = 0.02;  // m, of the largest deflection

}  // namespace

ComplianceEquations compliance_equations(const Robot& robot, const std::vector<Spring>& springs,
                                         const std::vector<LoadSample>& samples,
                                         const std::array<bool, 3>& components) {
  ComplianceEquations equations;
  equations.springs = springs;
  const Eigen::Index n = springs.size();
  Eigen::Index count = 0;
  bool with_std = true;
  for (const LoadSample& sample : samples) {
    count += std::count(components.begin(), components.end(), true) + (sample.rotation_rad ? 3 : 0);
    with_std = with_std && sample.deflection_std_m && (!sample.rotation_rad || sample.rotation_std_rad);
  }
  equations.a.resize(count, n);
  equations.largest.resize(count, n);
  equations.b.resize(count);
  if (with_std) equations.std.resize(count);
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const LoadSample& sample = samples[s];
    const RobotPose pose = robot_pose(robot, sample.angles);
    const Eigen::Vector3d force_point = pose.flange * sample.force_point;
    const Eigen::Vector3d measuring_point = pose.flange * sample.measuring_point;
    Eigen::Matrix3Xd moved(3, n), turned(3, n);  // by the load, per unit of compliance
    Eigen::RowVectorXd largest_load(n), lever(n), turns(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const SpringAxis axis = spring_axis(pose, springs[k]);
      double load = axis.load(sample.force_n, force_point, sample.moment_n_m);
      if (sample.with_own_weight) load += weight_load(robot, pose, springs[k]);
      moved.col(k) = load * axis.displacement(measuring_point);
      turned.col(k) = load * axis.rotation();
      turns[k] = axis.turns ? 1 : 0;
      largest_load[k] = sample.force_n.norm();
      lever[k] = 1;
      if (!axis.turns) continue;
      largest_load[k] = (force_point - axis.point).norm() * sample.force_n.norm() + sample.moment_n_m.norm();
      lever[k] = (measuring_point - axis.point).norm();
    }
    const auto add = [&](const auto& per_compliance, const Eigen::RowVectorXd& arm, double measured,
                         const std::optional<Eigen::Vector3d>& std, int component, bool rotation) {
      equations.a.row(row) = per_compliance;
      equations.largest.row(row) = arm.cwiseProduct(largest_load);
      equations.b[row] = measured;
      if (with_std) equations.std[row] = (*std)[component];
      equations.sample.push_back(static_cast<int>(s));
      equations.rotation.push_back(rotation);
      ++row;
    };
    for (int d = 0; d < 3; ++d) {
      if (components[d]) add(moved.row(d), lever, sample.deflection_m[d], sample.deflection_std_m, d, false);
    }
    for (int d = 0; d < 3 && sample.rotation_rad; ++d)
      add(turned.row(d), turns, (*sample.rotation_rad)[d], sample.rotation_std_rad, d, true);
  }
  return equations;
}

ComplianceEquations with_springs(const ComplianceEquations& equations, const std::vector<Spring>& springs) {
  std::vector<Eigen::Index> columns;
  for (const Spring& spring : springs) {
    const auto found = std::find(equations.springs.begin(), equations.springs.end(), spring);
    columns.push_back(found - equations.springs.begin());
  }
  ComplianceEquations part = equations;
  part.springs = springs;
  part.a = equations.a(Eigen::all, columns);
  part.largest = equations.largest(Eigen::all, columns);
  return part;
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
