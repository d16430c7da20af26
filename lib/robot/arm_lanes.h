// The hot kernel of inverse kinematics and pose search: the four arms (shoulder front or rear, elbow on
// either side) that bring a spherical wrist to a target, side by side on plain arrays, so that the compiler
// can use wide vectors. Built for several processors; without fused multiply-adds, so each gives the same
// bytes.
#pragma once

namespace stablecut::robot {

inline constexpr int kArms = 4;      ///< arm = 2 * rear shoulder + elbow on the negative side
inline constexpr int kBranches = 8;  ///< branch = 4 * flipped wrist + arm

/// A robot with parallel shoulder and elbow axes and a spherical wrist, as the kernel wants it. Lengths in m.
/// "Home" is frame 0 turned by alpha of link 0 and moved by a of link 0 and d of joint 1: its z is axis 1.
struct ArmConstants {
  double home[3][3], home_shift[3];  ///< from the base frame to home: rows of the rotation, and the shift
  double cos_alpha1, sin_alpha1, a1;
  double along_axis2;         ///< of the wrist centre, from home: the same in every pose
  double a2, forearm;         ///< upper arm, and wrist centre's distance from axis 3
  double cos_bend, sin_bend;  ///< of the wrist centre's direction in frame 3, turned into the sense of axis 2
  double elbow_sense;         ///< +1 where axis 3 has axis 2's direction, else -1
  double cos_alpha3, sin_alpha3;  ///< with half a turn added for the elbow's sense -1
  double wrist4, wrist5;          ///< signs of alpha 4 and alpha 5, which are +-90 degrees
  double d6;
  double sign[6], offset[6];  ///< theta = sign * (angle + ratio * followed angle) + offset
  double least[6], most[6];   ///< of the angle
  double middle[6], half_range[6];
  bool coupled;    ///< any joint follows another
  int follows[6];  ///< index of the followed joint, below the joint's own; -1 for none
  double ratio[6];
  double coupled_least[6], coupled_most[6];  ///< of angle + ratio * followed angle, or infinite
  double cos_free1, sin_free1;               ///< of theta of joint 1 where the target leaves it free
  double cos_free4, sin_free4;               ///< and of joint 4
};

/// Where frame 6 has to be: its x and z axes and origin, base frame.
struct ArmTarget {
  double x[3], z[3], origin[3];
};

/// What reaches the target, in the home frame (m). Where an arm does not reach, its limit margins are
/// -infinity and the rest is finite and means nothing.
struct ArmLanes {
  double angle[6][kBranches];      ///< controller angles, the copy nearest the middle of the range
  double limit_margin[kBranches];  ///< least distance to a limit, rad; negative outside
  // Axes of the arms: unit vectors and points on them. Axes 4, 5 and 6 meet at the wrist centre; a flipped
  // wrist has the same lines. axis3 is parallel to axis2.
  double axis2[3][kArms], point2[3][kArms], point3[3][kArms];
  double axis4[3][kArms], axis5[3][kArms];
  double axis6[3], wrist[3];
  double x6[3];  ///< x of frame 6, unit vector
};

/// Policies where the target leaves a joint free: on axis 1, and with axes 4 and 6 in line,
/// joints 1 and 4 take their free angle (and joint 6 the rest); with the wrist centre on axis 2 joint 2's
/// theta is 0. A target within 1e-12 (relative) outside the reach counts as stretched.
void solve_arms(const ArmConstants& robot, const ArmTarget& target, ArmLanes& lanes);

/// Translational compliance C_tt = sum c_j v_j v_j^T at a tool point (home frame, m), for each arm: entries
/// xx, xy, xz, yy, yz, zz in m/N, with c_j in rad/(N m) and v_j the velocity of the point per joint.
void arm_compliances(const ArmLanes& lanes, const double point[3], const double joint_compliance[6],
                     double compliance[6][kArms]);

/// The largest eigenvalue of each, m/N, to 1e-8 of the spread of the eigenvalues.
void largest_arm_compliances(const double compliance[6][kArms], double largest[kArms]);

}  // namespace stablecut::robot
