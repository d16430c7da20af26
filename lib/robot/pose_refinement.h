// The last step of a pose search: from a sample to the local optimum. README.md, "Refinement".
#pragma once

#include <optional>

#include "robot/pose_scan.h"

namespace stablecut::robot {

/// Scores that differ by no more than 1e-7 of their size are equal.
bool equal_scores(double a, double b);

/// The local optimum of the start's branch over those of x, y (m) and redundancy (rad) that are free and
/// matter, within the task's intervals, limits and margins; first steps of size `radius` (m and rad). Nothing
/// when no allowed point is found from there.
std::optional<FoundPose> refined_pose(const PoseScanner& scanner, const PlanePoint& start, double radius);

}  // namespace stablecut::robot
