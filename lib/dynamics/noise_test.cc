#include "dynamics/noise.h"

#include <catch2/catch.hpp>
#include <random>

using namespace stablecut;

namespace {

Eigen::VectorXcd white(Eigen::Index lines, double sigma) {
  std::mt19937_64 generator(9);
  std::normal_distribution<double> normal(0, sigma / std::sqrt(2.0));
  return Eigen::VectorXcd::NullaryExpr(
      lines, [&] { return std::complex<double>(normal(generator), normal(generator)); });
}

}  // namespace

TEST_CASE("the variance of noise on a smooth curve is found within its window's scatter") {
  Eigen::VectorXcd values = white(4000, 0.02);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) / 4000;
    values[i] *= 1 + 4 * x;
    values[i] += std::complex<double>(std::cos(9 * x), 1 / (0.05 + x));
  }
  const Eigen::VectorXd variance = estimated_variance(values, values.cwiseAbs());
  for (const Eigen::Index i : {100, 1000, 3000, 3990}) {
    const double expected = std::pow(0.02 * (1 + 4 * static_cast<double>(i) / 4000), 2);
    CHECK(variance[i] > 0.4 * expected);
    CHECK(variance[i] < 2.5 * expected);
  }
  CHECK(variance.size() == 4000);
}

TEST_CASE("white residuals have correlation length 1, smooth ones more") {
  CHECK(correlation_length(white(4000, 1)) == Approx(1).margin(0.25));
  Eigen::VectorXcd smooth(4000);
  for (Eigen::Index i = 0; i < 4000; ++i) smooth[i] = std::sin(0.02 * static_cast<double>(i));
  CHECK(correlation_length(smooth) > 20);
}

TEST_CASE("noise that follows a sharp peak is told from a floor") {
  const Eigen::VectorXcd noise = white(2000, 1);
  Eigen::VectorXcd signal(2000);
  for (Eigen::Index i = 0; i < 2000; ++i)
    signal[i] = 1.0 / std::complex<double>(0.003, (static_cast<double>(i) - 1000) / 1000);
  const Eigen::VectorXd size = signal.cwiseAbs();
  const Eigen::VectorXcd following = 0.01 * noise.cwiseProduct(size.cast<std::complex<double>>());
  const double level = 0.01 * size.maxCoeff();
  for (const Eigen::Index i : {990, 1000, 1200}) {
    CHECK(estimated_variance(following, size)[i] == Approx(1e-4 * size[i] * size[i]).epsilon(0.6));
    CHECK(estimated_variance(level * noise, size)[i] == Approx(level * level).epsilon(0.6));
  }
}
