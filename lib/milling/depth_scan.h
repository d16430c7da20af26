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

/// A depth at which a cut becomes unstable or stable again.
struct StabilityBoundary {
  double depth_m = 0;
  bool unstable_above = true;
  std::complex<double> multiplier;  ///< that leaves the unit circle there, to some digits
};

class DepthScan {
 public:
  /// Errors of the interpolation that are good enough for a chart, and where only limits are wanted (a
  /// crossing is corrected with the map itself), of max(1, radius).
  static constexpr double kExact = 2e-7, kForLimits = 1e-4;

  /// Depths (0, largest_depth_m], largest_depth_m > 0. The map must outlive the scan.
  DepthScan(const PeriodMap& map, double largest_depth_m, double tolerance = kExact);

  /// The spectral radius, of one tooth's pass, at each depth in [0, largest_depth_m], to the tolerance beside
  /// the map's own error.
  std::vector<double> spectral_radii(const std::vector<double>& depths_m) const;

  /// Every boundary of stability, increasing, to 1e-9 of the largest depth or the accuracy of the map. Two
  /// that are closer than some thousandth of the largest depth may be missed.
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
};

}  // namespace stablecut::milling
