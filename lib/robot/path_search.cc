#include "robot/path_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/units.h"
#include "robot/path_obstacles.h"

namespace stablecut::robot {
namespace {

constexpr double kTieSmoothness = 1;      // of the turns' weight where the largest cost is settled
constexpr double kMeanSmoothness = 1e-4;  // the same beside the mean
constexpr double kSameCost = 1e-9;        // relative: branches that are as good
constexpr double kCostRounding = 1e-12;   // relative
constexpr double kFinerSteps[] = {kPi / 720, kPi / 2880, kPi / 11520, kPi / 46080};
constexpr int kFinerRungs = 4;       // on either side of what was found
constexpr int kMostRounds = 8;       // with one step
constexpr double kNoGain = 1e-5;     // relative, of the objective
constexpr double kNoTieGain = 1e-4;  // relative, of what is least beside the largest cost
constexpr double kStairStep =
    3 * kPi / 180;  // rad that every joint has to be able to turn from stair to stair
constexpr std::size_t kSomePoints = 50;
constexpr double kCoarseStep = 5 * kPi / 180;
constexpr double kRampReach = 4 * kPi / 180;  // rad that the motion may be off the ramps
constexpr double kLeastRampStep = kPi / 180'000;
constexpr double kRampStep = kPi / 360;
constexpr double kRampShare = 0.25;  // of what the slowest joint turns between two points
constexpr int kMostRampRungs = 60;
constexpr double kLadderShare = 0.95;  // of the time that a motion takes, for the bar

// A motion through a stretch and what it is worth.
struct Found {
  PathChain chain;
  double objective = 0;  // the largest cost, or what the chain makes least
};

class Search {
 public:
  Search(const PathModel& model, int threads, const Progress& progress)
      : model_(model),
        mean_(model.task().mean_objective),
        threads_(threads),
        progress_(progress),
        limits_(model.step_limits()),
        whole_(model.whole_ladder(kLadderStep)),
        known_(model.size(), whole_.rungs) {
    near_.base.resize(model_.size());
    if (mean_) mean_cost_ = typical_cost();
    set_stairs();
  }

  std::optional<PathPart> whole_motion() {
    std::vector<PathPart> parts;
    if (!add_motion(0, model_.size() - 1, parts)) return std::nullopt;
    return std::move(parts.front());
  }

  PathSearch run() {
    const std::size_t end = model_.size() - 1;
    PathSearch result;
    if (!add_motion(0, end, result.parts)) {
      std::vector<PathStretch> stairs;
      const auto plain = path_stretches(chain_task(whole_, limits_, 0.5), 0, end);
      if (!stair_ends_.empty()) stairs = path_stretches(chain_task(whole_, stair_limits_, 0.4), 0, end);
      const bool fewer = !stairs.empty() && stairs.size() < plain.size();
      for (const PathStretch& stretch : fewer ? stairs : plain) {
        if (add_motion(stretch.first, stretch.last, result.parts)) continue;
        // Stairs that no real motion follows.
        for (const PathStretch& part : plain) {
          const std::size_t first = std::max(part.first, stretch.first),
                            last = std::min(part.last, stretch.last);
          if (first <= last) add_motion(first, last, result.parts);
        }
      }
    }
    result.obstacles = path_obstacles(model_, limits_, result.parts, threads_);
    if (progress_) progress_(1);
    return result;
  }

 private:
  ChainTask chain_task(const Ladder& ladder, const std::vector<StepLimit>& limits, double share) {
    const double from = done_;
    done_ += share * (1 - done_);
    Progress part;
    if (progress_) part = [this, from, to = done_](double at) { progress_(from + (to - from) * at); };
    return {model_, ladder, limits, kAllBranches, threads_, part, &ladder == &whole_ ? &known_ : nullptr};
  }

  // What the search through these points takes of what is left to do, in the order of the path.
  double share_of(std::size_t first, std::size_t last) const {
    return kLadderShare * static_cast<double>(last - first + 1) / static_cast<double>(model_.size() - first);
  }

  // Where points are so near that no joint can turn by a rung between them: stairs of several points, between
  // which joints and tool may turn by what the whole stair allows, and within which the tool does not turn.
  void set_stairs() {
    stair_limits_ = limits_;
    for (StepLimit& limit : stair_limits_) limit.turn = 0;
    StepLimit sum{JointAngles::Zero(), 0};
    bool needed = false;
    for (std::size_t i = 1; i < limits_.size(); ++i) {
      sum.joint += limits_[i].joint;
      sum.turn += limits_[i].turn;
      const bool enough = sum.joint.minCoeff() >= kStairStep && sum.turn >= kStairStep;
      needed = needed || limits_[i].joint.minCoeff() < kLadderStep || limits_[i].turn < kLadderStep;
      if (!enough && i + 1 < limits_.size()) continue;
      stair_limits_[i] = {sum.joint.cwiseMin(kPi / 2), std::min(sum.turn, kPi / 2)};
      stair_ends_.push_back(i);
      sum = {JointAngles::Zero(), 0};
    }
    if (!needed) stair_ends_.clear();
    std::vector<double> slowest;
    for (const StepLimit& limit : limits_) slowest.push_back(limit.joint.minCoeff());
    const auto middle = slowest.begin() + static_cast<std::ptrdiff_t>(slowest.size() / 2);
    std::nth_element(slowest.begin(), middle, slowest.end());
    usual_step_ = *middle;
  }

  // What a cost is about: the mean of the least costs of some points, continuity aside.
  double typical_cost() const {
    const Ladder ladder = model_.whole_ladder(kCoarseStep);
    const std::size_t count = std::min(model_.size(), kSomePoints);
    std::vector<double> least(count);
    parallel_for(count, threads_, [&](std::size_t s) {
      PointRungs rungs;
      model_.fill(ladder, s * (model_.size() - 1) / std::max<std::size_t>(1, count - 1), kAllBranches, rungs);
      least[s] = least_cost(rungs);
    });
    std::erase_if(least, [](double cost) { return !std::isfinite(cost); });
    if (least.empty()) return 1;
    return std::accumulate(least.begin(), least.end(), 0.0) / static_cast<double>(least.size());
  }

  // Adds the best motion through these points, if there is one.
  bool add_motion(std::size_t first, std::size_t last, std::vector<PathPart>& parts) {
    std::optional<Found> best;
    if (!stair_ends_.empty()) best = from_stairs(first, last);
    if (auto found = from_ladder(first, last, best ? best->objective * (1 - kNoGain) : kUnreached);
        found && (!best || found->objective < best->objective))
      best = std::move(found);
    if (best) parts.push_back(part_of(first, *best));
    return best.has_value();
  }

  // The branches of a stretch that are as good as the best.
  static unsigned best_branches(const PathStretch& stretch) {
    unsigned branches = 0;
    for (int b = 0; b < kBranches; ++b) {
      if (stretch.largest[b] <= stretch.best() * (1 + kSameCost)) branches |= 1U << b;
    }
    return branches;
  }

  // The best sequence of rungs through these points, over rungs that cost no more than `most_cost` where the
  // largest cost counts.
  std::optional<Found> best_of(ChainTask task, std::size_t first, std::size_t last,
                               double most_cost = kUnreached) const {
    ChainWeights weights{mean_cost_, kMeanSmoothness};
    double largest = 0;
    if (!mean_) {
      const Progress whole = task.progress;
      if (whole) task.progress = [whole](double at) { whole(at / 2); };
      const auto through = path_through(task, first, last, most_cost);
      if (!through) return std::nullopt;
      largest = through->best();
      if (whole) task.progress = [whole](double at) { whole((1 + at) / 2); };
      weights = {largest, kTieSmoothness, largest * (1 + kCostRounding)};
      task.branches = best_branches(*through);
    }
    auto chain = best_chain(task, first, last, weights);
    if (!chain) return std::nullopt;
    return Found{std::move(*chain), mean_ ? chain->total : largest};
  }

  // The best about a known motion, turned by up to `rungs` steps either way; nothing where none leads
  // through.
  std::optional<Found> around(std::size_t first, int branch, const std::vector<double>& turn, double step,
                              int rungs) {
    for (std::size_t i = 0; i < turn.size(); ++i) near_.base[first + i] = turn[i] - rungs * step;
    near_.step = step;
    near_.rungs = 2 * rungs + 1;
    ChainTask task = chain_task(near_, limits_, 0);
    task.progress = nullptr;
    task.branches = 1U << branch;
    return best_of(task, first, first + turn.size() - 1);
  }

  std::optional<Found> from_ladder(std::size_t first, std::size_t last, double most_cost) {
    const double before = done_;
    auto found = best_of(chain_task(whole_, limits_, share_of(first, last)), first, last, most_cost);
    if (found) return refined(first, std::move(*found));
    done_ = before;  // it ended where the motion does
    return std::nullopt;
  }

  std::optional<Found> from_stairs(std::size_t first, std::size_t last) {
    const auto stairs = best_of(chain_task(whole_, stair_limits_, share_of(first, last) / 2), first, last);
    if (!stairs) return std::nullopt;
    // Finer than the joints' steps, so that the motion may be slower than the ramps where the path needs
    // speed.
    const double step = std::clamp(kRampShare * usual_step_, kLeastRampStep, kRampStep);
    const int rungs = std::min(kMostRampRungs, static_cast<int>(std::ceil(kRampReach / step)));
    auto found = around(first, stairs->chain.branch, ramps(first, stairs->chain.turn), step, rungs);
    return found ? std::optional(refined(first, std::move(*found))) : std::nullopt;
  }

  // Straight from the middle of one stair to the next.
  std::vector<double> ramps(std::size_t first, const std::vector<double>& turn) const {
    std::vector<double> at{0}, value{turn.front()};
    std::size_t begin = 0;
    for (const std::size_t stair : stair_ends_) {
      if (stair <= first) continue;
      const std::size_t end = std::min(stair - first, turn.size());
      if (end > begin) {
        at.push_back(0.5 * static_cast<double>(begin + end - 1));
        value.push_back(turn[begin]);
      }
      begin = end;
    }
    at.push_back(static_cast<double>(turn.size()));
    value.push_back(turn.back());
    std::vector<double> result(turn.size());
    std::size_t k = 1;
    for (std::size_t i = 0; i < turn.size(); ++i) {
      while (k + 1 < at.size() && at[k] < static_cast<double>(i)) ++k;
      const double width = at[k] - at[k - 1];
      const double share = width > 0 ? std::clamp((static_cast<double>(i) - at[k - 1]) / width, 0.0, 1.0) : 1;
      result[i] = value[k - 1] + share * (value[k] - value[k - 1]);
    }
    return result;
  }

  Found refined(std::size_t first, Found found) {
    for (const double step : kFinerSteps) {
      for (int round = 0; round < kMostRounds; ++round) {
        auto next = around(first, found.chain.branch, found.chain.turn, step, kFinerRungs);
        if (!next || next->objective > found.objective) break;
        const bool gained = next->objective < found.objective * (1 - kNoGain) ||
                            next->chain.total < found.chain.total * (1 - (mean_ ? kNoGain : kNoTieGain));
        found = std::move(*next);
        if (!gained) break;
      }
    }
    return found;
  }

  PathPart part_of(std::size_t first, const Found& found) const {
    PathPart part{first, found.chain.branch, {}, 0};
    const std::size_t count = found.chain.turn.size();
    for (std::size_t i = 0; i < count; ++i) {
      PathPose pose;
      pose.turn = found.chain.turn[i];
      pose.angles = model_.angles(first + i, pose.turn, part.branch, found.chain.copy[i]);
      pose.cost = model_.pose(first + i, pose.turn, part.branch)->cost;
      part.objective = mean_ ? part.objective + pose.cost / static_cast<double>(count)
                             : std::max(part.objective, pose.cost);
      if (i > 0) {
        const JointAngles step = pose.angles - part.poses.back().angles;
        // A move that only turns takes the time that its joints need.
        double time = model_.frames().time[first + i];
        if (!(time > 0)) time = step.cwiseAbs().cwiseQuotient(model_.task().max_speed).maxCoeff();
        pose.time = part.poses.back().time + time;
        if (time > 0) pose.speed = step / time;
      }
      part.poses.push_back(pose);
    }
    return part;
  }

  const PathModel& model_;
  const bool mean_;
  const int threads_;
  const Progress& progress_;
  const std::vector<StepLimit> limits_;
  const Ladder whole_;
  RungCosts known_;  // of whole_
  Ladder near_;      // about a known motion; its base holds at the points of that motion
  std::vector<StepLimit> stair_limits_;
  std::vector<std::size_t>
      stair_ends_;         // the points that the stairs begin with, but the first; empty: none needed
  double usual_step_ = 0;  // rad: the median of what the slowest joint turns between two points
  double mean_cost_ = 1;   // typical_cost(), of the mean objective
  double done_ = 0;
};

}  // namespace

std::optional<PathPart> search_motion(const PathModel& model, int threads) {
  return Search(model, threads, {}).whole_motion();
}

PathSearch search_path(const PathModel& model, int threads, const Progress& progress) {
  return Search(model, threads, progress).run();
}

}  // namespace stablecut::robot
