#include "milling/operating_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "base/units.h"
#include "numerics/golden_section.h"

namespace stablecut::milling {
namespace {

// The margin of speed around a point is checked at this many steps to either side. Beyond it stability is
// followed in steps of kFarStep margins, to kFarthestMargins.
constexpr int kStepsPerMargin = 4;
constexpr double kFarStep = 0.5, kFarthestMargins = 3;
// Minima up to kAbove times the lowest limit are searched, by so many steps of golden section, with limits
// up to as much above it.
constexpr double kAbove = 1.1;
constexpr int kMinimumSteps = 8;
// A mode whose loop on the unit circle is smaller than this share of what limits leaves no notch that
// matters; features are not looked for on a finer scale than kFinest of the speed.
constexpr double kNotch = 0.05, kFinest = 2e-3;
// Steps that would make too many speeds grow by this factor until there are few enough; and what is kept off
// a number of steps before it is rounded up.
constexpr double kCoarser = 1.25, kRoundingOfSteps = 1e-9;

// Whether a limit is lower than another; no limit (stable to the largest depth) is higher than any.
bool lower(const std::optional<double>& a, const std::optional<double>& b) { return a && (!b || *a < *b); }

// The lowest limit between two speeds, from one known between them, by golden section.
LimitPoint refined_minimum(double from, double to, const LimitPoint& best, const LimitAt& limit_at) {
  const double top = kAbove * *best.depth_m;
  return numerics::golden_section(
      from, to, best, kMinimumSteps, [](const LimitPoint& point) { return point.revolutions_per_s; },
      [&](double speed) {
        return LimitPoint{speed, limit_at(speed, top)};
      },
      [](const LimitPoint& a, const LimitPoint& b) { return lower(a.depth_m, b.depth_m); },
      [](const LimitPoint&) { return false; });
}

// Lowers the point's depth until it keeps the margin of depth over the whole margin of speed, and finds
// between which speeds it is stable.
void verify(OperatingPoint& point, const std::vector<LimitPoint>& curve, const OperatingLimits& limits,
            const LimitAt& limit_at) {
  const double from = curve.front().revolutions_per_s, to = curve.back().revolutions_per_s;
  const auto speed = [&](double margins) {
    return std::clamp(point.revolutions_per_s * (1 + margins * limits.speed_share), from, to);
  };
  // The curve's limit near a speed, else one computed; 0 where nothing is known.
  const double near = limits.speed_share * point.revolutions_per_s / (2 * kStepsPerMargin);
  const auto limit_near = [&](double at, double largest_depth_m) -> std::optional<double> {
    const auto next =
        std::lower_bound(curve.begin(), curve.end(), at - near,
                         [](const LimitPoint& p, double value) { return p.revolutions_per_s < value; });
    if (next == curve.end() || next->revolutions_per_s > at + near) return limit_at(at, largest_depth_m);
    std::optional<double> lowest;
    for (auto p = next; p != curve.end() && p->revolutions_per_s <= at + near; ++p) {
      const std::optional<double> limit = p->known ? p->depth_m : 0.0;
      if (lower(limit, lowest)) lowest = limit;
    }
    return lowest && *lowest < largest_depth_m ? lowest : std::nullopt;
  };
  for (int step = -kStepsPerMargin; step <= kStepsPerMargin; ++step) {
    const double margins = static_cast<double>(step) / kStepsPerMargin;
    const double top = point.depth_m / (1 - limits.depth_share);
    const auto limit =
        std::abs(step) == kStepsPerMargin ? limit_at(speed(margins), top) : limit_near(speed(margins), top);
    if (limit) point.depth_m = (1 - limits.depth_share) * *limit;
    if (limits.allowed_depth) point.depth_m = limits.allowed_depth(speed(margins), point.depth_m);
  }
  // Further out half of the margin of depth is kept, since limits between the steps are not known.
  const double kept = point.depth_m / (1 - limits.depth_share / 2);
  const auto farthest = [&](double direction) {
    double reached = speed(direction);
    for (double margins = 1 + kFarStep; margins <= kFarthestMargins; margins += kFarStep) {
      const double next = speed(direction * margins);
      if (next == reached || limit_near(next, kept)) break;
      reached = next;
    }
    return reached;
  };
  point.slowest = farthest(-1);
  point.fastest = farthest(1);
  point.at_edge = point.revolutions_per_s * (1 - limits.speed_share) < from ||
                  point.revolutions_per_s * (1 + limits.speed_share) > to;
}

}  // namespace

std::vector<double> speeds_between(const std::vector<TipStructure>& structures, const Cutter& cutter,
                                   const std::vector<double>& chart, double depth_m, std::size_t most) {
  // The directional matrix's size, and what share of a period the teeth are in cut.
  const double force = std::hypot(cutter.kt_n_per_m2, cutter.kr_n_per_m2) *
                       std::min(1.0, (cutter.exit_rad - cutter.entry_rad) / cutter.mean_pitch_rad());
  double finest = 1;
  for (const TipStructure& structure : structures) {
    for (Eigen::Index k = 0; k < structure.modes(); ++k) {
      const double compliance =
          structure.psi_r.col(k).norm() * structure.psi_l.col(k).norm() / -structure.lambda[k].real();
      if (depth_m * force * compliance > kNotch)
        finest = std::min(finest, -structure.lambda[k].real() / std::abs(structure.lambda[k]));
    }
  }
  finest = std::max(finest, kFinest);
  const auto count_at = [&](double step) {
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i + 1 < chart.size(); ++i)
      counts.push_back(static_cast<std::size_t>(
                           std::ceil(std::log(chart[i + 1] / chart[i]) / step * (1 - kRoundingOfSteps))) -
                       1);
    return counts;
  };
  const auto total = [](const std::vector<std::size_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  };
  std::vector<std::size_t> counts = count_at(finest);
  while (total(counts) > most) counts = count_at(finest *= kCoarser);
  std::vector<double> between;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double ratio = std::pow(chart[i + 1] / chart[i], 1.0 / static_cast<double>(counts[i] + 1));
    double speed = chart[i];
    for (std::size_t k = 0; k < counts[i]; ++k) between.push_back(speed *= ratio);
  }
  return between;
}

std::optional<LimitPoint> unconditional_limit(const std::vector<LimitPoint>& curve, const LimitAt& limit_at,
                                              int threads) {
  std::vector<LimitPoint> chart;
  for (const LimitPoint& point : curve) {
    if (point.known) chart.push_back(point);
  }
  std::vector<std::size_t> minima;
  double top = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < chart.size(); ++i) {
    if (!chart[i].depth_m) continue;
    top = std::min(top, kAbove * *chart[i].depth_m);
    const bool below_left = i == 0 || !lower(chart[i - 1].depth_m, chart[i].depth_m);
    const bool below_right = i + 1 == chart.size() || !lower(chart[i + 1].depth_m, chart[i].depth_m);
    if (below_left && below_right) minima.push_back(i);
  }
  std::erase_if(minima, [&](std::size_t i) { return *chart[i].depth_m > top; });
  std::vector<LimitPoint> refined(minima.size());
  parallel_for(refined.size(), threads, [&](std::size_t m) {
    const std::size_t i = minima[m];
    const double from = chart[i == 0 ? 0 : i - 1].revolutions_per_s;
    const double to = chart[std::min(i + 1, chart.size() - 1)].revolutions_per_s;
    refined[m] = from < to ? refined_minimum(from, to, chart[i], limit_at) : chart[i];
  });
  const auto best =
      std::min_element(refined.begin(), refined.end(),
                       [](const LimitPoint& a, const LimitPoint& b) { return lower(a.depth_m, b.depth_m); });
  return best != refined.end() && best->depth_m ? std::optional(*best) : std::nullopt;
}

CutRate cut_rate(const Cutter& cutter, const CuttingLoad& load, double revolutions_per_s, double depth_m) {
  const double width = cutter.diameter_m / 2 * (std::cos(cutter.entry_rad) - std::cos(cutter.exit_rad));
  CutRate rate;
  rate.removal_m3_per_s = depth_m * width * load.feed_per_tooth_m * cutter.teeth * revolutions_per_s;
  rate.torque_n_m = depth_m * force_cycle(cutter, load, depth_m).mean()[3] * cutter.diameter_m / 2;
  rate.power_w = kTwoPi * revolutions_per_s * rate.torque_n_m;
  return rate;
}

std::vector<OperatingPoint> best_points(const std::vector<LimitPoint>& curve, const OperatingLimits& limits,
                                        std::size_t count, const LimitAt& limit_at, int threads) {
  // The deepest cut at each speed.
  std::vector<double> depth(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double speed = curve[i].revolutions_per_s;
    double deepest = curve[i].known ? limits.largest_depth_m : 0;
    for (const LimitPoint& other : curve) {
      if (std::abs(other.revolutions_per_s - speed) <= limits.speed_share * speed && other.depth_m)
        deepest = std::min(deepest, (1 - limits.depth_share) * *other.depth_m);
    }
    if (limits.largest_depth_times_speed)
      deepest = std::min(deepest, *limits.largest_depth_times_speed / speed);
    if (limits.largest_depth_by_torque) deepest = std::min(deepest, *limits.largest_depth_by_torque);
    depth[i] = deepest;
  }
  if (limits.allowed_depth) {
    parallel_for(curve.size(), threads, [&](std::size_t i) {
      if (depth[i] > 0) depth[i] = limits.allowed_depth(curve[i].revolutions_per_s, depth[i]);
    });
  }
  const auto rate = [&](std::size_t i) { return depth[i] * curve[i].revolutions_per_s; };
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const bool above_left = i == 0 || rate(i) >= rate(i - 1);
    const bool above_right = i + 1 == curve.size() || rate(i) > rate(i + 1);
    if (above_left && above_right && depth[i] > 0) peaks.push_back(i);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&](std::size_t a, std::size_t b) { return rate(a) > rate(b); });
  if (peaks.size() > count) peaks.resize(count);

  std::vector<OperatingPoint> points;
  for (const std::size_t i : peaks)
    points.push_back({curve[i].revolutions_per_s, depth[i], curve[i].depth_m});
  parallel_for(points.size(), threads, [&](std::size_t i) { verify(points[i], curve, limits, limit_at); });
  std::erase_if(points, [](const OperatingPoint& point) { return point.depth_m <= 0; });
  std::stable_sort(points.begin(), points.end(), [](const OperatingPoint& a, const OperatingPoint& b) {
    return a.depth_m * a.revolutions_per_s > b.depth_m * b.revolutions_per_s;
  });
  return points;
}

}  // namespace stablecut::milling
