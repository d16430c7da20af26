// The force of helical teeth as an operator at any depth: the structure's response to polynomials along the
// whole arc, which belongs to the speed, times what the directional matrix of a depth makes of them.
// README.md, "Helical teeth".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "milling/circle_operator.h"
#include "milling/collocation.h"
#include "milling/cut_schedule.h"
#include "milling/cutter.h"
#include "milling/structure.h"
#include "numerics/legendre.h"

namespace stablecut::milling {

class HelicalForce {
 public:
  /// `polynomials` >= 1 for each direction. Equal pitch, no process damping.
  HelicalForce(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
               double largest_depth_m, int polynomials);

  /// [forces x rows] The force per depth, in polynomials of each direction, that the rows make at a depth
  /// (m): the directional matrix times polynomials. All integrals are those of its smooth pieces.
  Eigen::MatrixXd forces(double depth_m) const;
  /// What follows the force of a depth's `forces`.
  CircleOperator operator_of(const Eigen::MatrixXd& forces) const;

  const Collocation& unit() const { return unit_; }
  Eigen::Index count() const { return count_; }

 private:
  Cutter cutter_;
  HelicalArc arc_;
  std::vector<Eigen::Index> axes_;
  Eigen::Index count_;
  Collocation unit_;  // of forces in each direction by themselves
  Eigen::VectorXcd growth_;
  std::vector<numerics::GaussRule> rules_;  // of 1, 2, ... times kRuleStep points
};

}  // namespace stablecut::milling
