#include "milling/cut_schedule.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/units.h"
#include "numerics/legendre.h"

namespace stablecut::milling {
namespace {

// Ends of pieces closer than this are one: an entry and an exit fall together when a whole number of pitches
// is in cut, as in slotting with an even number of teeth. Radians.
constexpr double kSameAngle = 1e-12;
// Discs of edges whose helices differ.
constexpr int kLeastDiscs = 3;

// Force per depth along the cut, inwards and along the axis: of a displacement outwards, and of one along the
// axis. N/m2, or of process damping N s/m2.
struct ForceCoefficients {
  double tangential = 0, inward = 0, axial = 0;
  double tangential_z = 0, inward_z = 0, axial_z = 0;
  double sensed_z = 0;  // of a straight edge: the chip of a displacement along the axis, of one outwards

  // Of a part of the edge.
  ForceCoefficients times(double share) const {
    return {share * tangential, share * inward,  share * axial, share * tangential_z,
            share * inward_z,   share * axial_z, sensed_z};
  }
};

// A chip h = n r is normal to the edge, n = (sin kappa sin phi, sin kappa cos phi, -cos kappa), and as wide
// as the edge is long, depth / sin kappa. kt is along the cut, kr against n, and ka along the edge's own
// axis, n turned by 90 degrees towards the spindle [Altintas2012].
ForceCoefficients coefficients_of(double kt, double kr, double ka, const EdgeMeans& edge) {
  return {kt,
          kr * edge.sine - ka * edge.cosine,
          kr * edge.cosine + ka * edge.sine,
          -kt * edge.cotangent,
          -kr * edge.cosine + ka * edge.cosine_cotangent,
          -kr * edge.cosine_cotangent - ka * edge.cosine,
          -edge.cotangent};
}

// Values at an angle phi, or their integrals.
struct TurnFunctions {
  double sc, ss, cc, s, c, one;
};

Eigen::Matrix3d feed_turn(const Cutter& cutter) {
  return Eigen::AngleAxisd(cutter.feed_angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

// [RobotMillingThesis, eq. 6-8] for one tooth, with the axis, turned by the feed angle.
Eigen::Matrix3d directional_matrix(const Cutter& cutter, const ForceCoefficients& k, const TurnFunctions& f) {
  Eigen::Matrix3d a;
  a << -k.tangential * f.sc - k.inward * f.ss, -k.tangential * f.cc - k.inward * f.sc,
      -k.tangential_z * f.c - k.inward_z * f.s,  //
      k.tangential * f.ss - k.inward * f.sc, k.tangential * f.sc - k.inward * f.cc,
      k.tangential_z * f.s - k.inward_z * f.c,  //
      k.axial * f.s, k.axial * f.c, k.axial_z * f.one;
  if (cutter.feed_angle_rad == 0) return a;
  return feed_turn(cutter) * a * feed_turn(cutter).transpose();
}

// The integral of one tooth's matrix over the angles from middle - width / 2 to middle + width / 2.
Eigen::Matrix3d integrated_matrix(const Cutter& cutter, const ForceCoefficients& k, double middle,
                                  double width) {
  const double sine = std::sin(width), chord = 2 * std::sin(width / 2);
  const double turn = sine * std::cos(2 * middle) / 2;
  return directional_matrix(cutter, k,
                            {sine * std::sin(2 * middle) / 2, width / 2 - turn, width / 2 + turn,
                             chord * std::sin(middle), chord * std::cos(middle), width});
}

// The coefficients of teeth whose tips are at these angles, and whose edges lag by `lag_rad` at the top of
// the cut: the mean over the depth.
DirectionalFactors directional_factors(const Cutter& cutter, const ForceCoefficients& k,
                                       const std::vector<double>& angles, double lag_rad) {
  if (angles.size() == 1 && lag_rad == 0 && cutter.corner_radius_m == 0) {
    // [RobotMillingThesis, eqs. 6-2 and 6-4]: the chip thickness, here h / sin kappa, and the force of a
    // chip.
    const double s = std::sin(angles[0]), c = std::cos(angles[0]);
    const Eigen::Matrix3d feed = feed_turn(cutter);
    const Eigen::Vector3d force(-c * k.tangential - s * k.inward, s * k.tangential - c * k.inward, k.axial);
    return {feed * force, Eigen::RowVector3d(s, c, k.sensed_z) * feed.transpose()};
  }
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const double phi : angles) {
    if (lag_rad == 0) {
      const double s = std::sin(phi), c = std::cos(phi);
      sum += directional_matrix(cutter, k, {s * c, s * s, c * c, s, c, 1});
      continue;
    }
    // The part of the edge that is in cut. The whole edge is the lag exactly, which the ends' difference,
    // rounded, is not.
    const double low = std::max(cutter.entry_rad, std::min(phi, phi - lag_rad));
    const double high = std::min(cutter.exit_rad, std::max(phi, phi - lag_rad));
    const bool whole = low != cutter.entry_rad && high != cutter.exit_rad;
    if (low < high)
      sum += integrated_matrix(cutter, k, (low + high) / 2, whole ? std::abs(lag_rad) : high - low) /
             std::abs(lag_rad);
  }
  return {sum, Eigen::Matrix3d::Identity()};
}

// Sorted, and each once.
std::vector<double> distinct(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  angles.erase(
      std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < kSameAngle; }),
      angles.end());
  return angles;
}

// An angle in [0, period), and 0 where it is just below the period.
double wrapped(double angle, double period) {
  const double phase = angle - period * std::floor(angle / period);
  return period - phase < kSameAngle ? 0.0 : phase;
}

// The teeth's way through the cut at one depth and speed.
struct Pass {
  const Cutter& cutter;
  double lag_rad;                  // at the top of the cut
  double first_rad, last_rad;      // tip angles between which a part of the tooth is in cut
  std::vector<double> events_rad;  // tip angles at which the tip or the top enters or leaves
  EdgeMeans edge;
  ForceCoefficients cutting, damping;

  Pass(const Cutter& of, double revolutions_per_s, double depth_m)
      : cutter(of),
        lag_rad(of.lag_rad_per_m * depth_m),
        first_rad(of.entry_rad + std::min(0.0, lag_rad)),
        last_rad(of.exit_rad + std::max(0.0, lag_rad)),
        edge(edge_means(of, depth_m)),
        cutting(coefficients_of(of.kt_n_per_m2, of.kr_n_per_m2, of.ka_n_per_m2, edge)) {
    events_rad = distinct({of.entry_rad, of.exit_rad, of.entry_rad + lag_rad, of.exit_rad + lag_rad});
    if (of.damping_n_per_m > 0) {
      const double flank = of.damping_n_per_m / (kPi * of.diameter_m * revolutions_per_s);
      damping = coefficients_of(of.damping_friction * flank, flank, 0, edge);
    }
  }

  // A piece on which teeth are in cut whose tips are at the turn plus these angles.
  CutPiece piece(double from, double to, const std::vector<double>& teeth) const {
    CutPiece piece{from, to, {}, {}};
    const auto coefficients = [cutter = cutter, teeth, lag = lag_rad](const ForceCoefficients& k) {
      return [=](double turn) {
        std::vector<double> angles = teeth;
        for (double& angle : angles) angle += turn;
        return directional_factors(cutter, k, angles, lag);
      };
    };
    piece.cutting = coefficients(cutting);
    if (cutter.damping_n_per_m > 0) piece.damping = coefficients(damping);
    return piece;
  }
};

// From a tip angle on, which may lie within a piece; or from the first end of one.
CutSchedule schedule_of_equal_pitch(const Pass& pass, std::optional<double> from_rad = {}) {
  const double pitch = pass.cutter.mean_pitch_rad(), base = from_rad.value_or(0);
  std::vector<double> ends;
  for (const double event : pass.events_rad) ends.push_back(base + wrapped(event - base, pitch));
  if (from_rad) ends.push_back(base);
  ends = distinct(ends);
  const double start = ends.front();
  ends.push_back(start + pitch);

  CutSchedule schedule{pitch, 1, {}};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = (ends[i] + ends[i + 1]) / 2;
    std::vector<double> teeth;
    for (double j = std::ceil((pass.first_rad - middle) / pitch); middle + j * pitch < pass.last_rad; ++j)
      teeth.push_back(start + j * pitch);
    if (teeth.empty()) continue;
    CutPiece piece = pass.piece(ends[i] - start, ends[i + 1] - start, teeth);
    piece.cut_by = schedule.pieces.size();
    schedule.pieces.push_back(std::move(piece));
  }
  return schedule;
}

// The pitches up to where their pattern repeats, which is what a period has: 70, 110, 70, 110 is half a
// revolution.
std::vector<double> repeated(const std::vector<double>& pitch) {
  for (std::size_t count = 1; count < pitch.size(); ++count) {
    bool repeats = pitch.size() % count == 0;
    for (std::size_t j = count; repeats && j < pitch.size(); ++j)
      repeats = std::abs(pitch[j] - pitch[j - count]) < kSameAngle;
    if (repeats) return {pitch.begin(), pitch.begin() + static_cast<std::ptrdiff_t>(count)};
  }
  return pitch;
}

// Angle of each tooth behind the first.
std::vector<double> angles_behind(const std::vector<double>& pitch) {
  std::vector<double> behind = {0};
  for (std::size_t j = 0; j + 1 < pitch.size(); ++j) behind.push_back(behind.back() + pitch[j]);
  return behind;
}

CutSchedule schedule_of_unequal_pitch(const Pass& pass) {
  const std::vector<double> pitch = repeated(pass.cutter.pitch_rad), behind = angles_behind(pitch);
  const std::size_t teeth = pitch.size();
  const double period = std::accumulate(pitch.begin(), pitch.end(), 0.0);

  // Tip angles at which this tooth or any other enters or leaves. The pieces of all teeth end at the same tip
  // angles, so that each has a piece of the tooth before that cut its surface.
  std::vector<double> ends = pass.events_rad;
  const auto turns = static_cast<int>((pass.last_rad - pass.first_rad) / period) + 1;
  for (const double own : behind) {
    for (const double other : behind) {
      for (const double event : pass.events_rad) {
        for (int turn = -turns; turn <= turns; ++turn) {
          const double angle = event + other - own + turn * period;
          if (angle > pass.first_rad && angle < pass.last_rad) ends.push_back(angle);
        }
      }
    }
  }
  ends = distinct(ends);

  // Tooth by tooth; the period starts where the first tooth enters.
  CutSchedule schedule{period, static_cast<int>(teeth), {}};
  const std::size_t own = ends.size() - 1;
  for (std::size_t j = 0; j < teeth; ++j) {
    const std::size_t before = (j + teeth - 1) % teeth;
    for (std::size_t b = 0; b < own; ++b) {
      const double from = wrapped(ends[b] + behind[j] - pass.first_rad, period);
      CutPiece piece = pass.piece(from, from + ends[b + 1] - ends[b], {ends[b] - from});
      piece.cut_by = before * own + b;
      piece.in_period_before = from - pitch[before] < -kSameAngle;
      schedule.pieces.push_back(std::move(piece));
    }
  }
  return schedule;
}

// Where helices differ: at Gauss's heights, straight teeth that have their own pitches and keep a surface of
// their own. Pieces end where their period does; the first tooth's tip enters there.
CutSchedule schedule_of_discs(const Cutter& cutter, double revolutions_per_s, double depth_m, int points) {
  cutter.check_edges_apart(depth_m);
  const double length = cutter.exit_rad - cutter.entry_rad;
  const double lag_in_points = points * cutter.largest_lag_rad_per_m() * depth_m / length;
  const numerics::GaussRule heights =
      numerics::gauss_legendre(std::max(kLeastDiscs, static_cast<int>(std::ceil(lag_in_points))));
  CutSchedule schedule{kTwoPi, cutter.teeth, {}};
  for (Eigen::Index disc = 0; disc < heights.node.size(); ++disc) {
    const double height = depth_m * (1 + heights.node[disc]) / 2;
    const Cutter straight = cutter.at_height(height);
    Pass pass(straight, revolutions_per_s, 0);
    pass.cutting = pass.cutting.times(heights.weight[disc] / 2);
    pass.damping = pass.damping.times(heights.weight[disc] / 2);
    std::vector<double> enters = angles_behind(straight.pitch_rad), ends = {0, length};
    for (double& turn : enters) {
      turn = wrapped(turn + cutter.lag_of(0) * height, kTwoPi);
      if (turn + length > kTwoPi) ends.push_back(kTwoPi - turn);
    }
    ends = distinct(ends);
    const std::size_t first = schedule.pieces.size(), own = ends.size() - 1;
    for (std::size_t j = 0; j < enters.size(); ++j) {
      const std::size_t before = (j + enters.size() - 1) % enters.size();
      for (std::size_t b = 0; b < own; ++b) {
        const double from = wrapped(enters[j] + ends[b], kTwoPi);
        CutPiece piece = pass.piece(from, from + ends[b + 1] - ends[b], {cutter.entry_rad + ends[b] - from});
        piece.cut_by = first + before * own + b;
        piece.in_period_before = from - straight.pitch_rad[before] < -kSameAngle;
        schedule.pieces.push_back(std::move(piece));
      }
    }
  }
  return schedule;
}

}  // namespace

CutSchedule cut_schedule(const Cutter& cutter, double revolutions_per_s, double depth_m, int points) {
  if (cutter.helices_differ()) return schedule_of_discs(cutter, revolutions_per_s, depth_m, points);
  const Pass pass(cutter, revolutions_per_s, depth_m);
  return cutter.equal_pitch() ? schedule_of_equal_pitch(pass) : schedule_of_unequal_pitch(pass);
}

std::vector<CutPiece> way_of_tooth(const Cutter& cutter, double revolutions_per_s, double depth_m) {
  const Pass pass(cutter, revolutions_per_s, depth_m);
  std::vector<CutPiece> pieces;
  for (std::size_t i = 0; i + 1 < pass.events_rad.size(); ++i)
    pieces.push_back(pass.piece(pass.events_rad[i], pass.events_rad[i + 1], {0.0}));
  return pieces;
}

HelicalArc helical_arc(const Cutter& cutter, double largest_depth_m) {
  const Pass pass(cutter, 1, largest_depth_m);
  return {pass.first_rad, std::min(pass.last_rad - pass.first_rad, cutter.mean_pitch_rad())};
}

CutSchedule helical_pieces(const Cutter& cutter, double depth_m, double from_rad) {
  return schedule_of_equal_pitch(Pass(cutter, 1, depth_m), from_rad);
}

CutSchedule tooth_arcs(const Cutter& cutter, double revolutions_per_s) {
  const Pass pass(cutter, revolutions_per_s, 0);
  const std::vector<double> pitch = repeated(cutter.pitch_rad), behind = angles_behind(pitch);
  const double length = pass.last_rad - pass.first_rad;
  CutSchedule schedule{std::accumulate(pitch.begin(), pitch.end(), 0.0), static_cast<int>(pitch.size()), {}};
  for (std::size_t j = 0; j < pitch.size(); ++j) {
    CutPiece arc = pass.piece(behind[j], behind[j] + length, {pass.first_rad - behind[j]});
    arc.cut_by = (j + pitch.size() - 1) % pitch.size();
    arc.in_period_before = j == 0;
    schedule.pieces.push_back(std::move(arc));
  }
  return schedule;
}

Eigen::Matrix3d mean_directional_coefficients(const Cutter& cutter, double from_rad, double to_rad,
                                              double depth_m) {
  const double pitch = cutter.mean_pitch_rad();
  const ForceCoefficients k = coefficients_of(cutter.kt_n_per_m2, cutter.kr_n_per_m2, cutter.ka_n_per_m2,
                                              edge_means(cutter, depth_m));
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const int first = static_cast<int>(std::floor((cutter.entry_rad - to_rad) / pitch));
  const int last = static_cast<int>(std::ceil((cutter.exit_rad - from_rad) / pitch));
  for (int tooth = first; tooth <= last; ++tooth) {
    const double a = std::max(cutter.entry_rad, from_rad + tooth * pitch);
    const double b = std::min(cutter.exit_rad, to_rad + tooth * pitch);
    if (a < b) sum += integrated_matrix(cutter, k, (a + b) / 2, b - a);
  }
  return sum / (to_rad - from_rad);
}

}  // namespace stablecut::milling
