// What a stable cut leaves on the part: where its surface lies, and how the tip moves. README.md, "Surface".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "milling/cutting_force.h"
#include "milling/forced_vibration.h"
#include "milling/lobes.h"
#include "milling/regenerative_vibration.h"

namespace stablecut::milling {

struct SurfacePoint {
  /// Where the surface lies against the one that the cutter would leave if it stood still: of the walls that
  /// the cut leaves (at phi = 0 and 180 degrees) and along the edge the largest in size, positive where
  /// material is left. Of teeth that leave different ones the deepest counts. None where no tooth touches a
  /// wall.
  std::optional<double> location_error_m;
  /// The same where the path is offset by the negative mean deflection.
  std::optional<double> error_with_offset_m;
  double peak_vibration_m = 0;  ///< largest distance of the tip from its mean, in the plane of the cut
  double rms_vibration_m = 0;
  Eigen::Vector2d mean_deflection_m = Eigen::Vector2d::Zero();  ///< along the feed and normal to it
};

/// What the stand-in modes below a table's band add to its static compliance, m/N, in x and y.
Eigen::Matrix2d compliance_below_band(const dynamics::ModalModel& model);

/// What cuts at one speed leave. The structure, the cutter and the load must outlive it.
class SurfaceAtSpeed {
 public:
  /// `resolution` as StabilityChart's, needed where vibration changes the chip. `added_compliance` (m/N, in
  /// the structure's frame, x and y) moves the tip under the mean force beside what the structure does.
  SurfaceAtSpeed(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                 double revolutions_per_s, int resolution,
                 const Eigen::Matrix2d& added_compliance = Eigen::Matrix2d::Zero());

  SurfacePoint at(double depth_m);
  /// The deepest cut up to a depth up to which the wall's location is off by no more than this, either way.
  double deepest_within(double largest_error_m, double depth_m);

 private:
  // A tooth at a wall, at some height of its edge.
  struct Passage {
    double wall_rad, turn_rad, runout_m;
    int height;
  };
  void set_depth(double depth_m);
  std::vector<Passage> passages(double depth_m) const;
  Eigen::Matrix3Xd displacements(double depth_m, const std::vector<Passage>& passages);
  double points_per_rad(double depth_m) const;

  const TipStructure& structure_;
  const Cutter& cutter_;
  const CuttingLoad& load_;
  double revolutions_per_s_;
  int resolution_;
  Eigen::Matrix2d added_compliance_;
  double depth_m_ = 0;     // of the force, where that changes with it
  Eigen::Vector2d added_;  // displacement per depth
  std::optional<ForcedVibration> forced_;
  int samples_;  // of a period
  std::optional<RegenerativeVibration> regenerative_;
  std::optional<SurfacePoint> per_depth_;  // where all is in proportion to the depth
};

/// [depths][speeds]; nothing where the cut is unstable or the chart has no answer. The chart with its grid.
using SurfaceChart = std::vector<std::vector<std::optional<SurfacePoint>>>;
SurfaceChart surface_chart(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                           const std::vector<double>& revolutions_per_s, const std::vector<double>& depths_m,
                           const StabilityChart& chart, const Eigen::Matrix2d& added_compliance, int threads,
                           const Progress& progress = {});

}  // namespace stablecut::milling
