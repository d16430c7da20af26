#include "taps/force_disturbance.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "taps/averages.h"
#include "taps/hit_spectra.h"
#include "taps/tap_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::taps;
using Eigen::Index;

namespace {

constexpr double kRate = 2560;  // pulses of 1 ms are as wide as lines up to rate / 2.56 allow
constexpr int kFiner = 8;
const std::vector<fixtures::Blow> kBlows = {{0.2, 80}, {2.3, 60}, {4.5, 95}, {6.7, 70}};
const Index kSamples = static_cast<Index>(9 * kRate);

// The blows as a converter sees them whose linear-phase filter falls by half a cosine wave from rate / 2.56
// on to as far above rate / 2, 9 samples late.
Eigen::VectorXd filtered_force() {
  const Eigen::VectorXd fine = fixtures::force_of(kBlows, kFiner * kRate, kFiner * kSamples);
  Eigen::FFT<double> transform;
  Eigen::VectorXcd spectrum, filtered;
  transform.fwd(spectrum, fine);
  const Index length = fine.size();
  for (Index k = 0; k < length; ++k) {
    const double periods = static_cast<double>(k <= length / 2 ? k : k - length) * kFiner /
                           static_cast<double>(length);  // in a sample of the record
    const double fall = std::clamp((std::abs(periods) - 1 / 2.56) / (1 - 2 / 2.56), 0.0, 1.0);
    spectrum[k] *= std::polar((1 + std::cos(kPi * fall)) / 2, -kTwoPi * periods * 9);
  }
  transform.inv(filtered, spectrum);
  Eigen::VectorXd force(kSamples);
  for (Index i = 0; i < kSamples; ++i) force[i] = filtered[kFiner * i].real();
  return force;
}

// As a converter of 16 bits gives it.
std::vector<Record> recorded(const Eigen::VectorXd& force, double noise, unsigned seed) {
  std::mt19937_64 generator(seed);
  Record record{kRate, force, {}};
  fixtures::add_noise(record.force, noise, generator);
  const double step = 2 * 125.0 / 65536;
  for (double& value : record.force) value = step * std::round(value / step);
  return {record};
}

bool disturbed(const std::vector<Record>& records) {
  const HitSearch search = find_hits(records);
  REQUIRE(search.hits.size() == kBlows.size());
  const Index length = transform_length(search.length);
  return force_disturbed(records, search, length,
                         static_cast<Index>(std::floor(static_cast<double>(length) / 2.56)));
}

// First order, as a charge amplifier that loses its charge in 0.5 s.
Eigen::VectorXd with_undershoot(const Eigen::VectorXd& force) {
  Eigen::VectorXd result = force;
  double lost = 0;
  for (Index i = 0; i < force.size(); ++i) {
    result[i] -= lost;
    lost += result[i] / (0.5 * kRate);
  }
  return result;
}

}  // namespace

TEST_CASE("what a converter's filter rings is no disturbance of the force, an undershoot and a drift are") {
  const Eigen::VectorXd force = filtered_force(), undershoot = with_undershoot(force);
  Eigen::VectorXd drifting = force;
  for (Index i = 0; i < kSamples; ++i) drifting[i] += 0.2 * std::sin(2.0 * static_cast<double>(i) / kRate);
  // From half a step of the converter to twenty.
  for (const double noise : {0.002, 0.02, 0.08}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      CHECK_FALSE(disturbed(recorded(force, noise, seed)));
      CHECK(disturbed(recorded(undershoot, noise, seed)));
      CHECK(disturbed(recorded(drifting, noise, seed)));
    }
  }
}

TEST_CASE("the force window leaves the lines the pulse that a converter's filter has drawn out") {
  const Eigen::VectorXd force = filtered_force();
  const Record record{kRate, force, {}};
  const HitSearch search = find_hits({record});
  REQUIRE(search.hits.size() == kBlows.size());
  const Index length = transform_length(search.length);
  const auto lines = static_cast<Index>(std::floor(static_cast<double>(length) / 2.56));
  for (const Hit& hit : search.hits) {
    const auto through = [&](ForceWindow window) {
      return force_spectrum(record, hit, length, lines, 0, 0, {0, window}).force;
    };
    const Eigen::VectorXcd whole = through(ForceWindow::kNone), pulse = through(ForceWindow::kPulse);
    CHECK(((pulse - whole).array().abs() / whole.array().abs()).maxCoeff() < 5e-4);
    CHECK((pulse + through(ForceWindow::kAway) - whole).norm() < 1e-12 * whole.norm());
  }
}

TEST_CASE("where the force ends in its noise does not depend on the force window") {
  const std::vector<Record> records = recorded(filtered_force(), 0.2, 3);
  const HitSearch search = find_hits(records);
  const Index length = transform_length(search.length);
  const auto ends = [&](ForceWindow window) {
    std::vector<HitSpectrum> hits;
    for (const Hit& hit : search.hits)
      hits.push_back(force_spectrum(records[0], hit, length, length / 2 - 1, search.offset_n[0],
                                    search.noise_n[0], {0, window}));
    return static_cast<double>(lines_with_force(hits));
  };
  const double whole = ends(ForceWindow::kNone);
  CHECK(whole < 0.45 * static_cast<double>(length));
  // The noise moves the first line that falls below the level.
  CHECK(ends(ForceWindow::kPulse) == Approx(whole).epsilon(0.2));
}
