// Every depth at which a multiplier of helical teeth passes the unit circle, at one speed. README.md,
// "Helical teeth".
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "milling/circle_reduction.h"
#include "milling/circle_scan.h"
#include "milling/helical_force.h"

namespace stablecut::milling {

/// A passage with what its equation depth * kappa(angle, depth) = 1 changes by, per rad and per m.
struct HelicalPassage : CirclePassage {
  std::complex<double> by_angle, by_depth;
};

struct HelicalPassages {
  std::vector<HelicalPassage> found;  ///< by depth
  bool confirmed = false;             ///< by the winding number at several depths
  std::optional<Start> nearest;       ///< without a passage: what comes nearest to one, at the largest depth
};

/// All passages between depth 0 and the largest, of a structure that is stable by itself.
HelicalPassages helical_passages(const HelicalForce& force, double largest_depth_m);

/// An eigenvalue of an operator near a value, with its vectors, by inverse iteration.
EigenTriple eigenvalue_near(const CircleOperator& of, double angle, std::complex<double> near);

/// One step of Newton's method from a passage whose eigenvalue has turned out to be another: changes of the
/// angle (none of a real multiplier) and of the depth.
struct PassageStep {
  double angle = 0, depth_m = 0;
};
PassageStep step_from(const HelicalPassage& at, std::complex<double> value);

}  // namespace stablecut::milling
