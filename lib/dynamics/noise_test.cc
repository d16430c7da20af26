#include "dynamics/noise.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::dynamics;

namespace {

Eigen::VectorXcd white(Eigen::Index lines, double sigma) {
  std::mt19937_64 generator(9);
  return Eigen::VectorXcd::NullaryExpr(lines,
                                       [&] { return sigma * numerics::unit_complex_normal(generator); });
}

Eigen::VectorXd lines_of(Eigen::Index lines) {
  return Eigen::VectorXd::LinSpaced(lines, 2, static_cast<double>(lines + 1));
}

NoiseShapes floors_of(Eigen::Index lines) { return floor_shapes(lines_of(lines)); }

}  // namespace

TEST_CASE("the variance of noise on a smooth curve is found within its window's scatter") {
  Eigen::VectorXcd values = white(4000, 0.02);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) / 4000;
    values[i] *= 1 + 4 * x;
    values[i] += std::complex<double>(std::cos(9 * x), 1 / (0.05 + x));
  }
  const Eigen::VectorXd variance =
      estimated_variance(lines_of(4000), values, values.cwiseAbs(), floors_of(4000));
  for (const Eigen::Index i : {100, 1000, 3000, 3990}) {
    const double expected = std::pow(0.02 * (1 + 4 * static_cast<double>(i) / 4000), 2);
    CHECK(variance[i] > 0.4 * expected);
    CHECK(variance[i] < 2.5 * expected);
  }
  CHECK(variance.size() == 4000);
}

TEST_CASE("the spacing of the lines does not count as noise") {
  // Three densities of lines, and single gaps.
  Eigen::VectorXd lines(3000);
  lines[0] = 10;
  for (Eigen::Index i = 1; i < 3000; ++i)
    lines[i] = lines[i - 1] + (i < 1000 ? 0.1 : i < 2000 ? 1.0 : 0.3) * (i % 97 == 0 ? 4 : 1);
  Eigen::VectorXcd values = white(3000, 1e-6);
  for (Eigen::Index i = 0; i < 3000; ++i) values[i] += std::polar(1.0, lines[i] / 100) * lines[i] / 1000.0;
  const Eigen::VectorXd variance =
      estimated_variance(lines, values, Eigen::VectorXd::Ones(3000), floor_shapes(lines));
  CHECK((variance.array() / 1e-12).mean() == Approx(1).margin(0.2));
  CHECK((variance.array() / 1e-12).maxCoeff() < 3);
}

TEST_CASE("curves shorter than a window have windows of their own size, inside the curve") {
  // An odd number of squares has one window of all; an even number has two, which leave out the last or the
  // first.
  for (Eigen::Index lines = 6; lines <= 60; ++lines) {
    const Eigen::VectorXcd values = white(lines, 1);
    std::vector<double> squares;
    for (Eigen::Index i = 0; i + 4 < lines; ++i)
      squares.push_back(std::norm(values[i] - 4.0 * values[i + 1] + 6.0 * values[i + 2] -
                                  4.0 * values[i + 3] + values[i + 4]) /
                        70);
    const std::size_t length = std::min<std::size_t>(49, (squares.size() - 1) / 2 * 2 + 1);
    // Of the window whose first square is that one.
    const auto level = [&](std::size_t first) {
      std::vector<double> window(squares.begin() + static_cast<std::ptrdiff_t>(first),
                                 squares.begin() + static_cast<std::ptrdiff_t>(first + length));
      std::sort(window.begin(), window.end());
      return window[length / 2] / std::log(2.0);
    };
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(lines);
    const Eigen::VectorXd variance = estimated_variance(lines_of(lines), values, ones, {ones});
    INFO(lines << " lines");
    for (const double value : variance) {
      bool inside = false;
      for (std::size_t first = 0; first + length <= squares.size(); ++first)
        inside = inside || value == Approx(level(first)).epsilon(1e-10);
      CHECK(inside);
    }
  }
  CHECK(estimated_variance(lines_of(5), white(5, 1), Eigen::VectorXd::Ones(5), floors_of(5)).isZero(0));
}

TEST_CASE("white residuals have correlation length 1, smooth ones more") {
  CHECK(correlation_length(white(4000, 1)) == Approx(1).margin(0.25));
  Eigen::VectorXcd smooth(4000);
  for (Eigen::Index i = 0; i < 4000; ++i) smooth[i] = std::sin(0.02 * static_cast<double>(i));
  CHECK(correlation_length(smooth) > 20);
  CHECK(correlation_length(Eigen::VectorXcd::Zero(100)) == 1);
}

TEST_CASE("noise that follows a sharp peak is told from a floor") {
  const Eigen::VectorXcd noise = white(2000, 1);
  Eigen::VectorXcd signal(2000);
  for (Eigen::Index i = 0; i < 2000; ++i)
    signal[i] = 1.0 / std::complex<double>(0.003, (static_cast<double>(i) - 1000) / 1000);
  const Eigen::VectorXd size = signal.cwiseAbs();
  const Eigen::VectorXcd following = 0.01 * noise.cwiseProduct(size.cast<std::complex<double>>());
  const double level = 0.01 * size.maxCoeff();
  // A window's median scatters by 30 %: the mean over some windows.
  const auto part = [](const Eigen::VectorXd& v) { return v.segment(900, 400).array(); };
  const Eigen::VectorXd found = estimated_variance(lines_of(2000), following, size, floors_of(2000));
  CHECK((part(found) / part(1e-4 * size.cwiseAbs2())).mean() == Approx(1).margin(0.25));
  const Eigen::VectorXd floor = estimated_variance(lines_of(2000), level * noise, size, floors_of(2000));
  CHECK(part(floor).mean() == Approx(level * level).epsilon(0.25));
}

TEST_CASE("the variance of a residual is fitted as floor and share, or locally") {
  const Eigen::VectorXcd noise = white(4000, 1);
  Eigen::VectorXd size(4000);
  for (Eigen::Index i = 0; i < 4000; ++i)
    size[i] = std::abs(1.0 / std::complex<double>(0.003, (static_cast<double>(i) - 1500) / 1000));
  for (const auto& [floor, share] : {std::pair(0.3, 0.0), std::pair(0.0, 0.02), std::pair(0.3, 0.02)}) {
    const Eigen::VectorXd truth = (floor * floor + share * share * size.array().square()).matrix();
    const Eigen::VectorXcd residual = noise.cwiseProduct(truth.cwiseSqrt().cast<std::complex<double>>());
    const ResidualNoise noise_found = residual_noise(residual, size, floors_of(4000));
    const Eigen::VectorXd& found = noise_found.smooth;
    CHECK_FALSE(noise_found.is_local);
    INFO(floor << ' ' << share);
    // The lowest lines alone say how steep a floor is.
    CHECK((found.array() / truth.array()).tail(3950).minCoeff() > 0.8);
    CHECK((found.array() / truth.array()).tail(3950).maxCoeff() < 1.25);
  }
  // Hum around some lines: neither of the two.
  Eigen::VectorXcd humming = noise;
  humming.segment(1000, 400) *= 10;
  const ResidualNoise found = residual_noise(humming, Eigen::VectorXd::Ones(4000), floors_of(4000));
  CHECK(found.is_local);
  CHECK(found.local[1200] == Approx(100).epsilon(0.6));
  CHECK(found.local[3000] == Approx(1).epsilon(0.6));
}

TEST_CASE("a floor of the acceleration, or of the velocity, is recognised in the receptance") {
  const Eigen::Index lines = 2000;
  const NoiseShapes floors = floors_of(lines);
  for (const std::size_t order : {1u, 2u}) {
    const Eigen::VectorXcd noise = white(lines, 1).cwiseProduct(floors[order].cast<std::complex<double>>());
    const Eigen::VectorXd truth = floors[order].cwiseAbs2();
    const Eigen::VectorXd first =
        estimated_variance(lines_of(lines), noise, Eigen::VectorXd::Ones(lines), floors);
    CHECK((first.array() / truth.array()).mean() == Approx(1).margin(0.25));
    CHECK((first.array() / truth.array())[0] == Approx(1).margin(0.9));
    const ResidualNoise found = residual_noise(noise, Eigen::VectorXd::Ones(lines), floors);
    CHECK_FALSE(found.is_local);
    CHECK((found.smooth.array() / truth.array()).minCoeff() > 0.8);
    CHECK((found.smooth.array() / truth.array()).maxCoeff() < 1.25);
  }
}

TEST_CASE("estimates from few averages are pooled") {
  // From two averages: one degree of freedom, an exponential distribution, whose inverse has no mean.
  const Eigen::Index lines = 3000;
  const Eigen::VectorXd estimates = white(lines, 1).cwiseAbs2();
  const Eigen::VectorXd pooled =
      pooled_variance(estimates, 1, Eigen::VectorXd::Ones(lines), floors_of(lines));
  // Over 31 lines: the inverse is 31 / 30 on average, and scatters by 18 % a window.
  CHECK(pooled.cwiseInverse().mean() == Approx(31.0 / 30).epsilon(0.05));
  CHECK((pooled.array() / pooled.mean() - 1).square().mean() == Approx(1.0 / 31).epsilon(0.4));
  // Many averages stand for themselves.
  CHECK(pooled_variance(estimates, 40, Eigen::VectorXd::Ones(lines), floors_of(lines)) == estimates);
}

TEST_CASE("the noise of the first lines of an integrated acceleration is not that of a mean of many") {
  const Eigen::Index lines = 2000;
  const Eigen::VectorXd omega = Eigen::VectorXd::LinSpaced(lines, 1, static_cast<double>(lines));
  // 1 / omega^2, three times as much in the middle third, so that no smooth shape has it.
  Eigen::VectorXd deviation = omega.cwiseAbs2().cwiseInverse();
  deviation.segment(lines / 3, lines / 3) *= 3;
  double mean = 0;
  const int seeds = 40;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937_64 generator(seed);
    Eigen::VectorXcd residual(lines);
    for (Eigen::Index i = 0; i < lines; ++i)
      residual[i] = deviation[i] * numerics::unit_complex_normal(generator);
    const ResidualNoise noise = residual_noise(residual, Eigen::VectorXd::Ones(lines), floor_shapes(omega));
    CHECK(noise.is_local);
    mean += noise.local[0] / std::pow(deviation[0], 2) / seeds;
  }
  CHECK(mean > 0.7);
  CHECK(mean < 1.4);
}
