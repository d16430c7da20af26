// Fits in which fixed terms stand for what lies outside the band.
#include <catch2/catch.hpp>
#include <cmath>

#include "modal/fit.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

namespace {

// The band holds the modes at 120, 121.8 and 260 Hz of close_pair(); those at 25 and 640 Hz lie outside.
const Eigen::VectorXd kLines = Eigen::VectorXd::LinSpaced(901, 50, 500);

dynamics::ModalModel structure() {
  dynamics::ModalModel model = fixtures::close_pair();
  model.modes.push_back(fixtures::mode(25, 0.03, {Complex(1, 0), Complex(0.8, 0.1)}, {3e-4, 2e-4}));
  return model;
}

dynamics::FrequencyResponse noisy(std::uint64_t seed) {
  dynamics::FrequencyResponse measured = dynamics::synthesize(structure(), kLines);
  dynamics::add_noise(measured, {{}, 40.0, seed});
  return measured;
}

FitOptions three_modes(bool residual_terms) {
  FitOptions options;
  options.modes = 3;
  options.residual_terms = residual_terms;
  return options;
}

}  // namespace

TEST_CASE("residual terms are one below and one above the band for each direction, and stay") {
  FitData data;
  data.dofs = 2;
  data.s = Complex(0, kTwoPi) * kLines.cast<Complex>();
  data.residual_terms = true;
  const Eigen::VectorXcd expected = residual_poles(data);
  REQUIRE(expected.size() == 4);
  const ModalFit fit = fit_modes(noisy(1), three_modes(true));
  int outside = 0;
  for (std::size_t k = 0; k < fit.model.modes.size(); ++k) {
    const dynamics::Mode& mode = fit.model.modes[k];
    CHECK(mode.out_of_band == !data.in_band(mode.pole()));
    if (!mode.out_of_band) continue;
    ++outside;
    CHECK((expected.array() - mode.pole()).abs().minCoeff() < 1e-12 * std::abs(mode.pole()));
    CHECK(fit.model.deviation(k)[0] == 0);
    CHECK(fit.model.deviation(k)[1] == 0);
  }
  CHECK(outside == 4);
  CHECK(fit.model.modes.size() == 7);
  CHECK(fit.findings.empty());
}

TEST_CASE("with residual terms a number of modes is that of the band, and they are less off than without") {
  const dynamics::ModalModel truth = structure();
  const auto worst = [&](const ModalFit& fit) {
    double off = 0;
    for (std::size_t t = 0; t < 3; ++t) {
      double nearest = 1;
      for (const dynamics::Mode& mode : fit.model.modes)
        nearest =
            std::min(nearest, std::abs(mode.pole() - truth.modes[t].pole()) / -truth.modes[t].pole().real());
      off = std::max(off, nearest);
    }
    return off;
  };
  const ModalFit with = fit_modes(noisy(2), three_modes(true)),
                 without = fit_modes(noisy(2), three_modes(false));
  CHECK(worst(with) < 0.02);
  CHECK(worst(without) > 5 * worst(with));
}

TEST_CASE("of given poles those outside the band give way to residual terms") {
  FitOptions options;
  options.poles_fixed = options.residual_terms = true;
  for (const dynamics::Mode& mode : structure().modes) options.poles.push_back({mode.pole(), {}});
  const ModalFit fit = fit_modes(noisy(3), options);
  REQUIRE(fit.model.modes.size() == 7);
  for (std::size_t k = 2; k < 5; ++k)
    CHECK(std::abs(fit.model.modes[k].pole() - structure().modes[k - 2].pole()) <
          1e-12 * std::abs(fit.model.modes[k].pole()));
  CHECK(fit.relative_error < 0.02);
}

TEST_CASE("a search with residual terms leaves no other mode outside the band") {
  FitOptions options;
  options.residual_terms = true;
  const ModalFit fit = fit_modes(noisy(4), options);
  CHECK(std::count_if(fit.model.modes.begin(), fit.model.modes.end(),
                      [](const dynamics::Mode& mode) { return mode.out_of_band; }) == 4);
  CHECK(fit.reduced_chi_square == Approx(1).margin(0.1));
}
