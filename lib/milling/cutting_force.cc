#include "milling/cutting_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;
using Harmonics = TurningArc<4>::Harmonics;

// A chip thickness slope * s + offset from one value of s = sin(phi) to another, m.
struct ChipLine {
  double slope, offset, from, to;
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
Harmonics harmonics_of(const Cutter& cutter, const CuttingLoad& load, const ChipLine& chip) {
  const double kt = cutter.kt_n_per_m2, kr = cutter.kr_n_per_m2;
  const double along = kt * chip.offset + load.kte_n_per_m, across = kr * chip.offset + load.kre_n_per_m;
  // sin = -i/2 e + ..., cos = 1/2 e + ..., sin^2 = 1/2 - 1/4 e^2 + ..., sin cos = -i/4 e^2 + ...
  const Complex sine = Complex(0, -0.5), cosine = 0.5, square = -0.25, product = Complex(0, -0.25);
  Harmonics h;
  h.col(0) << -0.5 * kr * chip.slope, 0.5 * kt * chip.slope,
      load.ka_n_per_m2 * chip.offset + load.kae_n_per_m, along;
  h.col(1) << -along * cosine - across * sine, along * sine - across * cosine,
      load.ka_n_per_m2 * chip.slope * sine, kt * chip.slope * sine;
  h.col(2) << chip.slope * (-kt * product - kr * square), chip.slope * (kt * square - kr * product), 0, 0;
  return h;
}

// Chips of tooth `index`, if `before` m teeth back the surface was left.
std::vector<ChipLine> left_before(const Cutter& cutter, const CuttingLoad& load, int index) {
  const double feed_per_rad = load.feed_per_tooth_m * cutter.teeth / kTwoPi;
  if (load.runout_m.empty()) {
    const double pitch = cutter.equal_pitch() ? kTwoPi / cutter.teeth
                                              : cutter.pitch_rad[(index + cutter.teeth - 1) % cutter.teeth];
    return {{feed_per_rad * pitch, 0, 0, 1}};
  }
  std::vector<ChipLine> left_by;
  double angle = 0;
  for (int m = 1; m <= cutter.teeth; ++m) {
    const int other = (index + cutter.teeth - m) % cutter.teeth;
    angle += cutter.equal_pitch() ? kTwoPi / cutter.teeth : cutter.pitch_rad[other];
    left_by.push_back({feed_per_rad * angle, load.runout_m[index] - load.runout_m[other], 0, 1});
  }
  return left_by;
}

void add_arc(const Harmonics& harmonics, const Cutter& cutter, double from, double to, double tooth,
             ForceCycle& cycle) {
  from = std::max(from, cutter.entry_rad);
  to = std::min(to, cutter.exit_rad);
  if (!(from < to)) return;
  TurningArc<4> arc{from + tooth, to + tooth, harmonics};
  for (int m = 1; m < 3; ++m) arc.harmonics.col(m) *= std::polar(1.0, -m * tooth);
  cycle.arcs.push_back(arc);
}

}  // namespace

ForceCycle force_cycle(const Cutter& cutter, const CuttingLoad& load) {
  const bool alike = cutter.equal_pitch() && load.runout_m.empty();
  ForceCycle cycle;
  cycle.period_rad = alike ? kTwoPi / cutter.teeth : kTwoPi;
  double tooth = 0;
  for (int index = 0; index < (alike ? 1 : cutter.teeth); ++index) {
    for (const ChipLine& chip : chip_of(left_before(cutter, load, index))) {
      const Harmonics harmonics = harmonics_of(cutter, load, chip);
      const double from = std::asin(chip.from), to = std::asin(chip.to);
      if (chip.to < 1) {
        add_arc(harmonics, cutter, from, to, tooth, cycle);
        add_arc(harmonics, cutter, kPi - to, kPi - from, tooth, cycle);
      } else {
        add_arc(harmonics, cutter, from, kPi - from, tooth, cycle);
      }
    }
    tooth += cutter.equal_pitch() ? kTwoPi / cutter.teeth : cutter.pitch_rad[index];
  }
  return cycle;
}

}  // namespace stablecut::milling
