// The processor's speed of the day, by library code that this project does not change: what scripts/bench
// divides by.
#include <Eigen/Eigenvalues>
#include <cstdio>
#include <random>

#include "base/seconds_benchmark.h"
#include "numerics/random.h"

int main() {
  std::mt19937_64 generator(1);
  const Eigen::MatrixXd matrix =
      Eigen::MatrixXd::NullaryExpr(60, 60, [&] { return stablecut::numerics::unit_normal(generator); });
  double sink = 0;
  const auto work = [&] {
    for (int i = 0; i < 100; ++i)
      sink += Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues()[0].real();
  };
  std::printf("%.6f\n", stablecut::least_seconds(work, 7));
  return sink == 0;
}
