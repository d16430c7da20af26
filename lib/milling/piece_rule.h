// The Gauss points of a piece of the cut, and how a mode responds to a force through them.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "numerics/legendre.h"

namespace stablecut::milling {

/// Of all pieces of one length, in s, or in radians of turn with poles per radian. The force on a piece is
/// the polynomial through its values at the points.
class PieceRule {
 public:
  PieceRule(double length, int points);

  double length() const { return length_; }
  const numerics::GaussRule& rule() const { return rule_; }
  Eigen::Index points() const { return rule_.node.size(); }

  /// [points]: the force at a place in [-1, 1] of the piece per value at the points.
  Eigen::RowVectorXd force(double place) const;
  /// [points]: the coordinate of a mode (of the pole lambda) at a place of the piece, which it entered at
  /// rest, per value at the points of the rate at which the force drives it.
  Eigen::RowVectorXcd response(std::complex<double> lambda, double place) const;
  /// Places of the piece for responses(); at first the points and the end.
  void set_places(const Eigen::VectorXd& places);
  /// [places x points]: the same at each of them.
  Eigen::MatrixXcd responses(std::complex<double> lambda);

 private:
  double length_;
  numerics::GaussRule rule_;
  Eigen::MatrixXd transform_;  // Legendre coefficients from values at the points
  Eigen::VectorXd places_;
  Eigen::MatrixXd legendre_;  // [places x polynomials] there
};

}  // namespace stablecut::milling
