// The leading multipliers of one speed as functions of the axial depth.
//
// Multipliers are analytic in the depth but where two of them meet. The depths are divided into panels; in
// each, the leading multipliers at eight Chebyshev nodes are joined to branches, and a branch is a polynomial
// whose last coefficients say how exact it is. Where a panel does not resolve them it is made shorter, so
// that a wrong join cannot pass: it is not smooth. Two branches that meet on the real axis and part as a
// complex pair are followed by their sum and product, which stay smooth.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <optional>
#include <vector>

#include "milling/floquet.h"

namespace stablecut::milling {

/// A depth at which a cut becomes unstable or stable again.
struct StabilityBoundary {
  double depth_m = 0;
  bool unstable_above = true;
  std::complex<double> multiplier;  ///< that leaves the unit circle there, to some digits
};

class DepthScan {
 public:
  static constexpr Eigen::Index kNodes = 8;  ///< as many as the eigenvalue solver takes side by side

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
  // A multiplier (or a pair of them that may be real or complex, then sum and product) in Chebyshev
  // polynomials over its panel.
  struct Branch {
    bool pair;
    Eigen::Matrix<double, kNodes, 1> sum, product;  // a single real multiplier is its `sum`
    // NaN where a pair is too near to meeting.
    double radius(double x) const;
  };
  struct Panel {
    double from_m, to_m;
    std::array<double, kNodes> depth_m, radius;  // at the nodes
    bool resolved = false;
    std::vector<Branch> branches;

    double place(double depth) const { return (2 * depth - from_m - to_m) / (to_m - from_m); }
    std::optional<double> interpolated(double depth) const;
  };

  struct Sample {
    double depth, excess;  // radius - 1
  };

  double resolve(Panel& panel) const;
  const Panel& panel_at(double depth) const;
  std::complex<double> largest_multiplier(double depth) const;
  double excess(double depth) const;
  Sample climb(double from, double to, double sign) const;
  StabilityBoundary boundary_between(double stable_m, double unstable_m) const;

  const PeriodMap& map_;
  double largest_depth_m_, tolerance_;
  std::vector<Panel> panels_;
};

}  // namespace stablecut::milling
