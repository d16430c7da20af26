#include "robot/joint_stiffness.h"

namespace stablecut::robot {

Elasticity joints_only(const JointAngles& compliance) { return {joint_springs(), compliance}; }

}  // namespace stablecut::robot
