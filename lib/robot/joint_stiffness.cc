#include "robot/joint_stiffness.h"

namespace stablecut::robot {

Elasticity joints_only(const JointAngles& compliance) {
  Elasticity elasticity;
  for (int j = 0; j < kJoints; ++j) elasticity.springs.push_back({Spring::Kind::kJoint, j, 2});
  elasticity.compliance = compliance;
  return elasticity;
}

}  // namespace stablecut::robot
