// How fast a small deviation from the periodic motion grows in the simulation. README.md, "Growth".
#pragma once

#include <complex>

#include "milling/simulated_cut.h"

namespace stablecut::milling {

struct SimulatedGrowth {
  double per_tooth = 0;  ///< the factor by which the fastest growing deviation grows from tooth to tooth
  double error = 0;      ///< of it, relative: its change by the last doubling of the steps
  std::complex<double> multiplier;  ///< of that deviation over `passes` teeth
  int passes = 1;
  SimulationSteps steps;  ///< with which it was found
};

/// Of one simulation: the leading eigenvalue of its deviations' map, by the method of Arnoldi [Arnoldi1951].
/// Throws NoAnswer where that does not settle.
SimulatedGrowth growth_of(const SimulatedCut& cut, double displacement_scale_m);

/// The motion that repeats every cycle where the teeth stay in contact, at the beginning of one: the state of
/// at_rest() moved. By the generalized minimal residual [Saad1986].
SimulatedCut::State periodic_state(const SimulatedCut& cut, double displacement_scale_m);

/// With as many steps as it needs. Throws NoAnswer, with Remedy::kModes, where the fastest mode turns too
/// often to be followed.
SimulatedGrowth simulated_growth(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                                 double revolutions_per_s, double depth_m);

}  // namespace stablecut::milling
