#include "milling/helical_force.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "milling/cut_schedule.h"

namespace stablecut::milling {
namespace {

// Polynomials of the force beside those of what it depends on: what lies above is hardly felt by these.
constexpr int kForceBeyond = 8;
// Gauss points of a whole arc beside those of the polynomials' products, and of a piece beside its share.
constexpr Eigen::Index kSpareOfArc = 2, kPointsOfPiece = 4;
// Rules are of a multiple of so many points.
constexpr Eigen::Index kRuleStep = 4;

CutSchedule unit_schedule(const HelicalArc& arc, double pitch_rad) {
  CutPiece piece{0, arc.length_rad, {}, {}};
  piece.cutting = [](double) {
    return DirectionalFactors{Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
  };
  return {pitch_rad, 1, {piece}};
}

}  // namespace

HelicalForce::HelicalForce(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                           double largest_depth_m, int polynomials)
    : cutter_(cutter),
      arc_(helical_arc(cutter, largest_depth_m)),
      axes_(structure.axes),
      count_(polynomials),
      unit_(collocate(structure, unit_schedule(arc_, cutter.mean_pitch_rad()), revolutions_per_s,
                      polynomials + kForceBeyond)),
      growth_((structure.lambda * cutter.tooth_period_s(revolutions_per_s)).array().exp()) {
  const Eigen::Index whole = polynomials + kForceBeyond / 2 + kSpareOfArc + kPointsOfPiece;
  for (Eigen::Index points = kRuleStep; points < whole + kRuleStep; points += kRuleStep)
    rules_.push_back(numerics::gauss_legendre(points));
}

Eigen::MatrixXd HelicalForce::forces(double depth_m) const {
  const auto directions = static_cast<Eigen::Index>(axes_.size());
  const Eigen::Index forces = unit_.rows.size() / directions;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(directions * forces, directions * count_);
  const auto whole = static_cast<double>((forces + count_) / 2 + kSpareOfArc);
  for (const CutPiece& piece : helical_pieces(cutter_, depth_m, arc_.from_rad).pieces) {
    const double from = 2 * piece.from_rad / arc_.length_rad - 1, to = 2 * piece.to_rad / arc_.length_rad - 1;
    const auto share = static_cast<Eigen::Index>(std::sqrt((to - from) / 2) * whole);
    const numerics::GaussRule& rule = rules_[(share + kPointsOfPiece - 1) / kRuleStep];
    const Eigen::Index points = rule.node.size();
    // [forces x points] orthonormal polynomials, and [points] the matrix's entries with the weights.
    Eigen::MatrixXd values(forces, points);
    std::vector<Eigen::VectorXd> entries(directions * directions, Eigen::VectorXd(points));
    for (Eigen::Index i = 0; i < points; ++i) {
      const double place = (from + to) / 2 + (to - from) / 2 * rule.node[i];
      values.col(i) = numerics::orthonormal_legendre(place, forces);
      const DirectionalFactors factors = piece.cutting((place + 1) / 2 * arc_.length_rad);
      const Eigen::MatrixXd matrix = factors.drive * factors.sense;
      for (Eigen::Index b = 0; b < directions; ++b)
        for (Eigen::Index a = 0; a < directions; ++a)
          entries[b * directions + a][i] = (to - from) / 2 * rule.weight[i] * matrix(axes_[b], axes_[a]);
    }
    for (Eigen::Index b = 0; b < directions; ++b)
      for (Eigen::Index a = 0; a < directions; ++a)
        result.block(b * forces, a * count_, forces, count_).noalias() +=
            (values * entries[b * directions + a].asDiagonal()) * values.topRows(count_).transpose();
  }
  return result;
}

CircleOperator HelicalForce::operator_of(const Eigen::MatrixXd& forces) const {
  CircleOperator result;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index r = 0; r < static_cast<Eigen::Index>(unit_.rows.size()); ++r) {
    if (unit_.polynomials[r].degree >= count_) continue;
    rows.push_back(r);
    result.polynomials.push_back(unit_.polynomials[r]);
  }
  result.parts = {
      {0, unit_.difference_of_drive(rows, Eigen::all) * forces, unit_.difference_of_state(rows, Eigen::all)}};
  result.state_of = unit_.final_of_drive * forces;
  result.growth = growth_;
  result.plain = true;
  result.arc_length = {1};
  return result;
}

}  // namespace stablecut::milling
