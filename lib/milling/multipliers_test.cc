#include "milling/multipliers.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace stablecut;
using Complex = std::complex<double>;

namespace {

// Greatest distance from a value to its nearest partner, each partner used once.
double mismatch(const Eigen::VectorXcd& values, const Eigen::VectorXcd& expected) {
  std::vector<Complex> left(expected.begin(), expected.end());
  double worst = 0;
  for (const Complex& value : values) {
    const auto nearest = std::min_element(left.begin(), left.end(), [&](Complex a, Complex b) {
      return std::abs(a - value) < std::abs(b - value);
    });
    worst = std::max(worst, std::abs(*nearest - value));
    left.erase(nearest);
  }
  return worst;
}

}  // namespace

TEST_CASE("eigenvalues of random matrices are those of the Schur form") {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  for (const int n : {1, 2, 3, 4, 7, 20, 54, 90}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::MatrixXd matrix = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
      const Eigen::VectorXcd values = eigenvalues(matrix);
      REQUIRE(values.size() == n);
      CHECK(mismatch(values, Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues()) <
            1e-11 * matrix.norm());
      CHECK(std::abs(values.sum() - matrix.trace()) < 1e-12 * n * matrix.norm());
    }
  }
}

TEST_CASE("rotations, zero, identity, companion and permutation matrices") {
  Eigen::Matrix3d cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  CHECK(mismatch(eigenvalues(cycle), Eigen::Vector3cd(1, std::polar(1.0, 2.0943951023931957),
                                                      std::polar(1.0, -2.0943951023931957))) < 1e-14);
  CHECK(eigenvalues(Eigen::MatrixXd::Zero(5, 5)).cwiseAbs().maxCoeff() == 0);
  CHECK(mismatch(eigenvalues(Eigen::MatrixXd::Identity(6, 6)), Eigen::VectorXcd::Ones(6)) < 1e-15);
  // A multiplier near 1 beside a defective block of delays (a shift register).
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(9, 9);
  shift.diagonal(-1).setOnes();
  shift(0, 0) = 0.9967;
  CHECK(eigenvalues(shift).cwiseAbs().maxCoeff() == Approx(0.9967).epsilon(1e-13));
}
