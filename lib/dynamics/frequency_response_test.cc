#include "dynamics/frequency_response.h"

#include <catch2/catch.hpp>
#include <complex>

#include "base/error.h"
#include "base/units.h"
#include "dynamics/noise.h"

using namespace stablecut;
using namespace stablecut::dynamics;

namespace {

FrequencyResponse sample(Quantity quantity) {
  FrequencyResponse frf;
  frf.quantity = quantity;
  frf.frequency_hz = Eigen::Vector3d(1, 2, 4);
  FrequencyResponseEntry entry;
  entry.response = "x";
  entry.reference = "y";
  entry.h =
      Eigen::Vector3cd(std::complex<double>(1, 2), std::complex<double>(3, -1), std::complex<double>(0, 1));
  entry.variance = Eigen::Vector3d(1, 4, 9);
  frf.entries.push_back(entry);
  return frf;
}

}  // namespace

TEST_CASE("accelerance is -omega^2 times receptance, mobility i omega times") {
  const double omega = rad_per_s_from_hz(2);
  const auto from_accelerance = to_receptance(sample(Quantity::kAccelerance));
  const auto from_mobility = to_receptance(sample(Quantity::kMobility));
  const std::complex<double> value(3, -1);
  CHECK(std::abs(from_accelerance.entries[0].h[1] * (-omega * omega) - value) < 1e-15);
  CHECK(std::abs(from_mobility.entries[0].h[1] * std::complex<double>(0, omega) - value) < 1e-15);
  CHECK(from_accelerance.entries[0].variance[1] == Approx(4 / std::pow(omega, 4)).epsilon(1e-14));
  CHECK(from_accelerance.quantity == Quantity::kReceptance);
}

TEST_CASE("a line at 0 Hz cannot be converted") {
  auto frf = sample(Quantity::kAccelerance);
  frf.frequency_hz[0] = 0;
  CHECK_THROWS_AS(to_receptance(frf), InvalidArgument);
  frf.quantity = Quantity::kReceptance;
  CHECK_NOTHROW(to_receptance(frf));
}

TEST_CASE("a band keeps its ends") {
  const auto part = within_band(sample(Quantity::kReceptance), 2, 4);
  CHECK(part.frequency_hz == Eigen::Vector2d(2, 4));
  CHECK(part.entries[0].variance == Eigen::Vector2d(4, 9));
  CHECK(within_band(sample(Quantity::kReceptance), 5, 9).frequency_hz.size() == 0);
}

TEST_CASE("on other lines: measured ones as they are, a cubic between them, nothing outside") {
  FrequencyResponse frf;
  frf.frequency_hz.resize(6);
  frf.frequency_hz << 10, 12, 15, 19, 24, 30;
  const auto cubic = [](double f) {
    return std::complex<double>(1 + f * (2 - f * (0.1 - 0.003 * f)), -f * f * f);
  };
  FrequencyResponseEntry entry;
  entry.response = entry.reference = "x";
  entry.h = frf.frequency_hz.unaryExpr(cubic);
  entry.variance = 3 * frf.frequency_hz;
  frf.entries.push_back(entry);
  Eigen::VectorXd lines(5);
  lines << 10, 11.5, 19, 29.9, 30;
  const FrequencyResponse other = on_lines(frf, lines);
  for (Eigen::Index i = 0; i < lines.size(); ++i) {
    CHECK(std::abs(other.entries[0].h[i] - cubic(lines[i])) < 1e-12 * std::abs(cubic(lines[i])));
    CHECK(other.entries[0].variance[i] == Approx(3 * lines[i]).epsilon(1e-12));
  }
  CHECK(other.entries[0].h[2] == entry.h[3]);
  lines << 9, 10, 11, 12, 13;
  CHECK_THROWS_AS(on_lines(frf, lines), InvalidArgument);
  lines << 10, 11, 12, 13, 30.1;
  CHECK_THROWS_AS(on_lines(frf, lines), InvalidArgument);
}

TEST_CASE("variance: given, by coherence, or unknown") {
  FrequencyResponseEntry entry;
  entry.h = Eigen::VectorXcd::Constant(2, {3, 4});
  CHECK(known_variance(entry).size() == 0);
  entry.coherence = Eigen::Vector2d(1, 0.8);
  entry.averages = 5;
  // (1 - 0.8) / (2 * 4 * 0.8) |H|^2 for each of the two parts; a coherence of 1 is one that was rounded.
  const double expected = 2 * 0.2 / 6.4 * 25;
  CHECK(known_variance(entry)[0] == Approx(expected));
  CHECK(known_variance(entry)[1] == Approx(expected));
  entry.averages.reset();
  CHECK(known_variance(entry).size() == 0);
  entry.variance = Eigen::Vector2d(7, 8);
  CHECK(known_variance(entry) == Eigen::Vector2d(7, 8));
  entry.h[1] = 10;
  entry.variance = Eigen::Vector2d(5, 0);
  CHECK(known_variance(entry) == Eigen::Vector2d(5, 20));
  entry.variance = Eigen::Vector2d(0, 0);
  CHECK(known_variance(entry) == Eigen::Vector2d(0, 0));
}

TEST_CASE("a variance that rests on few averages is pooled before it weighs") {
  constexpr Eigen::Index kLines = 60;
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(kLines, 10, 600);
  FrequencyResponseEntry entry;
  entry.h = Eigen::VectorXcd::Constant(kLines, {3, 4});
  CHECK(weighing_variance(entry, hz).size() == 0);
  entry.variance = Eigen::VectorXd::LinSpaced(kLines, 0.5, 1.5).cwiseAbs2();
  CHECK(weighing_variance(entry, hz) == entry.variance);  // nothing says on what it rests
  entry.averages = 2;
  CHECK(weighing_variance(entry, hz) ==
        pooled_variance(entry.variance, 1, entry.h.cwiseAbs(), floor_shapes(hz)));
  entry.averages = 40;
  CHECK(weighing_variance(entry, hz) == entry.variance);
}

TEST_CASE("without some lines") {
  FrequencyResponse frf;
  frf.frequency_hz = Eigen::VectorXd::LinSpaced(5, 1, 5);
  FrequencyResponseEntry entry;
  entry.h = frf.frequency_hz.cast<std::complex<double>>();
  entry.variance = entry.coherence = frf.frequency_hz;
  frf.entries.push_back(entry);
  const FrequencyResponse part = without_lines(frf, {0, 3});
  CHECK(part.frequency_hz == Eigen::Vector3d(2, 3, 5));
  CHECK(part.entries[0].h.real() == part.frequency_hz);
  CHECK(part.entries[0].variance == part.frequency_hz);
  CHECK(part.entries[0].coherence == part.frequency_hz);
}

TEST_CASE("through an exponential window, accelerance is s^2 times receptance at s = i omega + decay") {
  FrequencyResponse frf;
  frf.quantity = Quantity::kAccelerance;
  frf.frequency_hz = Eigen::Vector2d(10, 20);
  FrequencyResponseEntry entry;
  entry.h.resize(2);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const std::complex<double> s(4, kTwoPi * frf.frequency_hz[i]);
    entry.h[i] = s * s * std::complex<double>(2, 1);
  }
  frf.entries.push_back(entry);
  frf.window_decay_per_s = 4;
  const FrequencyResponse receptance = to_receptance(frf);
  for (const auto& value : receptance.entries[0].h)
    CHECK(std::abs(value - std::complex<double>(2, 1)) < 1e-14);
}

TEST_CASE("a delay or a factor taken off one entry leaves errors correlated as they were") {
  FrequencyResponse frf = sample(Quantity::kReceptance);
  frf.entries.push_back(frf.entries[0]);
  frf.entries[1].response = "y";
  frf.window_decay_per_s = 3;
  // The errors of both are one: their covariance is the geometric mean of the variances.
  frf.covariances.push_back({"x", "y", "y", frf.entries[0].variance.cast<std::complex<double>>()});
  const FrequencyResponse before = frf;
  correct(frf, 1, 0.02, -1.5);
  CHECK(frf.entries[0].h == before.entries[0].h);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::complex<double> s(3, kTwoPi * frf.frequency_hz[i]), change = -1.5 * std::exp(s * 0.02);
    CHECK(std::abs(frf.entries[1].h[i] - change * before.entries[1].h[i]) < 1e-14);
    const double both = frf.entries[0].variance[i] * frf.entries[1].variance[i];
    CHECK(std::abs(std::norm(frf.covariances[0].value[i]) / both - 1) < 1e-14);
    // An error d of x, of y then change d: E[d conj(change d)].
    CHECK(std::abs(frf.covariances[0].value[i] - std::conj(change) * before.entries[0].variance[i]) < 1e-13);
  }
}
