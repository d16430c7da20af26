#include "milling/turning_force.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace stablecut::milling {
namespace {

constexpr double kTurnStep = kPi / 180;  // rad
constexpr double kSameBreak = 1e-9;      // rad

class Turning {
 public:
  Turning(const Cutter& cutter, const CuttingLoad& load, double depth_m)
      : cycle_(force_cycle(cutter, load, depth_m)), depth_m_(depth_m), lag_rad_per_m_(cutter.lag_rad_per_m) {
    for (const TurningArc<4>& arc : cycle_.arcs) {
      for (const double end : {arc.from_rad, arc.to_rad}) {
        breaks_.push_back(in_period(end));
        if (!straight()) breaks_.push_back(in_period(end + lag()));
      }
    }
    std::sort(breaks_.begin(), breaks_.end());
    const auto same = [](double a, double b) { return b - a <= kSameBreak; };
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end(), same), breaks_.end());
  }

  bool straight() const { return std::abs(lag()) < kStraight; }
  Eigen::Vector3d mean() const { return depth_m_ * cycle_.mean().head<3>(); }

  Eigen::Matrix3Xd over_period() const {
    std::vector<Eigen::Vector3d> forces;
    for (std::size_t i = 0; i < breaks_.size(); ++i) {
      const double from = breaks_[i], to = end_of(i);
      const int steps = static_cast<int>(std::ceil((to - from) / kTurnStep));
      for (int k = 0; k <= steps; ++k)
        forces.push_back(at(from + (to - from) * k / steps, 0.5 * (from + to)));
    }
    return matrix_of(forces);
  }

  // Of the teeth that touch a wall at this angle of their tips: they enter there, or leave.
  Eigen::Matrix3Xd while_leaving(double angle_rad, bool entering) const {
    // A long edge has all that a period has.
    const double along = std::clamp(lag(), -cycle_.period_rad, cycle_.period_rad);
    const int steps = straight() ? 0 : static_cast<int>(std::ceil(std::abs(along) / kTurnStep));
    std::vector<Eigen::Vector3d> forces;
    for (int k = 0; k <= steps; ++k) {
      const double turn = angle_rad + (steps > 0 ? along * k / steps : 0);
      forces.push_back(at(turn, turn + (entering ? 0.5 : -0.5) * room(turn, entering)));
    }
    return matrix_of(forces);
  }

 private:
  double lag() const { return lag_rad_per_m_ * depth_m_; }

  double in_period(double turn) const {
    const double inside = turn - cycle_.period_rad * std::floor(turn / cycle_.period_rad);
    return cycle_.period_rad - inside <= kSameBreak ? 0 : inside;
  }

  double end_of(std::size_t i) const {
    return i + 1 < breaks_.size() ? breaks_[i + 1] : breaks_.front() + cycle_.period_rad;
  }

  // How far it is from a break to the next one, or to the one before.
  double room(double turn, bool after) const {
    double least = cycle_.period_rad;
    for (const double other : breaks_) {
      const double distance = in_period(after ? other - turn : turn - other);
      if (distance > kSameBreak) least = std::min(least, distance);
    }
    return least;
  }

  // At a turn, as it is on the side of `beside`, with no break in between: straight teeth jump into cut.
  Eigen::Vector3d at(double turn, double beside) const {
    Eigen::Vector4d force = Eigen::Vector4d::Zero();
    if (!straight()) {
      force = (integral_to(cycle_.arcs, cycle_.period_rad, turn) -
               integral_to(cycle_.arcs, cycle_.period_rad, turn - lag())) /
              lag_rad_per_m_;
      return force.head<3>();
    }
    for (const TurningArc<4>& arc : cycle_.arcs) {
      const double last = last_passed(arc.from_rad, cycle_.period_rad, beside);
      for (double copy = last_passed(arc.to_rad, cycle_.period_rad, beside) + 1; copy <= last; ++copy)
        force += depth_m_ * arc.at(turn - copy * cycle_.period_rad);
    }
    return force.head<3>();
  }

  static Eigen::Matrix3Xd matrix_of(const std::vector<Eigen::Vector3d>& columns) {
    Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
    return matrix;
  }

  ForceCycle cycle_;
  double depth_m_, lag_rad_per_m_;
  std::vector<double> breaks_;  // turns of a period at which an edge begins or ends to cut, in order
};

}  // namespace

TurningForce turning_force(const Cutter& cutter, const CuttingLoad& load, double depth_m) {
  const Turning turning(cutter, load, depth_m);
  TurningForce force{turning.mean(), turning.over_period(), {}};
  const bool alike = cutter.equal_pitch() && load.runout_m.empty();
  for (const double wall : wall_angles(cutter)) {
    Eigen::Matrix3Xd leaving(3, 0);
    if (alike) leaving = turning.while_leaving(wall, wall == 0);
    force.walls.push_back({wall, std::move(leaving)});
  }
  return force;
}

}  // namespace stablecut::milling
