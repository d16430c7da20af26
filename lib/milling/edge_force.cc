#include "milling/edge_force.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "numerics/golden_section.h"
#include "numerics/legendre.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

constexpr double kSameBreak = 1e-9;  // rad
constexpr int kLooks = 24;           // between two such places
constexpr int kNarrowings = 40;
// Heights of a helical edge: so many, and as many more as its lag has radians of a harmonic.
constexpr int kHeights = 16;

// The integral of exp(i k turn) over an arc.
Complex wave_integral(double k, double from, double to) {
  if (k == 0) return to - from;
  return (std::polar(1.0, k * to) - std::polar(1.0, k * from)) / Complex(0, k);
}

// The integral of an arc times exp(-i k turn).
Eigen::Matrix<Complex, 4, 1> arc_harmonic(const TurningArc<4>& arc, double k) {
  Eigen::Matrix<Complex, 4, 1> sum =
      arc.harmonics.col(0).real() * wave_integral(-k, arc.from_rad, arc.to_rad);
  for (int m = 1; m < 3; ++m)
    sum += arc.harmonics.col(m) * wave_integral(m - k, arc.from_rad, arc.to_rad) +
           arc.harmonics.col(m).conjugate() * wave_integral(-m - k, arc.from_rad, arc.to_rad);
  return sum;
}

}  // namespace

EdgeForce::EdgeForce(const Cutter& cutter, const CuttingLoad& load, double depth_m)
    : cycle_(force_cycle(cutter, load, depth_m)),
      depth_m_(depth_m),
      lag_rad_(cutter.lag_rad_per_m * depth_m) {
  if (std::abs(lag_rad_) < kStraight) lag_rad_ = 0;
  if (cutter.helices_differ()) {
    set_edges(cutter, load);
  } else {
    for (const TurningArc<4>& arc : cycle_.arcs)
      for (const double end : {arc.from_rad, arc.to_rad}) add_break(end, lag_rad_);
  }
  std::sort(breaks_.begin(), breaks_.end());
  const auto same = [](double a, double b) { return b - a <= kSameBreak; };
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end(), same), breaks_.end());
}

void EdgeForce::add_break(double turn_rad, double lag_rad) {
  breaks_.push_back(in_period(turn_rad));
  if (lag_rad != 0) breaks_.push_back(in_period(turn_rad + lag_rad));
}

// Each tooth cuts what the one before it has left: one arc for each.
void EdgeForce::set_edges(const Cutter& cutter, const CuttingLoad& load) {
  cutter.check_edges_apart(depth_m_);
  if (!load.runout_m.empty()) throw InvalidArgument("runout: expected none where helices differ");
  const Cutter tip = cutter.at_height(0), top = cutter.at_height(depth_m_);
  const auto arcs_of = [&](const Cutter& straight) {
    std::vector<TurningArc<4>> arcs = force_cycle(straight, load, depth_m_).arcs;
    double behind = 0;
    for (std::size_t j = 0; j < arcs.size(); ++j) {
      for (int m = 1; m < 3; ++m) arcs[j].harmonics.col(m) *= std::polar(1.0, m * behind);
      arcs[j].from_rad = cutter.entry_rad;
      arcs[j].to_rad = cutter.exit_rad;
      behind += straight.pitch_rad[j];
    }
    return arcs;
  };
  const std::vector<TurningArc<4>> at_tip = arcs_of(tip), at_top = arcs_of(top);
  double behind = 0;
  for (int j = 0; j < cutter.teeth; ++j) {
    double lag = cutter.lag_of(j) * depth_m_;
    if (std::abs(lag) < kStraight) lag = 0;
    edges_.push_back({behind, lag, at_tip[j], at_top[j]});
    add_break(behind + cutter.entry_rad, lag);
    add_break(behind + cutter.exit_rad, lag);
    behind += cutter.pitch_after(j);
  }
}

TurningArc<4> EdgeForce::Edge::at(double share) const {
  return {at_tip.from_rad, at_tip.to_rad, (1 - share) * at_tip.harmonics + share * at_top.harmonics};
}

// Of the part of the edge between two shares of its depth, times that part.
ForceParts EdgeForce::Edge::of_part(double from, double to, double turn_rad) const {
  static const numerics::GaussRule rule = numerics::gauss_legendre(kHeights);
  ForceParts sum = ForceParts::Zero();
  for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
    const double share = from + (to - from) * (1 + rule.node[i]) / 2;
    sum += rule.weight[i] / 2 * (to - from) * at(share).at(turn_rad - share * lag_rad);
  }
  return sum;
}

ForceParts EdgeForce::of_edges(double turn_rad, double beside_rad) const {
  ForceParts sum = ForceParts::Zero();
  for (const Edge& edge : edges_) {
    const double entry = edge.at_tip.from_rad, exit = edge.at_tip.to_rad;
    // Copies of the revolution in which any part of it may be in cut.
    const double early = std::min(0.0, edge.lag_rad), late = std::max(0.0, edge.lag_rad);
    const double own = turn_rad - edge.behind_rad;
    for (double copy = std::floor((own - exit - late) / kTwoPi); copy <= (own - entry - early) / kTwoPi;
         ++copy) {
      const double phi = own - copy * kTwoPi;
      double from = 0, to = 1;
      if (edge.lag_rad == 0) {
        const double beside = phi + beside_rad - turn_rad;
        if (beside < entry || beside >= exit) continue;
      } else {
        const double one = (phi - exit) / edge.lag_rad, other = (phi - entry) / edge.lag_rad;
        from = std::clamp(std::min(one, other), 0.0, 1.0);
        to = std::clamp(std::max(one, other), 0.0, 1.0);
      }
      if (from < to) sum += edge.of_part(from, to, phi);
    }
  }
  return depth_m_ * sum;
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
  if (!edges_.empty()) return of_edges(turn_rad, beside_rad);
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
  for (const Edge& edge : edges_) {
    const numerics::GaussRule heights =
        numerics::gauss_legendre(kHeights + static_cast<int>(std::abs(k * edge.lag_rad)));
    for (Eigen::Index i = 0; i < heights.node.size(); ++i) {
      const double share = (1 + heights.node[i]) / 2;
      sum += heights.weight[i] / 2 * std::polar(1.0, -k * (edge.behind_rad + share * edge.lag_rad)) *
             arc_harmonic(edge.at(share), k);
    }
  }
  if (edges_.empty()) {
    for (const TurningArc<4>& arc : cycle_.arcs) sum += arc_harmonic(arc, k);
    // The mean over the lags of a helical edge.
    if (lag_rad_ != 0) sum *= wave_integral(-k, 0, lag_rad_) / lag_rad_;
  }
  return depth_m_ / cycle_.period_rad * sum;
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
