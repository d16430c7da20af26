#include "milling/cutting_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;
using Harmonics = TurningArc<4>::Harmonics;

// A chip thickness slope * s + offset from one value of s = sin(phi) to another, m, where the surface was
// left `delay` radians before.
struct ChipLine {
  double slope, offset, from, to, delay;
};

// The least of what 1, 2, ... teeth before would have left, over 0 <= s <= 1, where it is a chip.
std::vector<ChipLine> chip_of(const std::vector<ChipLine>& left_by) {
  const auto at = [](const ChipLine& line, double s) { return line.slope * s + line.offset; };
  std::size_t now = 0;
  for (std::size_t m = 1; m < left_by.size(); ++m) {
    if (left_by[m].offset < left_by[now].offset) now = m;
  }
  std::vector<ChipLine> chip;
  for (double s = 0; s < 1;) {
    // The next that falls below: one of smaller slope.
    double until = 1;
    std::size_t next = now;
    for (std::size_t m = 0; m < left_by.size(); ++m) {
      if (!(left_by[m].slope < left_by[now].slope)) continue;
      const double meet = (left_by[m].offset - left_by[now].offset) / (left_by[now].slope - left_by[m].slope);
      if (meet < until || (meet == until && left_by[m].slope < left_by[next].slope)) {
        until = meet;
        next = m;
      }
    }
    ChipLine line = left_by[now];
    line.to = until;
    line.from = std::max(s, line.slope > 0 ? -line.offset / line.slope : s);
    if (line.from < line.to && at(line, (line.from + line.to) / 2) > 0) chip.push_back(line);
    if (next == now) break;
    s = std::max(s, until);
    now = next;
  }
  return chip;
}

// Harmonics of a tooth's force per depth over its own angle [RobotMillingThesis, eqs. 6-2 to 6-4; edges:
// Altintas2012].
Harmonics harmonics_of(const Cutter& cutter, const CuttingLoad& load, const EdgeMeans& edge,
                       const Bite& bite) {
  // Of a radial chip: along the cut, inwards, and along the axis.
  const double kt = cutter.kt_n_per_m2;
  const double kr = cutter.kr_n_per_m2 * edge.sine - cutter.ka_n_per_m2 * edge.cosine;
  const double ka = cutter.kr_n_per_m2 * edge.cosine + cutter.ka_n_per_m2 * edge.sine;
  const double along = kt * bite.offset_m + load.kte_n_per_m * edge.inverse_sine;
  const double across = kr * bite.offset_m + load.kre_n_per_m - load.kae_n_per_m * edge.cotangent;
  const double axial = ka * bite.offset_m + load.kae_n_per_m + load.kre_n_per_m * edge.cotangent;
  // sin = -i/2 e + ..., cos = 1/2 e + ..., sin^2 = 1/2 - 1/4 e^2 + ..., sin cos = -i/4 e^2 + ...
  const Complex sine = Complex(0, -0.5), cosine = 0.5, square = -0.25, product = Complex(0, -0.25);
  Harmonics h;
  h.col(0) << -0.5 * kr * bite.slope_m, 0.5 * kt * bite.slope_m, axial, along;
  h.col(1) << -along * cosine - across * sine, along * sine - across * cosine, ka * bite.slope_m * sine,
      kt * bite.slope_m * sine;
  h.col(2) << bite.slope_m * (-kt * product - kr * square), bite.slope_m * (kt * square - kr * product), 0, 0;
  return h;
}

// Chips of tooth `index`, if `before` m teeth back the surface was left.
std::vector<ChipLine> left_before(const Cutter& cutter, const CuttingLoad& load, int index) {
  const double feed_per_rad = load.feed_per_tooth_m * cutter.teeth / kTwoPi;
  if (load.runout_m.empty()) {
    const double pitch = cutter.pitch_after((index + cutter.teeth - 1) % cutter.teeth);
    return {{feed_per_rad * pitch, 0, 0, 1, pitch}};
  }
  std::vector<ChipLine> left_by;
  double angle = 0;
  for (int m = 1; m <= cutter.teeth; ++m) {
    const int other = (index + cutter.teeth - m) % cutter.teeth;
    angle += cutter.pitch_after(other);
    left_by.push_back({feed_per_rad * angle, load.runout_m[index] - load.runout_m[other], 0, 1, angle});
  }
  return left_by;
}

// A chip's part of the way, which the engagement may shorten or leave out.
void add_bite(const Cutter& cutter, const ChipLine& chip, double from, double to, Bite bite,
              std::vector<Bite>& all) {
  bite.delay_rad = chip.delay;
  bite.slope_m = chip.slope;
  bite.offset_m = chip.offset;
  bite.entry_rad = std::max(from, cutter.entry_rad);
  bite.exit_rad = std::min(to, cutter.exit_rad);
  if (bite.entry_rad < bite.exit_rad) all.push_back(bite);
}

}  // namespace

bool cuts_alike(const Cutter& cutter, const CuttingLoad& load) {
  return cutter.equal_pitch() && load.runout_m.empty();
}

double force_period_rad(const Cutter& cutter, const CuttingLoad& load) {
  return cuts_alike(cutter, load) ? cutter.mean_pitch_rad() : kTwoPi;
}

std::vector<Bite> bites(const Cutter& cutter, const CuttingLoad& load) {
  std::vector<Bite> all;
  double behind = 0;
  for (int tooth = 0; tooth < (cuts_alike(cutter, load) ? 1 : cutter.teeth); ++tooth) {
    Bite bite;
    bite.tooth = tooth;
    bite.behind_rad = behind;
    for (const ChipLine& chip : chip_of(left_before(cutter, load, tooth))) {
      const double from = std::asin(chip.from), to = std::asin(chip.to);
      if (chip.to < 1) {
        add_bite(cutter, chip, from, to, bite, all);
        add_bite(cutter, chip, kPi - to, kPi - from, bite, all);
      } else {
        add_bite(cutter, chip, from, kPi - from, bite, all);
      }
    }
    behind += cutter.pitch_after(tooth);
  }
  return all;
}

ForceCycle force_cycle(const Cutter& cutter, const CuttingLoad& load, double depth_m) {
  const EdgeMeans edge = edge_means(cutter, depth_m);
  ForceCycle cycle;
  cycle.period_rad = force_period_rad(cutter, load);
  for (const Bite& bite : bites(cutter, load)) {
    TurningArc<4> arc{bite.entry_rad + bite.behind_rad, bite.exit_rad + bite.behind_rad,
                      harmonics_of(cutter, load, edge, bite)};
    for (int m = 1; m < 3; ++m) arc.harmonics.col(m) *= std::polar(1.0, -m * bite.behind_rad);
    cycle.arcs.push_back(arc);
  }
  return cycle;
}

}  // namespace stablecut::milling
