// The circle operator of unequal pitches, with polynomials along each tooth's way through the cut. README.md,
// "Unequal pitches on the unit circle".
#pragma once

#include "milling/circle_operator.h"
#include "milling/cut_schedule.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// `arcs` as tooth_arcs, with `polynomials` >= 1 for each number that the force of an arc depends on.
PeriodForce tooth_arc_force(const TipStructure& structure, const CutSchedule& arcs, double revolutions_per_s,
                            int polynomials);

}  // namespace stablecut::milling
