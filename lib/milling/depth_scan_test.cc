#include "milling/depth_scan.h"

#include <catch2/catch.hpp>

#include "base/range.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

// Every change of sign on a fine grid is a boundary, in the same order. How many there are.
std::size_t check_against_direct(const PeriodMap& map, double largest_depth_m, int count) {
  const DepthScan scan(map, largest_depth_m);
  const std::vector<double> depths = Range{0, largest_depth_m, count}.values();
  const std::vector<double> radii = scan.spectral_radii(depths), direct = spectral_radii(map, depths);
  const std::vector<StabilityBoundary> boundaries = scan.boundaries();
  std::size_t found = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    INFO("depth " << depths[i] << ", radius " << direct[i]);
    CHECK(std::abs(radii[i] - direct[i]) < 2e-7 * std::max(1.0, direct[i]));
    if (i == 0 || (direct[i] > 1) == (direct[i - 1] > 1)) continue;
    // Pairs of boundaries between two grid points are finer than the grid.
    while (found < boundaries.size() && boundaries[found].depth_m < depths[i - 1]) ++found;
    bool seen = false;
    for (; found < boundaries.size() && boundaries[found].depth_m <= depths[i]; ++found)
      seen = seen || boundaries[found].unstable_above == (direct[i] > 1);
    CHECK(seen);
  }
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    CHECK(boundaries[i].unstable_above == (i % 2 == 0));
    CHECK(spectral_radius(map, boundaries[i].depth_m) == Approx(1).margin(1e-8));
  }
  return boundaries.size();
}

}  // namespace

TEST_CASE("the multipliers' branches agree with every depth computed by itself") {
  std::size_t boundaries = 0;
  for (const int modes : {1, 2, 4, 9, 15}) {
    const TipStructure structure =
        tip_structure(fixtures::coupled_modes(modes, static_cast<unsigned>(modes)));
    for (const double speed : {60.0, 150.0, 400.0}) {
      for (const double immersion : {0.1, 0.6}) {
        INFO(modes << " modes, " << speed << " /s, immersion " << immersion);
        const SpectralMap map(structure, fixtures::benchmark_cutter(speed < 200, immersion), speed, 14);
        boundaries += check_against_direct(map, 6e-3, 401);
      }
    }
  }
  CHECK(boundaries > 20);
}

TEST_CASE("flips and islands of the one-mode slot and of low immersion") {
  const TipStructure one = tip_structure(fixtures::oscillator({"x"}));
  const TipStructure two = tip_structure(fixtures::oscillator({"x", "y"}));
  std::size_t slot = 0, low = 0;
  for (const double rpm : {2500.0, 5000.0, 7000.0, 9000.0, 12000.0, 14500.0, 20000.0, 26000.0}) {
    INFO(rpm << " rpm");
    slot +=
        check_against_direct(SpectralMap(one, fixtures::benchmark_cutter(false, 1), rpm / 60, 24), 5e-3, 801);
    low += check_against_direct(SpectralMap(two, fixtures::benchmark_cutter(true, 0.05), rpm / 60, 12), 10e-3,
                                801);
  }
  CHECK(slot >= 8);
  CHECK(low >= 6);
  // Stable again from 2.9 to 3.8 mm.
  const Cutter down = fixtures::benchmark_cutter(false, 0.1);
  CHECK(check_against_direct(SpectralMap(one, down, 18025.3 / 60, 16), 20e-3, 801) == 3);
}
