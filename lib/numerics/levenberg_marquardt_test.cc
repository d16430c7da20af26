#include "numerics/levenberg_marquardt.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

using namespace stablecut::numerics;

namespace {

// Sums of a residual and its Jacobian given as functions; counts the evaluations.
struct Problem {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> residual;
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> jacobian;
  int plain = 0, with_matrix = 0;

  SumsOfSquares sums() {
    return [this](const Eigen::VectorXd& x, bool matrix) {
      ++(matrix ? with_matrix : plain);
      const Eigen::VectorXd r = residual(x);
      if (!matrix) return NormalEquations{r.squaredNorm(), {}, {}};
      const Eigen::MatrixXd j = jacobian(x);
      return NormalEquations{r.squaredNorm(), j.transpose() * r, j.transpose() * j};
    };
  }
};

// [More1981, 1]: a curved valley with its end in (1, 1).
Problem rosenbrock() {
  return {[](const Eigen::VectorXd& x) {
            return Eigen::VectorXd(Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]));
          },
          [](const Eigen::VectorXd& x) {
            Eigen::Matrix2d j;
            j << -20 * x[0], 10, -1, 0;
            return Eigen::MatrixXd(j);
          }};
}

const double kInfinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd everywhere(double value) { return Eigen::VectorXd::Constant(2, value); }

}  // namespace

TEST_CASE("a curved valley is followed to its end") {
  Problem problem = rosenbrock();
  const LeastSquares least = levenberg_marquardt(problem.sums(), Eigen::Vector2d(-1.2, 1),
                                                 everywhere(-kInfinity), everywhere(kInfinity), {200, 1e-14});
  CHECK(least.converged);
  CHECK((least.x - everywhere(1)).norm() < 1e-9);
  CHECK(problem.with_matrix <= problem.plain + 1);  // a matrix where a step is taken, and at the start
}

TEST_CASE("a linear problem takes one step, and its sums are those of the end") {
  Eigen::MatrixXd j(3, 2);
  j << 1, 2, 3, 4, 5, 7;
  const Eigen::Vector3d y(1, -1, 2);
  Problem problem{[&](const Eigen::VectorXd& x) { return Eigen::VectorXd(j * x - y); },
                  [&](const Eigen::VectorXd&) { return j; }};
  const LeastSquares least = levenberg_marquardt(problem.sums(), everywhere(0), everywhere(-kInfinity),
                                                 everywhere(kInfinity), {10, 1e-12});
  const Eigen::Vector2d exact = (j.transpose() * j).ldlt().solve(j.transpose() * y);
  CHECK(least.converged);
  CHECK((least.x - exact).norm() < 1e-6);
  CHECK(least.at.sum_of_squares == Approx((j * least.x - y).squaredNorm()).epsilon(1e-12));
  CHECK((least.at.matrix - j.transpose() * j).norm() == 0);
}

TEST_CASE("a minimum outside of the bounds ends at the bound") {
  Problem problem = rosenbrock();
  Eigen::VectorXd upper = everywhere(kInfinity);
  upper[0] = 0.5;
  const LeastSquares least = levenberg_marquardt(problem.sums(), Eigen::Vector2d(-1.2, 1),
                                                 everywhere(-kInfinity), upper, {400, 1e-14});
  CHECK(least.x[0] == 0.5);
  CHECK(least.x[1] == Approx(0.25).epsilon(2e-3));  // cut steps creep along a bound
}

TEST_CASE("never above the start, whatever the function does") {
  // Not finite beyond 1.5, where the first step leads: a shorter one is taken.
  Problem problem{
      [](const Eigen::VectorXd& x) {
        return Eigen::VectorXd(Eigen::Vector2d(x[0] > 1.5 ? std::nan("") : std::exp(-x[0]), x[1]));
      },
      [](const Eigen::VectorXd& x) {
        return Eigen::MatrixXd(Eigen::Vector2d(-std::exp(-x[0]), 1).asDiagonal());
      }};
  const LeastSquares least = levenberg_marquardt(problem.sums(), everywhere(1), everywhere(-kInfinity),
                                                 everywhere(kInfinity), {50, 1e-10});
  CHECK(least.at.sum_of_squares < std::exp(-2.0) + 1);
  CHECK(least.x[0] <= 1.5);
  CHECK(least.x[0] > 1);
}

TEST_CASE("a variable that moves nothing stays") {
  Problem problem{[](const Eigen::VectorXd& x) { return Eigen::VectorXd(Eigen::Vector2d(x[0] - 3, 0)); },
                  [](const Eigen::VectorXd&) { return Eigen::MatrixXd(Eigen::Vector2d(1, 0).asDiagonal()); }};
  const LeastSquares least = levenberg_marquardt(problem.sums(), everywhere(0.25), everywhere(-kInfinity),
                                                 everywhere(kInfinity), {50, 1e-12});
  CHECK(least.x[0] == Approx(3));
  CHECK(least.x[1] == 0.25);
}
