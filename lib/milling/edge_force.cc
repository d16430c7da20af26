#include "milling/edge_force.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/units.h"
#include "numerics/golden_section.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

constexpr double kSameBreak = 1e-9;  // rad
constexpr int kLooks = 24;           // between two such places
constexpr int kNarrowings = 40;

// The integral of exp(i k turn) over an arc.
Complex wave_integral(double k, double from, double to) {
  if (k == 0) return to - from;
  return (std::polar(1.0, k * to) - std::polar(1.0, k * from)) / Complex(0, k);
}

}  // namespace

EdgeForce::EdgeForce(const Cutter& cutter, const CuttingLoad& load, double depth_m)
    : cycle_(force_cycle(cutter, load, depth_m)),
      depth_m_(depth_m),
      lag_rad_(cutter.lag_rad_per_m * depth_m) {
  if (std::abs(lag_rad_) < kStraight) lag_rad_ = 0;
  for (const TurningArc<4>& arc : cycle_.arcs) {
    for (const double end : {arc.from_rad, arc.to_rad}) {
      breaks_.push_back(in_period(end));
      if (lag_rad_ != 0) breaks_.push_back(in_period(end + lag_rad_));
    }
  }
  std::sort(breaks_.begin(), breaks_.end());
  const auto same = [](double a, double b) { return b - a <= kSameBreak; };
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end(), same), breaks_.end());
}

double EdgeForce::in_period(double turn_rad) const {
  const double inside = turn_rad - cycle_.period_rad * std::floor(turn_rad / cycle_.period_rad);
  return cycle_.period_rad - inside <= kSameBreak ? 0 : inside;
}

double EdgeForce::room(double turn_rad, bool after) const {
  double least = cycle_.period_rad;
  for (const double other : breaks_) {
    const double distance = in_period(after ? other - turn_rad : turn_rad - other);
    if (distance > kSameBreak) least = std::min(least, distance);
  }
  return least;
}

ForceParts EdgeForce::at(double turn_rad, double beside_rad) const {
  const double period = cycle_.period_rad;
  if (lag_rad_ != 0) {
    return depth_m_ / lag_rad_ *
           (integral_to(cycle_.arcs, period, turn_rad) -
            integral_to(cycle_.arcs, period, turn_rad - lag_rad_));
  }
  return depth_m_ * sum_at(cycle_.arcs, period, turn_rad, beside_rad);
}

Eigen::Matrix<Complex, 4, 1> EdgeForce::harmonic(int order) const {
  const double k = order * kTwoPi / cycle_.period_rad;
  Eigen::Matrix<Complex, 4, 1> sum = Eigen::Matrix<Complex, 4, 1>::Zero();
  for (const TurningArc<4>& arc : cycle_.arcs) {
    sum += arc.harmonics.col(0).real() * wave_integral(-k, arc.from_rad, arc.to_rad);
    for (int m = 1; m < 3; ++m)
      sum += arc.harmonics.col(m) * wave_integral(m - k, arc.from_rad, arc.to_rad) +
             arc.harmonics.col(m).conjugate() * wave_integral(-m - k, arc.from_rad, arc.to_rad);
  }
  sum *= depth_m_ / cycle_.period_rad;
  // The mean over the lags of a helical edge.
  if (lag_rad_ != 0) sum *= wave_integral(-k, 0, lag_rad_) / lag_rad_;
  return sum;
}

EdgeForce::Peak EdgeForce::peak() const {
  Peak peak;
  if (breaks_.empty()) return peak;
  std::vector<double> ends = breaks_;
  ends.push_back(ends.front() + cycle_.period_rad);
  struct Look {
    double turn, value;
  };
  const auto largest = [&](const auto& value) {
    Look best{0, -1};
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
      const double from = ends[e], to = ends[e + 1], beside = (from + to) / 2;
      const auto look = [&](double turn) { return Look{turn, value(at(turn, beside))}; };
      const double step = (to - from) / kLooks;
      Look top{from, -1};
      for (int i = 0; i <= kLooks; ++i) {
        const Look here = look(from + i * step);
        if (here.value > top.value) top = here;
      }
      top = numerics::golden_section(
          std::max(from, top.turn - step), std::min(to, top.turn + step), top, kNarrowings,
          [](const Look& l) { return l.turn; }, look,
          [](const Look& a, const Look& b) { return a.value > b.value; }, [](const Look&) { return false; });
      if (top.value > best.value) best = top;
    }
    return best;
  };
  const Look force = largest([](const ForceParts& parts) { return parts.head<3>().norm(); });
  peak.turn_rad = force.turn;
  peak.force_n = force.value;
  peak.along_n = largest([](const ForceParts& parts) { return parts[3]; }).value;
  return peak;
}

}  // namespace stablecut::milling
