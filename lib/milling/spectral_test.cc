#include "milling/spectral.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "milling/milling_fixtures_test.h"
#include "milling/semi_discretization.h"

using namespace stablecut;

TEST_CASE("without a cut the multipliers are those of free flight") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(6, 3));
  for (const int teeth : {1, 2, 3}) {
    const Cutter cutter = fixtures::benchmark_cutter(true, 0.4, teeth);
    const SpectralMap map(structure, cutter, 120, 8);
    const double slowest = structure.lambda.real().maxCoeff();
    CHECK(spectral_radius(map, 0) == Approx(std::exp(slowest * cutter.tooth_period_s(120))).epsilon(1e-12));
  }
}

TEST_CASE("the spectral radius converges exponentially") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(6, 3));
  for (const auto& [teeth, immersion] : {std::pair{2, 0.25}, std::pair{3, 1.0}, std::pair{5, 0.6}}) {
    const Cutter cutter = fixtures::benchmark_cutter(false, immersion, teeth);
    const double converged = spectral_radius(SpectralMap(structure, cutter, 60, 40), 1e-3);
    const double coarse = std::abs(spectral_radius(SpectralMap(structure, cutter, 60, 12), 1e-3) - converged);
    const double fine = std::abs(spectral_radius(SpectralMap(structure, cutter, 60, 24), 1e-3) - converged);
    INFO(teeth << " teeth: " << coarse << ", " << fine);
    CHECK(fine < 1e-11);
    CHECK(fine <= coarse);
  }
}

TEST_CASE("semi-discretization tends to the spectral result, with the square of the interval") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 11));
  for (const auto& [teeth, immersion] : {std::pair{2, 0.25}, std::pair{3, 1.0}, std::pair{4, 0.9}}) {
    Cutter cutter = fixtures::benchmark_cutter(true, immersion, teeth);
    cutter.feed_angle_rad = 0.5;
    const double exact = spectral_radius(SpectralMap(structure, cutter, 200, 30), 0.8e-3);
    const double error_80 =
        std::abs(spectral_radius(SemiDiscretizationMap(structure, cutter, 200, 80), 0.8e-3) - exact);
    const double error_320 =
        std::abs(spectral_radius(SemiDiscretizationMap(structure, cutter, 200, 320), 0.8e-3) - exact);
    INFO(teeth << " teeth: " << error_80 << ", " << error_320);
    CHECK(error_320 < error_80 / 4);
    CHECK(error_320 < 1e-4);
  }
}
