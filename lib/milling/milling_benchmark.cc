// What a change of this room's constants costs and what it loses: errors, crossings and work on five groups
// of cuts, each against a slower way of computing the same. README.md, "Measuring a change".
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "base/range.h"
#include "milling/depth_scan.h"
#include "milling/lobes.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

// A map that counts how often it is computed: the scan's work, whatever the machine.
class CountingMap : public PeriodMap {
 public:
  explicit CountingMap(const PeriodMap& map)
      : PeriodMap(map.structure(), map.period_s(), map.passes()), map_(map) {}
  Eigen::MatrixXd monodromy(double depth_m) const override {
    ++count;
    return map_.monodromy(depth_m);
  }
  std::vector<ForceImpulse> forces(double depth_m, std::complex<double> multiplier,
                                   const Eigen::VectorXcd& state) const override {
    return map_.forces(depth_m, multiplier, state);
  }
  mutable int count = 0;

 private:
  const PeriodMap& map_;
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Cut {
  TipStructure structure;
  Cutter cutter;
  double revolutions_per_s, largest_depth_m;
};

struct Totals {
  int points = 0, scan_maps = 0, crossings = 0, missed = 0, missed_limits = 0;
  double map_error = 0, estimate = 0, scan_error = 0, prepare_s = 0, scan_s = 0, limits_s = 0;
};

// Changes of sign between neighbours of a fine grid that no boundary accounts for.
template <typename Boundary>
int missed_by(const std::vector<Boundary>& boundaries, const std::vector<double>& depths,
              const std::vector<double>& radii, int& changes) {
  int missed = 0;
  for (std::size_t i = 1; i < depths.size(); ++i) {
    if ((radii[i] > 1) == (radii[i - 1] > 1)) continue;
    ++changes;
    missed += std::none_of(boundaries.begin(), boundaries.end(), [&](const Boundary& b) {
      return b.depth_m >= depths[i - 1] - 1e-9 && b.depth_m <= depths[i] + 1e-9;
    });
  }
  return missed;
}

// The largest difference of radii, of max(1, radius); where the radius is above 100 nobody needs its digits.
double largest_error(const std::vector<double>& radii, const std::vector<double>& better) {
  double error = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (better[i] < 100) error = std::max(error, std::abs(radii[i] - better[i]) / std::max(1.0, better[i]));
  }
  return error;
}

void measure(const Cut& cut, Totals& totals) {
  double start = processor_seconds();
  const PreparedPeriod period =
      prepare_period(cut.structure, cut.cutter, cut.revolutions_per_s, {}, cut.largest_depth_m);
  totals.prepare_s += processor_seconds() - start;
  totals.points += period.resolution;
  totals.estimate = std::max(totals.estimate, period.error);

  const CountingMap map(*period.map);
  const std::vector<double> depths = Range{0, cut.largest_depth_m, 1001}.values();
  start = processor_seconds();
  const DepthScan scan(map, cut.largest_depth_m);
  const std::vector<StabilityBoundary> boundaries = scan.boundaries();
  const std::vector<double> radii = scan.spectral_radii(depths);
  totals.scan_s += processor_seconds() - start;
  totals.scan_maps += map.count;
  start = processor_seconds();
  const std::vector<StabilityCrossing> limits =
      crossings_at(cut.structure, cut.cutter, cut.revolutions_per_s, cut.largest_depth_m, period.resolution);
  totals.limits_s += processor_seconds() - start;

  const std::vector<double> direct = spectral_radii(*period.map, depths);
  totals.scan_error = std::max(totals.scan_error, largest_error(radii, direct));
  totals.missed += missed_by(boundaries, depths, direct, totals.crossings);
  int again = 0;
  totals.missed_limits += missed_by(limits, depths, direct, again);

  const SpectralMap finer(cut.structure, cut.cutter, cut.revolutions_per_s, 2 * period.resolution + 6);
  const std::vector<double> few = Range{0, cut.largest_depth_m, 41}.values();
  totals.map_error =
      std::max(totals.map_error, largest_error(spectral_radii(*period.map, few), spectral_radii(finer, few)));
}

void print(const char* name, const std::vector<Cut>& cuts) {
  Totals t;
  for (const Cut& cut : cuts) measure(cut, t);
  const auto n = static_cast<double>(cuts.size());
  std::printf("%-19s %4zu | %6.1f %8.1e %8.1e %6.0f | %8.1e %6.1f %6.0f %9d %6d | %6.0f %6d\n", name,
              cuts.size(), t.points / n, t.map_error, t.estimate, 1e6 * t.prepare_s / n, t.scan_error,
              t.scan_maps / n, 1e6 * t.scan_s / n, t.crossings, t.missed, 1e6 * t.limits_s / n,
              t.missed_limits);
}

std::vector<Cut> at_speeds(const dynamics::ModalModel& model, const Cutter& cutter, const Range& speeds,
                           double largest_depth_m) {
  std::vector<Cut> cuts;
  for (const double speed : speeds.values())
    cuts.push_back({tip_structure(model), cutter, speed, largest_depth_m});
  return cuts;
}

std::vector<Cut> random_cuts(int count) {
  std::mt19937_64 generator(11);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(generator() >> 11) * 0x1p-53;
  };
  std::vector<Cut> cuts;
  for (int i = 0; i < count; ++i) {
    const int modes = 1 + static_cast<int>(uniform(0, 12)), teeth = 1 + static_cast<int>(uniform(0, 6));
    Cutter cutter = fixtures::benchmark_cutter(uniform(0, 1) < 0.5, uniform(0.02, 1), teeth);
    cutter.feed_angle_rad = uniform(0, 3);
    const auto model = fixtures::coupled_modes(modes, static_cast<unsigned>(100 + i));
    cuts.push_back({tip_structure(model), cutter, uniform(30, 400), uniform(1e-3, 8e-3)});
  }
  return cuts;
}

}  // namespace

// Collocation: points on the longest piece, error of the radius against a finer map and as estimated. Scan,
// as for a grid: error of the radius against each depth by itself, maps computed, crossings of a grid of 1001
// depths and how many of them are missed. Limits only, from the unit circle: the same misses. Times in us of
// one processor for each cut.
int main() {
  std::printf("%-24s | %-30s | %-39s | limits only\n%-24s |", "", "collocation", "scan", "cuts");
  std::printf(" %6s %8s %8s %6s | %8s %6s %6s %9s %6s | %6s %6s\n", "points", "error", "estimate", "us",
              "error", "maps", "us", "crossings", "missed", "us", "missed");
  using fixtures::benchmark_cutter;
  print("15 modes, 25 %",
        at_speeds(fixtures::coupled_modes(15, 1), benchmark_cutter(true, 0.25), {80, 340, 14}, 4e-3));
  print("one mode, slot",
        at_speeds(fixtures::oscillator({"x"}), benchmark_cutter(false, 1), {45, 430, 60}, 5e-3));
  print("two directions, 5 %",
        at_speeds(fixtures::oscillator({"x", "y"}), benchmark_cutter(true, 0.05), {45, 430, 60}, 10e-3));
  print("low speed, slot",
        at_speeds(fixtures::coupled_modes(4, 6), benchmark_cutter(false, 1), {15, 60, 10}, 2e-3));
  print("random", random_cuts(150));
}
