// Materials and sizes that no milling tool has, as numbers in other units than the expected ones have.
// README.md, section 4.
#pragma once

#include <optional>

#include "receptance/held_tool.h"

namespace stablecut::receptance {

/// Why a material is no solid's, and by which factors its numbers become one's.
struct MaterialDoubt {
  enum class Kind {
    kModulus,   ///< above that of any solid
    kDensity,   ///< outside those of solids
    kWaveSpeed  ///< sqrt(E / rho) outside those of solids, rubber apart
  };
  Kind kind;
  double wave_speed_m_per_s;
  /// Powers of ten by which modulus and density are multiplied to be a solid's, as few as possible; both 1
  /// where no usual unit explains them.
  double modulus_factor = 1, density_factor = 1;
};

/// Nothing where the material may be a solid's.
std::optional<MaterialDoubt> material_doubt(double youngs_modulus_pa, double density_kg_per_m3);

/// Why a chain is no tool or holder.
enum class SizeDoubt {
  kDiameter,  ///< it is nowhere as thick as kLeastDiameter
  kLength     ///< the whole of it is shorter than kLeastLength
};

/// Nothing where the segments, of which there is at least one, may be those of a tool or a holder.
std::optional<SizeDoubt> size_doubt(const BeamChain& chain);

}  // namespace stablecut::receptance
