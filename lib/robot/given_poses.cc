#include "robot/given_poses.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr double kOutside = 1e-9;      // rad
constexpr double kMostRadians = 6.3;   // of a written angle: a full turn, rounded
constexpr double kLeastRadians = 0.7;  // of the largest written angle

}  // namespace

std::vector<OutsideLimits> poses_outside_limits(const Robot& robot, const std::vector<JointAngles>& poses) {
  std::vector<OutsideLimits> outside;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    OutsideLimits farthest{static_cast<int>(p), 0, kOutside};
    bool any = false;
    for (int j = 0; j < kJoints; ++j) {
      const double beyond = -robot.range(j, poses[p]).margin_rad(poses[p][j]);
      if (!(beyond > farthest.beyond_rad)) continue;
      farthest.joint = j;
      farthest.beyond_rad = beyond;
      any = true;
    }
    if (any) outside.push_back(farthest);
  }
  return outside;
}

std::optional<double> looks_like_radians(const std::vector<JointAngles>& poses) {
  double largest = 0;
  for (const JointAngles& angles : poses) largest = std::max(largest, angles.lpNorm<Eigen::Infinity>());
  largest = degrees_from_radians(largest);
  return largest >= kLeastRadians && largest <= kMostRadians ? std::optional(largest) : std::nullopt;
}

}  // namespace stablecut::robot
