#include "modal/pole_sums.h"

#include <catch2/catch.hpp>

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

TEST_CASE("inner products by partial fractions equal the sums over the lines") {
  const Eigen::Index lines = 400;
  Eigen::VectorXcd s(lines);
  Eigen::VectorXd weight(lines);
  for (Eigen::Index i = 0; i < lines; ++i) {
    s[i] = Complex(0, 10 + 2.5 * static_cast<double>(i));
    weight[i] = 1 + 0.5 * std::sin(0.1 * static_cast<double>(i)) + 1e-3 * static_cast<double>(i * i);
  }
  // A close pair, a heavily damped pole, and poles outside the band.
  const Eigen::VectorXcd poles = (Eigen::VectorXcd(5) << Complex(-4, 300), Complex(-4.2, 301),
                                  Complex(-120, 500), Complex(-1, 3), Complex(-40, 2500))
                                     .finished();
  const PoleValues values(s, poles);
  Eigen::VectorXcd sum(10), sum_squared(10);
  sum << values.phi.transpose() * weight, values.phi_conj.transpose() * weight;
  for (Eigen::Index k = 0; k < 5; ++k) {
    sum_squared[k] = (values.phi.col(k).array().square() * weight.array()).sum();
    sum_squared[5 + k] = (values.phi_conj.col(k).array().square() * weight.array()).sum();
  }
  PoleGrams grams(poles);
  grams.evaluate(sum, sum_squared);
  Eigen::MatrixXcd own(lines, 10), mirrored(lines, 10);
  for (Eigen::Index k = 0; k < 5; ++k) {
    own.col(2 * k) = values.phi.col(k);
    own.col(2 * k + 1) = values.phi.col(k).array().square();
    mirrored.col(2 * k) = values.phi_conj.col(k);
    mirrored.col(2 * k + 1) = values.phi_conj.col(k).array().square();
  }
  const auto check = [&](const Eigen::MatrixXcd& gram, const Eigen::MatrixXcd& left,
                         const Eigen::MatrixXcd& right) {
    const Eigen::MatrixXcd expected = left.adjoint() * weight.asDiagonal() * right;
    const Eigen::VectorXd a = (weight.cwiseSqrt().asDiagonal() * left).colwise().norm();
    const Eigen::VectorXd b = (weight.cwiseSqrt().asDiagonal() * right).colwise().norm();
    // Cancellation grows with distance over damping, to the fourth power for two squares.
    CHECK(((gram - expected).cwiseAbs().array() / (a * b.transpose()).array()).maxCoeff() < 1e-7);
  };
  check(grams.same, own, own);
  check(grams.mirrored, mirrored, mirrored);
  check(grams.across, own, mirrored);
}

TEST_CASE("sums of a curve in one pass, for any number of lines") {
  for (const Eigen::Index lines : {5, 8, 203}) {
    const Eigen::VectorXd omega = Eigen::VectorXd::LinSpaced(lines, 1, 900);
    const Eigen::VectorXcd s = std::complex<double>(0, 1) * omega.cast<std::complex<double>>();
    Eigen::VectorXcd poles(2), h(lines);
    poles << std::complex<double>(-3, 120), std::complex<double>(-40, 700);
    const Eigen::VectorXd weight = omega.cwiseInverse();
    for (Eigen::Index i = 0; i < lines; ++i)
      h[i] = std::polar(1.0 + 0.01 * static_cast<double>(i), 0.3 * static_cast<double>(i));
    const PoleValues values(s, poles);
    Eigen::MatrixXcd phi(lines, 4), c(lines, 4);
    phi << values.phi, values.phi_conj;
    c << weight.cast<std::complex<double>>(), weight.cwiseProduct(h), weight.cwiseProduct(h.conjugate()),
        weight.cwiseProduct(h.cwiseAbs2()).cast<std::complex<double>>();
    const Eigen::MatrixXcd expected = phi.transpose() * c;
    CHECK((data_pole_sums(s, poles, weight, h) - expected).norm() < 1e-13 * expected.norm());
  }
}
