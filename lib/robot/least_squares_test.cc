#include "robot/least_squares.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::robot;

namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& generator) {
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = numerics::unit_normal(generator);
  return matrix;
}

}  // namespace

TEST_CASE("the inverse normal matrix, with columns that differ by nine orders of magnitude") {
  std::mt19937_64 generator(73);
  const Eigen::MatrixXd a = random_matrix(12, 4, generator);
  const Eigen::MatrixXd expected = (a.transpose() * a).inverse();
  CHECK((inverse_normal_matrix(a) - expected).norm() < 1e-12 * expected.norm());
  const Eigen::VectorXd scale = (Eigen::Vector4d() << 1, 1e-3, 1e-6, 1e-9).finished();
  const Eigen::MatrixXd scaled = inverse_normal_matrix(a * scale.asDiagonal());
  CHECK((scale.asDiagonal() * scaled * scale.asDiagonal() - expected).norm() < 1e-12 * expected.norm());
}

TEST_CASE("bounded least squares: the conditions of Karush, Kuhn and Tucker hold") {
  std::mt19937_64 generator(79);
  int held = 0, held_several = 0, negative = 0;
  for (int run = 0; run < 300; ++run) {
    const Eigen::Index n = 1 + run % 6;
    const Eigen::MatrixXd a = random_matrix(10, n, generator);
    const Eigen::VectorXd b = random_matrix(10, 1, generator);
    std::vector<bool> not_negative(n);
    for (Eigen::Index i = 0; i < n; ++i) not_negative[i] = (run / 6 + i) % 3 != 0;
    const Eigen::VectorXd x = bounded_least_squares(a, b, not_negative);
    const Eigen::VectorXd slope = a.transpose() * (a * x - b);  // of half the sum of squares
    int here = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      // Rounding of a solution and a gradient of order 1 in 10 rows.
      if (x[i] != 0 || !not_negative[i]) {
        CHECK(std::abs(slope[i]) < 1e-12);
        negative += x[i] < 0;
      } else {
        CHECK(slope[i] >= -1e-12);
        ++here;
      }
      if (not_negative[i]) CHECK(x[i] >= 0);
    }
    held += here > 0;
    held_several += here > 1;
  }
  CHECK(held > 100);
  CHECK(held_several > 30);
  CHECK(negative > 100);  // unknowns that may have any sign
}
