#include "modal/mode_selection.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

namespace {

// Curves with noise of that share of each value, which is known.
GroupFit noisy_fit(const dynamics::ModalModel& truth, std::uint64_t seed, double noise_db) {
  dynamics::FrequencyResponse noisy = dynamics::synthesize(truth, Eigen::VectorXd::LinSpaced(1000, 1, 1000));
  dynamics::add_noise(noisy, {noise_db, {}, seed});
  GroupFit fit;
  fit.data = fixtures::data_of(truth, 1e-2);
  for (std::size_t e = 0; e < 4; ++e) {
    fit.data.curves[e].h = noisy.entries[e].h;
    fit.variance.push_back(noisy.entries[e].variance);
  }
  fit.weigh(Regime::kNoise);
  return fit;
}

// At the line of that many Hz, so many line spacings (1 Hz) of half width.
dynamics::Mode narrow_mode(double hz, double spacings) {
  dynamics::Mode mode = fixtures::mode(hz, 0.1, {1, 1}, {1e-6, 1e-6});
  dynamics::set_pole(mode, kTwoPi * Complex(-spacings, hz));
  return mode;
}

}  // namespace

TEST_CASE("a mode that is behind the curves is worth its price, and noise is not") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  GroupFit fit = noisy_fit(truth, 4, 40);
  fit.refined = fit.refine(truth.modes, {100, 1e-5});
  CHECK(price_of_mode(fit, fit.refined, fit.refined) ==
        Approx((8.0 / 2) * std::log(8000.0) + std::log(1000.0)).epsilon(0.02));
  CHECK(fit.refined.removal_loss.minCoeff() > 100 * price_of_mode(fit, fit.refined, fit.refined));
  CHECK_FALSE(with_another_mode(fit, {}));
}

TEST_CASE("modes are added and removed until those behind the curves are left") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  for (const bool too_few : {true, false}) {
    GroupFit fit = noisy_fit(truth, 7, 40);
    std::vector<dynamics::Mode> start = truth.modes;
    if (too_few) {
      start.erase(start.begin() + 1, start.begin() + 3);
    } else {
      for (const double hz : {60.0, 330.0, 800.0})
        start.push_back(fixtures::mode(hz, 0.05, {1, 0.2}, {1e-7, Complex(0, 1e-7)}));
    }
    fit.refined = fit.refine(start, {40, 0.1});
    select_modes(fit, {});
    CHECK(fit.selection_settled);
    REQUIRE(fit.modes().size() == 4);
    CHECK(fit.refined.chi_square / fit.complex_values() == Approx(1).margin(0.06));
  }
}

TEST_CASE("a selection that runs out of rounds says so") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  GroupFit fit = noisy_fit(truth, 7, 40);
  fit.weigh(Regime::kModelError);  // where modes pay from the strongest on
  fit.refined = fit.refine({}, {40, 0.1});
  SelectionOptions options;
  options.rounds = 2;
  select_modes(fit, options);
  CHECK_FALSE(fit.selection_settled);
  CHECK(fit.modes().size() == 2);
  // Enough of them settle it.
  options.rounds = kSelectionRounds;
  select_modes(fit, options);
  CHECK(fit.selection_settled);
  // Also with as many as were wanted.
  fit.refined = fit.refine({}, {40, 0.1});
  options.wanted_modes = 3;
  select_modes(fit, options);
  CHECK(fit.selection_settled);
  CHECK(fit.modes().size() == 3);
}

TEST_CASE("what is expected to be left of curves where the model is the limit is the floor and their noise") {
  GroupFit fit = noisy_fit(fixtures::close_pair(), 3, 60);
  CHECK(fit.expected_error() == Approx(std::hypot(kModelErrorFloor, 1e-3)).epsilon(1e-4));
  // 1 % of the size of each curve.
  for (std::size_t c = 0; c < 4; ++c)
    fit.variance[c].setConstant(1e-4 * fit.data.curves[c].h.squaredNorm() / 1000);
  CHECK(fit.expected_error() == Approx(std::hypot(kModelErrorFloor, 0.01)).epsilon(1e-9));
  // 4 %: more than a table is to leave.
  for (auto& variance : fit.variance) variance *= 16;
  CHECK(fit.expected_error() == 0.05);
}

TEST_CASE("where the model is the limit, a mode must take away a share of what is left") {
  GroupFit fit = noisy_fit(fixtures::close_pair(), 3, 60);
  fit.weigh(Regime::kModelError);
  fit.refined = fit.refine({}, {40, 0.1});
  // Nothing is explained yet: the lesser share.
  CHECK(relative_error(fit.data, {}) == Approx(1));
  CHECK(price_of_mode(fit, fit.refined, fit.refined) == Approx(0.05 * fit.refined.chi_square));
  // All is: the larger share, but never less than in noise.
  fit.refined = fit.refine(fixtures::close_pair().modes, {40, 0.1});
  CHECK(relative_error(fit.data, fit.modes()) < 0.01);
  RefinedModes large = fit.refined;
  large.chi_square = 1e6;
  CHECK(price_of_mode(fit, fit.refined, large) == Approx(3e5));
  CHECK(price_of_mode(fit, fit.refined, fit.refined) ==
        Approx((8.0 / 2) * std::log(8000.0) + std::log(1000.0)));
}

TEST_CASE("a mode narrower than a fiftieth of the line spacing is a disturbed line") {
  const FitData data = fixtures::data_of(fixtures::close_pair(), 1e-2);  // lines 1 Hz apart, 1 to 1000 Hz
  CHECK(is_too_narrow(data, narrow_mode(500, 0.019)));
  CHECK_FALSE(is_too_narrow(data, narrow_mode(500, 0.021)));
  CHECK_FALSE(is_too_narrow(data, narrow_mode(1001, 0.001)));
}

TEST_CASE("a residual of exactly zero leaves a chi-square of zero over its degrees of freedom") {
  GroupFit fit;
  fit.data = fixtures::data_of(fixtures::close_pair(), 1e-2);
  fit.refined.modes = fixtures::close_pair().modes;
  fit.refined.chi_square = 0;
  CHECK(fit.degrees_of_freedom() == 4000 - 4 * 8 / 2);
  CHECK(fit.reduced_chi_square() == 0);
  CHECK(reduced_chi_square_of({fit, fit}) == 0);
  GroupFit other = fit;
  other.refined.chi_square = 2 * other.degrees_of_freedom();
  CHECK(reduced_chi_square_of({fit, other}) == Approx(1));
}

TEST_CASE("more modes at one pole than directions are crowded") {
  GroupFit fit;
  fit.data = fixtures::data_of(fixtures::close_pair(), 1e-2);
  const std::vector<dynamics::Mode> two(2, fixtures::mode(300, 0.01, {1, 0}, {1e-6, 0}));
  fit.refined.modes = two;
  CHECK_FALSE(fit.is_crowded());
  // A third within half of the half width, and one further away.
  for (const auto& [hz, crowded] : {std::pair(301.4, true), std::pair(301.6, false)}) {
    fit.refined.modes = two;
    fit.refined.modes.push_back(fixtures::mode(hz, 0.01, {1, 0}, {1e-6, 0}));
    CHECK(fit.is_crowded() == crowded);
  }
}
