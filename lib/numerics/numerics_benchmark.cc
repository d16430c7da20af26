// The processor's speed of the day, by library code that this project does not change: what scripts/bench
// divides by.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>

#include "numerics/random.h"

int main() {
  std::mt19937_64 generator(1);
  const Eigen::MatrixXd matrix =
      Eigen::MatrixXd::NullaryExpr(60, 60, [&] { return stablecut::numerics::unit_normal(generator); });
  double best = 1e9, sink = 0;
  for (int round = 0; round < 7; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 100; ++i)
      sink += Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues()[0].real();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("%.6f\n", best);
  return sink == 0;
}
