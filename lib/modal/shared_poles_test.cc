#include "modal/shared_poles.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "modal/fit.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

namespace {

// Modes of x and of y alone: two with one pole, one of y with a pole of its own.
dynamics::ModalModel apart() {
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  model.modes = {fixtures::mode(150, 0.02, {1, 0}, {Complex(0, -1e-4), 0}),
                 fixtures::mode(150, 0.02, {0, 1}, {0, Complex(1e-5, -2e-4)}),
                 fixtures::mode(400, 0.03, {1, 0}, {Complex(2e-5, -3e-4), 0}),
                 fixtures::mode(400, 0.03, {0, 1}, {0, Complex(0, -1e-4)}),
                 fixtures::mode(640, 0.01, {1, 0}, {Complex(0, -1e-4), 0}),
                 fixtures::mode(641, 0.01, {0, 1}, {0, Complex(0, -1e-4)})};
  return model;
}

// Tapped in x and in y, and not across.
dynamics::FrequencyResponse tap_of(const dynamics::ModalModel& model, std::uint64_t seed) {
  dynamics::FrequencyResponse measured =
      dynamics::synthesize(model, Eigen::VectorXd::LinSpaced(1000, 1, 1000));
  dynamics::add_noise(measured, {{}, 30.0, seed});
  std::erase_if(measured.entries, [](const auto& entry) { return entry.response != entry.reference; });
  return measured;
}

}  // namespace

TEST_CASE(
    "only xx and yy: each has poles of its own; shared, where they agree, they are surer by what both tell") {
  const dynamics::ModalModel truth = apart();
  double square = 0, apart_square = 0, count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const dynamics::FrequencyResponse measured = tap_of(truth, seed);
    const ModalFit own = fit_modes(measured);
    REQUIRE(own.model.modes.size() == 6);
    CHECK(own.model.modes[0].frequency_hz != own.model.modes[1].frequency_hz);
    FitOptions options;
    options.share_poles = true;
    const ModalFit fit = fit_modes(measured, options);
    REQUIRE(fit.model.modes.size() == 6);
    // The third pair differs by 16 % of a half width, many deviations.
    CHECK(std::abs(fit.model.modes[4].frequency_hz - 640) < 0.1);
    CHECK(std::abs(fit.model.modes[5].frequency_hz - 641) < 0.1);
    if (fit.shared_poles != 2) continue;  // 5 % of either pair
    for (const Eigen::Index k : {0, 2}) {
      const auto at = static_cast<std::size_t>(k);
      CHECK(fit.model.modes[at].frequency_hz == fit.model.modes[at + 1].frequency_hz);
      CHECK(fit.model.modes[at].damping_ratio == fit.model.modes[at + 1].damping_ratio);
      const Eigen::VectorXd deviation = fit.model.deviation(k);
      CHECK(deviation[0] < own.model.deviation(k)[0]);
      CHECK(deviation[0] == Approx(fit.model.deviation(k + 1)[0]).epsilon(1e-6));
      for (Eigen::Index p = 0; p < 2; ++p) {
        const double expected = p == 0 ? truth.modes[at].frequency_hz : truth.modes[at].damping_ratio;
        const auto value = [&](const dynamics::Mode& mode) {
          return p == 0 ? mode.frequency_hz : mode.damping_ratio;
        };
        square += std::pow((value(fit.model.modes[at]) - expected) / deviation[p], 2);
        apart_square += std::pow((value(own.model.modes[at]) - expected) / deviation[p], 2);
        ++count;
      }
    }
  }
  // Some 70 squares: their mean to 17 %. That one curve alone does worse by what it lacks.
  REQUIRE(count >= 50);
  CHECK(square / count == Approx(1).margin(0.45));
  CHECK(apart_square > 1.3 * square);
}

TEST_CASE("the constrained table is the fit at one pole: its chi-square is the least") {
  const dynamics::ModalModel truth = apart();
  const dynamics::FrequencyResponse measured = tap_of(truth, 2);
  FitOptions options;
  options.share_poles = true;
  const ModalFit fit = fit_modes(measured, options);
  REQUIRE(fit.shared_poles >= 1);
  const auto chi_square = [&](const dynamics::ModalModel& model) {
    const dynamics::FrequencyResponse fitted = dynamics::synthesize(model, measured.frequency_hz);
    double sum = 0;
    for (const auto& entry : measured.entries) {
      const auto* other = fitted.find(entry.response, entry.reference);
      sum += (other->h - entry.h).cwiseAbs2().cwiseQuotient(entry.variance).sum();
    }
    return sum;
  };
  // Vectors fitted anew at these poles gain nothing: they have moved with the poles.
  FitOptions fixed;
  fixed.poles_fixed = true;
  for (const dynamics::Mode& mode : fit.model.modes)
    fixed.poles.push_back({mode.pole(), {mode.psi_r[0] != 0.0 ? "x" : "y"}});
  const ModalFit again = fit_modes(measured, fixed);
  CHECK(std::abs(chi_square(fit.model) - chi_square(again.model)) < 0.05);
}

TEST_CASE("modes of one direction, and modes outside the band, share nothing") {
  dynamics::ModalModel model = apart();
  model.modes = {model.modes[0], model.modes[0]};
  model.modes[1].frequency_hz += 1e-3;
  model.covariance = Eigen::MatrixXd::Identity(20, 20);
  CHECK(share_poles(model) == 0);
  model.modes[1] = apart().modes[1];
  model.modes[1].out_of_band = true;
  CHECK(share_poles(model) == 0);
  model.modes[1].out_of_band = false;
  CHECK(share_poles(model) == 1);
}
