// What yields beside the joints, for the kernel: bearings and foundation in the frames of the four arms.
// README.md, "Elasticity".
#pragma once

#include "robot/inverse.h"
#include "robot/joint_stiffness.h"

namespace stablecut::robot {

/// An Elasticity as the kernel wants it; rad/(N m) and m/N, home frame.
struct ArmSprings {
  double joint[kJoints] = {};
  bool beyond_joints = false;                               ///< any of what follows is not 0
  double base[6] = {};                                      ///< compliance of the foundation: xx ... zz
  double bearing_x[kJoints] = {}, bearing_y[kJoints] = {};  ///< about x and y of the joints' frames
  // Of the robot's table, as in ArmConstants; lengths in m.
  double sin_alpha1 = 1, a2 = 1, d6 = 0, forearm = 1, cos_bend = 1, sin_bend = 0;
  double along_axis2[2] = {};  ///< of the origins of frames 2 and 3 from the arm's points on axes 2 and 3

  /// The compliance is the same in all directions across axis 1, and axis 1 is a principal direction.
  bool base_alike_about_axis1() const;
  /// A turn of frame 6 about its z does not change what its bearing gives.
  bool bearing6_alike() const { return bearing_x[kJoints - 1] == bearing_y[kJoints - 1]; }
};

/// For the robot of that inverse kinematics.
ArmSprings arm_springs(const Robot& robot, const Elasticity& elasticity, const InverseKinematics& inverse);

/// Adds what bearings and foundation yield to what arm_compliances() gives for the same point.
void add_spring_compliances(const ArmLanes& lanes, const ArmSprings& springs, const double point[3],
                            double compliance[6][kArms]);

}  // namespace stablecut::robot
