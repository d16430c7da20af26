#include "numerics/complex_eigen_lanes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace stablecut::numerics;
using Complex = std::complex<double>;

namespace {

constexpr Eigen::Index kBlock = 2 * kLanes;

struct EightMatrices {
  std::vector<Eigen::MatrixXcd> dense;
  ComplexEigenLanes lanes;

  EightMatrices(Eigen::Index n, unsigned seed) : lanes(n) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
      dense.push_back(Eigen::MatrixXcd::NullaryExpr(n, n, [&](Eigen::Index, Eigen::Index j) {
        const double re = normal(generator), share = std::pow(0.6, static_cast<double>(j));
        return share * Complex(re, normal(generator));
      }));
      if (lane == 3) dense.back().setZero();
      if (lane == 4) dense.back() = dense.back().real().cast<Complex>().eval();
    }
  }
  void fill() {
    const Eigen::Index n = lanes.size();
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
          lanes.matrix()[(i * n + j) * kBlock + lane] = dense[lane](i, j).real();
          lanes.matrix()[(i * n + j) * kBlock + kLanes + lane] = dense[lane](i, j).imag();
        }
    lanes.reduce();
  }
};

}  // namespace

TEST_CASE("eigenvalues of complex matrices in lanes are those of a dense solver") {
  for (const Eigen::Index n : {1, 2, 3, 5, 8, 13, 24}) {
    EightMatrices matrices(n, static_cast<unsigned>(n));
    matrices.fill();
    const auto values = matrices.lanes.values(1e-15);
    for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
      REQUIRE(static_cast<Eigen::Index>(values[lane].size()) == n);
      const Eigen::VectorXcd dense =
          Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(matrices.dense[lane], false).eigenvalues();
      for (const Complex& wanted : dense) {
        const double nearest =
            std::abs(*std::min_element(values[lane].begin(), values[lane].end(),
                                       [&](const Complex& a, const Complex& b) {
                                         return std::abs(a - wanted) < std::abs(b - wanted);
                                       }) -
                     wanted);
        CHECK(nearest < 1e-11 * (1 + matrices.dense[lane].norm()));
      }
    }
  }
}

TEST_CASE("right and left eigenvectors in lanes leave no residual") {
  for (const Eigen::Index n : {1, 2, 3, 8, 15}) {
    EightMatrices matrices(n, static_cast<unsigned>(40 + n));
    matrices.fill();
    const auto values = matrices.lanes.values(1e-13);
    std::array<Complex, kLanes> shifts;
    for (Eigen::Index lane = 0; lane < kLanes; ++lane) shifts[lane] = values[lane].front();
    std::vector<double> right(n * kBlock), left(n * kBlock);
    matrices.lanes.vectors(shifts, right.data(), left.data());
    for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
      Eigen::VectorXcd x(n), y(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        x[i] = {right[i * kBlock + lane], right[i * kBlock + kLanes + lane]};
        y[i] = {left[i * kBlock + lane], left[i * kBlock + kLanes + lane]};
      }
      const Eigen::MatrixXcd& m = matrices.dense[lane];
      REQUIRE(x.norm() == Approx(1));
      REQUIRE(y.norm() == Approx(1));
      CHECK((m * x - shifts[lane] * x).norm() < 1e-11 * (1 + m.norm()));
      CHECK((y.adjoint() * m - shifts[lane] * y.adjoint()).norm() < 1e-11 * (1 + m.norm()));
    }
  }
}

TEST_CASE("phases of determinants in lanes are those of a dense factorization") {
  EightMatrices matrices(9, 77);
  matrices.fill();
  const Complex shift(0.3, -0.2);
  const auto phases = matrices.lanes.determinant_phases(shift);
  for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
    const Complex determinant =
        (matrices.dense[lane] - shift * Eigen::MatrixXcd::Identity(9, 9)).determinant();
    CHECK(std::abs(phases[lane] - determinant / std::abs(determinant)) < 1e-11);
  }
}
