// Where a program has to send the tool so that under the force it is where the path wants it. README.md, "The
// deflection under a cut".
#pragma once

#include "robot/inverse.h"
#include "robot/pose_report.h"

namespace stablecut::robot {

/// What has to be added to the tool point of a pose, m, base frame, so that the deflection under the mean
/// force there brings the tool point back: offset = -C_tt(p + offset) F, with the tool's orientation and the
/// branch of the pose. `task` of the pose, with a force in the base's frame or a cut.
Eigen::Vector3d cancelling_offset(const Robot& robot, const InverseKinematics& inverse,
                                  const PoseReport& report, const StiffnessTask& task,
                                  const Elasticity& elasticity);

}  // namespace stablecut::robot
