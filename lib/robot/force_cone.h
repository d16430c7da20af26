// The largest deflection under a force whose direction is not known exactly: it may lie anywhere in a cone,
// or turn about an axis as the teeth of a cutter turn it. README.md, "A force that turns".
#pragma once

#include <Eigen/Core>

namespace stablecut::robot {

/// A direction that maximizes a length, and that length.
struct LargestDeflection {
  double length = 0;        ///< m
  Eigen::Vector3d force_n;  ///< under which it is reached
};

/// The largest |C F| over all F = along + radius (p cos(phi) + q sin(phi)), with p, q of length 1 at right
/// angles to each other and to `axis`: a force that turns once about `axis` (length 1). `compliance` C is
/// symmetric, m/N; `along` in N, parallel to `axis` or not.
/// Where two forces tie the largest has a kink. With `smoothing` s it is replaced by a smooth length that
/// lies above it by at most s of the part that turns; the force is then not the one that reaches it.
LargestDeflection largest_over_turn(const Eigen::Matrix3d& compliance, const Eigen::Vector3d& along,
                                    const Eigen::Vector3d& axis, double radius_n, double smoothing = 0);

/// The largest |C F| over all F of the length of `force_n` that make at most `angle_rad` (0 to pi/2) with it.
LargestDeflection largest_over_cone(const Eigen::Matrix3d& compliance, const Eigen::Vector3d& force_n,
                                    double angle_rad, double smoothing = 0);

}  // namespace stablecut::robot
