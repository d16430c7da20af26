#include "robot/arm_lanes.h"

#include <cmath>
#include <limits>

#include "base/units.h"
#include "numerics/elementary_lanes.h"

namespace stablecut::robot {
namespace {

using Four = numerics::FourLanes;
using numerics::absolute;
using numerics::angle_of;
using numerics::least;
using numerics::square_root;

constexpr double kReachTolerance = 1e-12;  // relative
constexpr double kFreeRadius = 1e-10;      // m: nearer to axis 1 than this, joint 1 is free
constexpr double kFreeSine = 1e-11;        // axes 4 and 6 nearer in line than this: joint 4 is free

STABLECUT_INLINE Four load(const double* from) { return numerics::load_lanes<Four>(from); }
STABLECUT_INLINE void store(const Four& v, double* to) { numerics::store_lanes(v, to); }

// theta -> the controller angle nearest the middle of the range.
STABLECUT_INLINE Four controller_angle(const ArmConstants& robot, int joint, const Four& theta) {
  const Four angle = robot.sign[joint] * (theta - robot.offset[joint]);
  return angle + kTwoPi * numerics::nearest_whole((robot.middle[joint] - angle) * (1 / kTwoPi));
}

STABLECUT_INLINE Four joint_margin(const ArmConstants& robot, int joint, const Four& angle) {
  return robot.half_range[joint] - absolute(angle - robot.middle[joint]);
}

}  // namespace

STABLECUT_WIDE void solve_arms(const ArmConstants& robot, const ArmTarget& target, ArmLanes& out) {
  const ArmConstants k = robot;
  // The target in the home frame.
  const auto home = [&k](const double v[3], double w[3]) {
    w[0] = v[0];
    w[1] = k.cos_alpha0 * v[1] + k.sin_alpha0 * v[2];
    w[2] = k.cos_alpha0 * v[2] - k.sin_alpha0 * v[1];
  };
  double x6[3], z6[3], p6[3];
  home(target.x, x6);
  home(target.z, z6);
  home(target.origin, p6);
  p6[0] -= k.a0;
  p6[2] -= k.d1;
  const double wx = p6[0] - k.d6 * z6[0], wy = p6[1] - k.d6 * z6[1], wz = p6[2] - k.d6 * z6[2];
  for (int i = 0; i < 3; ++i) out.axis6[i] = z6[i];
  out.wrist[0] = wx;
  out.wrist[1] = wy;
  out.wrist[2] = wz;

  // Joint 1 turns the wrist centre into the plane that lies along_axis2 from axis 1:
  // z2 . wrist = -sin(alpha1) y1 + cos(alpha1) z = along_axis2, with (x1, y1) in frame 1.
  const double radius2 = wx * wx + wy * wy;
  const double y1 = (k.cos_alpha1 * wz - k.along_axis2) / k.sin_alpha1;
  const double x1_squared = radius2 - y1 * y1;
  const bool on_axis1 = radius2 < kFreeRadius * kFreeRadius;
  const double per_radius2 = on_axis1 ? 0 : 1 / radius2;
  const double free_c1 = on_axis1 ? k.cos_free1 : 0, free_s1 = on_axis1 ? k.sin_free1 : 0;
  const bool shoulder_reaches = x1_squared >= -kReachTolerance * (radius2 + k.forearm * k.forearm);
  const double x1_size = std::sqrt(x1_squared > 0 ? x1_squared : 0);
  const double v = k.cos_alpha1 * y1 + k.sin_alpha1 * wz;
  const double sum2 = k.a2 * k.a2 + k.forearm * k.forearm, per_2al = 0.5 / (k.a2 * k.forearm);
  const double wrist45 = k.wrist4 * k.wrist5;
  const Four front = {1, 1, -1, -1}, side = {1, -1, 1, -1};
  const Four zero = {}, one = zero + 1;

  // Shoulder.
  const Four x1 = front * x1_size;
  const Four c1 = (wx * x1 + wy * y1) * per_radius2 + free_c1;
  const Four s1 = (wy * x1 - wx * y1) * per_radius2 + free_s1;
  // The planar pair: u + i v = exp(i theta2) (a2 + forearm exp(i bent)).
  const Four u = x1 - k.a1;
  const Four reach2 = u * u + v * v;
  const Four cos_bent_raw = (reach2 - sum2) * per_2al;
  const auto bends = absolute(cos_bent_raw) <= 1 + kReachTolerance;
  if (!shoulder_reaches || !(bends[0] || bends[2])) {  // the elbow's side does not matter here
    const double sixth[3] = {z6[0], z6[1], z6[2]}, wrist[3] = {wx, wy, wz};
    out = ArmLanes{};
    for (int i = 0; i < 3; ++i) {
      out.axis6[i] = sixth[i];
      out.wrist[i] = wrist[i];
    }
    for (double& margin : out.limit_margin) margin = -std::numeric_limits<double>::infinity();
    return;
  }
  const Four cb = least(numerics::largest(cos_bent_raw, Four{} - 1), Four{} + 1);
  const Four sb = side * square_root((1 - cb) * (1 + cb));
  const Four tx = k.a2 + k.forearm * cb, ty = k.forearm * sb;
  const Four size2 = reach2 * (tx * tx + ty * ty);
  const auto opened = size2 > 1e-40;
  const Four per_size = 1 / square_root(opened ? size2 : one);
  const Four c2 = opened ? (u * tx + v * ty) * per_size : one;
  const Four s2 = opened ? (v * tx - u * ty) * per_size : zero;
  const Four cp = cb * k.cos_bend + sb * k.sin_bend, sp = sb * k.cos_bend - cb * k.sin_bend;
  const Four c23 = c2 * cp - s2 * sp, s23 = s2 * cp + c2 * sp;
  // Axes of frame 3 turned by alpha3: m4x, m4y, m4z; m4z is axis 4.
  const Four f1yx = -s1 * k.cos_alpha1, f1yy = c1 * k.cos_alpha1, f1yz = zero + k.sin_alpha1;
  const Four f1zx = s1 * k.sin_alpha1, f1zy = -c1 * k.sin_alpha1, f1zz = zero + k.cos_alpha1;
  const Four exx = c23 * c1 + s23 * f1yx, exy = c23 * s1 + s23 * f1yy, exz = s23 * f1yz;
  const Four eyx = c23 * f1yx - s23 * c1, eyy = c23 * f1yy - s23 * s1, eyz = c23 * f1yz;
  const Four ax = k.cos_alpha3 * eyx + k.sin_alpha3 * f1zx, ay = k.cos_alpha3 * eyy + k.sin_alpha3 * f1zy,
             az = k.cos_alpha3 * eyz + k.sin_alpha3 * f1zz;
  const Four bx = k.cos_alpha3 * f1zx - k.sin_alpha3 * eyx, by = k.cos_alpha3 * f1zy - k.sin_alpha3 * eyy,
             bz = k.cos_alpha3 * f1zz - k.sin_alpha3 * eyz;
  // M = Rz(theta4) Rx(alpha4) Rz(theta5) Rx(alpha5) Rz(theta6), its first and third columns.
  const Four m11 = exx * x6[0] + exy * x6[1] + exz * x6[2], m21 = ax * x6[0] + ay * x6[1] + az * x6[2],
             m31 = bx * x6[0] + by * x6[1] + bz * x6[2];
  const Four m13 = exx * z6[0] + exy * z6[1] + exz * z6[2], m23 = ax * z6[0] + ay * z6[1] + az * z6[2],
             m33 = bx * z6[0] + by * z6[1] + bz * z6[2];
  // m13 = c4 s5 wrist5, m23 = s4 s5 wrist5, m33 = -wrist45 c5; here with s5 >= 0.
  const Four s5 = square_root(m13 * m13 + m23 * m23), c5 = -wrist45 * m33;
  const auto in_line = s5 < kFreeSine;
  const Four per_s5 = k.wrist5 / (in_line ? one : s5);
  const Four c4 = in_line ? zero + k.cos_free4 : m13 * per_s5,
             s4 = in_line ? zero + k.sin_free4 : m23 * per_s5;
  // theta6 from what is left after theta4 and theta5: well conditioned in every pose.
  const Four lx = c4 * m11 + s4 * m21, ly = c4 * m21 - s4 * m11;
  const Four c6 = c5 * lx + k.wrist4 * s5 * m31, s6 = -wrist45 * ly;

  const Four theta4 = angle_of(s4, c4), theta5 = angle_of(s5, c5), theta6 = angle_of(s6, c6);
  const Four arm_angles[3] = {controller_angle(k, 0, angle_of(s1, c1)),
                              controller_angle(k, 1, angle_of(s2, c2)),
                              controller_angle(k, 2, angle_of(k.elbow_sense * sp, cp))};
  const Four wrist_angles[2][3] = {
      {controller_angle(k, 3, theta4), controller_angle(k, 4, theta5), controller_angle(k, 5, theta6)},
      {controller_angle(k, 3, theta4 + kPi), controller_angle(k, 4, -theta5),
       controller_angle(k, 5, theta6 + kPi)}};
  Four arm_margin = joint_margin(k, 0, arm_angles[0]);
  for (int j = 1; j < 3; ++j) arm_margin = least(arm_margin, joint_margin(k, j, arm_angles[j]));
  const Four nowhere = zero - std::numeric_limits<double>::infinity();
  arm_margin = bends ? arm_margin : nowhere;
  for (int w = 0; w < 2; ++w) {
    Four margin = arm_margin;
    for (int j = 0; j < 3; ++j) {
      store(arm_angles[j], out.angle[j] + w * kArms);
      store(wrist_angles[w][j], out.angle[3 + j] + w * kArms);
      margin = least(margin, joint_margin(k, 3 + j, wrist_angles[w][j]));
    }
    store(margin, out.limit_margin + w * kArms);
  }

  store(f1zx, out.axis2[0]);
  store(f1zy, out.axis2[1]);
  store(f1zz, out.axis2[2]);
  store(k.a1 * c1, out.point2[0]);
  store(k.a1 * s1, out.point2[1]);
  store(zero, out.point2[2]);
  // The upper arm lies along c2 (x of frame 1) + s2 (its y turned by alpha1).
  store(k.a1 * c1 + k.a2 * (c2 * c1 + s2 * f1yx), out.point3[0]);
  store(k.a1 * s1 + k.a2 * (c2 * s1 + s2 * f1yy), out.point3[1]);
  store(k.a2 * s2 * f1yz, out.point3[2]);
  store(bx, out.axis4[0]);
  store(by, out.axis4[1]);
  store(bz, out.axis4[2]);
  store(k.wrist4 * (s4 * exx - c4 * ax), out.axis5[0]);
  store(k.wrist4 * (s4 * exy - c4 * ay), out.axis5[1]);
  store(k.wrist4 * (s4 * exz - c4 * az), out.axis5[2]);
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
  const auto along = [](const double axis[3][kArms], const Four& x, const Four& y, const Four& z, Four v[3]) {
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
  const auto entry = [&](int a, int b) {
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
