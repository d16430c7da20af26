#include "milling/cut_simulation.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "base/units.h"
#include "milling/chatter_spectrum.h"

namespace stablecut::milling {
namespace {

constexpr double kGone = 1e-6;  // what is left of the start
constexpr int kLeastRevolutions = 16, kMostPasses = 4000;
constexpr double kMostStepsInAll = 4e6;
constexpr double kSettled = 1e-3;      // of the vibration
constexpr double kStill = 1e-3;        // of the mean deflection: vibration that is none
constexpr std::size_t kSamples = 200;  // once per tooth
constexpr int kMostPeriods = 256;      // of the spectrum
constexpr int kMostPerPeriod = 1024, kLeastPerPeriod = 64;
constexpr double kRepeats = 1e-6, kNear = 0.1;  // of the state
constexpr double kFarthest = 0.1;               // m

// Teeth to follow: a whole number of revolutions.
int passes_of(const SimulatedGrowth& growth, int teeth, double steps_per_tooth) {
  const double wanted = std::log(kGone) / -std::max(std::abs(std::log(growth.per_tooth)), 1e-9);
  const double most = std::min<double>(kMostPasses, kMostStepsInAll / steps_per_tooth);
  const double passes = std::max<double>(kLeastRevolutions * teeth, std::min(wanted, most));
  return static_cast<int>(std::ceil(passes / teeth)) * teeth;
}

// What is kept of the motion.
class Record {
 public:
  // Everything from a period on, and the wall from another one on.
  Record(const SimulatedCut& cut, const CuttingLoad& load, long from, long wall_from)
      : cut_(cut), load_(load), from_(from), wall_from_(wall_from) {
    for (const double wall : wall_angles(cut.cutter())) {
      for (const SimulationTouch& touch : cut.grid().touches) {
        if (std::abs(touch.phi_rad - wall) < kAtWall) at_wall_.push_back(touch);
      }
    }
    farthest_.assign(2 * cut.grid().depth_m.size(), std::nullopt);
  }

  void add(const SimulatedNode& node) {
    const int steps = cut_.grid().steps(), here = node.node % steps;
    for (const int leaving : cut_.grid().leaving) {
      if (here == leaving) samples.push_back(node.tip_m);
    }
    if (samples.size() > kSamples) samples.pop_front();
    farthest_tip_m = std::max(farthest_tip_m, node.tip_m.cwiseAbs().maxCoeff());
    if (node.period < from_) {
      first_tip = node.tip_m;
      return;
    }
    const double turn = cut_.grid().turn_rad[node.node] - cut_.grid().turn_rad[node.node - 1];
    turns.push_back(turn);
    tips.push_back(node.tip_m);
    turned += turn;
    force += turn / 2 * (node.before + node.force);
    peak_force = std::max({peak_force, node.before.head<3>().norm(), node.force.head<3>().norm()});
    if (node.period < wall_from_) return;
    for (const SimulationTouch& touch : at_wall_) {
      if (touch.node != here) continue;
      double out = touch.cosine * node.tip_m.y();
      if (!load_.runout_m.empty())
        out += load_.runout_m[cut_.tooth_of(touch, node.period + (node.node == steps ? 1 : 0))];
      std::optional<double>& farthest = farthest_[2 * touch.disc + (touch.cosine > 0 ? 0 : 1)];
      if (!farthest || out > *farthest) farthest = out;
    }
  }

  // The tooth that stands out farthest makes the wall, as it would at rest; along the edge the largest error
  // in size.
  std::optional<double> location_error_m() const {
    const double at_rest = load_.runout_m.empty() ? 0 : std::ranges::max(load_.runout_m);
    std::optional<double> error;
    for (const std::optional<double>& out : farthest_) {
      if (out && (!error || std::abs(at_rest - *out) > std::abs(*error))) error = at_rest - *out;
    }
    return error;
  }

  std::deque<Eigen::Vector2d> samples;
  std::vector<Eigen::Vector2d> tips;
  Eigen::Vector2d first_tip = Eigen::Vector2d::Zero();  // before the first of them
  std::vector<double> turns;
  double turned = 0, peak_force = 0, farthest_tip_m = 0;
  ForceParts force = ForceParts::Zero();

 private:
  const SimulatedCut& cut_;
  const CuttingLoad& load_;
  long from_, wall_from_;
  std::vector<SimulationTouch> at_wall_;
  std::vector<std::optional<double>> farthest_;
};

// Of the modes' states, as a share of the second's.
double distance(const SimulatedCut::State& from, const SimulatedCut::State& to) {
  return (from.modes - to.modes).matrix().norm() / to.modes.matrix().norm();
}

// Whether a motion that repeats in contact does so when teeth may lose it.
bool repeats(const SimulatedCut& cut, const SimulatedCut::State& motion) {
  SimulatedCut::State state = motion;
  SimulatedCut::Contact contact;
  for (int period = 0; period < cut.cycle(); ++period) cut.advance(state, contact, [](const auto&) {});
  return distance(state, motion) <= kRepeats;
}

SimulatedCut::State pushed(SimulatedCut::State state, double by) {
  state.modes *= 1 + by;
  return state;
}

// The motion at equal distances of the turn, `count` for each of `periods`.
Eigen::Matrix2Xd resampled(const Record& record, int count, int periods) {
  const int samples = count * periods;
  Eigen::Matrix2Xd motion(2, samples);
  double at = 0;
  std::size_t next = 0;
  const double step = record.turned / samples;
  for (int i = 0; i < samples; ++i) {
    const double wanted = (i + 1) * step;
    while (next + 1 < record.turns.size() && at + record.turns[next] < wanted) at += record.turns[next++];
    const double share = std::clamp((wanted - at) / record.turns[next], 0.0, 1.0);
    const Eigen::Vector2d& before = next == 0 ? record.first_tip : record.tips[next - 1];
    motion.col(i) = (1 - share) * before + share * record.tips[next];
  }
  return motion;
}

}  // namespace

SimulationResult simulate_cut(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                              const SimulationRequest& request) {
  SimulationResult result;
  const double speed = request.revolutions_per_s;
  result.growth = simulated_growth(structure, cutter, load, speed, request.depth_m);
  SimulationSteps steps = result.growth.steps;
  steps.in_cut = false;
  steps.path = request.path;
  if (request.per_pitch) steps.longest_rad = longest_step_rad(cutter, *request.per_pitch);
  const SimulatedCut cut(structure, cutter, load, speed, request.depth_m, steps);
  const SimulationGrid& grid = cut.grid();
  result.steps_per_tooth = grid.steps() / grid.passes;
  const int teeth = cutter.teeth, passes_of_period = grid.passes;
  result.passes = request.passes ? (*request.passes + teeth - 1) / teeth * teeth
                                 : passes_of(result.growth, teeth, 1.0 * grid.steps() / passes_of_period);
  // Whatever repeats does so after a cycle; a power of two of them at the end, at most the second half.
  const int cycles = result.passes / (passes_of_period * cut.cycle());
  int looked_at = 1;
  while (2 * looked_at <= std::min((cycles + 1) / 2, kMostPeriods)) looked_at *= 2;

  const SimulatedCut::State repeating = periodic_state(cut, structure.displacement_scale_m);
  result.keeps_contact = repeats(cut, repeating);
  SimulatedCut::State state = request.from_rest ? cut.at_rest() : pushed(repeating, request.push);
  const long start = state.period, end = start + static_cast<long>(cycles) * cut.cycle();
  const long from = end - static_cast<long>(looked_at) * cut.cycle();
  Record record(cut, load, from, end - teeth / passes_of_period);
  SimulatedCut::Contact contact;
  while (state.period < end) {
    if (state.period == from) contact = {};
    cut.advance(state, contact, [&](const SimulatedNode& node) { record.add(node); });
    if (record.farthest_tip_m < kFarthest) continue;
    result.passes = static_cast<int>(state.period - start) * passes_of_period;
    result.ran_away = true;
    result.settled = false;
    return result;
  }

  result.samples_m.assign(record.samples.begin(), record.samples.end());
  result.without_contact = contact.expected_m > 0 ? contact.missed_m / contact.expected_m : 0;
  result.mean_force_n = record.force / record.turned;
  result.peak_force_n = record.peak_force;
  result.location_error_m = record.location_error_m();
  const double longest = std::clamp(grid.steps() * cut.cycle(), kLeastPerPeriod, kMostPerPeriod);
  int count = kLeastPerPeriod;
  while (count < longest) count *= 2;
  const Eigen::Matrix2Xd motion = resampled(record, count, looked_at);
  result.mean_deflection_m = motion.rowwise().mean();
  for (const Eigen::Vector2d& tip : record.tips)
    result.peak_vibration_m = std::max(result.peak_vibration_m, (tip - result.mean_deflection_m).norm());
  const Eigen::Index shifted = motion.cols() - count;
  const double change =
      std::sqrt((motion.rightCols(shifted) - motion.leftCols(shifted)).colwise().squaredNorm().maxCoeff());
  // Near a motion from which deviations grow nothing settles: it has not left yet.
  const bool leaves = result.keeps_contact && !result.stable() && distance(state, repeating) <= kNear;
  result.settled =
      looked_at > 1 && !leaves &&
      change <= kSettled * std::max(result.peak_vibration_m, kStill * result.mean_deflection_m.norm());
  if (!result.settled && looked_at > 1) {
    const SpectralLine line =
        largest_line(motion, count, static_cast<double>(motion.cols()) * kTwoPi * speed / record.turned);
    result.chatter_frequency_hz = line.frequency_hz;
    result.chatter_amplitude_m = line.amplitude;
  }
  return result;
}

}  // namespace stablecut::milling
