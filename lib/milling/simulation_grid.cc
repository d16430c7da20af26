#include "milling/simulation_grid.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "numerics/legendre.h"

namespace stablecut::milling {
namespace {

constexpr double kSameNode = 1e-9;     // rad
constexpr int kLeastStepsOfArc = 12;   // of a disc's way through the cut
constexpr int kLeastStepsOfPitch = 8;  // of the smallest pitch
constexpr int kRead = 4;               // numbers of the surface that a value is interpolated from

double place_of(const Cutter& cutter, int tooth) {
  double place = 0;
  for (int j = 0; j < tooth; ++j) place += cutter.pitch_after(j);
  return place;
}

// Gauss's heights, so that few discs are enough.
void set_discs(const Cutter& cutter, double depth_m, int discs, SimulationGrid& grid) {
  if (cutter.largest_lag_rad_per_m() * depth_m < kSameNode) {
    grid.depth_m = {depth_m};
    grid.height_m = {0};
    return;
  }
  const numerics::GaussRule rule = numerics::gauss_legendre(discs);
  for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
    grid.depth_m.push_back(depth_m * rule.weight[i] / 2);
    grid.height_m.push_back(depth_m * (1 + rule.node[i]) / 2);
  }
}

double wrapped(double angle, double period) {
  const double phase = angle - period * std::floor(angle / period);
  return period - phase < kSameNode ? 0 : phase;
}

// The turns at which a disc enters or leaves, and equal steps between them.
void set_nodes(const Cutter& cutter, const SimulationSteps& steps, SimulationGrid& grid) {
  std::vector<double> ends = {0};
  for (int tooth = 0; tooth < (cutter.equal_pitch() ? 1 : cutter.teeth); ++tooth) {
    const double place = place_of(cutter, tooth);
    const auto add = [&](double angle) { ends.push_back(wrapped(angle, grid.period_rad)); };
    for (const double height : grid.height_m) {
      add(place + cutter.lag_of(tooth) * height + cutter.entry_rad);
      add(place + cutter.lag_of(tooth) * height + cutter.exit_rad);
    }
    add(place + cutter.exit_rad);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < kSameNode; }),
             ends.end());
  ends.push_back(grid.period_rad);
  const auto cuts = [&](double turn) {
    for (int tooth = 0; tooth < (cutter.equal_pitch() ? 1 : cutter.teeth); ++tooth) {
      for (const double height : grid.height_m) {
        double phi = wrapped(turn - place_of(cutter, tooth) - cutter.lag_of(tooth) * height, grid.period_rad);
        for (; phi < cutter.exit_rad; phi += grid.period_rad)
          if (phi > cutter.entry_rad) return true;
      }
    }
    return false;
  };
  for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
    const double length = ends[e + 1] - ends[e];
    const bool idle = steps.in_cut && !cuts((ends[e] + ends[e + 1]) / 2);
    const int parts =
        idle ? 1 : std::max(1, static_cast<int>(std::ceil(length / steps.longest_rad - kSameNode)));
    for (int i = 0; i < parts; ++i) grid.turn_rad.push_back(ends[e] + length * i / parts);
  }
  grid.turn_rad.push_back(grid.period_rad);
}

SimulationTouch touch_at(const Cutter& cutter, int node, int tooth, int disc, double phi) {
  SimulationTouch touch;
  touch.node = node;
  touch.tooth = ((tooth % cutter.teeth) + cutter.teeth) % cutter.teeth;
  touch.disc = disc;
  touch.phi_rad = phi;
  touch.sine = std::sin(phi);
  touch.cosine = std::cos(phi);
  touch.before = phi > cutter.entry_rad + kSameNode;
  touch.after = phi < cutter.exit_rad - kSameNode;
  return touch;
}

double rise_within(double end_rad, double next_rad) {
  return std::max(0.0, std::sin((end_rad + next_rad) / 2) - std::sin(end_rad));
}

// Of a pass in the order of its nodes.
void set_within(std::vector<SimulationTouch>& pass) {
  pass.front().within = rise_within(pass.front().phi_rad, pass[1].phi_rad);
  pass.back().within = rise_within(pass.back().phi_rad, pass[pass.size() - 2].phi_rad);
}

bool in_cut(const Cutter& cutter, double phi) {
  return phi > cutter.entry_rad - kSameNode && phi < cutter.exit_rad + kSameNode;
}

// With equal pitch all teeth pass the nodes at the same angles: the surface is known there.
void touch_with_equal_pitch(const Cutter& cutter, SimulationGrid& grid) {
  const double pitch = grid.period_rad;
  for (int disc = 0; disc < static_cast<int>(grid.height_m.size()); ++disc) {
    const double lag = cutter.lag_rad_per_m * grid.height_m[disc];
    const auto from = static_cast<int>(std::floor((cutter.entry_rad + lag) / pitch)) - 1;
    const auto to = static_cast<int>(std::ceil((cutter.exit_rad + lag) / pitch));
    const int base = grid.disc_from.back();
    int last = base;
    std::vector<SimulationTouch> pass;
    for (int m = from; m <= to; ++m) {
      for (int node = 0; node < grid.steps(); ++node) {
        const double phi = grid.turn_rad[node] + m * pitch - lag;
        if (!in_cut(cutter, phi)) continue;
        SimulationTouch touch = touch_at(cutter, node, -m, disc, phi);
        touch.surface = last;
        touch.weight = {1, 0, 0, 0};
        touch.write_from = static_cast<int>(grid.writes.size());
        grid.writes.push_back({last, {0, 0, 1}});
        touch.write_to = touch.write_from + 1;
        touch.leave_from = last;
        touch.leave_to = last + 1;
        grid.surface_at.push_back(phi);
        pass.push_back(touch);
        ++last;
      }
    }
    set_within(pass);
    grid.touches.insert(grid.touches.end(), pass.begin(), pass.end());
    grid.disc_from.push_back(last);
  }
}

std::array<double, 4> cubic_weights(double x) {
  return {-(x - 1) * (x - 2) * (x - 3) / 6, x * (x - 2) * (x - 3) / 2, -x * (x - 1) * (x - 3) / 2,
          x * (x - 1) * (x - 2) / 6};
}

// The weights of values at -two (where there is one), -one and 0 for the value at -x.
std::array<double, 3> write_weights(double two, double one, double x) {
  if (two == 0) return {0, one > 0 ? x / one : 0, one > 0 ? 1 - x / one : 1};
  return {x * (x - one) / (two * (two - one)), x * (two - x) / (one * (two - one)),
          (one - x) * (two - x) / (one * two)};
}

// One tooth's pass of a disc, over a surface at equal distances.
void touch_in_pass(const Cutter& cutter, double step, int base, int count, std::vector<SimulationTouch>& pass,
                   SimulationGrid& grid) {
  std::sort(pass.begin(), pass.end(),
            [](const SimulationTouch& a, const SimulationTouch& b) { return a.phi_rad < b.phi_rad; });
  set_within(pass);
  int written = 0, left = base;
  for (std::size_t i = 0; i < pass.size(); ++i) {
    SimulationTouch& touch = pass[i];
    const double at = (touch.phi_rad - cutter.entry_rad) / step;
    const int first = std::clamp(static_cast<int>(std::floor(at)) - 1, 0, count - kRead);
    touch.surface = base + first;
    touch.weight = cubic_weights(at - first);
    touch.write_from = static_cast<int>(grid.writes.size());
    const double one = i > 0 ? touch.phi_rad - pass[i - 1].phi_rad : 0;
    const double two = i > 1 ? touch.phi_rad - pass[i - 2].phi_rad : 0;
    for (; written < count && (i + 1 == pass.size() || written <= at + kSameNode); ++written) {
      const double x = touch.phi_rad - cutter.entry_rad - written * step;
      grid.writes.push_back({base + written, write_weights(two, one, x)});
    }
    touch.write_to = static_cast<int>(grid.writes.size());
    int next = base + count;
    if (i + 1 < pass.size()) {
      const double then = (pass[i + 1].phi_rad - cutter.entry_rad) / step;
      next = base + std::clamp(static_cast<int>(std::floor(then)) - 1, 0, count - kRead);
      next = std::min(std::max(left, next), base + written);
    }
    touch.leave_from = left;
    touch.leave_to = left = next;
  }
}

void touch_with_unequal_pitch(const Cutter& cutter, SimulationGrid& grid) {
  const double arc = cutter.exit_rad - cutter.entry_rad;
  const int parts =
      std::max(kLeastStepsOfArc, static_cast<int>(std::ceil(arc * grid.steps() / grid.period_rad)));
  const double step = arc / parts;
  for (int disc = 0; disc < static_cast<int>(grid.height_m.size()); ++disc) {
    const int base = grid.disc_from.back(), count = parts + 1;
    for (int i = 0; i < count; ++i) grid.surface_at.push_back(cutter.entry_rad + i * step);
    grid.disc_from.push_back(base + count);
    for (int tooth = 0; tooth < cutter.teeth; ++tooth) {
      std::vector<SimulationTouch> pass;
      for (int node = 0; node < grid.steps(); ++node) {
        const double lag = cutter.lag_of(tooth) * grid.height_m[disc];
        const double phi = wrapped(grid.turn_rad[node] - place_of(cutter, tooth) - lag, kTwoPi);
        if (in_cut(cutter, phi)) pass.push_back(touch_at(cutter, node, tooth, disc, phi));
      }
      touch_in_pass(cutter, step, base, count, pass, grid);
      grid.touches.insert(grid.touches.end(), pass.begin(), pass.end());
    }
  }
}

}  // namespace

double longest_step_rad(const Cutter& cutter, int per_pitch) {
  double longest =
      std::min(cutter.mean_pitch_rad() / per_pitch, (cutter.exit_rad - cutter.entry_rad) / kLeastStepsOfArc);
  for (const double pitch : cutter.pitch_rad) longest = std::min(longest, pitch / kLeastStepsOfPitch);
  return longest;
}

SimulationGrid simulation_grid(const Cutter& cutter, double depth_m, const SimulationSteps& steps) {
  cutter.check_edges_apart(depth_m);
  SimulationGrid grid;
  const bool equal = cutter.equal_pitch();
  grid.period_rad = equal ? cutter.mean_pitch_rad() : kTwoPi;
  grid.shift = equal ? 1 : 0;
  grid.passes = equal ? 1 : cutter.teeth;
  grid.disc_from = {0};
  set_discs(cutter, depth_m, steps.discs, grid);
  set_nodes(cutter, steps, grid);
  if (equal)
    touch_with_equal_pitch(cutter, grid);
  else
    touch_with_unequal_pitch(cutter, grid);
  grid.surface_within.assign(grid.surface_at.size(), 0);
  for (std::size_t disc = 0; disc + 1 < grid.disc_from.size(); ++disc) {
    const int first = grid.disc_from[disc], last = grid.disc_from[disc + 1] - 1;
    grid.surface_within[first] = rise_within(grid.surface_at[first], grid.surface_at[first + 1]);
    grid.surface_within[last] = rise_within(grid.surface_at[last], grid.surface_at[last - 1]);
  }
  std::stable_sort(grid.touches.begin(), grid.touches.end(),
                   [](const SimulationTouch& a, const SimulationTouch& b) { return a.node < b.node; });
  grid.first_touch.assign(grid.steps() + 1, 0);
  for (const SimulationTouch& touch : grid.touches) ++grid.first_touch[touch.node + 1];
  for (int i = 0; i < grid.steps(); ++i) grid.first_touch[i + 1] += grid.first_touch[i];

  for (int tooth = 0; tooth < grid.passes; ++tooth) {
    const double leaves = wrapped(place_of(cutter, equal ? 0 : tooth) + cutter.exit_rad, grid.period_rad);
    const auto node = std::find_if(grid.turn_rad.begin(), grid.turn_rad.end(),
                                   [&](double turn) { return std::abs(turn - leaves) < kSameNode; });
    grid.leaving.push_back(static_cast<int>(node - grid.turn_rad.begin()));
  }
  std::sort(grid.leaving.begin(), grid.leaving.end());
  return grid;
}

}  // namespace stablecut::milling
