#include "milling/cutter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"

namespace stablecut::milling {
namespace {

// Breakpoints closer than this are one: entry and exit fall on each other when a whole number of pitches is
// in cut, as in slotting with an even number of teeth.
constexpr double kSameAngle = 1e-12;

// Of force to displacement: cutting coefficients, or process damping's in their place.
struct ForceCoefficients {
  double tangential, radial;
};

// (6-8) for one tooth, from s c, s^2 and c^2 (s = sin phi, c = cos phi), turned by the feed angle. Values or
// integrals of the three alike.
Eigen::Matrix2d combine(const Cutter& cutter, const ForceCoefficients& k, double sc, double ss, double cc) {
  Eigen::Matrix2d a;
  a << -k.tangential * sc - k.radial * ss, -k.tangential * cc - k.radial * sc,  //
      k.tangential * ss - k.radial * sc, k.tangential * sc - k.radial * cc;
  if (cutter.feed_angle_rad == 0) return a;
  const Eigen::Rotation2Dd feed(cutter.feed_angle_rad);
  return feed.toRotationMatrix() * a * feed.toRotationMatrix().transpose();
}

// The integral of one tooth's coefficients over the angles `width` around `middle`.
Eigen::Matrix2d integral(const Cutter& cutter, const ForceCoefficients& k, double middle, double width) {
  const double sine = std::sin(width);
  const double turn = sine * std::cos(2 * middle) / 2;
  return combine(cutter, k, sine * std::sin(2 * middle) / 2, width / 2 - turn, width / 2 + turn);
}

// Of teeth whose tips are at these angles, edges lagging by `lag_rad` at their upper end: the mean over
// depth.
DirectionalFactors factors(const Cutter& cutter, const ForceCoefficients& k,
                           const std::vector<double>& angles, double lag_rad) {
  if (angles.size() == 1 && lag_rad == 0) {
    // (6-2) and (6-4): h = s x + c y, and the force of a chip of that thickness.
    const double s = std::sin(angles[0]), c = std::cos(angles[0]);
    const Eigen::Matrix2d feed = Eigen::Rotation2Dd(cutter.feed_angle_rad).toRotationMatrix();
    const Eigen::Vector2d force(-c * k.tangential - s * k.radial, s * k.tangential - c * k.radial);
    return {feed * force, Eigen::RowVector2d(s, c) * feed.transpose()};
  }
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const double phi : angles) {
    if (lag_rad == 0) {
      const double s = std::sin(phi), c = std::cos(phi);
      sum += combine(cutter, k, s * c, s * s, c * c);
      continue;
    }
    // What of the edge is in cut; all of it is as long as the lag, which the ends' difference may not hold.
    const double low = std::max(cutter.entry_rad, std::min(phi, phi - lag_rad));
    const double high = std::min(cutter.exit_rad, std::max(phi, phi - lag_rad));
    const bool whole = low != cutter.entry_rad && high != cutter.exit_rad;
    if (low < high)
      sum +=
          integral(cutter, k, (low + high) / 2, whole ? std::abs(lag_rad) : high - low) / std::abs(lag_rad);
  }
  return {sum, Eigen::Matrix2d::Identity()};
}

// Increasing, each once.
std::vector<double> distinct(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  angles.erase(
      std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < kSameAngle; }),
      angles.end());
  return angles;
}

// An angle in [0, period), and 0 where it is just below the period.
double within(double angle, double period) {
  const double phase = angle - period * std::floor(angle / period);
  return period - phase < kSameAngle ? 0.0 : phase;
}

// A cut at one depth and speed.
struct Pass {
  const Cutter& cutter;
  double lag_rad;                  // at the upper end of the cut
  double first_rad, last_rad;      // tip angles between which some of the tooth is in cut
  std::vector<double> events_rad;  // tip angles at which an end of the edge enters or leaves
  ForceCoefficients cutting, damping;

  Pass(const Cutter& of, double revolutions_per_s, double depth_m)
      : cutter(of),
        lag_rad(of.lag_rad_per_m * depth_m),
        first_rad(of.entry_rad + std::min(0.0, lag_rad)),
        last_rad(of.exit_rad + std::max(0.0, lag_rad)),
        cutting{of.kt_n_per_m2, of.kr_n_per_m2},
        damping{0, 0} {
    events_rad = distinct({of.entry_rad, of.exit_rad, of.entry_rad + lag_rad, of.exit_rad + lag_rad});
    if (of.damping_n_per_m > 0) {
      damping.radial = of.damping_n_per_m / (kPi * of.diameter_m * revolutions_per_s);
      damping.tangential = of.damping_friction * damping.radial;
    }
  }

  // A piece in which the teeth are those at the turn plus these angles.
  CutPiece piece(double from, double to, const std::vector<double>& teeth) const {
    CutPiece piece{from, to, {}, {}, 0, true};
    const auto coefficients = [cutter = cutter, teeth, lag = lag_rad](const ForceCoefficients& k) {
      return [=](double turn) {
        std::vector<double> angles = teeth;
        for (double& angle : angles) angle += turn;
        return factors(cutter, k, angles, lag);
      };
    };
    piece.cutting = coefficients(cutting);
    if (damping.radial > 0) piece.damping = coefficients(damping);
    return piece;
  }
};

CutSchedule schedule_of_equal_pitch(const Pass& pass) {
  const double pitch = pass.cutter.mean_pitch_rad();
  std::vector<double> ends;
  for (const double event : pass.events_rad) ends.push_back(within(event, pitch));
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
    piece.left_by = schedule.pieces.size();
    schedule.pieces.push_back(std::move(piece));
  }
  return schedule;
}

CutSchedule schedule_of_unequal_pitch(const Pass& pass) {
  const std::vector<double>& pitch = pass.cutter.pitch_rad;
  const std::size_t teeth = pitch.size();
  std::vector<double> behind = {0};  // of each tooth, after the first
  for (std::size_t j = 0; j + 1 < teeth; ++j) behind.push_back(behind.back() + pitch[j]);

  // Tip angles at which a tooth or any other has an event: the same for all teeth, so that what one tooth
  // left is known at the next one's nodes.
  std::vector<double> ends = pass.events_rad;
  const auto turns = static_cast<int>((pass.last_rad - pass.first_rad) / kTwoPi) + 1;
  for (const double own : behind) {
    for (const double other : behind) {
      for (const double event : pass.events_rad) {
        for (int turn = -turns; turn <= turns; ++turn) {
          const double angle = event + other - own + turn * kTwoPi;
          if (angle > pass.first_rad && angle < pass.last_rad) ends.push_back(angle);
        }
      }
    }
  }
  ends = distinct(ends);

  // In the order of teeth, their pieces in order; the period starts where the first tooth does.
  CutSchedule schedule{kTwoPi, static_cast<int>(teeth), {}};
  const std::size_t own = ends.size() - 1;
  for (std::size_t j = 0; j < teeth; ++j) {
    const std::size_t before = (j + teeth - 1) % teeth;
    for (std::size_t b = 0; b < own; ++b) {
      const double from = within(ends[b] + behind[j] - pass.first_rad, kTwoPi);
      CutPiece piece = pass.piece(from, from + ends[b + 1] - ends[b], {ends[b] - from});
      piece.left_by = before * own + b;
      piece.left_before = from - pitch[before] < -kSameAngle;
      schedule.pieces.push_back(std::move(piece));
    }
  }
  return schedule;
}

}  // namespace

double Cutter::mean_pitch_rad() const { return kTwoPi / teeth; }

double Cutter::tooth_period_s(double revolutions_per_s) const { return 1 / (teeth * revolutions_per_s); }

void set_immersion(Cutter& cutter, bool up_milling, double radial_immersion) {
  if (!(radial_immersion > 0 && radial_immersion <= 1)) {
    throw InvalidArgument("radial immersion: expected a ratio above 0 and at most 1");
  }
  cutter.entry_rad = up_milling ? 0 : std::acos(2 * radial_immersion - 1);
  cutter.exit_rad = up_milling ? std::acos(1 - 2 * radial_immersion) : kPi;
}

CutSchedule cut_schedule(const Cutter& cutter, double revolutions_per_s, double depth_m) {
  const Pass pass(cutter, revolutions_per_s, depth_m);
  return cutter.equal_pitch() ? schedule_of_equal_pitch(pass) : schedule_of_unequal_pitch(pass);
}

Eigen::Matrix2d mean_directional_coefficients(const Cutter& cutter, double from_rad, double to_rad) {
  const double pitch = cutter.mean_pitch_rad();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  const int first = static_cast<int>(std::floor((cutter.entry_rad - to_rad) / pitch));
  const int last = static_cast<int>(std::ceil((cutter.exit_rad - from_rad) / pitch));
  for (int tooth = first; tooth <= last; ++tooth) {
    const double a = std::max(cutter.entry_rad, from_rad + tooth * pitch);
    const double b = std::min(cutter.exit_rad, to_rad + tooth * pitch);
    if (a < b) sum += integral(cutter, {cutter.kt_n_per_m2, cutter.kr_n_per_m2}, (a + b) / 2, b - a);
  }
  return sum / (to_rad - from_rad);
}

}  // namespace stablecut::milling
