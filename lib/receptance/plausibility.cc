#include "receptance/plausibility.h"

#include <algorithm>
#include <cmath>

namespace stablecut::receptance {
namespace {

// README.md, section 18.
constexpr double kMostModulus = 1300e9;    // Pa
constexpr double kLeastDensity = 22.6;     // kg/m3
constexpr double kMostDensity = 22.6e3;    // kg/m3
constexpr double kLeastWaveSpeed = 450;    // m/s
constexpr double kMostWaveSpeed = 19e3;    // m/s
constexpr double kLeastDiameter = 0.5e-3;  // m
constexpr double kLeastLength = 1e-3;      // m
// Numbers in MPa, kPa, Pa or TPa taken for GPa; in g/cm3, kg/mm3, t/mm3 or g/m3 taken for kg/m3.
constexpr double kModulusUnits[] = {1, 1e-3, 1e-6, 1e-9, 1e3};
constexpr double kDensityUnits[] = {1, 1e3, 1e9, 1e12, 1e-3};

std::optional<MaterialDoubt> doubt_of(double modulus, double density) {
  const double speed = std::sqrt(modulus / density);
  if (modulus > kMostModulus) return MaterialDoubt{MaterialDoubt::Kind::kModulus, speed};
  if (!(density > kLeastDensity && density <= kMostDensity))
    return MaterialDoubt{MaterialDoubt::Kind::kDensity, speed};
  if (!(speed >= kLeastWaveSpeed && speed <= kMostWaveSpeed))
    return MaterialDoubt{MaterialDoubt::Kind::kWaveSpeed, speed};
  return std::nullopt;
}

}  // namespace

std::optional<MaterialDoubt> material_doubt(double youngs_modulus_pa, double density_kg_per_m3) {
  std::optional<MaterialDoubt> doubt = doubt_of(youngs_modulus_pa, density_kg_per_m3);
  if (!doubt) return doubt;
  int fewest = 3;  // more than there can be
  for (const double modulus : kModulusUnits) {
    for (const double density : kDensityUnits) {
      const int changes = (modulus != 1) + (density != 1);
      if (changes >= fewest || doubt_of(modulus * youngs_modulus_pa, density * density_kg_per_m3)) continue;
      fewest = changes;
      doubt->modulus_factor = modulus;
      doubt->density_factor = density;
    }
  }
  return doubt;
}

std::optional<SizeDoubt> size_doubt(const BeamChain& chain) {
  double thickest = 0;
  for (const BeamSegment& segment : chain) thickest = std::max(thickest, segment.outer_diameter_m);
  if (thickest < kLeastDiameter) return SizeDoubt::kDiameter;
  if (length_of(chain) < kLeastLength) return SizeDoubt::kLength;
  return std::nullopt;
}

}  // namespace stablecut::receptance
