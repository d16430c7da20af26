#include "robot/arm_springs.h"

#include <algorithm>
#include <cmath>

namespace stablecut::robot {
namespace {

constexpr double kAlike =
    1e-12;  // of the base's largest compliance: rounding of its turn into the home frame

}  // namespace

bool ArmSprings::base_alike_about_axis1() const {
  const double largest = std::max({base[0], base[3], base[5]});
  return std::max({std::abs(base[0] - base[3]), std::abs(base[1]), std::abs(base[2]), std::abs(base[4])}) <=
         kAlike * largest;
}

ArmSprings arm_springs(const Robot& robot, const Elasticity& elasticity, const InverseKinematics& inverse) {
  ArmSprings arm;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < elasticity.springs.size(); ++k) {
    const Spring& spring = elasticity.springs[k];
    const double compliance = elasticity.compliance[k];
    switch (spring.kind) {
      case Spring::Kind::kJoint:
        arm.joint[spring.joint] = compliance;
        break;
      case Spring::Kind::kBearing:
        (spring.axis == 0 ? arm.bearing_x : arm.bearing_y)[spring.joint] = compliance;
        arm.beyond_joints |= compliance != 0;
        break;
      case Spring::Kind::kBase:
        base[spring.axis] = compliance;
        arm.beyond_joints |= compliance != 0;
        break;
    }
  }
  const Eigen::Matrix3d to_home = inverse.home_from_base().linear();
  const Eigen::Matrix3d home = to_home * base.asDiagonal() * to_home.transpose();
  int entry = 0;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) arm.base[entry++] = home(row, column);
  }
  const auto& j = robot.joints;
  const ArmConstants& k = inverse.constants();
  arm.sin_alpha1 = k.sin_alpha1;
  arm.a2 = k.a2;
  arm.d6 = k.d6;
  arm.forearm = k.forearm;
  arm.cos_bend = k.cos_bend;
  arm.sin_bend = k.sin_bend;
  arm.along_axis2[0] = j[1].d_m;
  arm.along_axis2[1] =
      j[1].d_m + j[2].cos_alpha() * j[2].d_m;  // axis 3 has axis 2's direction or its opposite
  return arm;
}

}  // namespace stablecut::robot
