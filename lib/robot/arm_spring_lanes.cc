#include "numerics/lanes.h"
#include "robot/arm_springs.h"

namespace stablecut::robot {
namespace {

using Four = numerics::FourLanes;

// A vector for each arm.
struct Vectors {
  Four x, y, z;
};

STABLECUT_INLINE Vectors load(const double from[3][kArms]) {
  return {numerics::load_lanes<Four>(from[0]), numerics::load_lanes<Four>(from[1]),
          numerics::load_lanes<Four>(from[2])};
}
STABLECUT_INLINE Vectors same_for_all(const double v[3]) {
  const Four zero = {};
  return {zero + v[0], zero + v[1], zero + v[2]};
}
STABLECUT_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
STABLECUT_INLINE Vectors operator*(double factor, const Vectors& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}
STABLECUT_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

STABLECUT_INLINE Vectors operator*(const Four& factor, const Vectors& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}
STABLECUT_INLINE Four dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Adds c v v^T, v the movement of the point per turn about a direction through the place that it is `from`.
STABLECUT_INLINE void add_turn(double c, const Vectors& direction, const Vectors& from, Four sum[6]) {
  if (c == 0) return;
  const Vectors v = cross(direction, from), cv = c * v;
  sum[0] += cv.x * v.x;
  sum[1] += cv.x * v.y;
  sum[2] += cv.x * v.z;
  sum[3] += cv.y * v.y;
  sum[4] += cv.y * v.z;
  sum[5] += cv.z * v.z;
}

}  // namespace

// Directions count as lines: a flipped wrist, or a sense of an axis, changes no v v^T. In the wrist y of
// frame 4 lies along axis 5 and y of frame 5 along axis 6, as the axes are at right angles; both frames'
// origins are the wrist centre.
STABLECUT_WIDE void add_spring_compliances(const ArmLanes& lanes, const ArmSprings& springs,
                                           const double point[3], double compliance[6][kArms]) {
  const ArmSprings& s = springs;
  Four sum[6];
  for (int i = 0; i < 6; ++i) sum[i] = numerics::load_lanes<Four>(compliance[i]) + s.base[i];
  const Four zero = {};
  const Vectors p = same_for_all(point), z2 = load(lanes.axis2), z4 = load(lanes.axis4),
                z5 = load(lanes.axis5), z6 = same_for_all(lanes.axis6), x6 = same_for_all(lanes.x6);
  const Vectors from_wrist = p - same_for_all(lanes.wrist);
  const Vectors point2 = load(lanes.point2), point3 = load(lanes.point3);
  const double per_sine = 1 / s.sin_alpha1;
  const Vectors x1 = {-per_sine * z2.y, per_sine * z2.x, zero}, y1 = {-x1.y, x1.x, zero};
  const Vectors x2 = (1 / s.a2) * (point3 - point2);
  const Vectors from2 = p - point2 - s.along_axis2[0] * z2, from3 = p - point3 - s.along_axis2[1] * z2;
  const Vectors from6 = from_wrist - s.d6 * z6;
  // The wrist centre lies across axis 2 from point 3 by forearm (cos_bend x3 + sin_bend z2 x x3).
  const Vectors forearm = same_for_all(lanes.wrist) - point3;
  const Vectors across = forearm - dot(forearm, z2) * z2;
  const double per_forearm = 1 / s.forearm;
  const Vectors x3 = (per_forearm * s.cos_bend) * across - (per_forearm * s.sin_bend) * cross(z2, across);
  add_turn(s.bearing_x[0], x1, p, sum);
  add_turn(s.bearing_y[0], y1, p, sum);
  add_turn(s.bearing_x[1], x2, from2, sum);
  add_turn(s.bearing_y[1], cross(z2, x2), from2, sum);
  add_turn(s.bearing_x[2], x3, from3, sum);
  add_turn(s.bearing_y[2], cross(z2, x3), from3, sum);
  add_turn(s.bearing_x[3], cross(z5, z4), from_wrist, sum);
  add_turn(s.bearing_y[3], z5, from_wrist, sum);
  add_turn(s.bearing_x[4], cross(z6, z5), from_wrist, sum);
  add_turn(s.bearing_y[4], z6, from_wrist, sum);
  add_turn(s.bearing_x[5], x6, from6, sum);
  add_turn(s.bearing_y[5], cross(z6, x6), from6, sum);
  for (int i = 0; i < 6; ++i) numerics::store_lanes(sum[i], compliance[i]);
}

}  // namespace stablecut::robot
