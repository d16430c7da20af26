#include "modal/tap_checks.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "base/units.h"
#include "dynamics/synthesis.h"
#include "modal/fit.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

namespace {

// A tool tip with three modes, passive: psi real and a pole's residue psi psi^T / (2 i omega).
dynamics::ModalModel tip() {
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  for (const auto& [hz, zeta, x, y] : {std::array{150.0, 0.02, 0.5, 0.3}, std::array{320.0, 0.03, -0.3, 0.4},
                                       std::array{700.0, 0.015, 0.2, 0.3}}) {
    dynamics::Mode mode;
    mode.frequency_hz = hz;
    mode.damping_ratio = zeta;
    const Complex phase = std::sqrt(Complex(0, -1) / (2 * kTwoPi * hz));
    mode.psi_r = mode.psi_l = Eigen::Vector2cd(x, y) * phase;
    model.modes.push_back(mode);
  }
  return model;
}

dynamics::FrequencyResponse tap(const Eigen::VectorXd& lines) {
  dynamics::FrequencyResponse frf = dynamics::synthesize(tip(), lines);
  dynamics::add_noise(frf, {40.0, std::nullopt, 3});
  for (auto& entry : frf.entries) entry.variance.resize(0);
  return frf;
}

Eigen::VectorXd usual_lines() { return Eigen::VectorXd::LinSpaced(1991, 5, 1000); }

std::vector<std::string> findings_on(const dynamics::FrequencyResponse& frf, bool zeros_are_dead) {
  return check_tap(frf, zeros_are_dead).findings;
}

std::vector<Eigen::Index> disturbed_on(const dynamics::FrequencyResponse& frf) {
  return check_tap(frf, true).disturbed_lines;
}

// How many findings hold the text.
std::ptrdiff_t count(const dynamics::FrequencyResponse& frf, const std::string& text,
                     bool zeros_are_dead = true) {
  const auto findings = findings_on(frf, zeros_are_dead);
  for (const auto& finding : findings) UNSCOPED_INFO(finding);
  return std::count_if(findings.begin(), findings.end(),
                       [&](const std::string& finding) { return finding.find(text) != std::string::npos; });
}

template <typename Change>
dynamics::FrequencyResponse changed(std::size_t entry, const Change& change) {
  dynamics::FrequencyResponse frf = tap(usual_lines());
  for (Eigen::Index i = 0; i < frf.frequency_hz.size(); ++i)
    frf.entries[entry].h[i] = change(frf.entries[entry].h[i], kTwoPi * frf.frequency_hz[i]);
  return frf;
}

}  // namespace

TEST_CASE("a sound tap has no findings") {
  CHECK(findings_on(tap(usual_lines()), true).empty());
  CHECK(disturbed_on(tap(usual_lines())).empty());
  // Nor a suspended one, whose mass line rises towards 0 Hz, real and negative.
  dynamics::FrequencyResponse free = tap(usual_lines());
  for (Eigen::Index i = 0; i < free.frequency_hz.size(); ++i)
    free.entries[0].h[i] -= 1 / (40 * std::pow(kTwoPi * free.frequency_hz[i], 2));
  CHECK(findings_on(free, true).empty());
}

TEST_CASE("lines that are not equally spaced") {
  const Eigen::VectorXd uneven = Eigen::VectorXd::LinSpaced(2000, std::log(10), std::log(1000)).array().exp();
  CHECK(count(tap(uneven), "Hz apart") == 1);
  CHECK(findings_on(tap(uneven), true).size() == 1);
}

TEST_CASE("drift that integration made at the low end, and noise at the high end") {
  // 1 / omega^3 with the phase of a drift.
  const auto drift =
      changed(0, [](Complex h, double omega) { return h + Complex(-0.3, 1) * 2.0 / std::pow(omega, 3); });
  CHECK(count(drift, "Hz Hxx rises towards 0 Hz as no structure does") == 1);
  // Noise of the acceleration.
  dynamics::FrequencyResponse noise = tap(usual_lines());
  std::mt19937_64 generator(5);
  // It condemns the band in a driving point only.
  for (const std::size_t entry : {1u, 0u}) {
    for (Eigen::Index i = 0; i < noise.frequency_hz.size(); ++i)
      noise.entries[entry].h[i] +=
          0.05 * numerics::unit_complex_normal(generator) / std::pow(kTwoPi * noise.frequency_hz[i], 2);
    CHECK(count(noise, "rises towards 0 Hz") == (entry == 0 ? 1 : 0));
  }
  dynamics::FrequencyResponse high = tap(usual_lines());
  for (Eigen::Index i = 1600; i < high.frequency_hz.size(); ++i)
    high.entries[0].h[i] *= 1.0 + numerics::unit_complex_normal(generator);
  CHECK(count(high, "within 10 dB of its noise") == 1);
}

TEST_CASE("dead channels") {
  std::mt19937_64 generator(5);
  CHECK(count(changed(1, [&](Complex, double) { return 1e-9 * numerics::unit_complex_normal(generator); }),
              "Hxy: nothing but noise") == 1);
  CHECK(count(changed(1, [&](Complex, double) { return Complex(1e-9, 0); }),
              "Hxy: the same value on every line") == 1);
  const auto zero = changed(1, [&](Complex, double) { return Complex(0, 0); });
  CHECK(count(zero, "Hxy: all lines are 0") == 1);
  CHECK(findings_on(zero, false).empty());
}

TEST_CASE("signs and quantities that a driving point cannot have") {
  CHECK(count(changed(0, [](Complex h, double) { return -h; }),
              "Hxx: a driving point's imaginary part is negative") == 1);
  CHECK(count(changed(0, [](Complex h, double) { return -h; }), "is swapped") == 1);
  CHECK(count(changed(0, [](Complex h, double w) { return -w * w * h; }),
              "Hxx: a driving point's imaginary part is negative, this is positive on 100 %: is it an "
              "acceleration") == 1);
  CHECK(count(changed(0, [](Complex h, double w) { return -h / (w * w); }), "is it a displacement already") ==
        1);
  CHECK(count(changed(0, [](Complex h, double w) { return Complex(0, w) * h; }), "is it a velocity") == 1);
  CHECK(count(changed(1, [](Complex h, double) { return -h; }), "Hxy is Hyx with the other sign") == 1);
  // A cross entry of either sign is sound.
  dynamics::FrequencyResponse both = tap(usual_lines());
  both.entries[1].h *= -1;
  both.entries[2].h *= -1;
  CHECK(findings_on(both, true).empty());
}

TEST_CASE("a unit that is none of m/N") {
  CHECK(count(changed(0, [](Complex h, double) { return 1e6 * h; }), "the largest receptance is") == 1);
  dynamics::FrequencyResponse stiff = tap(usual_lines());
  for (auto& entry : stiff.entries) entry.h *= 1e-9;
  CHECK(count(stiff, "as stiff as") == 1);
}

TEST_CASE("poor coherence, and the time between two hits") {
  dynamics::FrequencyResponse frf = tap(usual_lines());
  frf.entries[0].coherence = Eigen::VectorXd::Constant(frf.frequency_hz.size(), 0.99);
  CHECK(findings_on(frf, true).empty());
  // A second hit of 90 % after 12 ms: the force nearly vanishes every 83 Hz.
  for (Eigen::Index i = 0; i < frf.frequency_hz.size(); ++i) {
    const double force = std::norm(1.0 + 0.9 * std::polar(1.0, -kTwoPi * frf.frequency_hz[i] * 0.012));
    frf.entries[0].coherence[i] = force / (force + 0.2);
  }
  CHECK(count(frf, "Hxx: coherence below 0.8 on ") == 1);
  CHECK(count(frf, "as of a second hit 12") == 1);
  CHECK(count(frf, "with --averages N such lines weigh less") == 1);
  frf.entries[0].coherence.setConstant(0.5);
  CHECK(count(frf, "noise, a double hit or a changing structure") == 1);
}

TEST_CASE("single disturbed lines are found, resonances are not") {
  dynamics::FrequencyResponse frf = tap(usual_lines());
  for (const Eigen::Index line : {90, 290, 490}) frf.entries[1].h[line] += Complex(3e-6, -5e-6);
  CHECK(disturbed_on(frf) == std::vector<Eigen::Index>{90, 290, 490});
  // A mode of half the width of the spacing between lines, and one of a tenth, without noise and with.
  for (const double share : {0.5, 0.1}) {
    dynamics::ModalModel sharp = tip();
    sharp.modes[0].damping_ratio = share * 0.5 / 150.1;
    sharp.modes[0].frequency_hz = 150.1;
    dynamics::FrequencyResponse narrow = dynamics::synthesize(sharp, usual_lines());
    CHECK(disturbed_on(narrow).empty());
    dynamics::add_noise(narrow, {60.0, std::nullopt, 3});
    CHECK(disturbed_on(narrow).empty());
  }
  // Left out, they make no modes.
  const ModalFit fit = fit_modes(dynamics::without_lines(frf, disturbed_on(frf)));
  CHECK(fit.model.modes.size() == 3);
}
