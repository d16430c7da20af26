// Every depth at which a multiplier passes the unit circle, at one speed. README.md, "Limits from the unit
// circle".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "base/units.h"
#include "milling/circle_operator.h"
#include "milling/circle_search.h"
#include "milling/real_pair.h"

namespace stablecut::milling {

/// A depth with a multiplier on the unit circle, at an angle in [0, pi]; its conjugate is meant too.
struct CirclePassage {
  double depth_m = 0;
  double angle = 0;  ///< of the multiplier
  bool outwards = true;
  Seek seek = Seek::kAxis;      ///< what was sought; of a passage kAxis or kAtOne
  double curvature = 0;         ///< of a touch: second derivative of Im value by the angle
  std::complex<double> value;   ///< the eigenvalue of M: 1 / depth
  std::complex<double> from;    ///< the one that it was sought from
  std::complex<double> slope;   ///< its derivative by the angle
  Eigen::VectorXcd difference;  ///< [rows] what the rows sense, to a factor: right eigenvector
  Eigen::VectorXcd left;        ///< [rows] left eigenvector

  /// Of a touch: the imaginary part where it is least or greatest. It crosses the axis twice where that and
  /// the curvature have different signs.
  double extremum() const { return value.imag() - slope.imag() * slope.imag() / (2 * curvature); }
  bool is_real() const { return seek == Seek::kAtOne; }  ///< +1 or -1: passes alone
  std::complex<double> multiplier() const {
    return is_real() ? (angle > kPi / 2 ? -1.0 : 1.0) : std::polar(1.0, angle);
  }
  /// Of the number of multipliers outside the circle.
  int change() const { return (outwards ? 1 : -1) * (is_real() ? 1 : 2); }
};

/// Newton's method ends where the imaginary part is this share of the eigenvalue.
constexpr double kOnAxis = 1e-11;

/// Those of some passages, by depth, at which the cut becomes unstable (outwards) or stable again.
template <typename Passage>
std::vector<const Passage*> boundaries_among(const std::vector<Passage>& found) {
  std::vector<const Passage*> result;
  int outside = 0;
  for (const Passage& passage : found) {
    const int after = outside + passage.change();
    if ((after > 0) != (outside > 0)) result.push_back(&passage);
    outside = after;
  }
  return result;
}

struct CirclePassages {
  std::vector<CirclePassage> found;  ///< by depth
  /// Whether the winding number of det(I - depth M) agrees with them at several depths.
  bool confirmed = false;
  /// The eigenvalue of M on the circle that is nearest to a limit; none where M has none to speak of.
  std::optional<CirclePassage> nearest;
  /// Where two passages are close together or nearly are: eigenvalues whose imaginary part is least or
  /// greatest and nearly 0, and those at +1 and -1 that are nearly one.
  std::vector<CirclePassage> touches;
  std::vector<RealPair> pairs;
  Eigen::Index most = 0;  ///< polynomials on the longest arc
};

/// All passages between depth 0 and the largest, of a structure that is stable by itself.
CirclePassages circle_passages(const CircleOperator& whole, double largest_depth_m);

/// What another operator of the same cut changes.
struct Carried {
  double change = 0;      ///< the largest of the boundaries' multipliers; of the nearest where there is none
  bool doubtful = false;  ///< a touch or a pair changes so much that it may be two passages, or none
};

/// Carries passages over to an operator of the same cut with more polynomials along the same arcs, where they
/// are near.
Carried carried_over(CirclePassages& passages, const CircleOperator& finer);

}  // namespace stablecut::milling
