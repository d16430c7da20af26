#include "numerics/exponential_moments.h"

#include <algorithm>
#include <cmath>

#include "numerics/legendre.h"

namespace stablecut::numerics {
namespace {

using Complex = std::complex<double>;

constexpr double kSeriesReach = 0.5;  // |w| below which the quotient is summed
constexpr int kSeriesTerms = 20;
constexpr Eigen::Index kTail = 24;  // rows beyond the last wanted moment, besides |Re z|

// (exp(w) - 1) / w without cancellation.
Complex exponential_quotient(Complex w) {
  if (std::abs(w) > kSeriesReach) return (std::exp(w) - 1.0) / w;
  Complex term = 1, sum = 1;
  for (int k = 2; k < kSeriesTerms; ++k) {
    term *= w / static_cast<double>(k);
    sum += term;
  }
  return sum;
}

}  // namespace

ExponentialMoments::ExponentialMoments(Complex z, Eigen::Index count)
    : z_(z),
      count_(count),
      forward_(std::abs(z.imag()) < 1 ? 0 : static_cast<Eigen::Index>(std::abs(z.imag()))),
      tail_(std::max(count, forward_) + kTail + static_cast<Eigen::Index>(std::abs(z.real()))),
      factor_(Eigen::VectorXcd::Zero(tail_)),
      inverse_pivot_(Eigen::VectorXcd::Zero(tail_)) {
  // Unknown: j = forward+1 ... tail-1, row j: -z I_{j-1} - (2j+1) I_j + z I_{j+1} = -jump(j).
  for (Eigen::Index j = forward_ + 1; j < tail_; ++j) {
    Complex pivot = -static_cast<double>(2 * j + 1);
    if (j > forward_ + 1) {
      factor_[j] = z * inverse_pivot_[j - 1];
      pivot += factor_[j] * z;
    }
    inverse_pivot_[j] = 1.0 / pivot;
  }
}

Eigen::VectorXcd ExponentialMoments::at(double x) const {
  return at(Eigen::VectorXd::Constant(1, x), legendre_values(x, legendre_count()).transpose()).transpose();
}

Eigen::MatrixXcd ExponentialMoments::at(const Eigen::VectorXd& x, const Eigen::MatrixXd& p) const {
  const Eigen::Index n = x.size();
  // Real and imaginary parts by themselves: all places go through in step.
  Eigen::ArrayXXd re(n, tail_ + 1), im(n, tail_ + 1);
  const auto set = [&](Eigen::Index row, Eigen::Index j, Complex value) {
    re(row, j) = value.real();
    im(row, j) = value.imag();
  };
  const auto jump = [&](Eigen::Index j) { return (p.col(j + 1) - p.col(j - 1)).array(); };
  // Adds a factor times moment `from` to moment `to`.
  const auto add = [&](Complex factor, Eigen::Index from, Eigen::Index to) {
    re.col(to) += factor.real() * re.col(from) - factor.imag() * im.col(from);
    im.col(to) += factor.real() * im.col(from) + factor.imag() * re.col(from);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const Complex first = (x[i] + 1) * exponential_quotient(z_ * (x[i] + 1));
    set(i, 0, first);
    if (forward_ > 0) set(i, 1, (first - x[i] - std::exp(z_ * (x[i] + 1))) / z_);
  }
  if (forward_ > 0) {
    const Complex inverse = 1.0 / z_;
    for (Eigen::Index j = 1; j < forward_; ++j) {
      re.col(j + 1) = re.col(j - 1) - jump(j) * inverse.real();
      im.col(j + 1) = im.col(j - 1) - jump(j) * inverse.imag();
      add(static_cast<double>(2 * j + 1) * inverse, j, j + 1);
    }
  }
  re.col(tail_) = jump(tail_) / static_cast<double>(2 * tail_ + 1);
  im.col(tail_).setZero();
  for (Eigen::Index j = forward_ + 1; j < tail_; ++j) {
    re.col(j) = -jump(j);
    im.col(j).setZero();
    add(j == forward_ + 1 ? z_ : factor_[j], j - 1, j);
  }
  for (Eigen::Index j = tail_ - 1; j > forward_; --j) {
    add(-z_, j + 1, j);
    const Complex by = inverse_pivot_[j];
    const Eigen::ArrayXd real = by.real() * re.col(j) - by.imag() * im.col(j);
    im.col(j) = by.real() * im.col(j) + by.imag() * re.col(j);
    re.col(j) = real;
  }
  Eigen::MatrixXcd moments(n, count_);
  moments.real() = re.leftCols(count_);
  moments.imag() = im.leftCols(count_);
  return moments;
}

}  // namespace stablecut::numerics
