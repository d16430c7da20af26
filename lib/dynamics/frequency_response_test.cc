#include "dynamics/frequency_response.h"

#include <catch2/catch.hpp>
#include <complex>

#include "base/error.h"
#include "base/units.h"

using namespace stablecut;

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
