// Places of the unit circle at which eigenvalues of a circle operator are computed, as many as it takes to
// know what crosses the positive real axis. README.md, "The search on the unit circle".
#pragma once

#include <array>
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

/// Of a cut whose operator changes with the depth: operators of equal rows at a low and a high depth beside
/// the one, at a depth between, that is searched.
struct DepthVariation {
  double low_m = 0, searched_m = 0, high_m = 0;
  CircleOperator low, high;
};

class CircleSearch {
 public:
  /// For limits up to a depth. The operator must outlive the search. With a variation (which must too) the
  /// values are 1 / a where 1 / a is an eigenvalue of the operator at a, to the first order of what changes.
  CircleSearch(const CircleOperator& of, double largest_depth_m, const DepthVariation* along = nullptr);

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
  /// Whether some curve turns back within this share of its size from the axis, above a depth.
  bool turns_near_axis(double share, double least_depth_m) const;
  /// The number of multipliers outside the unit circle at a depth, from the winding of det(I - depth M); none
  /// where its phase changes too much from place to place.
  std::optional<int> count(double depth_m) const;
  std::vector<double> angles() const;
  /// The value nearest to that of each, at its angle.
  std::vector<std::complex<double>> values_near(const std::vector<Start>& at);

 private:
  void add(const std::vector<double>& angles);
  std::vector<Place> computed(const CircleLanes::Angles& angles, std::size_t count);

  void follow_depth(const std::array<std::vector<std::size_t>, CircleLanes::kPlaces>& wanted,
                    std::size_t turn, std::vector<Place>& places);

  CircleLanes lanes_;
  double least_;
  const DepthVariation* along_;
  std::list<Place> places_;
};

}  // namespace stablecut::milling
