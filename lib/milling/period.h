// The map of one period at one speed, with as many points as it needs. README.md, "How many points".
#pragma once

#include <memory>
#include <string>

#include "base/error.h"
#include "milling/cutter.h"
#include "milling/floquet.h"
#include "milling/structure.h"

namespace stablecut::milling {

enum class StabilityMethod {
  kSpectral,            ///< collocation on the arcs in cut, refined until it has converged
  kSemiDiscretization,  ///< the zeroth-order scheme of [RobotMillingThesis] at a given number of intervals
};

struct StabilityScheme {
  StabilityMethod method = StabilityMethod::kSpectral;
  int intervals = 40;  ///< m, for the semi-discretization
};

/// A period map at one speed with what is known of its error. README.md, "How many points".
struct PreparedPeriod {
  std::unique_ptr<PeriodMap> map;
  /// Estimated error of the spectral radius, of max(1, radius): the change when points are added (spectral),
  /// or the distance to the spectral method (semi-discretization); the largest at a few depths.
  double error = 0;
  int resolution = 0;  ///< points on the longest piece of the cut, or intervals
};

/// The map at one speed, for depths up to `largest_depth_m`; where the radius is above 100 its error is not
/// looked at. The structure must outlive the map. Throws NoAnswer, with Remedy::kModes, when the speed is so
/// low that the fastest mode cannot be followed through one cut, or when the radius does not converge.
PreparedPeriod prepare_period(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                              const StabilityScheme& scheme, double largest_depth_m);

/// How many points on the longest piece to begin with and to take at most, and the change of a multiplier
/// that is small enough.
struct PointPlan {
  int first = 0, most = 0;
  double wanted = 0;
  bool follows_all = true;  ///< false: fast modes are out of chatter's reach, and their ringing is left out
};
/// For depths up to `largest_depth_m`. Throws NoAnswer where the fastest mode turns too often to be followed.
PointPlan point_plan(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                     double largest_depth_m);
/// The same for polynomials along each tooth's way through the cut, with unequal pitches.
PointPlan plan_by_tooth(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s);
/// The number of points to try after `points`.
int more_points(int points);

/// An error from which on a radius says nothing about stability by itself.
inline constexpr double kUseless = 0.01;
/// That there is no answer at a speed, and why.
NoAnswer no_answer_at(double revolutions_per_s, const std::string& what);
/// Throws it where an error is so large that the radius says nothing.
void refuse_useless(double revolutions_per_s, double error);

}  // namespace stablecut::milling
