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

using Kinds = std::vector<TapFindingKind>;

Kinds kinds_on(const dynamics::FrequencyResponse& frf, bool zeros_are_dead = true) {
  Kinds kinds;
  for (const TapFinding& finding : check_tap(frf, zeros_are_dead).findings) kinds.push_back(finding.kind);
  return kinds;
}

std::vector<Eigen::Index> disturbed_on(const dynamics::FrequencyResponse& frf) {
  return check_tap(frf, true).disturbed_lines;
}

// The one finding of that kind.
TapFinding the(TapFindingKind kind, const dynamics::FrequencyResponse& frf) {
  const std::vector<TapFinding> findings = check_tap(frf, true).findings;
  const auto is_it = [&](const TapFinding& finding) { return finding.kind == kind; };
  REQUIRE(std::count_if(findings.begin(), findings.end(), is_it) == 1);
  return *std::find_if(findings.begin(), findings.end(), is_it);
}

const EntryName kXx{"x", "x"}, kXy{"x", "y"}, kYx{"y", "x"};

template <typename Change>
dynamics::FrequencyResponse changed(std::size_t entry, const Change& change) {
  dynamics::FrequencyResponse frf = tap(usual_lines());
  for (Eigen::Index i = 0; i < frf.frequency_hz.size(); ++i)
    frf.entries[entry].h[i] = change(frf.entries[entry].h[i], kTwoPi * frf.frequency_hz[i]);
  return frf;
}

}  // namespace

TEST_CASE("a sound tap has no findings") {
  CHECK(kinds_on(tap(usual_lines())).empty());
  CHECK(disturbed_on(tap(usual_lines())).empty());
  // Nor a suspended one, whose mass line rises towards 0 Hz, real and negative.
  dynamics::FrequencyResponse free = tap(usual_lines());
  for (Eigen::Index i = 0; i < free.frequency_hz.size(); ++i)
    free.entries[0].h[i] -= 1 / (40 * std::pow(kTwoPi * free.frequency_hz[i], 2));
  CHECK(kinds_on(free).empty());
  // Nor what has too few lines to say anything of it.
  dynamics::FrequencyResponse few = dynamics::within_band(tap(usual_lines()), 100, 109);
  few.entries[0].h *= -1;
  REQUIRE(few.frequency_hz.size() == 19);
  CHECK(kinds_on(few).empty());
}

TEST_CASE("lines that are not equally spaced") {
  const Eigen::VectorXd uneven = Eigen::VectorXd::LinSpaced(2000, std::log(10), std::log(1000)).array().exp();
  const dynamics::FrequencyResponse frf = tap(uneven);
  CHECK(kinds_on(frf) == Kinds{TapFindingKind::kUnevenLines});
  const TapFinding finding = the(TapFindingKind::kUnevenLines, frf);
  CHECK(finding.least == Approx(uneven[1] - uneven[0]));
  CHECK(finding.most == Approx(uneven[1999] - uneven[1998]));
  // Rounded frequencies are even: lines 0.53 Hz apart, printed as multiples of 0.2 Hz.
  const Eigen::VectorXd rounded = (Eigen::VectorXd::LinSpaced(1991, 5, 1059.7).array() * 5).round() / 5;
  CHECK(kinds_on(tap(rounded)).empty());
}

TEST_CASE("drift that integration made at the low end, and noise at the high end") {
  // 1 / omega^3 with the phase of a drift: as large as the tip's stiffness line at 60 Hz.
  const auto drift =
      changed(0, [](Complex h, double omega) { return h + Complex(-0.3, 1) * 2.0 / std::pow(omega, 3); });
  const TapFinding low = the(TapFindingKind::kDrift, drift);
  CHECK(low.entry == kXx);
  CHECK(low.lo_hz > 60);
  CHECK(low.lo_hz < 150);
  // Noise of the acceleration.
  dynamics::FrequencyResponse noise = tap(usual_lines());
  std::mt19937_64 generator(5);
  // Noise only weighs little: it is said of driving points, and nothing is left out.
  for (const std::size_t entry : {1u, 0u}) {
    for (Eigen::Index i = 0; i < noise.frequency_hz.size(); ++i)
      noise.entries[entry].h[i] +=
          0.05 * numerics::unit_complex_normal(generator) / std::pow(kTwoPi * noise.frequency_hz[i], 2);
    const Kinds kinds = kinds_on(noise);
    CHECK(std::count(kinds.begin(), kinds.end(), TapFindingKind::kDrift) == (entry == 0 ? 1 : 0));
    CHECK(check_tap(noise, true).usable_from_hz == 0);
  }
  CHECK(the(TapFindingKind::kDrift, noise).lo_hz == 0);
  dynamics::FrequencyResponse high = tap(usual_lines());
  for (Eigen::Index i = 1600; i < high.frequency_hz.size(); ++i)
    high.entries[0].h[i] *= 1.0 + numerics::unit_complex_normal(generator);
  const TapFinding end = the(TapFindingKind::kNoiseAtHighEnd, high);
  CHECK(end.entry == kXx);
  // From line 1600 on, to within a window.
  CHECK(end.lo_hz == Approx(high.frequency_hz[1600]).epsilon(0.13));
}

TEST_CASE("dead channels") {
  std::mt19937_64 generator(5);
  const auto noise =
      changed(1, [&](Complex, double) { return 1e-9 * numerics::unit_complex_normal(generator); });
  CHECK(the(TapFindingKind::kNothingButNoise, noise).entry == kXy);
  const auto constant = changed(1, [&](Complex, double) { return Complex(1e-9, 0); });
  CHECK(the(TapFindingKind::kConstantEntry, constant).entry == kXy);
  const auto zero = changed(1, [&](Complex, double) { return Complex(0, 0); });
  CHECK(the(TapFindingKind::kZeroEntry, zero).entry == kXy);
  CHECK(kinds_on(zero, false).empty());
}

TEST_CASE("signs and quantities that a driving point cannot have") {
  const auto swapped = changed(0, [](Complex h, double) { return -h; });
  CHECK(the(TapFindingKind::kPositive, swapped).entry == kXx);
  CHECK(the(TapFindingKind::kPositive, swapped).most == Approx(1).margin(0.01));
  const auto acceleration = changed(0, [](Complex h, double w) { return -w * w * h; });
  CHECK(the(TapFindingKind::kPositiveRising, acceleration).entry == kXx);
  const auto twice_integrated = changed(0, [](Complex h, double w) { return -h / (w * w); });
  CHECK(the(TapFindingKind::kPositiveFalling, twice_integrated).entry == kXx);
  const auto velocity = changed(0, [](Complex h, double w) { return Complex(0, w) * h; });
  CHECK(the(TapFindingKind::kLikeVelocity, velocity).entry == kXx);
  const auto opposite = changed(1, [](Complex h, double) { return -h; });
  CHECK(the(TapFindingKind::kOppositeMirror, opposite).entry == kXy);
  CHECK(the(TapFindingKind::kOppositeMirror, opposite).mirror == kYx);
  // A cross entry of either sign is sound.
  dynamics::FrequencyResponse both = tap(usual_lines());
  both.entries[1].h *= -1;
  both.entries[2].h *= -1;
  CHECK(kinds_on(both).empty());
}

TEST_CASE("cross entries that are no mirror images") {
  // |1.5 h - h| / |2.5 h| = 0.2; noise of 1 % in each makes sqrt(1.5^2 + 1) / 2.5 % of it.
  const TapFinding finding =
      the(TapFindingKind::kNotReciprocal, changed(1, [](Complex h, double) { return 1.5 * h; }));
  CHECK(finding.most == Approx(0.2).epsilon(0.02));
  CHECK(finding.least == Approx(0.01 * std::sqrt(3.25) / 2.5).epsilon(0.2));
}

TEST_CASE("a unit that is none of m/N") {
  const auto soft = changed(0, [](Complex h, double) { return 1e6 * h; });
  CHECK(the(TapFindingKind::kSoft, soft).most == Approx(soft.entries[0].h.cwiseAbs().maxCoeff()));
  dynamics::FrequencyResponse stiff = tap(usual_lines());
  double largest = 0;
  for (auto& entry : stiff.entries) {
    entry.h *= 1e-9;
    largest = std::max(largest, entry.h.cwiseAbs().maxCoeff());
  }
  CHECK(the(TapFindingKind::kStiff, stiff).most == Approx(largest));
}

TEST_CASE("poor coherence, and the time between two hits") {
  dynamics::FrequencyResponse frf = tap(usual_lines());
  frf.entries[0].coherence = Eigen::VectorXd::Constant(frf.frequency_hz.size(), 0.99);
  CHECK(kinds_on(frf).empty());
  // A second hit of 90 % after 12 ms: the force nearly vanishes every 83 Hz.
  for (Eigen::Index i = 0; i < frf.frequency_hz.size(); ++i) {
    const double force = std::norm(1.0 + 0.9 * std::polar(1.0, -kTwoPi * frf.frequency_hz[i] * 0.012));
    frf.entries[0].coherence[i] = force / (force + 0.2);
  }
  TapFinding finding = the(TapFindingKind::kPoorCoherence, frf);
  CHECK(finding.entry == kXx);
  REQUIRE(finding.hit_delay_s);
  CHECK(*finding.hit_delay_s == Approx(0.012).epsilon(0.02));
  CHECK_FALSE(finding.averages_known);
  CHECK(finding.lo_hz >= 5);
  CHECK(finding.lo_hz < finding.hi_hz);
  // The same coherence everywhere is nobody's second hit.
  frf.entries[0].coherence.setConstant(0.5);
  frf.entries[0].averages = 4;
  finding = the(TapFindingKind::kPoorCoherence, frf);
  CHECK(finding.most == 1);
  CHECK_FALSE(finding.hit_delay_s);
  CHECK(finding.averages_known);
}

TEST_CASE("single disturbed lines are found, resonances are not") {
  dynamics::FrequencyResponse frf = tap(usual_lines());
  for (const Eigen::Index line : {90, 290, 490}) frf.entries[1].h[line] += Complex(3e-6, -5e-6);
  CHECK(disturbed_on(frf) == std::vector<Eigen::Index>{90, 290, 490});
  CHECK(the(TapFindingKind::kDisturbedLines, frf).lines_hz == std::vector<double>{50, 150, 250});
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

TEST_CASE("more disturbed lines than a few are something else, and stay") {
  // Two in a hundred of 1991 lines are 39.
  for (const Eigen::Index count : {39, 40}) {
    dynamics::FrequencyResponse frf = tap(usual_lines());
    for (Eigen::Index i = 0; i < count; ++i) frf.entries[1].h[400 + 30 * i] += Complex(3e-5, -5e-5);
    CHECK(disturbed_on(frf).size() == (count == 39 ? 39u : 0u));
    CHECK(kinds_on(frf) == (count == 39 ? Kinds{TapFindingKind::kDisturbedLines} : Kinds{}));
  }
}

TEST_CASE("responses that were exchanged are told from a structure that is not reciprocal") {
  const auto exchanged = [](std::initializer_list<std::pair<std::size_t, std::size_t>> pairs) {
    dynamics::FrequencyResponse frf = tap(usual_lines());
    for (const auto& [a, b] : pairs) std::swap(frf.entries[a].h, frf.entries[b].h);
    return frf;
  };
  // xx, xy, yx, yy: responses to the force along x, along y, and to both.
  const TapFinding x = the(TapFindingKind::kExchanged, exchanged({{0, 2}}));
  CHECK(x.entry == kXx);
  CHECK(x.mirror == kYx);
  CHECK(x.least < 0.03);
  CHECK(x.most > 0.3);
  CHECK(the(TapFindingKind::kExchanged, exchanged({{1, 3}})).entry == kXy);
  CHECK(the(TapFindingKind::kBothExchanged, exchanged({{0, 2}, {1, 3}})).most > 0.2);
  // Not reciprocal either way.
  const auto scaled = kinds_on(changed(1, [](Complex h, double) { return 1.5 * h; }));
  CHECK(scaled == Kinds{TapFindingKind::kNotReciprocal});
}

TEST_CASE(
    "exchanged responses show where all four entries are much alike, and such entries are no exchange") {
  // Modes within 9 degrees of 45: cross entries nearly equal driving points.
  dynamics::ModalModel model = tip();
  const std::array<double, 3> turned{0.12, -0.15, 0.1};
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    dynamics::Mode& mode = model.modes[k];
    const double angle = kTwoPi / 8 + turned[k];
    mode.psi_r =
        Eigen::Vector2cd(std::cos(angle), std::sin(angle)) * mode.psi_r.norm() * std::sqrt(Complex(0, -1));
    mode.psi_l = mode.psi_r;
  }
  dynamics::FrequencyResponse sound = dynamics::synthesize(model, usual_lines());
  dynamics::add_noise(sound, {40.0, std::nullopt, 5});
  for (auto& entry : sound.entries) entry.variance.resize(0);
  CHECK(kinds_on(sound).empty());
  const auto exchanged = [&](std::initializer_list<std::pair<std::size_t, std::size_t>> pairs) {
    dynamics::FrequencyResponse frf = sound;
    for (const auto& [a, b] : pairs) std::swap(frf.entries[a].h, frf.entries[b].h);
    return frf;
  };
  CHECK(the(TapFindingKind::kExchanged, exchanged({{0, 2}})).entry == kXx);
  const TapFinding y = the(TapFindingKind::kExchanged, exchanged({{1, 3}}));
  CHECK(y.entry == kXy);
  CHECK(y.most < 0.1);
}

TEST_CASE("exchanged responses show where the hits lie beside the sensor") {
  // Mirror images differ by more than a tenth.
  dynamics::ModalModel model = tip();
  const std::array<double, 3> hit{0.25, -0.3, 0.35};
  for (std::size_t k = 0; k < model.modes.size(); ++k) model.modes[k].psi_l[0] *= 1 + hit[k];
  dynamics::FrequencyResponse frf = dynamics::synthesize(model, usual_lines());
  dynamics::add_noise(frf, {40.0, std::nullopt, 6});
  for (auto& entry : frf.entries) entry.variance.resize(0);
  CHECK(the(TapFindingKind::kNotReciprocal, frf).most > 0.1);
  std::swap(frf.entries[0].h, frf.entries[2].h);
  CHECK(the(TapFindingKind::kExchanged, frf).entry == kXx);
}

TEST_CASE("a round tool has equal driving points, and no responses that were exchanged") {
  // Pairs of equal modes at right angles, hits a little beside the sensor: cross entries are small and
  // differ.
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  for (const double hz : {400.0, 900.0, 2000.0}) {
    for (const double turned : {0.0, 1.0}) {
      const double angle = 0.02 + turned * kTwoPi / 4;
      const Eigen::Vector2cd shape =
          1e-3 * Eigen::Vector2cd(std::cos(angle), std::sin(angle)) * std::sqrt(Complex(0, -1));
      dynamics::Mode mode;
      mode.frequency_hz = hz * (1 + 0.002 * turned);
      mode.damping_ratio = 0.03;
      mode.psi_r = mode.psi_l = shape;
      mode.psi_l[turned > 0 ? 0 : 1] +=
          (turned > 0 ? -0.03 : 0.08) * shape.norm() * std::sqrt(Complex(0, -1));
      model.modes.push_back(mode);
    }
  }
  dynamics::FrequencyResponse frf = dynamics::synthesize(model, usual_lines());
  dynamics::add_noise(frf, {50.0, std::nullopt, 7});
  for (auto& entry : frf.entries) entry.variance.resize(0);
  CHECK(kinds_on(frf) == Kinds{TapFindingKind::kNotReciprocal});
}
