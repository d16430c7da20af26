#include "milling/operating_points.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/units.h"
#include "numerics/golden_section.h"

namespace stablecut::milling {
namespace {

// The margin of speed around a point is checked at this many steps to either side. Beyond it stability is
// followed in steps of kFarStep margins, to kFarthestMargins.
constexpr int kStepsPerMargin = 4;
constexpr double kFarStep = 0.5, kFarthestMargins = 3;
// Minima of the chart around which the lowest limit is searched, by so many steps of golden section. Limits
// up to kAbove times the lowest one known are computed there: what lies above cannot become the lowest.
constexpr std::size_t kRefinedMinima = 2;
constexpr int kMinimumSteps = 10;
constexpr double kAbove = 1.1;
// A flip's lobe: as wide as so many damping ratios of its mode, searched at so many steps; and above so many
// waves in a period lobes are broad enough for the chart's speeds.
constexpr double kFlipWidth = 4, kMostWaves = 4;
constexpr int kNarrowSteps = 4;

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

// The lowest point of a narrow lobe inside the chart that lies below `top`, or no depth.
LimitPoint lowest_of(const NarrowLobe& lobe, double from, double to, double top, const LimitAt& limit_at) {
  const auto speed = [&](int i) {
    return std::clamp(lobe.revolutions_per_s * (1 + lobe.width * i / kNarrowSteps), from, to);
  };
  LimitPoint best;
  int at = 0;
  for (int i = 0; i <= kNarrowSteps; ++i) {
    const LimitPoint trial{speed(i), limit_at(speed(i), top)};
    if (lower(trial.depth_m, best.depth_m)) {
      best = trial;
      at = i;
    }
  }
  return best.depth_m ? refined_minimum(speed(at - 1), speed(at + 1), best, limit_at) : best;
}

// Lowers the point's depth until it keeps the margin of depth over the whole margin of speed, and finds
// between which speeds it is stable.
void verify(OperatingPoint& point, double from, double to, const OperatingLimits& limits,
            const LimitAt& limit_at) {
  const auto speed = [&](double margins) {
    return std::clamp(point.revolutions_per_s * (1 + margins * limits.speed_share), from, to);
  };
  for (int step = -kStepsPerMargin; step <= kStepsPerMargin; ++step) {
    const double margins = static_cast<double>(step) / kStepsPerMargin;
    if (const auto limit = limit_at(speed(margins), point.depth_m / (1 - limits.depth_share)))
      point.depth_m = (1 - limits.depth_share) * *limit;
  }
  const auto farthest = [&](double direction) {
    double reached = speed(direction);
    for (double margins = 1 + kFarStep; margins <= kFarthestMargins; margins += kFarStep) {
      const double next = speed(direction * margins);
      if (next == reached || limit_at(next, point.depth_m)) break;
      reached = next;
    }
    return reached;
  };
  point.slowest = farthest(-1);
  point.fastest = farthest(1);
}

}  // namespace

std::vector<NarrowLobe> possible_flips(const TipStructure& structure, const Cutter& cutter, double from,
                                       double to) {
  const double passes = cutter.equal_pitch() ? cutter.teeth : 1;  // periods in a revolution
  std::vector<NarrowLobe> lobes;
  for (const auto& lambda : structure.lambda) {
    const double turns_per_s = std::abs(lambda) / kTwoPi;
    for (double half = std::floor(turns_per_s / (passes * to)) + 0.5; half < kMostWaves; ++half) {
      const double speed = turns_per_s / (passes * half);
      if (speed < from) break;
      if (speed <= to) lobes.push_back({speed, -kFlipWidth * lambda.real() / std::abs(lambda)});
    }
  }
  return lobes;
}

std::optional<LimitPoint> unconditional_limit(const std::vector<LimitPoint>& chart, double largest_depth_m,
                                              const std::vector<NarrowLobe>& narrow, const LimitAt& limit_at,
                                              int threads) {
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < chart.size(); ++i) {
    if (!chart[i].depth_m) continue;
    const bool below_left = i == 0 || !lower(chart[i - 1].depth_m, chart[i].depth_m);
    const bool below_right = i + 1 == chart.size() || !lower(chart[i + 1].depth_m, chart[i].depth_m);
    if (below_left && below_right) minima.push_back(i);
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [&](std::size_t a, std::size_t b) { return *chart[a].depth_m < *chart[b].depth_m; });
  if (minima.size() > kRefinedMinima) minima.resize(kRefinedMinima);
  const double top = minima.empty() ? largest_depth_m : *chart[minima.front()].depth_m;

  std::vector<LimitPoint> refined(minima.size() + narrow.size());
  parallel_for(refined.size(), threads, [&](std::size_t m) {
    if (m >= minima.size()) {
      refined[m] = lowest_of(narrow[m - minima.size()], chart.front().revolutions_per_s,
                             chart.back().revolutions_per_s, top, limit_at);
      return;
    }
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

CutRate cut_rate(const Cutter& cutter, double feed_per_tooth_m, double revolutions_per_s, double depth_m) {
  const double width = cutter.diameter_m / 2 * (std::cos(cutter.entry_rad) - std::cos(cutter.exit_rad));
  CutRate rate;
  rate.removal_m3_per_s = depth_m * width * feed_per_tooth_m * cutter.teeth * revolutions_per_s;
  rate.power_w = cutter.kt_n_per_m2 * rate.removal_m3_per_s;
  rate.torque_n_m = rate.power_w / (kTwoPi * revolutions_per_s);
  return rate;
}

std::vector<OperatingPoint> best_points(const std::vector<LimitPoint>& chart, const OperatingLimits& limits,
                                        std::size_t count, const LimitAt& limit_at, int threads) {
  // The deepest cut at each speed.
  std::vector<double> depth(chart.size());
  for (std::size_t i = 0; i < chart.size(); ++i) {
    const double speed = chart[i].revolutions_per_s;
    double deepest = limits.largest_depth_m;
    for (const LimitPoint& other : chart) {
      if (std::abs(other.revolutions_per_s - speed) <= limits.speed_share * speed && other.depth_m)
        deepest = std::min(deepest, (1 - limits.depth_share) * *other.depth_m);
    }
    if (limits.largest_depth_times_speed)
      deepest = std::min(deepest, *limits.largest_depth_times_speed / speed);
    if (limits.largest_depth_by_torque) deepest = std::min(deepest, *limits.largest_depth_by_torque);
    depth[i] = deepest;
  }
  const auto rate = [&](std::size_t i) { return depth[i] * chart[i].revolutions_per_s; };
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i < chart.size(); ++i) {
    const bool above_left = i == 0 || rate(i) >= rate(i - 1);
    const bool above_right = i + 1 == chart.size() || rate(i) > rate(i + 1);
    if (above_left && above_right && depth[i] > 0) peaks.push_back(i);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&](std::size_t a, std::size_t b) { return rate(a) > rate(b); });
  if (peaks.size() > count) peaks.resize(count);

  std::vector<OperatingPoint> points;
  for (const std::size_t i : peaks)
    points.push_back({chart[i].revolutions_per_s, depth[i], chart[i].depth_m});
  parallel_for(points.size(), threads, [&](std::size_t i) {
    verify(points[i], chart.front().revolutions_per_s, chart.back().revolutions_per_s, limits, limit_at);
  });
  std::stable_sort(points.begin(), points.end(), [](const OperatingPoint& a, const OperatingPoint& b) {
    return a.depth_m * a.revolutions_per_s > b.depth_m * b.revolutions_per_s;
  });
  return points;
}

}  // namespace stablecut::milling
