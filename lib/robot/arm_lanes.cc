#include "robot/arm_lanes.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "base/units.h"
#include "numerics/elementary_lanes.h"

namespace stablecut::robot {
namespace {

using Four = numerics::FourLanes;
using Mask = decltype(Four{} < Four{});
using numerics::absolute;
using numerics::angle_of;
using numerics::least;
using numerics::square_root;

constexpr double kReachTolerance = 1e-12;  // relative
constexpr double kFreeRadius = 1e-10;      // m: nearer to axis 1 than this, joint 1 is free
constexpr double kFreeSine = 1e-11;        // axes 4 and 6 nearer in line than this: joint 4 is free
constexpr double kFolded = 1e-40;          // m^4: a wrist centre nearer to axis 2 leaves joint 2 free

STABLECUT_INLINE Four load(const double* from) { return numerics::load_lanes<Four>(from); }
STABLECUT_INLINE void store(const Four& v, double* to) { numerics::store_lanes(v, to); }

// A joint's controller angle, the copy nearest the middle of its range, and its margin to the limits.
struct JointLanes {
  Four angle, margin;
};

// Without a coupling.
STABLECUT_INLINE JointLanes joint_lanes(const ArmConstants& robot, int joint, const Four& theta) {
  Four angle = robot.sign[joint] * (theta - robot.offset[joint]);
  angle = angle + kTwoPi * numerics::nearest_whole((robot.middle[joint] - angle) * (1 / kTwoPi));
  return {angle, robot.half_range[joint] - absolute(angle - robot.middle[joint])};
}

// With one; `angles` holds those of the joints before. The range is what Robot::range says.
STABLECUT_INLINE JointLanes coupled_joint_lanes(const ArmConstants& robot, int joint, const Four& theta,
                                                const Four angles[6]) {
  const Four zero = {}, added = robot.ratio[joint] * angles[robot.follows[joint]];
  const Four least_angle = numerics::largest(zero + robot.least[joint], robot.coupled_least[joint] - added);
  const Four most_angle = least(zero + robot.most[joint], robot.coupled_most[joint] - added);
  const Four middle = 0.5 * (least_angle + most_angle), half_range = 0.5 * (most_angle - least_angle);
  Four angle = robot.sign[joint] * (theta - robot.offset[joint]) - added;
  angle = angle + kTwoPi * numerics::nearest_whole((middle - angle) * (1 / kTwoPi));
  return {angle, half_range - absolute(angle - middle)};
}

// The steps of solve_arms, in the order of README.md, "Inverse kinematics". They are always inlined: each
// version that is built for a processor has its own copy of them.

// What has to be reached, in the home frame: the tool-side frame's axes x6 and z6, and the wrist centre.
struct HomeTarget {
  double x6[3], z6[3], wrist[3];
};

STABLECUT_INLINE HomeTarget target_in_home(const ArmConstants& k, const ArmTarget& target) {
  const auto turned = [&k](const double v[3], double w[3]) STABLECUT_INLINE_LAMBDA {
    for (int i = 0; i < 3; ++i) w[i] = k.home[i][0] * v[0] + k.home[i][1] * v[1] + k.home[i][2] * v[2];
  };
  HomeTarget home;
  double p6[3];
  turned(target.x, home.x6);
  turned(target.z, home.z6);
  turned(target.origin, p6);
  for (int i = 0; i < 3; ++i) p6[i] += k.home_shift[i];
  for (int i = 0; i < 3; ++i) home.wrist[i] = p6[i] - k.d6 * home.z6[i];
  return home;
}

// Joint 1, and the wrist centre (x1, v) from it in the plane of the arm: x1 along x of frame 1, v square to
// x1 and to axis 2.
struct Shoulder {
  Four c1, s1;
  Four x1;
  double v;
  bool reaches;
};

STABLECUT_INLINE Shoulder solve_shoulder(const ArmConstants& k, const double wrist[3]) {
  const double wx = wrist[0], wy = wrist[1], wz = wrist[2];
  // Joint 1 turns the wrist centre into the plane that lies along_axis2 from axis 1:
  // z2 . wrist = -sin(alpha1) y1 + cos(alpha1) z = along_axis2, with (x1, y1) in frame 1.
  const double radius2 = wx * wx + wy * wy;
  const double y1 = (k.cos_alpha1 * wz - k.along_axis2) / k.sin_alpha1;
  const double x1_squared = radius2 - y1 * y1;
  const bool on_axis1 = radius2 < kFreeRadius * kFreeRadius;
  const double per_radius2 = on_axis1 ? 0 : 1 / radius2;
  const double free_c1 = on_axis1 ? k.cos_free1 : 0, free_s1 = on_axis1 ? k.sin_free1 : 0;
  const double x1_size = std::sqrt(x1_squared > 0 ? x1_squared : 0);
  const Four front = {1, 1, -1, -1};
  Shoulder shoulder;
  shoulder.reaches = x1_squared >= -kReachTolerance * (radius2 + k.forearm * k.forearm);
  shoulder.x1 = front * x1_size;
  shoulder.c1 = (wx * shoulder.x1 + wy * y1) * per_radius2 + free_c1;
  shoulder.s1 = (wy * shoulder.x1 - wx * y1) * per_radius2 + free_s1;
  shoulder.v = k.cos_alpha1 * y1 + k.sin_alpha1 * wz;
  return shoulder;
}

// Joints 2 and 3 as a planar pair of links: u + i v = exp(i theta2) (a2 + forearm exp(i bent)), with u
// counted from axis 2. A bent of 0 is a stretched arm.
struct Elbow {
  Mask reaches;
  Four c2, s2;
  Four cp, sp;    // of theta3 in the sense of axis 2
  Four c23, s23;  // of theta2 + theta3 in that sense
};

STABLECUT_INLINE Elbow solve_elbow(const ArmConstants& k, const Shoulder& shoulder) {
  const double sum2 = k.a2 * k.a2 + k.forearm * k.forearm, per_2al = 0.5 / (k.a2 * k.forearm);
  const Four side = {1, -1, 1, -1};
  const Four zero = {}, one = zero + 1;
  const Four u = shoulder.x1 - k.a1;
  const double v = shoulder.v;
  const Four reach2 = u * u + v * v;
  const Four cos_bent_raw = (reach2 - sum2) * per_2al;
  Elbow elbow;
  elbow.reaches = absolute(cos_bent_raw) <= 1 + kReachTolerance;
  const Four cb = least(numerics::largest(cos_bent_raw, Four{} - 1), Four{} + 1);
  const Four sb = side * square_root((1 - cb) * (1 + cb));
  const Four tx = k.a2 + k.forearm * cb, ty = k.forearm * sb;
  const Four size2 = reach2 * (tx * tx + ty * ty);
  const auto opened = size2 > kFolded;
  const Four per_size = 1 / square_root(opened ? size2 : one);
  elbow.c2 = opened ? (u * tx + v * ty) * per_size : one;
  elbow.s2 = opened ? (v * tx - u * ty) * per_size : zero;
  elbow.cp = cb * k.cos_bend + sb * k.sin_bend;
  elbow.sp = sb * k.cos_bend - cb * k.sin_bend;
  elbow.c23 = elbow.c2 * elbow.cp - elbow.s2 * elbow.sp;
  elbow.s23 = elbow.s2 * elbow.cp + elbow.c2 * elbow.sp;
  return elbow;
}

// The frames that shoulder and elbow leave, in the home frame: y and z of frame 1 turned by alpha1 (z is axis
// 2), and frame 3 turned by alpha3, with columns e, a and b (b is axis 4).
struct ForearmAxes {
  Four f1yx, f1yy, f1yz, f1zx, f1zy, f1zz;
  Four ex, ey, ez, ax, ay, az, bx, by, bz;
};

STABLECUT_INLINE ForearmAxes forearm_axes(const ArmConstants& k, const Shoulder& shoulder,
                                          const Elbow& elbow) {
  const Four zero = {};
  const Four c1 = shoulder.c1, s1 = shoulder.s1, c23 = elbow.c23, s23 = elbow.s23;
  ForearmAxes m;
  m.f1yx = -s1 * k.cos_alpha1, m.f1yy = c1 * k.cos_alpha1, m.f1yz = zero + k.sin_alpha1;
  m.f1zx = s1 * k.sin_alpha1, m.f1zy = -c1 * k.sin_alpha1, m.f1zz = zero + k.cos_alpha1;
  m.ex = c23 * c1 + s23 * m.f1yx, m.ey = c23 * s1 + s23 * m.f1yy, m.ez = s23 * m.f1yz;
  const Four y3x = c23 * m.f1yx - s23 * c1, y3y = c23 * m.f1yy - s23 * s1, y3z = c23 * m.f1yz;
  m.ax = k.cos_alpha3 * y3x + k.sin_alpha3 * m.f1zx, m.ay = k.cos_alpha3 * y3y + k.sin_alpha3 * m.f1zy,
  m.az = k.cos_alpha3 * y3z + k.sin_alpha3 * m.f1zz;
  m.bx = k.cos_alpha3 * m.f1zx - k.sin_alpha3 * y3x, m.by = k.cos_alpha3 * m.f1zy - k.sin_alpha3 * y3y,
  m.bz = k.cos_alpha3 * m.f1zz - k.sin_alpha3 * y3z;
  return m;
}

// Joints 4 to 6 of the wrist with sin(theta5) not below 0; the flipped wrist has theta4 and theta6 half a
// turn further and theta5 reversed.
struct Wrist {
  Four c4, s4, c5, s5, c6, s6;
};

STABLECUT_INLINE Wrist solve_wrist(const ArmConstants& k, const HomeTarget& home, const ForearmAxes& m) {
  const Four zero = {}, one = zero + 1;
  const double* const x6 = home.x6;
  const double* const z6 = home.z6;
  const double wrist45 = k.wrist4 * k.wrist5;
  // M = Rz(theta4) Rx(alpha4) Rz(theta5) Rx(alpha5) Rz(theta6), its first and third columns.
  const Four m11 = m.ex * x6[0] + m.ey * x6[1] + m.ez * x6[2],
             m21 = m.ax * x6[0] + m.ay * x6[1] + m.az * x6[2],
             m31 = m.bx * x6[0] + m.by * x6[1] + m.bz * x6[2];
  const Four m13 = m.ex * z6[0] + m.ey * z6[1] + m.ez * z6[2],
             m23 = m.ax * z6[0] + m.ay * z6[1] + m.az * z6[2],
             m33 = m.bx * z6[0] + m.by * z6[1] + m.bz * z6[2];
  // m13 = c4 s5 wrist5, m23 = s4 s5 wrist5, m33 = -wrist45 c5.
  Wrist wrist;
  wrist.s5 = square_root(m13 * m13 + m23 * m23);
  wrist.c5 = -wrist45 * m33;
  const auto in_line = wrist.s5 < kFreeSine;
  const Four per_s5 = k.wrist5 / (in_line ? one : wrist.s5);
  wrist.c4 = in_line ? zero + k.cos_free4 : m13 * per_s5;
  wrist.s4 = in_line ? zero + k.sin_free4 : m23 * per_s5;
  // theta6 from what is left after theta4 and theta5: well conditioned in every pose.
  const Four lx = wrist.c4 * m11 + wrist.s4 * m21, ly = wrist.c4 * m21 - wrist.s4 * m11;
  wrist.c6 = wrist.c5 * lx + k.wrist4 * wrist.s5 * m31;
  wrist.s6 = -wrist45 * ly;
  return wrist;
}

// The controller angles of the eight branches, and each branch's margin to the limits. The joints are looked
// at in order, as one may follow another.
template <bool coupled>
STABLECUT_INLINE void store_angles(const ArmConstants& k, const Shoulder& shoulder, const Elbow& elbow,
                                   const Wrist& wrist, ArmLanes& out) {
  const Four theta4 = angle_of(wrist.s4, wrist.c4), theta5 = angle_of(wrist.s5, wrist.c5),
             theta6 = angle_of(wrist.s6, wrist.c6);
  Four angles[6] = {};
  const auto joint = [&](int j, const Four& theta, Four margin) STABLECUT_INLINE_LAMBDA {
    const JointLanes lanes =
        coupled && k.follows[j] >= 0 ? coupled_joint_lanes(k, j, theta, angles) : joint_lanes(k, j, theta);
    angles[j] = lanes.angle;
    return least(margin, lanes.margin);
  };
  const Four infinite = Four{} + std::numeric_limits<double>::infinity();
  Four arm_margin = joint(0, angle_of(shoulder.s1, shoulder.c1), infinite);
  arm_margin = joint(1, angle_of(elbow.s2, elbow.c2), arm_margin);
  arm_margin = joint(2, angle_of(k.elbow_sense * elbow.sp, elbow.cp), arm_margin);
  arm_margin = elbow.reaches ? arm_margin : -infinite;
  for (std::ptrdiff_t w = 0; w < 2; ++w) {
    Four margin = joint(3, w == 0 ? theta4 : theta4 + kPi, arm_margin);
    margin = joint(4, w == 0 ? theta5 : -theta5, margin);
    margin = joint(5, w == 0 ? theta6 : theta6 + kPi, margin);
    for (int j = 0; j < 6; ++j) store(angles[j], out.angle[j] + w * kArms);
    store(margin, out.limit_margin + w * kArms);
  }
}

// Directions of axes 2, 4 and 5, and points on axes 2 and 3.
STABLECUT_INLINE void store_axes(const ArmConstants& k, const Shoulder& shoulder, const Elbow& elbow,
                                 const Wrist& wrist, const ForearmAxes& m, ArmLanes& out) {
  const Four c1 = shoulder.c1, s1 = shoulder.s1, c2 = elbow.c2, s2 = elbow.s2;
  store(m.f1zx, out.axis2[0]);
  store(m.f1zy, out.axis2[1]);
  store(m.f1zz, out.axis2[2]);
  store(k.a1 * c1, out.point2[0]);
  store(k.a1 * s1, out.point2[1]);
  store(Four{}, out.point2[2]);
  // The upper arm lies along c2 (x of frame 1) + s2 (its y turned by alpha1).
  store(k.a1 * c1 + k.a2 * (c2 * c1 + s2 * m.f1yx), out.point3[0]);
  store(k.a1 * s1 + k.a2 * (c2 * s1 + s2 * m.f1yy), out.point3[1]);
  store(k.a2 * s2 * m.f1yz, out.point3[2]);
  store(m.bx, out.axis4[0]);
  store(m.by, out.axis4[1]);
  store(m.bz, out.axis4[2]);
  store(k.wrist4 * (wrist.s4 * m.ex - wrist.c4 * m.ax), out.axis5[0]);
  store(k.wrist4 * (wrist.s4 * m.ey - wrist.c4 * m.ay), out.axis5[1]);
  store(k.wrist4 * (wrist.s4 * m.ez - wrist.c4 * m.az), out.axis5[2]);
}

STABLECUT_INLINE void store_no_arm(ArmLanes& out) {
  out = ArmLanes{};
  for (double& margin : out.limit_margin) margin = -std::numeric_limits<double>::infinity();
}

}  // namespace

STABLECUT_WIDE void solve_arms(const ArmConstants& robot, const ArmTarget& target, ArmLanes& out) {
  const ArmConstants k = robot;
  const HomeTarget home = target_in_home(k, target);
  const Shoulder shoulder = solve_shoulder(k, home.wrist);
  const Elbow elbow = solve_elbow(k, shoulder);
  // Lanes 0 and 2 are the front and the rear shoulder; the side of the elbow does not change the reach.
  if (!shoulder.reaches || !(elbow.reaches[0] || elbow.reaches[2])) {
    store_no_arm(out);
  } else {
    const ForearmAxes axes = forearm_axes(k, shoulder, elbow);
    const Wrist wrist = solve_wrist(k, home, axes);
    if (k.coupled)
      store_angles<true>(k, shoulder, elbow, wrist, out);
    else
      store_angles<false>(k, shoulder, elbow, wrist, out);
    store_axes(k, shoulder, elbow, wrist, axes, out);
  }
  for (int i = 0; i < 3; ++i) {
    out.axis6[i] = home.z6[i];
    out.x6[i] = home.x6[i];
    out.wrist[i] = home.wrist[i];
  }
}

STABLECUT_WIDE void arm_compliances(const ArmLanes& lanes, const double point[3],
                                    const double joint_compliance[6], double compliance[6][kArms]) {
  const double px = point[0], py = point[1], pz = point[2];
  const double rx = px - lanes.wrist[0], ry = py - lanes.wrist[1], rz = pz - lanes.wrist[2];
  const double c1 = joint_compliance[0], c2 = joint_compliance[1], c3 = joint_compliance[2],
               c4 = joint_compliance[3], c5 = joint_compliance[4], c6 = joint_compliance[5];
  // Joints 1 and 6 are the same for the four arms.
  const double v1x = -py, v1y = px;
  const double v6x = lanes.axis6[1] * rz - lanes.axis6[2] * ry,
               v6y = lanes.axis6[2] * rx - lanes.axis6[0] * rz,
               v6z = lanes.axis6[0] * ry - lanes.axis6[1] * rx;
  const double xx = c1 * v1x * v1x + c6 * v6x * v6x, xy = c1 * v1x * v1y + c6 * v6x * v6y,
               xz = c6 * v6x * v6z;
  const double yy = c1 * v1y * v1y + c6 * v6y * v6y, yz = c6 * v6y * v6z, zz = c6 * v6z * v6z;
  const auto along = [](const double axis[3][kArms], const Four& x, const Four& y, const Four& z, Four v[3])
                         STABLECUT_INLINE_LAMBDA {
                           const Four ax = load(axis[0]), ay = load(axis[1]), az = load(axis[2]);
                           v[0] = ay * z - az * y;
                           v[1] = az * x - ax * z;
                           v[2] = ax * y - ay * x;
                         };
  const Four zero = {};
  Four v2[3], v3[3], v4[3], v5[3];
  along(lanes.axis2, px - load(lanes.point2[0]), py - load(lanes.point2[1]), pz - load(lanes.point2[2]), v2);
  along(lanes.axis2, px - load(lanes.point3[0]), py - load(lanes.point3[1]), pz - load(lanes.point3[2]), v3);
  along(lanes.axis4, zero + rx, zero + ry, zero + rz, v4);
  along(lanes.axis5, zero + rx, zero + ry, zero + rz, v5);
  const auto entry = [&](int a, int b) STABLECUT_INLINE_LAMBDA {
    return c2 * v2[a] * v2[b] + c3 * v3[a] * v3[b] + (c4 * v4[a] * v4[b] + c5 * v5[a] * v5[b]);
  };
  store(xx + entry(0, 0), compliance[0]);
  store(xy + entry(0, 1), compliance[1]);
  store(xz + entry(0, 2), compliance[2]);
  store(yy + entry(1, 1), compliance[3]);
  store(yz + entry(1, 2), compliance[4]);
  store(zz + entry(2, 2), compliance[5]);
}

// q + 2 p cos(acos(r) / 3), with q the mean, p and r from the second and third invariants of the deviator.
STABLECUT_WIDE void largest_arm_compliances(const double compliance[6][kArms], double largest[kArms]) {
  const Four xx = load(compliance[0]), xy = load(compliance[1]), xz = load(compliance[2]);
  const Four yy = load(compliance[3]), yz = load(compliance[4]), zz = load(compliance[5]);
  const Four mean = (xx + yy + zz) * (1.0 / 3);
  const Four a = xx - mean, b = yy - mean, c = zz - mean;
  const Four p2 = (a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)) * (1.0 / 6);
  const Four p = square_root(p2), zero = {}, one = zero + 1;
  const Four determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const Four ratio = p2 > 0 ? 0.5 * determinant / (p2 * p) : zero;
  const Four r = least(one, numerics::largest(-one, ratio));
  const Four third = angle_of(square_root((1 - r) * (1 + r)), r) * (1.0 / 3);
  store(mean + 2 * p * numerics::cosine_of_small(third), largest);
}

}  // namespace stablecut::robot
