#include "receptance/measured_holder.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "dynamics/synthesis.h"
#include "receptance/receptance_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::receptance;
using namespace stablecut::receptance::fixtures;

namespace {

constexpr BeamTheory kTheory = BeamTheory::kTimoshenko;
const Eigen::VectorXd kLines = Eigen::VectorXd::LinSpaced(60, 100, 3050);
constexpr int kDeflections[] = {0, 2};
constexpr const char* kNames[] = {"x", "slope_x", "y", "slope_y"};

// A spindle of three modes that move x, y and their slopes.
dynamics::ModalModel spindle(bool coupled) {
  dynamics::ModalModel model;
  model.dofs = {"x", "slope_x", "y", "slope_y"};
  for (int k = 0; k < 3; ++k) {
    dynamics::Mode mode;
    mode.frequency_hz = 600.0 + 700 * k;
    mode.damping_ratio = 0.03;
    const double size = 1e-2 / (k + 1), turn = 8.0 * (k + 1);
    mode.psi_r.resize(4);
    mode.psi_r << size, size * turn, coupled ? 0.5 * size : 0, coupled ? -0.4 * size * turn : 0;
    mode.psi_l = std::complex<double>(0, -1) * mode.psi_r;
    model.modes.push_back(mode);
    if (coupled) continue;
    std::swap(mode.psi_r[0], mode.psi_r[2]);
    std::swap(mode.psi_r[1], mode.psi_r[3]);
    std::swap(mode.psi_l[0], mode.psi_l[2]);
    std::swap(mode.psi_l[1], mode.psi_l[3]);
    mode.frequency_hz *= 1.1;
    model.modes.push_back(mode);
  }
  return model;
}

BeamChain artefact() {
  BeamChain chain = {bar(25), bar(30)};
  chain[0].outer_diameter_m = 0.03;
  chain[1].outer_diameter_m = 0.045;
  return chain;
}

// The taps of deflections on a held artefact (or on the bare holder, with places 0 only), at pairs of places.
dynamics::FrequencyResponse taps_on(const MeasuredHolder& holder, const BeamChain& chain, double mass_kg,
                                    const std::vector<std::pair<double, double>>& places) {
  dynamics::FrequencyResponse frf;
  frf.frequency_hz = kLines;
  for (const auto& [a, b] : places) {
    for (const int d : kDeflections) {
      for (const int e : kDeflections) {
        dynamics::FrequencyResponseEntry entry;
        entry.response = kNames[d];
        entry.reference = kNames[e];
        entry.response_position_m = a;
        entry.reference_position_m = b;
        entry.h.resize(kLines.size());
        for (Eigen::Index i = 0; i < kLines.size(); ++i) {
          const double omega = rad_per_s_from_hz(kLines[i]);
          const Receptance<4>& h = holder.receptance[i];
          const Receptance<4> along = receptance_along<4>(chain, kTheory, omega, h, a, b);
          const Receptance<4> direct = receptance_along<4>(chain, kTheory, omega, h, a, a);
          Receptance<4> mass = Receptance<4>::Zero();
          mass(0, 0) = mass(2, 2) = mass_kg * omega * omega;
          entry.h[i] = ((Receptance<4>::Identity() - direct * mass).inverse() * along)(d, e);
        }
        // The tests give a known noise, so small that it decides nothing.
        entry.variance = 1e-20 * entry.h.cwiseAbs2();
        frf.entries.push_back(entry);
      }
    }
  }
  return frf;
}

double largest_error(const MeasuredHolder& found, const MeasuredHolder& expected) {
  double worst = 0;
  for (std::size_t i = 0; i < expected.receptance.size(); ++i) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        const double size = std::sqrt(std::abs(expected.receptance[i](a, a) * expected.receptance[i](b, b)));
        worst = std::max(worst, std::abs(found.receptance[i](a, b) - expected.receptance[i](a, b)) / size);
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("measured with slopes: the modes' receptance, coupled or not") {
  for (const bool coupled : {false, true}) {
    const MeasuredHolder expected = modal_holder(spindle(coupled), kLines);
    CHECK(expected.couples_directions == coupled);
    HolderMeasurement measurement{dynamics::synthesize(spindle(coupled), kLines), 0, {}};
    const MeasuredHolder found = measured_holder(measurement, kTheory, kLines);
    CHECK(found.couples_directions == coupled);
    CHECK(largest_error(found, expected) < 1e-12);
    CHECK(found.quality[0].slopes == SlopeSource::kMeasured);
    CHECK(found.quality[0].unphysical_hz.empty());
    // Between the lines: the cubic is good where the lines are dense.
    const Eigen::VectorXd between = Eigen::VectorXd::LinSpaced(50, 500.25, 2500.75);
    measurement.frf = dynamics::synthesize(spindle(coupled), Eigen::VectorXd::LinSpaced(3000, 100, 3099));
    CHECK(largest_error(measured_holder(measurement, kTheory, between),
                        modal_holder(spindle(coupled), between)) < 1e-5);
    CHECK_THROWS_AS(measured_holder(measurement, kTheory, Eigen::VectorXd::LinSpaced(2, 50, 100)),
                    InvalidArgument);
  }
}

TEST_CASE("taps along a known artefact give what holds it, coupled or not, and without the sensor's mass") {
  for (const bool coupled : {false, true}) {
    const MeasuredHolder expected = modal_holder(spindle(coupled), kLines);
    for (const double mass : {0.0, 0.005}) {
      HolderMeasurement measurement{
          taps_on(expected, artefact(), mass, {{0, 0}, {0, 0.03}, {0.03, 0}, {0.03, 0.03}}), mass,
          artefact()};
      const MeasuredHolder found = measured_holder(measurement, kTheory, kLines);
      CHECK(largest_error(found, expected) < 1e-6);
      CHECK(found.couples_directions == coupled);
      CHECK(found.quality[1].slopes == SlopeSource::kArtefact);
      CHECK(found.quality[1].noisy_hz.empty());
      CHECK(found.quality[1].unphysical_hz.empty());
      if (mass > 0) {
        measurement.sensor_mass_kg = 0;
        CHECK(largest_error(measured_holder(measurement, kTheory, kLines), expected) > 1e-3);
      }
    }
  }
}

TEST_CASE("too few cross taps on an artefact are left out, too few direct ones go by differences") {
  const MeasuredHolder expected = modal_holder(spindle(true), kLines);
  HolderMeasurement measurement{taps_on(expected, artefact(), 0, {{0, 0}, {0, 0.03}, {0.03, 0.03}}), 0,
                                artefact()};
  // Across, only the tip.
  std::erase_if(measurement.frf.entries, [](const auto& e) {
    return e.response != e.reference && *e.response_position_m + *e.reference_position_m > 0;
  });
  const MeasuredHolder found = measured_holder(measurement, kTheory, kLines);
  CHECK(found.cross_left_out);
  CHECK_FALSE(found.couples_directions);
  // Three pairs across (h(0,0), h(0,S), h(S,0)) are one too few: left out, not refused.
  measurement.frf = taps_on(expected, artefact(), 0, {{0, 0}, {0, 0.03}, {0.03, 0.03}});
  std::erase_if(measurement.frf.entries, [](const auto& e) {
    return e.response != e.reference && *e.response_position_m + *e.reference_position_m > 0.05;
  });
  CHECK(measured_holder(measurement, kTheory, kLines).cross_left_out);
  measurement.frf = taps_on(modal_holder(spindle(false), kLines), artefact(), 0, {{0, 0}, {0, 0.03}});
  const MeasuredHolder differences = measured_holder(measurement, kTheory, kLines);
  CHECK(differences.quality[0].slopes == SlopeSource::kFiniteDifference);
  CHECK(differences.quality[0].spacing_m == 0.03);
}

TEST_CASE("the finite difference: exact for a rigid holder, its noise and its energy are watched") {
  // A rigid body moves its places in a line: a spindle that turns about a point 100 mm behind its face.
  const MeasuredHolder body = [] {
    dynamics::ModalModel model = spindle(false);
    for (dynamics::Mode& mode : model.modes) {
      for (const Eigen::Index at : {0, 2})
        mode.psi_r[at + 1] = mode.psi_r[at] / 0.1, mode.psi_l[at + 1] = mode.psi_l[at] / 0.1;
    }
    return modal_holder(model, kLines);
  }();
  BeamChain stub = {bar(40)};
  stub[0].outer_diameter_m = 0.2;
  stub[0].youngs_modulus_pa = 1e18;
  stub[0].density_kg_per_m3 = 1e-6;
  const auto at_tip = [&](std::vector<std::pair<double, double>> places) {
    return HolderMeasurement{taps_on(body, stub, 0, std::move(places)), 0, {}};
  };
  const MeasuredHolder second =
      measured_holder(at_tip({{0, 0}, {0, 0.02}, {0.02, 0}, {0.02, 0.02}}), kTheory, kLines);
  double worst = 0;
  for (Eigen::Index i = 0; i < kLines.size(); ++i) {
    const std::size_t at = i;
    const Receptance<2> tip =
        held_chain<2>(stub, kTheory, rad_per_s_from_hz(kLines[i]), body.receptance[at].topLeftCorner<2, 2>());
    worst = std::max(worst, (second.receptance[at].topLeftCorner<2, 2>() - tip)
                                .cwiseAbs()
                                .cwiseQuotient(tip.cwiseAbs())
                                .maxCoeff());
  }
  CHECK(worst < 1e-6);
  CHECK(second.quality[0].second_difference);
  CHECK(second.quality[0].unphysical_hz.empty());
  // With one transfer point p = l n / h, which for one mode of motion (here: turning about one point) is
  // exact.
  const MeasuredHolder first = measured_holder(at_tip({{0, 0}, {0, 0.02}}), kTheory, kLines);
  CHECK_FALSE(first.quality[0].second_difference);
  CHECK(std::abs(first.receptance[9](1, 1) - second.receptance[9](1, 1)) <
        1e-5 * std::abs(second.receptance[9](1, 1)));
  // Noise as large as the difference: said of every line.
  HolderMeasurement noisy = at_tip({{0, 0}, {0, 0.02}});
  for (auto& entry : noisy.frf.entries) entry.variance = entry.h.cwiseAbs2();
  CHECK(measured_holder(noisy, kTheory, kLines).quality[0].noisy_hz.size() ==
        static_cast<std::size_t>(kLines.size()));
  // The same on an artefact: none below the noise of the other tests, all in a large one.
  HolderMeasurement along{
      taps_on(modal_holder(spindle(false), kLines), artefact(), 0, {{0, 0}, {0, 0.03}, {0.03, 0.03}}), 0,
      artefact()};
  CHECK(measured_holder(along, kTheory, kLines).quality[0].noisy_hz.empty());
  for (auto& entry : along.frf.entries) entry.variance = entry.h.cwiseAbs2();
  CHECK(measured_holder(along, kTheory, kLines).quality[0].noisy_hz.size() ==
        static_cast<std::size_t>(kLines.size()));
  // A curve of the wrong sign gives energy away.
  HolderMeasurement wrong = at_tip({{0, 0}, {0, 0.02}});
  for (auto& entry : wrong.frf.entries) entry.h *= -1;
  CHECK(measured_holder(wrong, kTheory, kLines).quality[0].unphysical_hz.size() > 50);  // of 60 lines
}

TEST_CASE("one direction, with or without entries across it; across one way only") {
  const MeasuredHolder expected = modal_holder(spindle(true), kLines);
  const auto keep = [](dynamics::FrequencyResponse frf, const std::vector<std::string>& kept) {
    std::erase_if(frf.entries, [&](const auto& e) {
      return std::find(kept.begin(), kept.end(), e.response + e.reference) == kept.end();
    });
    return frf;
  };
  const std::vector<std::pair<double, double>> places = {{0, 0}, {0, 0.03}, {0.03, 0}, {0.03, 0.03}};
  const dynamics::FrequencyResponse taps = taps_on(expected, artefact(), 0, places);
  for (const BeamChain& chain : {artefact(), BeamChain{}}) {
    const MeasuredHolder alone = measured_holder({keep(taps, {"xx"}), 0, chain}, kTheory, kLines);
    const MeasuredHolder across = measured_holder({keep(taps, {"xx", "yx"}), 0, chain}, kTheory, kLines);
    CHECK_FALSE(alone.cross_left_out);
    CHECK(across.cross_left_out);
    CHECK_FALSE(across.couples_directions);
    CHECK_FALSE(across.quality[1].measured);
    for (std::size_t i = 0; i < alone.receptance.size(); ++i)
      CHECK(alone.receptance[i] == across.receptance[i]);
  }
  // What was measured one way holds the other way.
  const MeasuredHolder one_way =
      measured_holder({keep(taps, {"xx", "yy", "yx"}), 0, artefact()}, kTheory, kLines);
  CHECK(one_way.couples_directions);
  CHECK(largest_error(one_way, expected) < 1e-6);
  // Too little across: left out, not refused.
  dynamics::FrequencyResponse few = keep(taps, {"xx", "yy"});
  few.entries.push_back(taps.entries[1]);
  CHECK(measured_holder({few, 0, {}}, kTheory, kLines).cross_left_out);
  // h(0, S) and h(S, 0) say the same: two pairs of places go by differences.
  dynamics::FrequencyResponse two = keep(taps, {"xx"});
  two.entries.pop_back();
  CHECK(measured_holder({two, 0, artefact()}, kTheory, kLines).quality[0].slopes ==
        SlopeSource::kFiniteDifference);
}

TEST_CASE("a line at 0 Hz of a measured acceleration") {
  dynamics::FrequencyResponse frf = dynamics::synthesize(spindle(false), kLines);
  frf.quantity = dynamics::Quantity::kAccelerance;
  for (auto& entry : frf.entries) {
    Eigen::VectorXcd h(kLines.size() + 1);
    h << 0, (-(kTwoPi * kLines).array().square() * entry.h.array()).matrix();
    entry.h = h;
  }
  frf.frequency_hz.resize(kLines.size() + 1);
  frf.frequency_hz << 0, kLines;
  CHECK(largest_error(measured_holder({frf, 0, {}}, kTheory, kLines), modal_holder(spindle(false), kLines)) <
        1e-12);
}

TEST_CASE("measurements that do not suffice") {
  const MeasuredHolder holder = modal_holder(spindle(false), kLines);
  const auto refused = [&](std::vector<std::pair<double, double>> places, double mass) {
    const HolderMeasurement measurement{taps_on(holder, artefact(), 0, std::move(places)), mass, {}};
    CHECK_THROWS_AS(measured_holder(measurement, kTheory, kLines), InvalidArgument);
  };
  refused({{0, 0}}, 0);
  refused({{0, 0}, {0, 0.01}, {0, 0.02}}, 0);
  refused({{0, 0.01}}, 0);
  refused({{0, 0}, {0.01, 0}}, 0.005);
  dynamics::ModalModel table = spindle(false);
  table.dofs = {"x", "slope_x", "y", "z"};
  CHECK_THROWS_AS(modal_holder(table, kLines), InvalidArgument);
  table.dofs = {"u", "v", "w", "z"};
  CHECK_THROWS_AS(modal_holder(table, kLines), InvalidArgument);
}
