// The leading multipliers of one speed as functions of the axial depth. README.md, "The depth scan".
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <optional>
#include <vector>

#include "milling/floquet.h"
#include "milling/tracks.h"

namespace stablecut::milling {

/// A depth at which the spectral radius passes 1.
struct StabilityBoundary {
  double depth_m = 0;
  bool unstable_above = true;
  std::complex<double> multiplier;  ///< the one on the unit circle there, to some digits
};

/// From this radius on nobody needs its digits: it is only above.
inline constexpr double kFarAbove = 100;

/// What a radius differs from a better one by, of max(1, radius), both as far as they lie below kFarAbove.
/// Where it is below the distance of the radius, as far as that, from 1, both say the same about stability.
double radius_error(double radius, double better);

class DepthScan {
 public:
  /// Tolerances of the interpolation, of max(1, radius): for a grid of radii, and where only limits are
  /// wanted, which are corrected with the map itself.
  static constexpr double kExact = 2e-7, kForLimits = 1e-4;

  /// Follows the multipliers over the depths from 0 to `largest_depth_m` > 0. The map must outlive the scan.
  DepthScan(const PeriodMap& map, double largest_depth_m, double tolerance = kExact);

  /// The spectral radius for one tooth at each depth in [0, largest_depth_m]: that of the map, to the
  /// tolerance.
  std::vector<double> spectral_radii(const std::vector<double>& depths_m) const;

  /// The largest difference of the radii from those of a better map, of max(1, radius), at a few depths where
  /// the interpolation is worst: at depth 0 and in the panels of the largest errors. See radius_error().
  double error_against(const PeriodMap& better) const;

  /// Every boundary of stability, by depth, to 1e-9 of the largest depth or the map's accuracy. Two that are
  /// closer than some thousandth of the largest depth may be missed. Throws InvalidArgument where that takes
  /// thousands of maps.
  std::vector<StabilityBoundary> boundaries() const;

 private:
  // One real multiplier, as its `sum`; or two that are both real or a complex pair, as sum and product: in
  // Chebyshev polynomials over the panel.
  struct Branch {
    bool is_pair;
    Eigen::Matrix<double, kNodes, 1> sum, product;
    // The largest modulus at x in [-1, 1]; NaN where a pair is too near to meeting.
    double radius(double x) const;
  };
  struct Panel {
    double from_m, to_m;
    std::array<double, kNodes> depth_m, radius;  // at the nodes
    bool resolved = false;
    double error = 0;  // as resolve() says
    std::vector<Branch> branches;

    double place(double depth) const { return (2 * depth - from_m - to_m) / (to_m - from_m); }
    double gap_of(const Track& track) const;
    // None where the panel is not resolved, or a pair is too near to meeting.
    std::optional<double> interpolated(double depth) const;
  };

  struct Sample {
    double depth, excess;  // radius - 1
  };

  double resolve(Panel& panel) const;
  std::array<std::vector<std::complex<double>>, kNodes> sample(Panel& panel) const;
  static Branch branch_of(const TrackGroup& group, const std::vector<Track>& tracks);
  const Panel& panel_at(double depth) const;
  std::complex<double> largest_multiplier(double depth) const;
  double excess(double depth) const;
  std::vector<Sample> samples() const;
  static bool may_hide_crossings(const Sample& before, const Sample& top, const Sample& after);
  Sample climb(double from, double to, double sign) const;
  StabilityBoundary boundary_between(double stable_m, double unstable_m) const;

  const PeriodMap& map_;
  double largest_depth_m_, tolerance_;
  std::vector<Panel> panels_;
  mutable int maps_ = 0;  // computed for boundaries
};

}  // namespace stablecut::milling
