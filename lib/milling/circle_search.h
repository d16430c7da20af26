// Places of the unit circle at which eigenvalues of a circle operator are computed, as many as it takes to
// know what crosses the positive real axis. README.md, "The search on the unit circle".
#pragma once

#include <complex>
#include <list>
#include <optional>
#include <vector>

#include "milling/circle_curves.h"
#include "milling/circle_lanes.h"
#include "milling/circle_operator.h"
#include "milling/real_pair.h"

namespace stablecut::milling {

/// What Newton's method changes the angle for: an eigenvalue that is real, or whose imaginary part is least
/// or greatest; nothing where the multiplier is real (+1 or -1), or where any eigenvalue will do.
enum class Seek { kAxis, kTouch, kAtOne, kValue };

/// An eigenvalue to begin Newton's method with.
struct Start {
  double angle = 0;
  std::complex<double> value;
  Seek seek = Seek::kAxis;
  double curvature = 0;  ///< of a touch: second derivative of the imaginary part by the angle
};

class CircleSearch {
 public:
  /// For limits up to a depth. The operator must outlive the search.
  CircleSearch(const CircleOperator& of, double largest_depth_m);

  /// Bisects stretches until it is clear in all of them what crosses the axis.
  void settle();
  /// Bisects all stretches, and settles them.
  void refine();

  /// What crosses the positive real axis, touches it, or lies on it at +1 and -1.
  std::vector<Start> starts() const;
  /// Eigenvalues at +1 and -1 that are nearly one.
  std::vector<RealPair> pairs() const;
  /// The value nearest to a limit, whether or not it is one.
  std::optional<Start> nearest() const;
  /// Whether some curve comes nearer to the axis than this share of its size without crossing it there.
  bool touches(double share) const;
  /// The number of multipliers outside the unit circle at a depth, from the winding of det(I - depth M); none
  /// where its phase changes too much from place to place.
  std::optional<int> count(double depth_m) const;
  std::vector<double> angles() const;

 private:
  void add(const std::vector<double>& angles);
  std::vector<Place> computed(const CircleLanes::Angles& angles, std::size_t count);

  CircleLanes lanes_;
  double least_;
  std::list<Place> places_;
};

}  // namespace stablecut::milling
