// One step of the dynamic programme: the best way from the rungs of one point to a rung of the next. Part of
// path_chain. README.md, "Paths".
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/units.h"
#include "robot/path_chain.h"

namespace stablecut::robot {

inline constexpr int kBundle = 8;                // rungs
inline constexpr double kBundleRounding = 1e-9;  // rad

/// The best value of each copy at each rung so far, and the least of a rung.
struct Front {
  std::vector<double> value, least;
  std::vector<std::uint32_t> copies;  // [rung] a bit for each that has a value
  bool alive = false;

  void clear(std::size_t rungs, int combinations) {
    value.assign(rungs * combinations, kUnreached);
    least.assign(rungs, kUnreached);
    copies.assign(rungs, 0);
    alive = false;
  }
  void put(int rung, int copy, int combinations, double v) {
    value[static_cast<std::size_t>(rung) * combinations + copy] = v;
    least[rung] = std::min(least[rung], v);
    copies[rung] |= std::uint32_t{1} << copy;
    alive = true;
  }
  double best() const { return *std::min_element(least.begin(), least.end()); }
};

/// The best way to one rung. A rule says how costs add up along the path: with(before, cost), penalty(turn),
/// and enough(cost), from which on a better way before would not help.
template <typename Rule>
class RungStep {
 public:
  RungStep(const ChainTask& task, const Rule& rule, std::size_t point, const BranchRungs& before,
           const Front& from, const BranchRungs& now)
      : task_(task),
        rule_(rule),
        copies_(task.model.copies()),
        limit_(task.limits[point]),
        before_(before),
        from_(from),
        now_(now) {
    const double shift = task.ladder.base[point] - task.ladder.base[point - 1];
    centre_ = static_cast<int>(std::lround(shift / task.ladder.step));
    rest_ = shift - centre_ * task.ladder.step;
    // The tool turns by no more than all joints together.
    double all = 0;
    for (int j = 0; j < kJoints; ++j) {
      all += limit_.joint[j];
      if (const auto& c = task.model.robot().joints[j].coupling)
        all += std::abs(c->ratio) * limit_.joint[c->follows];
    }
    most_turn_ = std::min(limit_.turn, all);
    const double most_reach = task.ladder.closed ? 0.5 * task.ladder.rungs : task.ladder.rungs;
    reach_ = static_cast<int>(std::min(most_turn_ / task.ladder.step + 1, most_reach));
    bundles_ = bundles();
    for (int number = 0; number < static_cast<int>(bundles_.size()); ++number) {
      if (bundles_[number].copies != 0) by_value_.push_back(number);
    }
    std::stable_sort(by_value_.begin(), by_value_.end(),
                     [&](int a, int b) { return bundles_[a].least < bundles_[b].least; });
  }

  void take(int rung, Front& to, std::uint16_t* back) {
    const double cost = now_.cost[rung];
    if (!(cost <= rule_.most_cost) || now_.copies[rung] == 0) return;
    start(rung);
    if (possible_ == 0) return;
    const double enough = rule_.enough(cost);
    wrapped_ = true;  // perhaps
    look_aside(offset_);
    for (const Near& near : near_) {
      if (bound_ <= enough || bundles_[near.bundle].least >= bound_) break;
      wrapped_ = near.wrapped;
      if (may_help(&bundle_values_[static_cast<std::size_t>(near.bundle) * copies_.combinations],
                   bundles_[near.bundle].least, rule_.penalty(least_turn(near.bundle))))
        look_through(near.bundle);
    }
    for (int c = 0; c < copies_.combinations; ++c) {
      if (!(best_[c] < kUnreached)) continue;
      to.put(rung, c, copies_.combinations, rule_.with(best_[c], cost));
      if (back) back[static_cast<std::size_t>(rung) * copies_.combinations + c] = origin_[c];
    }
  }

 private:
  void start(int rung) {
    rung_ = rung;
    for (int j = 0; j < kJoints; ++j) angle_[j] = now_.angle[j][rung];
    std::fill_n(best_.begin(), copies_.combinations, kUnreached);
    bound_ = kUnreached;
    possible_ = 0;
    near_.clear();
    const int count = static_cast<int>(bundles_.size()), n = task_.ladder.rungs;
    int centre = rung_ + centre_;
    if (task_.ladder.closed) centre += centre < 0 ? n : centre >= n ? -n : 0;
    centre = std::clamp(centre, 0, n - 1) / kBundle;
    const int far = std::min(reach_ / kBundle + 2, task_.ladder.closed ? count / 2 : count);
    for (const int number : by_value_) {
      const int aside = std::abs(number - centre);
      if (std::min(aside, task_.ladder.closed ? count - aside : aside) <= far) take_bundle(number);
    }
    possible_ &= now_.copies[rung];
  }

  // A bundle that steps may come from, and whether copies may change their numbers on the way.
  struct Near {
    int bundle;
    bool wrapped;
  };

  // A few neighbouring rungs before: the least value, and where their angles lie.
  struct Bundle {
    double least = kUnreached;
    double middle[kJoints], half[kJoints];  // rad
    bool both_ends[kJoints] = {};           // some angles are at the beginning of a copy and some at its end
    std::uint32_t copies = 0;               // a bit for each that any of them has
  };

  std::vector<Bundle> bundles() {
    std::vector<Bundle> all;
    for (int begin = 0; begin < task_.ladder.rungs; begin += kBundle) {
      Bundle bundle;
      bundle_values_.resize((all.size() + 1) * copies_.combinations, kUnreached);
      double low[kJoints], high[kJoints];
      for (int k = begin; k < std::min(begin + kBundle, task_.ladder.rungs); ++k) {
        if (!(from_.least[k] < kUnreached)) continue;
        for (int j = 0; j < kJoints; ++j) {
          double angle = before_.angle[j][k];
          if (std::isinf(bundle.least)) low[j] = high[j] = angle;
          if (copies_.count[j] > 1 && std::abs(angle - low[j]) > kPi) {
            angle += angle < low[j] ? kTwoPi : -kTwoPi;
            bundle.both_ends[j] = true;
          }
          low[j] = std::min(low[j], angle);
          high[j] = std::max(high[j], angle);
        }
        bundle.least = std::min(bundle.least, from_.least[k]);
        bundle.copies |= from_.copies[k];
        double* const values = &bundle_values_[all.size() * copies_.combinations];
        for (int c = 0; c < copies_.combinations; ++c)
          values[c] =
              std::min(values[c], from_.value[static_cast<std::size_t>(k) * copies_.combinations + c]);
      }
      for (int j = 0; j < kJoints && bundle.least < kUnreached; ++j) {
        bundle.middle[j] = 0.5 * (low[j] + high[j]);
        bundle.half[j] = 0.5 * (high[j] - low[j]) + limit_.joint[j] + kBundleRounding;
      }
      all.push_back(bundle);
    }
    return all;
  }

  // Takes a bundle that steps may come from, and the copies that they lead to.
  void take_bundle(int number) {
    const Bundle& bundle = bundles_[number];
    std::uint32_t copies = bundle.copies;
    bool wrapped = false;
    for (int j = kJoints; j-- > 0;) {
      const double step = angle_[j] - bundle.middle[j];
      double off = std::abs(step);
      // Angles and middles of bundles lie within a turn and a half.
      if (copies_.count[j] > 1 && off > kPi) off = std::abs(off - kTwoPi);
      if (off > bundle.half[j]) return;
      if (copies_.count[j] == 1 || (!bundle.both_ends[j] && std::abs(step) <= kPi)) continue;
      wrapped = true;
      const std::uint32_t up = (copies & copies_.within[j][copies_.count[j] - 1]) << copies_.stride[j];
      const std::uint32_t down = (copies & ~copies_.within[j][1]) >> copies_.stride[j];
      copies = bundle.both_ends[j] ? copies | up | down : step > 0 ? down : up;
    }
    possible_ |= copies;
    near_.push_back({number, wrapped});
  }

  // Whether values before, one for each copy, can be better than what a copy here has, at that penalty.
  // Where copies change their numbers on the way the least of the values decides.
  bool may_help(const double* values, double least_value, double penalty) const {
    if (!(least_value + penalty < bound_)) return false;
    if (wrapped_) return true;
    for (int c = 0; c < copies_.combinations; ++c) {
      if (values[c] + penalty < best_[c] && (possible_ >> c & 1)) return true;
    }
    return false;
  }

  // What the tool turns by at least from any rung of a bundle, rad.
  double least_turn(int number) const {
    const int aside = aside_of(number * kBundle), end = aside_of(number * kBundle + kBundle - 1);
    if (aside > end || (aside <= 1 && end >= -1)) return 0;  // on either side, or across the middle
    return (std::min(std::abs(aside), std::abs(end)) - 1) * task_.ladder.step;
  }

  void look_through(int number) {
    const int end = std::min((number + 1) * kBundle, task_.ladder.rungs);
    for (int k = number * kBundle; k < end; ++k) look(k, aside_of(k));
  }

  // The rung that lies `aside` steps from the one that the tool would reach without turning.
  void look_aside(int aside) {
    const int n = task_.ladder.rungs;
    int k = rung_ + centre_ + aside;
    if (task_.ladder.closed) k += k < 0 ? n : k >= n ? -n : 0;
    if (k >= 0 && k < n) look(k, aside);
  }
  int aside_of(int k) const {
    const int n = task_.ladder.rungs, aside = k - rung_ - centre_;
    if (!task_.ladder.closed) return aside;
    return 2 * aside > n ? aside - n : 2 * aside < -n ? aside + n : aside;
  }

  void look(int k, int aside) {
    const double turn = rest_ - aside * task_.ladder.step;
    if (std::abs(turn) > most_turn_) return;
    const double penalty = rule_.penalty(turn);
    if (!may_help(&from_.value[static_cast<std::size_t>(k) * copies_.combinations], from_.least[k], penalty))
      return;
    // The joint that was too slow last is the likeliest to be so again.
    if (!follows(slow_, k)) return;
    for (int j = 0; j < kJoints; ++j) {
      if (!follows(j, k)) {
        slow_ = j;
        return;
      }
    }
    join(k, penalty, aside);
  }

  // Whether joint j keeps its limit from that rung on. Its copies are then so many turns apart.
  bool follows(int j, int k) {
    double step = angle_[j] - before_.angle[j][k];
    turns_[j] = 0;
    if (copies_.count[j] > 1 && std::abs(step) > kPi) {
      turns_[j] = step > 0 ? -1 : 1;
      step += kTwoPi * turns_[j];
    }
    return std::abs(step) <= limit_.joint[j];
  }

  // The common number of the copy that a copy here goes on from; nothing where there is none.
  std::optional<int> number_before(int copy) const {
    int before = copy;
    for (int j = 0; j < kJoints; ++j) {
      if (turns_[j] == 0) continue;
      const int turns = copies_.turns[copy][j] - turns_[j];
      if (turns < 0 || turns >= copies_.count[j]) return std::nullopt;
      before -= turns_[j] * copies_.stride[j];
    }
    return before;
  }

  void join(int k, double penalty, int aside) {
    const bool turned = std::any_of(turns_, turns_ + kJoints, [](int t) { return t != 0; });
    bound_ = -kUnreached;
    for (int c = 0; c < copies_.combinations; ++c) {
      if (!(possible_ >> c & 1)) continue;
      const std::optional<int> before = turned ? number_before(c) : c;
      if (before) {
        const auto at = static_cast<std::size_t>(k) * copies_.combinations + *before;
        if (from_.value[at] + penalty < best_[c]) {
          best_[c] = from_.value[at] + penalty;
          origin_[c] = static_cast<std::uint16_t>(at);
          offset_ = aside;
        }
      }
      bound_ = std::max(bound_, best_[c]);
    }
  }

  const ChainTask& task_;
  const Rule& rule_;
  const AngleCopies& copies_;
  const StepLimit& limit_;
  const BranchRungs& before_;
  const Front& from_;
  const BranchRungs& now_;
  double most_turn_ = 0;
  int centre_ = 0, reach_ = 0;  // rungs
  double rest_ = 0;             // rad: of the turn to the rung at the centre
  int rung_ = 0;
  double angle_[kJoints];
  int turns_[kJoints] = {};
  int slow_ = 5, offset_ = 0;  // as they were last
  std::vector<Bundle> bundles_;
  std::vector<double> bundle_values_;  // [bundle][copy] the least
  std::vector<int> by_value_;          // bundles that hold anything, the least value first
  std::vector<Near> near_;
  bool wrapped_ = false;
  std::uint32_t possible_ = 0;  // the copies that they may lead to
  std::array<double, kMostCopies> best_;
  std::array<std::uint16_t, kMostCopies> origin_;
  double bound_ = 0;  // the largest of best_ of the copies that are allowed and possible
};

}  // namespace stablecut::robot
