#include "numerics/eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "numerics/eigenvalue_lanes.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::numerics;
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

TEST_CASE("all eigenvalues of random matrices are those of the Schur form, and sum to the trace") {
  std::mt19937_64 generator(3);
  for (const int n : {1, 2, 3, 4, 7, 20, 54, 90}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::MatrixXd matrix =
          Eigen::MatrixXd::NullaryExpr(n, n, [&] { return unit_normal(generator); });
      const Eigen::VectorXcd values = leading_eigenvalues(matrix, n);  // too many states to stop early
      REQUIRE(values.size() == n);
      CHECK(mismatch(values, eigenvalues(matrix)) < 1e-11 * matrix.norm());
      CHECK(std::abs(values.sum() - matrix.trace()) < 1e-12 * n * matrix.norm());
    }
  }
}

TEST_CASE("matrices side by side have the eigenvalues of each alone") {
  std::mt19937_64 generator(4);
  for (const int n : {1, 2, 3, 5, 21, 47}) {
    for (const std::size_t count : {1U, 8U, 11U}) {
      std::vector<Eigen::MatrixXd> matrices;
      for (std::size_t i = 0; i < count; ++i) {
        matrices.push_back(Eigen::MatrixXd::NullaryExpr(n, n, [&] { return unit_normal(generator); }));
        // Blocks that part early.
        if (i % 3 == 1) matrices.back().bottomLeftCorner(n / 2, n - n / 2).setZero();
      }
      std::size_t alone = 1;
      const auto values = eigenvalues_of_each(matrices, &alone);
      CHECK(alone == 0);
      REQUIRE(values.size() == count);
      for (std::size_t i = 0; i < count; ++i)
        CHECK(mismatch(values[i], eigenvalues(matrices[i])) < 1e-11 * (1 + matrices[i].norm()));
    }
  }
  CHECK(eigenvalues_of_each({}).empty());
}

TEST_CASE("matrices so large that their squares overflow are solved alone") {
  std::mt19937_64 generator(6);
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::NullaryExpr(12, 12, [&] { return unit_normal(generator); });
  std::size_t alone = 0;
  const auto values = eigenvalues_of_each({matrix, 1e160 * matrix}, &alone);
  CHECK(alone == 2);
  CHECK(mismatch(values[1] / 1e160, values[0]) < 1e-11 * matrix.norm());
}

TEST_CASE("rotations, zero, identity, companion and permutation matrices") {
  Eigen::Matrix3d cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  CHECK(mismatch(eigenvalues_of_each({cycle})[0], Eigen::Vector3cd(1, std::polar(1.0, 2.0943951023931953),
                                                                   std::polar(1.0, -2.0943951023931953))) <
        1e-14);
  CHECK(eigenvalues_of_each({Eigen::MatrixXd::Zero(5, 5)})[0].cwiseAbs().maxCoeff() == 0);
  CHECK(mismatch(eigenvalues_of_each({Eigen::MatrixXd::Identity(6, 6)})[0], Eigen::VectorXcd::Ones(6)) <
        1e-15);
  // A multiplier near 1 beside a defective block of delays (a shift register).
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(9, 9);
  shift.diagonal(-1).setOnes();
  shift(0, 0) = 0.9967;
  CHECK(eigenvalues_of_each({shift})[0].cwiseAbs().maxCoeff() == Approx(0.9967).epsilon(1e-13));
}

TEST_CASE("the largest modulus: early stops agree with all eigenvalues") {
  std::mt19937_64 generator(5);
  const auto random = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return unit_normal(generator); }).eval();
  };
  for (const Eigen::Index n : {1, 2, 3, 12, 40}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::MatrixXd matrix = random(n, n);
      CHECK(leading_eigenvalues(matrix, (n + 1) / 2).cwiseAbs().maxCoeff() ==
            Approx(eigenvalues(matrix).cwiseAbs().maxCoeff()).epsilon(1e-11).margin(1e-12));
    }
  }
  // Few states and a quickly falling rest, in units that differ by 1e6; two structures that do not touch, of
  // which the start may see more of the weaker one.
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Index n = 50, states = 8;
    Eigen::MatrixXd matrix = random(n, n);
    for (Eigen::Index i = states; i < n; ++i) matrix.row(i) *= std::pow(0.6, static_cast<double>(i - states));
    if (trial % 2 == 1) {
      matrix.topRightCorner(n / 2, n / 2).setZero();
      matrix.bottomLeftCorner(n / 2, n / 2).setZero();
      matrix(n - 1, n - 1) = 9;
    }
    const double expected = eigenvalues(matrix).cwiseAbs().maxCoeff();
    matrix.topRightCorner(states, n - states) *= 1e-6;
    matrix.bottomLeftCorner(n - states, states) *= 1e6;
    CHECK(leading_eigenvalues(matrix, states).cwiseAbs().maxCoeff() == Approx(expected).epsilon(1e-10));
  }
  CHECK(leading_eigenvalues(Eigen::MatrixXd::Zero(5, 5), 2).cwiseAbs().maxCoeff() == 0);
  CHECK(leading_eigenvalues(Eigen::MatrixXd::Identity(9, 9), 4).cwiseAbs().maxCoeff() ==
        Approx(1).epsilon(1e-14));
}

// Followed from stop to stop, both of two values that nearly meet may go to the smaller one.
TEST_CASE("of two leading eigenvalues that nearly meet the larger is found") {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Index n = 60, states = 6;
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(n, n);
    const double apart = std::pow(10.0, -2 - trial % 5);
    values(0, 0) = -1.1;
    values(1, 1) = -1.1 + apart;
    for (Eigen::Index i = 2; i < n; ++i) values(i, i) = std::pow(0.4, static_cast<double>(i));
    const Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(n, n) +
                                  0.05 * Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index, Eigen::Index) {
                                    return normal(generator);
                                  });
    const Eigen::MatrixXd matrix = basis * values * basis.inverse();
    CHECK(std::abs(leading_eigenvalues(matrix, states).cwiseAbs().maxCoeff() - 1.1) < 1e-9);
  }
}
