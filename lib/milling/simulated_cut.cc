#include "milling/simulated_cut.h"

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "base/units.h"
#include "milling/forced_vibration.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

constexpr double kNoSurface = -1e3;  // m: before the first tooth
constexpr double kGrazing = 1e-9;    // of the feed: rounding of a chip that is 0
constexpr double kSeries = 0.5;      // of lambda times the step
constexpr int kTerms = 16;

// (exp(z) - 1) / z and (exp(z) - 1 - z) / z^2.
std::pair<Complex, Complex> held_and_rising(Complex z) {
  if (std::abs(z) > kSeries) return {(std::exp(z) - 1.0) / z, (std::exp(z) - 1.0 - z) / (z * z)};
  Complex held = 0, rising = 0, power = 1;  // z^k / (k + 1)!
  for (int k = 0; k < kTerms; ++k) {
    power /= k + 1.0;
    held += power;
    rising += power / (k + 2.0);
    power *= z;
  }
  return {held, rising};
}

}  // namespace

SimulatedCut::SimulatedCut(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                           double revolutions_per_s, double depth_m, const SimulationSteps& steps)
    : cutter_(cutter),
      load_(load),
      grid_(simulation_grid(cutter, depth_m, steps)),
      turn_per_s_(kTwoPi * revolutions_per_s),
      feed_per_revolution_m_(load.feed_per_tooth_m * cutter.teeth * (1 + kGrazing)),
      path_(steps.path),
      rate_(structure.lambda) {
  const ModesInCut modes = modes_in_cut(structure, cutter, revolutions_per_s);
  shape_ = modes.shape.topRows<2>();
  left_ = turn_per_s_ * modes.drive.topRows<2>();
  jump_ = 2 * (shape_ * left_.transpose()).real();
  if (cutter.damping_n_per_m > 0)
    flank_n_s_per_m2_ = cutter.damping_n_per_m / (kPi * cutter.diameter_m * revolutions_per_s);
  double length = -1;
  for (int i = 0; i < grid_.steps(); ++i) {
    const double turn = grid_.turn_rad[i + 1] - grid_.turn_rad[i];
    // Steps of one piece differ by rounding.
    if (!(std::abs(turn - length) < 1e-12 * grid_.period_rad)) {
      length = turn;
      operators_.push_back(operator_of(turn / turn_per_s_));
    }
    operator_of_step_.push_back(static_cast<int>(operators_.size()) - 1);
    bool jump = i == 0;
    for (int t = grid_.first_touch[i]; t < grid_.first_touch[i + 1]; ++t)
      jump = jump || grid_.touches[t].before != grid_.touches[t].after;
    jumps_.push_back(jump);
  }
  if (!(load_.feed_per_tooth_m > 0)) return;
  // In the first revolution every tooth passes everywhere; from the second on the chips repeat.
  const int revolution = cutter_.teeth / grid_.passes;
  cycle_ = load_.runout_m.empty() ? 1 : revolution;
  grazing_m_ = kGrazing * load_.feed_per_tooth_m;
  rigid_chip_.assign(grid_.touches.size() * cycle_, 0);
  rigid_leaves_.assign(grid_.surface_at.size() * cutter_.teeth * cycle_, 1);
  rest_ = empty_state();
  for (double& out : rest_.surface) out = kNoSurface;
  roll_rigid(rest_, 2 * revolution);
  rest_later_ = rest_;
  roll_rigid(rest_later_, cycle_);
}

// The modes under a force that changes linearly over the step: exact.
SimulatedCut::StepOperator SimulatedCut::operator_of(double seconds) const {
  StepOperator op;
  op.flight = (rate_ * seconds).exp();
  Eigen::ArrayXcd start(rate_.size()), end(rate_.size());
  for (Eigen::Index k = 0; k < rate_.size(); ++k) {
    const auto [held, rising] = held_and_rising(rate_[k] * seconds);
    end[k] = seconds * rising;
    start[k] = seconds * (held - rising);
  }
  op.from_start = start.matrix().asDiagonal() * left_.transpose();
  op.to_end = end.matrix().asDiagonal() * left_.transpose();
  op.moved = 2 * (shape_ * op.to_end).real();
  op.hastened = 2 * (shape_ * rate_.matrix().asDiagonal() * op.to_end).real() + jump_;
  return op;
}

// How much farther out a tooth's disc stands than all that have passed there before.
template <SimulatedCut::Kind kKind>
double SimulatedCut::chip_of(const State& state, const SimulationTouch& touch, long period,
                             const Eigen::Vector2d& tip) const {
  double chip = touch.sine * tip.x() + touch.cosine * tip.y();
  if constexpr (kKind != Kind::kDeviation) {
    const double now = travel(period, touch.node);
    chip += touch.sine * now;
    if (!load_.runout_m.empty()) chip += load_.runout_m[tooth_of(touch, period)];
    for (int i = 0; i < 4; ++i) {
      if (touch.weight[i] != 0) chip += touch.weight[i] * relief(now, touch, touch.surface + i, state);
    }
  }
  for (int i = 0; i < 4; ++i) {
    if (touch.weight[i] != 0) chip -= touch.weight[i] * state.surface[touch.surface + i];
  }
  return chip;
}

template <SimulatedCut::Kind kKind>
SimulatedCut::NodeForce SimulatedCut::force_at(const State& state, long period, int node, bool before,
                                               const Eigen::Vector2d& tip, const Eigen::Vector2d& velocity,
                                               Contact* contact) const {
  NodeForce sum;
  if (node == grid_.steps()) {
    node = 0;
    ++period;
  }
  const double kt = cutter_.kt_n_per_m2, kr = cutter_.kr_n_per_m2, mu = cutter_.damping_friction;
  const std::size_t turn = static_cast<std::size_t>(period % cycle_) * grid_.touches.size();
  for (int t = grid_.first_touch[node]; t < grid_.first_touch[node + 1]; ++t) {
    const SimulationTouch& touch = grid_.touches[t];
    if (!(before ? touch.before : touch.after)) continue;
    const double chip = chip_of<kKind>(state, touch, period, tip);
    const double s = touch.sine, c = touch.cosine, depth = grid_.depth_m[touch.disc];
    if constexpr (kKind == Kind::kReal) {
      const bool touches = chip + touch.within * load_.feed_per_tooth_m > 0;
      if (contact) {
        const double expected = std::max(rigid_chip_[turn + t], 0.0);
        contact->expected_m += expected;
        if (!touches) contact->missed_m += expected;
      }
      if (!touches) continue;
    } else if (!rigid_chip_.empty() &&
               rigid_chip_[turn + t] + touch.within * load_.feed_per_tooth_m < -grazing_m_) {
      continue;
    }
    double along = kt * chip, across = kr * chip;
    if constexpr (kKind != Kind::kDeviation) {
      along += load_.kte_n_per_m;
      across += load_.kre_n_per_m;
      sum.axial += depth * (cutter_.ka_n_per_m2 * chip + load_.kae_n_per_m);
    }
    const Eigen::RowVector2d sense(s, c);
    sum.by_tip.noalias() += depth * Eigen::Vector2d(-c * kt - s * kr, s * kt - c * kr) * sense;
    if (flank_n_s_per_m2_ > 0) {
      const double flank = flank_n_s_per_m2_ * sense.dot(velocity);
      across += flank;
      along += mu * flank;
      sum.by_speed.noalias() += depth * flank_n_s_per_m2_ * Eigen::Vector2d(-c * mu - s, s * mu - c) * sense;
    }
    sum.along += depth * along;
    sum.force += depth * Eigen::Vector2d(-c * along - s * across, s * along - c * across);
  }
  return sum;
}

// What the teeth leave at a node: to be called when both forces of the node are known.
template <SimulatedCut::Kind kKind>
void SimulatedCut::leave_surface(State& state, int node, const Eigen::Vector2d& tip,
                                 std::vector<char>* leaves) const {
  const std::size_t numbers = state.surface.size(), discs = grid_.depth_m.size();
  const std::size_t turn = static_cast<std::size_t>(state.period % cycle_) * numbers * cutter_.teeth;
  for (int t = grid_.first_touch[node]; t < grid_.first_touch[node + 1]; ++t) {
    const SimulationTouch& touch = grid_.touches[t];
    const int tooth = tooth_of(touch, state.period);
    double out = touch.sine * tip.x() + touch.cosine * tip.y();
    const double now = kKind == Kind::kDeviation ? 0 : travel(state.period, node);
    if constexpr (kKind != Kind::kDeviation) {
      out += touch.sine * now;
      if (!load_.runout_m.empty()) out += load_.runout_m[tooth];
    }
    double& one_back = state.one_back[tooth * discs + touch.disc];
    double& two_back = state.two_back[tooth * discs + touch.disc];
    double* passing = state.passing.data() + tooth * numbers;
    for (int w = touch.write_from; w < touch.write_to; ++w) {
      const SurfaceWrite& write = grid_.writes[w];
      passing[write.surface] =
          write.weight[0] * two_back + write.weight[1] * one_back + write.weight[2] * out;
    }
    two_back = one_back;
    one_back = out;
    for (int i = touch.leave_from; i < touch.leave_to; ++i) {
      const std::size_t place = turn + tooth * numbers + i;
      if constexpr (kKind != Kind::kReal) {
        if (!rigid_leaves_.empty() && rigid_leaves_[place] == 0) continue;
        state.surface[i] = passing[i];
        state.travel[i] = now;
      } else {
        const double kept = state.surface[i] - relief(now, touch, i, state) -
                            grid_.surface_within[i] * load_.feed_per_tooth_m;
        if (leaves) (*leaves)[place] = passing[i] >= kept - grazing_m_;
        if (!(passing[i] > kept)) continue;
        state.surface[i] = passing[i];
        state.travel[i] = now;
      }
    }
  }
}

template <SimulatedCut::Kind kKind>
void SimulatedCut::advance_as(State& state, Contact* contact, const Visit* visit) const {
  Eigen::ArrayXcd& modes = state.modes;
  Eigen::Vector2d tip = tip_of(modes);
  NodeForce start;
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const bool damped = flank_n_s_per_m2_ > 0;
  for (int i = 0; i < grid_.steps(); ++i) {
    if (jumps_[i]) {
      const Eigen::Vector2d speed = damped ? speed_of(modes) : Eigen::Vector2d::Zero();
      start = force_at<kKind>(state, state.period, i, false, tip, speed, nullptr);
      // A force changes the velocity of modes that do not belong to a mass at once.
      if (damped) start.force = ((one - start.by_speed * jump_).inverse() * start.force).eval();
    }
    leave_surface<kKind>(state, i, tip, nullptr);
    const StepOperator& op = operators_[operator_of_step_[i]];
    modes = op.flight * modes + (op.from_start * start.force).array();
    const Eigen::Vector2d free_tip = tip_of(modes);
    const Eigen::Vector2d free_speed = damped ? speed_of(modes) : Eigen::Vector2d::Zero();
    NodeForce end = force_at<kKind>(state, state.period, i + 1, true, free_tip + op.moved * start.force,
                                    free_speed + op.hastened * start.force, contact);
    // One step of Newton: exact as long as no disc comes into contact or loses it.
    const Eigen::Matrix2d change = end.by_tip * op.moved + end.by_speed * op.hastened;
    end.force = ((one - change).inverse() * (end.force - change * start.force)).eval();
    modes += (op.to_end * end.force).array();
    tip = free_tip + op.moved * end.force;
    if (visit) (*visit)({state.period, i + 1, tip, end.parts(), start.parts()});
    start = end;
  }
  ++state.period;
}

SimulatedCut::State SimulatedCut::empty_state() const {
  State state;
  state.modes = Eigen::ArrayXcd::Zero(rate_.size());
  state.surface.assign(grid_.surface_at.size(), 0);
  state.travel.assign(grid_.surface_at.size(), 0);
  state.passing.assign(grid_.surface_at.size() * cutter_.teeth, 0);
  state.one_back.assign(grid_.depth_m.size() * cutter_.teeth, 0);
  state.two_back = state.one_back;
  return state;
}

// Follows a rigid tool, and remembers its chips and what it leaves.
void SimulatedCut::roll_rigid(State& state, int periods) {
  const Eigen::Vector2d still = Eigen::Vector2d::Zero();
  for (int p = 0; p < periods; ++p, ++state.period) {
    const std::size_t turn = static_cast<std::size_t>(state.period % cycle_) * grid_.touches.size();
    for (int i = 0; i < grid_.steps(); ++i) {
      for (int t = grid_.first_touch[i]; t < grid_.first_touch[i + 1]; ++t)
        rigid_chip_[turn + t] = chip_of<Kind::kReal>(state, grid_.touches[t], state.period, still);
      leave_surface<Kind::kReal>(state, i, still, &rigid_leaves_);
    }
  }
}

void SimulatedCut::advance(State& state, Contact& contact, const Visit& visit) const {
  advance_as<Kind::kReal>(state, &contact, &visit);
}

void SimulatedCut::advance_in_contact(State& state) const {
  advance_as<Kind::kInContact>(state, nullptr, nullptr);
}

void SimulatedCut::advance_deviation(State& state) const {
  advance_as<Kind::kDeviation>(state, nullptr, nullptr);
}

}  // namespace stablecut::milling
