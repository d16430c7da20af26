#include "milling/spectral.h"

#include <Eigen/LU>
#include <complex>

#include "base/units.h"
#include "milling/cut_schedule.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// The differences d that the rows sense, in displacement scales, from the map's state [q, u]: [rows x state].
// From d = E q + depth W d - (what u remembers): d = (I - depth W)^-1 (E q - what u remembers).
Eigen::MatrixXd differences(const Collocation& c, double depth_m, double scale) {
  const Eigen::Index states = c.final_of_state.rows(), rows = c.rows.size();
  const Eigen::PartialPivLU<Eigen::MatrixXd> implicit(Eigen::MatrixXd::Identity(rows, rows) -
                                                      depth_m * c.difference_of_drive);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(rows, states + c.remembered_count);
  right.leftCols(states) = c.difference_of_state / scale;
  for (Eigen::Index r = 0; r < rows; ++r) {
    if (const Eigen::Index entry = c.rows[r].remembered; entry >= 0) right(r, states + entry) = -1;
  }
  return implicit.solve(right);
}

// The map of [q, u] over a period. A row whose surface was cut in the period before remembers, for the next
// period, what the row that cuts this surface senses now: a sum of differences back to a remembered one.
Eigen::MatrixXd monodromy_of(const Collocation& c, double depth_m, double scale) {
  const Eigen::MatrixXd difference = differences(c, depth_m, scale);
  const Eigen::Index states = c.final_of_state.rows(), size = states + c.remembered_count;
  Eigen::MatrixXd map(size, size);
  map.topRows(states).noalias() = (scale * depth_m) * c.final_of_drive * difference;
  map.topLeftCorner(states, states) += c.final_of_state;
  for (const SensedRow& row : c.rows) {
    if (row.remembered < 0) continue;
    auto next = map.row(states + row.remembered);
    Eigen::Index cutting = row.cut_by;
    next = difference.row(cutting);
    while (c.rows[cutting].remembered < 0) {
      cutting = c.rows[cutting].cut_by;
      next += difference.row(cutting);
    }
    next[states + c.rows[cutting].remembered] += 1;
  }
  return map;
}

}  // namespace

SpectralMap::SpectralMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                         int points)
    : SpectralMap(structure, cutter, cut_schedule(cutter, revolutions_per_s, 0), revolutions_per_s, points) {}

SpectralMap::SpectralMap(const TipStructure& structure, const Cutter& cutter, const CutSchedule& at_no_depth,
                         double revolutions_per_s, int points)
    : PeriodMap(structure, at_no_depth.period_rad / (kTwoPi * revolutions_per_s), at_no_depth.passes),
      cutter_(cutter),
      revolutions_per_s_(revolutions_per_s),
      points_(points) {
  if (!cutter.changes_with_depth()) fixed_ = collocate(structure, at_no_depth, revolutions_per_s, points);
}

SpectralMap::SpectralMap(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
                         int points)
    : PeriodMap(structure, schedule.period_rad / (kTwoPi * revolutions_per_s), schedule.passes),
      revolutions_per_s_(revolutions_per_s),
      points_(points),
      fixed_(collocate(structure, schedule, revolutions_per_s, points)) {}

Collocation SpectralMap::at_depth(double depth_m) const {
  return collocate(structure(), cut_schedule(cutter_, revolutions_per_s_, depth_m, points_),
                   revolutions_per_s_, points_, Rows::kByNode);
}

Eigen::MatrixXd SpectralMap::monodromy(double depth_m) const {
  const double scale = structure().displacement_scale_m;
  return fixed_ ? monodromy_of(*fixed_, depth_m, scale) : monodromy_of(at_depth(depth_m), depth_m, scale);
}

std::vector<ForceImpulse> SpectralMap::forces(double depth_m, Complex, const Eigen::VectorXcd& state) const {
  const Collocation helical = fixed_ ? Collocation{} : at_depth(depth_m);
  const Collocation& c = fixed_ ? *fixed_ : helical;
  const Eigen::VectorXcd sensed = differences(c, depth_m, structure().displacement_scale_m) * state;
  return forces_of(c.nodes, at_nodes(c, sensed));
}

std::vector<ForceImpulse> forces_of(const std::vector<CollocationNode>& nodes,
                                    const Eigen::VectorXcd& numbers) {
  std::vector<ForceImpulse> result;
  for (const CollocationNode& node : nodes) {
    result.push_back(
        {node.time_s, node.weight_s * (node.drive * numbers.segment(node.first_row, node.drive.cols()))});
  }
  return result;
}

}  // namespace stablecut::milling
