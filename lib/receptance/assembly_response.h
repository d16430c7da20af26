// The frequency responses of an assembly, as a frequency response document has them.
#pragma once

#include <vector>

#include "base/progress.h"
#include "dynamics/frequency_response.h"
#include "receptance/assembly.h"

namespace stablecut::receptance {

struct ResponseChoice {
  bool slopes = false;              ///< also slopes as responses and moments as references
  std::vector<double> positions_m;  ///< places on the tool, from the tip; empty: the tip, with its mass
};

/// The entries xx, xy, yx, yy at the tip, or those of every ordered pair of places, on the assembly's lines;
/// receptances in m/N (m/(N m), rad/N and rad/(N m) with slopes). Throws InvalidArgument for places that are
/// not on the tool.
dynamics::FrequencyResponse assembly_response(const Assembly& assembly, const ResponseChoice& choice,
                                              int threads, const Progress& progress = {});

}  // namespace stablecut::receptance
