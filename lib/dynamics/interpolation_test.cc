#include "dynamics/interpolation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "dynamics/frequency_response.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::dynamics;

namespace {

using Complex = std::complex<double>;

// Two resonances, at 300 and 500 Hz, of half width 9 Hz.
Complex curve(double hz) {
  const Complex s(0, hz), pole1(-9, 300), pole2(-9, 500);
  return 1.0 / (s - pole1) + 1.0 / (s - std::conj(pole1)) - 0.5 / (s - pole2);
}

// Every step Hz from 100 to 700 but for the lines inside a gap.
Eigen::VectorXd lines_without(double step, double from, double to) {
  std::vector<double> lines;
  for (int i = 0; 100 + i * step <= 700; ++i) {
    const double hz = 100 + i * step;
    if (hz <= from || hz >= to) lines.push_back(hz);
  }
  return Eigen::Map<Eigen::VectorXd>(lines.data(), lines.size());
}

Eigen::VectorXcd noisy(const Eigen::VectorXd& lines, double deviation, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Eigen::VectorXcd h(lines.size());
  for (Eigen::Index i = 0; i < lines.size(); ++i)
    h[i] = curve(lines[i]) + deviation * numerics::unit_complex_normal(generator);
  return h;
}

const Eigen::VectorXd kWanted = Eigen::VectorXd::LinSpaced(1201, 100, 700);

std::vector<DoubtfulInterval> found(const Eigen::VectorXd& lines, double deviation, std::uint64_t seed = 1) {
  return doubtful_intervals(lines, noisy(lines, deviation, seed),
                            Eigen::VectorXd::Constant(lines.size(), deviation * deviation), kWanted);
}

// Of the cubic without noise, between 280 and 330 Hz: a share of the largest value at the lines around.
double largest_error(const Eigen::VectorXd& lines) {
  FrequencyResponse frf;
  frf.frequency_hz = lines;
  frf.entries.emplace_back();
  frf.entries[0].h = noisy(lines, 0, 1);
  const Eigen::VectorXd inside = Eigen::VectorXd::LinSpaced(101, 280, 330);
  const Eigen::VectorXcd cubic = on_lines(frf, inside).entries[0].h;
  double worst = 0;
  for (Eigen::Index i = 0; i < inside.size(); ++i)
    worst = std::max(worst, std::abs(cubic[i] - curve(inside[i])));
  return worst / std::max(std::abs(curve(280)), std::abs(curve(330)));
}

}  // namespace

TEST_CASE("a resonance in a gap is told, with the gap; the same gap where the curve is smooth is not") {
  for (const double deviation : {0.0, 3e-4}) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const Eigen::VectorXd lines = lines_without(step, 280, 330);
      const auto across = found(lines, deviation);
      REQUIRE(across.size() == 1);
      CHECK(across[0].from_hz == 280);
      CHECK(across[0].to_hz == 330);
      CHECK(across[0].error == Approx(largest_error(lines)).epsilon(deviation > 0 ? 0.3 : 0.01));
      CHECK(found(lines_without(step, 390, 410), 0.3 * deviation).empty());
    }
  }
}

TEST_CASE("lines at equal distances: nothing is told, with noise of any size") {
  for (const double deviation : {0.0, 1e-3, 1e-2, 1e-1}) {
    for (const double step : {1.0, 2.0, 3.0}) {
      for (std::uint64_t seed = 1; seed <= 10; ++seed)
        CHECK(found(lines_without(step, 0, 0), deviation, seed).empty());
    }
  }
}

TEST_CASE("noise that is carried over a gap is told") {
  const Eigen::VectorXd lines = lines_without(1, 380, 420);
  const auto told = found(lines, 1e-2);
  REQUIRE(told.size() == 1);
  CHECK(told[0].from_hz == 380);
  CHECK(told[0].to_hz == 420);
}

TEST_CASE("lines that were measured, and curves of few lines, have no doubt") {
  const Eigen::VectorXd lines = lines_without(5, 280, 330), none = Eigen::VectorXd::Zero(lines.size());
  CHECK(doubtful_intervals(lines, noisy(lines, 0, 1), none, lines).empty());
  CHECK(
      doubtful_intervals(lines.head(4), noisy(lines.head(4), 0, 1), none.head(4), kWanted.head(30)).empty());
  CHECK(doubtful_intervals(lines.head(1), noisy(lines.head(1), 0, 1), none.head(1), lines.head(1)).empty());
}
