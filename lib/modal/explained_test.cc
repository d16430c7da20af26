#include "modal/explained.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "modal/maximum_likelihood.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;

TEST_CASE("modes that leave much of a band are no answer") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  const FitData data = fixtures::data_of(truth, 1e-3);
  CHECK_FALSE(most_unexplained(data, truth.modes, 0.5));
  // Without the mode at 640 Hz: its resonance is missing, and its stiffness where the others have little.
  const std::vector<dynamics::Mode> fewer(truth.modes.begin(), truth.modes.end() - 1);
  const auto left = most_unexplained(data, fewer, 0.5);
  REQUIRE(left);
  CHECK(left->error > 0.5);
}

TEST_CASE("modes do not explain a drift that takes energy") {
  const std::vector<bool> driving{true, false, false, true};
  const dynamics::ModalModel truth = fixtures::close_pair();
  FitData data = fixtures::data_of(truth, 1e-3);
  CHECK_FALSE(leave_low_end(data, truth.modes, driving, 14, 0.5));
  // An acceleration that falls like 1 / omega^2, as large as the receptance at 12 Hz.
  for (Curve& curve : data.curves)
    for (Eigen::Index i = 0; i < 40; ++i)
      curve.h[i] +=
          std::polar(std::abs(curve.h[11]), -2.6) * std::pow(12 / (1.0 + static_cast<double>(i)), 4);
  CHECK(leave_low_end(data, truth.modes, driving, 14, 0.5));
  // What modes follow is none, and few lines tell nothing.
  CHECK_FALSE(leave_low_end(data, truth.modes, std::vector<bool>(4), 14, 1.5));
  CHECK_FALSE(leave_low_end(data, truth.modes, driving, 5, 0.5));
  // Modes that follow it with another sign than in the rest of the band give energy.
  std::vector<dynamics::Mode> modes = fixtures::skew_modes().modes;
  data = fixtures::data_of(fixtures::skew_modes(), 1e-3);
  CHECK_FALSE(leave_low_end(data, modes, driving, 14, 0.5));
  modes.push_back(modes[0]);
  modes.back().frequency_hz = 0.5;
  modes.back().damping_ratio = 0.7;
  modes.back().psi_l *= -30;
  for (Curve& curve : data.curves) curve.h = curve_of(modes, curve, data.s);
  CHECK(leave_low_end(data, modes, driving, 14, 0.5));
}
