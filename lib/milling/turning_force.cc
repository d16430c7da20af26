#include "milling/turning_force.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "milling/edge_force.h"

namespace stablecut::milling {
namespace {

constexpr double kTurnStep = kPi / 180;  // rad
Eigen::Matrix3Xd matrix_of(const std::vector<Eigen::Vector3d>& columns) {
  Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
  return matrix;
}

Eigen::Matrix3Xd over_period(const EdgeForce& force) {
  std::vector<Eigen::Vector3d> forces;
  for (const double from : force.breaks()) {
    const double length = force.room(from, true);
    const int steps = static_cast<int>(std::ceil(length / kTurnStep));
    for (int k = 0; k <= steps; ++k)
      forces.push_back(force.at(from + length * k / steps, from + 0.5 * length).head<3>());
  }
  return matrix_of(forces);
}

// Of the teeth that touch a wall at this angle of their tips: they enter there, or leave.
Eigen::Matrix3Xd while_leaving(const EdgeForce& force, double angle_rad, bool entering) {
  // A long edge has all that a period has.
  const double along = std::clamp(force.lag_rad(), -force.period_rad(), force.period_rad());
  const int steps = static_cast<int>(std::ceil(std::abs(along) / kTurnStep));
  std::vector<Eigen::Vector3d> forces;
  for (int k = 0; k <= steps; ++k) {
    const double turn = angle_rad + (steps > 0 ? along * k / steps : 0);
    const double beside = turn + (entering ? 0.5 : -0.5) * force.room(turn, entering);
    forces.push_back(force.at(turn, beside).head<3>());
  }
  return matrix_of(forces);
}

}  // namespace

TurningForce turning_force(const Cutter& cutter, const CuttingLoad& load, double depth_m) {
  const EdgeForce edge(cutter, load, depth_m);
  TurningForce force{edge.mean().head<3>(), over_period(edge), {}};
  for (const double wall : wall_angles(cutter)) {
    Eigen::Matrix3Xd leaving(3, 0);
    if (cuts_alike(cutter, load)) leaving = while_leaving(edge, wall, wall == 0);
    force.walls.push_back({wall, std::move(leaving)});
  }
  return force;
}

}  // namespace stablecut::milling
