// Dynamic programming over the rungs of a ladder: which sequence of rungs and copies of angles is best.
// README.md, "Paths".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "robot/path_ladder.h"

namespace stablecut::robot {

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();  ///< the value of what is not

/// What the passes below work on.
struct ChainTask {
  const PathModel& model;
  const Ladder& ladder;
  const std::vector<StepLimit>& limits;  ///< of the move that leads to each point
  unsigned branches = kAllBranches;      ///< a bit for each that may be taken
  int threads = 1;
  Progress progress;
  RungCosts* known = nullptr;  ///< of the ladder
};

/// Points that one motion can run through, both ends in, and the least largest cost on each branch; infinite
/// where the branch does not run through.
struct PathStretch {
  std::size_t first = 0, last = 0;
  std::array<double, kBranches> largest;

  double best() const;
};

/// The points `first` to `last` in as few stretches as can be; points where nothing is allowed are in none.
std::vector<PathStretch> path_stretches(const ChainTask& task, std::size_t first, std::size_t last);

/// All of them in one stretch, over rungs that cost no more than `most_cost`; nothing where there is none.
std::optional<PathStretch> path_through(const ChainTask& task, std::size_t first, std::size_t last,
                                        double most_cost = kUnreached);

/// A sequence of rungs.
struct PathChain {
  int branch = 0;
  std::vector<double> turn;  ///< rad, of each point of the stretch
  std::vector<int> copy;
  double total = 0;  ///< what ChainWeights makes least
};

/// What best_chain() makes least: the sum of cost / reference + smoothness (change of turn / 90 degrees)^2.
struct ChainWeights {
  double reference = 1;
  double smoothness = 0;
  double most_cost = kUnreached;  ///< rungs that cost more are not taken
};

/// The best sequence through the points `first` to `last`; nothing where none runs through.
std::optional<PathChain> best_chain(const ChainTask& task, std::size_t first, std::size_t last,
                                    const ChainWeights& weights);

}  // namespace stablecut::robot
