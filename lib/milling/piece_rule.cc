#include "milling/piece_rule.h"

#include "numerics/exponential_moments.h"

namespace stablecut::milling {

PieceRule::PieceRule(double length, int points)
    : length_(length),
      rule_(numerics::gauss_legendre(points)),
      transform_(numerics::legendre_transform(rule_)) {
  places_.resize(points + 1);
  places_ << rule_.node, 1.0;
}

void PieceRule::set_places(const Eigen::VectorXd& places) {
  places_ = places;
  legendre_.resize(0, 0);
}

Eigen::RowVectorXd PieceRule::force(double place) const {
  return numerics::legendre_values(place, points()).transpose() * transform_;
}

Eigen::RowVectorXcd PieceRule::response(std::complex<double> lambda, double place) const {
  const numerics::ExponentialMoments moments(lambda * (length_ / 2), points());
  return (length_ / 2) * (moments.at(place).transpose() * transform_);
}

Eigen::MatrixXcd PieceRule::responses(std::complex<double> lambda) {
  const numerics::ExponentialMoments moments(lambda * (length_ / 2), points());
  if (legendre_.cols() < moments.legendre_count()) {
    legendre_.resize(places_.size(), moments.legendre_count());
    for (Eigen::Index i = 0; i < places_.size(); ++i)
      legendre_.row(i) = numerics::legendre_values(places_[i], legendre_.cols()).transpose();
  }
  const Eigen::MatrixXcd at_places = moments.at(places_, legendre_);
  Eigen::MatrixXcd result(places_.size(), points());
  result.real() = (length_ / 2) * at_places.real() * transform_;
  result.imag() = (length_ / 2) * at_places.imag() * transform_;
  return result;
}

}  // namespace stablecut::milling
