#include "milling/cutter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"

namespace stablecut {
namespace {

// Breakpoints closer than this are one: entry and exit fall on each other when a whole number of pitches is
// in cut, as in slotting with an even number of teeth.
constexpr double kSameAngle = 1e-12;

// (6-8) for one tooth, from s c, s^2 and c^2 (s = sin phi, c = cos phi), turned by the feed angle. Values or
// integrals of the three alike.
Eigen::Matrix2d combine(const Cutter& cutter, double sc, double ss, double cc) {
  const double kt = cutter.kt_n_per_m2;
  const double kr = cutter.kr_n_per_m2;
  Eigen::Matrix2d a;
  a << -kt * sc - kr * ss, -kt * cc - kr * sc,  //
      kt * ss - kr * sc, kt * sc - kr * cc;
  if (cutter.feed_angle_rad == 0) return a;
  const Eigen::Rotation2Dd feed(cutter.feed_angle_rad);
  return feed.toRotationMatrix() * a * feed.toRotationMatrix().transpose();
}

}  // namespace

double Cutter::pitch_rad() const { return kTwoPi / teeth; }

double Cutter::tooth_period_s(double revolutions_per_s) const { return 1 / (teeth * revolutions_per_s); }

void set_immersion(Cutter& cutter, bool up_milling, double radial_immersion) {
  if (!(radial_immersion > 0 && radial_immersion <= 1)) {
    throw InvalidArgument("radial immersion: expected a ratio above 0 and at most 1");
  }
  cutter.entry_rad = up_milling ? 0 : std::acos(2 * radial_immersion - 1);
  cutter.exit_rad = up_milling ? std::acos(1 - 2 * radial_immersion) : kPi;
}

std::vector<EngagedArc> engaged_arcs(const Cutter& cutter) {
  const double pitch = cutter.pitch_rad();
  const auto in_one_pitch = [&](double angle) {
    const double phase = angle - pitch * std::floor(angle / pitch);
    return pitch - phase < kSameAngle ? 0.0 : phase;
  };
  std::vector<double> ends = {in_one_pitch(cutter.entry_rad), in_one_pitch(cutter.exit_rad)};
  std::sort(ends.begin(), ends.end());
  if (ends[1] - ends[0] < kSameAngle) ends.pop_back();
  ends.push_back(ends.front() + pitch);

  std::vector<EngagedArc> arcs;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = (ends[i] + ends[i + 1]) / 2;
    EngagedArc arc{ends[i], ends[i + 1], 0, 0};
    arc.first_tooth = static_cast<int>(std::ceil((cutter.entry_rad - middle) / pitch));
    arc.last_tooth = static_cast<int>(std::floor((cutter.exit_rad - middle) / pitch)) + 1;
    if (arc.first_tooth < arc.last_tooth) arcs.push_back(arc);
  }
  return arcs;
}

Eigen::Matrix2d directional_coefficients(const Cutter& cutter, const EngagedArc& arc, double phase_rad) {
  double sc = 0, ss = 0, cc = 0;
  for (int tooth = arc.first_tooth; tooth < arc.last_tooth; ++tooth) {
    const double phi = phase_rad + tooth * cutter.pitch_rad();
    const double s = std::sin(phi), c = std::cos(phi);
    sc += s * c;
    ss += s * s;
    cc += c * c;
  }
  return combine(cutter, sc, ss, cc);
}

DirectionalFactors directional_factors(const Cutter& cutter, const EngagedArc& arc, double phase_rad) {
  if (arc.last_tooth - arc.first_tooth > 1) {
    return {directional_coefficients(cutter, arc, phase_rad), Eigen::Matrix2d::Identity()};
  }
  // (6-2) and (6-4): h = s x + c y, and the force of a chip of that thickness.
  const double phi = phase_rad + arc.first_tooth * cutter.pitch_rad();
  const double s = std::sin(phi), c = std::cos(phi);
  const Eigen::Matrix2d feed = Eigen::Rotation2Dd(cutter.feed_angle_rad).toRotationMatrix();
  const Eigen::Vector2d force(-c * cutter.kt_n_per_m2 - s * cutter.kr_n_per_m2,
                              s * cutter.kt_n_per_m2 - c * cutter.kr_n_per_m2);
  return {feed * force, Eigen::RowVector2d(s, c) * feed.transpose()};
}

Eigen::Matrix2d mean_directional_coefficients(const Cutter& cutter, double from_rad, double to_rad) {
  const double pitch = cutter.pitch_rad();
  double sc = 0, ss = 0, cc = 0;
  const int first = static_cast<int>(std::floor((cutter.entry_rad - to_rad) / pitch));
  const int last = static_cast<int>(std::ceil((cutter.exit_rad - from_rad) / pitch));
  for (int tooth = first; tooth <= last; ++tooth) {
    const double a = std::max(cutter.entry_rad, from_rad + tooth * pitch);
    const double b = std::min(cutter.exit_rad, to_rad + tooth * pitch);
    if (!(a < b)) continue;
    sc += (std::cos(2 * a) - std::cos(2 * b)) / 4;
    const double turn = (std::sin(2 * b) - std::sin(2 * a)) / 4;
    ss += (b - a) / 2 - turn;
    cc += (b - a) / 2 + turn;
  }
  return combine(cutter, sc, ss, cc) / (to_rad - from_rad);
}

}  // namespace stablecut
