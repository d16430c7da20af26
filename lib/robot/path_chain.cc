#include "robot/path_chain.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/units.h"
#include "robot/path_step.h"

namespace stablecut::robot {
namespace {

constexpr std::size_t kRungsAtOnce = 24'000;  // of a block of points in memory, all branches
constexpr double kTurnUnit = kPi / 2;         // rad

// The largest cost so far.
struct WorstRule {
  double most_cost;
  double start(double cost) const { return cost; }
  double with(double before, double cost) const { return std::max(before, cost); }
  double penalty(double) const { return 0; }
  double enough(double cost) const { return cost; }  // a better one before would not help
};

struct SumRule {
  double per_reference, per_turn2, most_cost;  // -, 1/rad^2, -
  double start(double cost) const { return cost * per_reference; }
  double with(double before, double cost) const { return before + cost * per_reference; }
  double penalty(double turn) const { return per_turn2 * turn * turn; }
  double enough(double) const { return -kUnreached; }
};

// One branch's front, moved along the path.
template <typename Rule>
class BranchPass {
 public:
  BranchPass(const ChainTask& task, const Rule& rule) : task_(task), rule_(rule) {}

  void start(const BranchRungs& rungs) {
    front_.clear(task_.ladder.rungs, task_.model.copies().combinations);
    if (!rungs.any) return;
    for (int k = 0; k < task_.ladder.rungs; ++k) {
      if (!(rungs.cost[k] <= rule_.most_cost)) continue;
      for (int c = 0; c < task_.model.copies().combinations; ++c) {
        if (rungs.copies[k] >> c & 1)
          front_.put(k, c, task_.model.copies().combinations, rule_.start(rungs.cost[k]));
      }
    }
  }
  // From point - 1 to point. `back`, where given, gets for each rung and copy the one that it comes from.
  void move(std::size_t point, const BranchRungs& before, const BranchRungs& now, std::uint16_t* back) {
    next_.clear(task_.ladder.rungs, task_.model.copies().combinations);
    if (front_.alive && now.any) {
      RungStep<Rule> step(task_, rule_, point, before, front_, now);
      for (int k = 0; k < task_.ladder.rungs; ++k) step.take(k, next_, back);
    }
    std::swap(front_, next_);
  }
  const Front& front() const { return front_; }

 private:
  const ChainTask& task_;
  const Rule& rule_;
  Front front_, next_;
};

// Blocks of points whose rungs are in memory, with the point before.
class Blocks {
 public:
  Blocks(const ChainTask& task, std::size_t first, std::size_t last, double most_cost)
      : task_(task),
        most_cost_(most_cost),
        first_(first),
        last_(last),
        size_(std::max<std::size_t>(1, kRungsAtOnce / static_cast<std::size_t>(task.ladder.rungs))),
        rungs_(std::min(size_, last - first + 1) + 1),
        ahead_(rungs_.size() - 1),
        begin_(first),
        end_(first) {}

  // The next block; false after the last.
  bool next() {
    if (end_ > last_) return false;
    if (end_ > begin_) std::swap(rungs_[0], rungs_[end_ - begin_]);
    if (!ahead_is_filled_)
      parallel_for(next_end() - end_, task_.threads, [&](std::size_t i) { fill_ahead(i); });
    begin_ = end_;
    end_ = next_end();
    for (std::size_t i = 0; i < end_ - begin_; ++i) std::swap(rungs_[i + 1], ahead_[i]);
    ahead_is_filled_ = false;
    if (task_.progress)
      task_.progress(static_cast<double>(begin_ - first_) / static_cast<double>(last_ - first_ + 1));
    return true;
  }
  // Calls work(0 ... count - 1) on the threads, and has the others fill the next block meanwhile.
  template <typename Work>
  void run(std::size_t count, const Work& work) {
    const std::size_t more = ahead_is_filled_ ? 0 : next_end() - end_;
    parallel_for(count + more, task_.threads, [&](std::size_t i) {
      if (i < count)
        work(i);
      else
        fill_ahead(i - count);
    });
    ahead_is_filled_ = true;
  }
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }
  // Of the block, or of the point before it.
  const PointRungs& at(std::size_t point) const { return rungs_[point + 1 - begin_]; }

 private:
  std::size_t next_end() const { return std::min(end_ + size_, last_ + 1); }
  void fill_ahead(std::size_t i) {
    task_.model.fill(task_.ladder, end_ + i, task_.branches, ahead_[i], task_.known, most_cost_);
  }

  const ChainTask& task_;
  double most_cost_;
  std::size_t first_, last_, size_;
  std::vector<PointRungs> rungs_, ahead_;  // of the block behind the point before it, and of the next block
  bool ahead_is_filled_ = false;
  std::size_t begin_, end_;
};

std::vector<int> branch_list(unsigned branches) {
  std::vector<int> list;
  for (int b = 0; b < kBranches; ++b) {
    if (branches >> b & 1) list.push_back(b);
  }
  return list;
}

// The stretches over rungs that cost no more than `most_cost`; `one`: the first alone.
std::vector<PathStretch> stretches(const ChainTask& task, std::size_t first, std::size_t last,
                                   double most_cost, bool one) {
  const WorstRule rule{most_cost};
  const std::vector<int> branches = branch_list(task.branches);
  std::vector<BranchPass<WorstRule>> passes(branches.size(), BranchPass<WorstRule>(task, rule));
  std::vector<std::vector<double>> best(branches.size());  // at the points of a block, from `from` on
  std::vector<PathStretch> found;
  bool open = false;
  Blocks blocks(task, first, last, most_cost);
  while (blocks.next()) {
    for (std::size_t from = blocks.begin(); from < blocks.end();) {
      blocks.run(branches.size(), [&](std::size_t b) {
        best[b].clear();
        for (std::size_t i = from; i < blocks.end(); ++i) {
          const BranchRungs& now = blocks.at(i)[branches[b]];
          if (i == from && !open)
            passes[b].start(now);
          else
            passes[b].move(i, blocks.at(i - 1)[branches[b]], now, nullptr);
          if (!passes[b].front().alive) break;
          best[b].push_back(passes[b].front().best());
        }
      });
      std::size_t reached = 0;
      for (const auto& values : best) reached = std::max(reached, values.size());
      if (reached > 0) {
        if (!open) found.push_back({from, from, {}});
        found.back().last = from + reached - 1;
        found.back().largest.fill(kUnreached);
        for (std::size_t b = 0; b < branches.size(); ++b) {
          if (best[b].size() == reached) found.back().largest[branches[b]] = best[b].back();
        }
      }
      // A point where a stretch ends begins the next; one where nothing is allowed is left behind.
      const bool ended = from + reached < blocks.end();
      if (one && ended) return found;
      from += reached + (ended && !open && reached == 0 ? 1 : 0);
      open = !ended;
    }
  }
  return found;
}

}  // namespace

double PathStretch::best() const { return *std::min_element(largest.begin(), largest.end()); }

std::vector<PathStretch> path_stretches(const ChainTask& task, std::size_t first, std::size_t last) {
  return stretches(task, first, last, kUnreached, false);
}

std::optional<PathStretch> path_through(const ChainTask& task, std::size_t first, std::size_t last,
                                        double most_cost) {
  const auto found = stretches(task, first, last, most_cost, true);
  if (found.empty() || found[0].first != first || found[0].last != last) return std::nullopt;
  return found[0];
}

std::optional<PathChain> best_chain(const ChainTask& task, std::size_t first, std::size_t last,
                                    const ChainWeights& weights) {
  const std::vector<int> branches = branch_list(task.branches);
  const SumRule rule{1 / weights.reference, weights.smoothness / (kTurnUnit * kTurnUnit), weights.most_cost};
  const std::size_t count = last - first + 1;
  const int combinations = task.model.copies().combinations;
  const std::size_t states = static_cast<std::size_t>(task.ladder.rungs) * combinations;
  std::vector<BranchPass<SumRule>> passes(branches.size(), BranchPass<SumRule>(task, rule));
  // [branch][point][rung and copy] where it comes from; of the branches that lead on.
  std::vector<std::vector<std::vector<std::uint16_t>>> back(branches.size());
  Blocks blocks(task, first, last, weights.most_cost);
  while (blocks.next()) {
    blocks.run(branches.size(), [&](std::size_t b) {
      for (std::size_t i = blocks.begin(); i < blocks.end(); ++i) {
        const BranchRungs& now = blocks.at(i)[branches[b]];
        if (i == first) {
          passes[b].start(now);
          back[b].emplace_back();
        } else if (passes[b].front().alive) {
          back[b].emplace_back(states);
          passes[b].move(i, blocks.at(i - 1)[branches[b]], now, back[b].back().data());
        }
      }
      if (!passes[b].front().alive) back[b] = {};
    });
  }
  std::optional<std::size_t> winner;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (!passes[b].front().alive) continue;
    if (!winner || passes[b].front().best() < passes[*winner].front().best()) winner = b;
  }
  if (!winner) return std::nullopt;
  const std::vector<double>& ends = passes[*winner].front().value;
  auto state = static_cast<std::size_t>(std::min_element(ends.begin(), ends.end()) - ends.begin());
  PathChain chain{branches[*winner], std::vector<double>(count), std::vector<int>(count), ends[state]};
  for (std::size_t i = count; i-- > 0;) {
    const int rung = static_cast<int>(state) / combinations;
    chain.turn[i] = task.ladder.turn(first + i, rung);
    chain.copy[i] = static_cast<int>(state) % combinations;
    if (i > 0) state = back[*winner][i][state];
  }
  // A closed ladder's turns may run on.
  for (std::size_t i = 1; i < count; ++i)
    chain.turn[i] += kTwoPi * std::nearbyint((chain.turn[i - 1] - chain.turn[i]) / kTwoPi);
  return chain;
}

}  // namespace stablecut::robot
