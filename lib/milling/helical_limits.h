// The limits of helical teeth at one speed. README.md, "Helical teeth".
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "milling/cutter.h"
#include "milling/floquet.h"
#include "milling/period.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// A depth at which the cut becomes unstable or stable again, with the forces over a period there.
struct HelicalLimit {
  double depth_m = 0;
  bool unstable_above = true;
  std::complex<double> multiplier;  ///< on the unit circle
  std::vector<ForceImpulse> forces;
};

struct HelicalLimits {
  std::vector<HelicalLimit> limits;  ///< by depth
  double error = 0;                  ///< estimated, of their multipliers
  int points = 0;                    ///< polynomials on the longest piece
};

/// Whether limits of a cut may be had this way: helical teeth of equal pitch without process damping.
bool is_helical_for_the_circle(const Cutter& cutter);

/// All limits up to a depth, of a structure that is stable by itself; nothing where the count does not
/// confirm them. Points as the plan says.
std::optional<HelicalLimits> helical_limits(const TipStructure& structure, const Cutter& cutter,
                                            double revolutions_per_s, double largest_depth_m,
                                            const PointPlan& plan);

}  // namespace stablecut::milling
