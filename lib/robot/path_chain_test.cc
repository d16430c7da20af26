// The dynamic programme over bundles of rungs against one that looks at all pairs of rungs and copies.
#include "robot/path_chain.h"

#include <catch2/catch.hpp>

#include "robot/path_fixtures_test.h"

namespace stablecut::robot {
namespace {

using namespace fixtures;

struct Plain {
  double largest = kUnreached, total = kUnreached;  // the least of what ChainTask's passes make least
};

// One branch through all points, with the weights of best_chain(): smoothness 1, reference `reference`.
Plain plain_programme(const ChainTask& task, int branch, double reference) {
  const AngleCopies& copies = task.model.copies();
  struct State {
    JointAngles angles;
    double turn, largest, total;
  };
  std::vector<State> before;
  for (std::size_t i = 0; i < task.model.size(); ++i) {
    PointRungs rungs;
    task.model.fill(task.ladder, i, kAllBranches, rungs);
    std::vector<State> now;
    for (int k = 0; k < task.ladder.rungs; ++k) {
      for (int c = 0; c < copies.combinations; ++c) {
        if (!(rungs[branch].copies[k] >> c & 1)) continue;
        State state{rungs[branch].at(k), task.ladder.turn(i, k), kUnreached, kUnreached};
        for (int j = 0; j < kJoints; ++j) state.angles[j] += kTwoPi * copies.turns[c][j];
        const double cost = rungs[branch].cost[k];
        if (i == 0) state.largest = cost, state.total = cost / reference;
        for (const State& from : before) {
          if (((state.angles - from.angles).cwiseAbs().array() > task.limits[i].joint.array()).any())
            continue;
          double turn = state.turn - from.turn;
          if (task.ladder.closed) turn = std::remainder(turn, kTwoPi);
          if (std::abs(turn) > task.limits[i].turn) continue;
          state.largest = std::min(state.largest, std::max(from.largest, cost));
          state.total = std::min(state.total, from.total + cost / reference + std::pow(turn / (kPi / 2), 2));
        }
        if (state.largest < kUnreached) now.push_back(state);
      }
    }
    before = std::move(now);
  }
  Plain best;
  for (const State& state : before) {
    best.largest = std::min(best.largest, state.largest);
    best.total = std::min(best.total, state.total);
  }
  return best;
}

TEST_CASE("the programme over bundles finds what all pairs of rungs and copies allow") {
  std::mt19937_64 generator(61);
  int through = 0, stopped = 0;
  for (int n = 0; n < 24; ++n) {
    PathCell cell = path_cells()[n % 3];
    if (n % 2 == 1) cell.robot = with_tool_offset(cell.robot, 0.15);
    // Ranges that hold two or three copies of the wrist's angles, beginning anywhere.
    for (const int j : {3, 5}) {
      const double from = -uniform(generator, 3, 7);
      cell.robot.joints[j].min_rad = from;
      cell.robot.joints[j].max_rad = from + uniform(generator, 7, j == 3 ? 11 : 15);
    }
    const ToolPath path = n % 4 < 2 ? circle_path(cell, 14, 0.5) : zigzag_path(cell, 60, 0.5);
    PathTask task = path_task(cell, {path.begin(), path.begin() + 14}, "deflection");
    if (n % 4 == 3) task.redundancy = Range{-1.2, 1.4, 3};
    const PathModel model(cell.robot, task);
    const Ladder ladder = model.whole_ladder(radians_from_degrees(4));
    // Steps from one rung to two dozen; turns that are bound as well.
    const double step = radians_from_degrees(uniform(generator, 10, 40));
    std::vector<StepLimit> limits(model.size(),
                                  {JointAngles::Constant(step), n % 3 == 0 ? step / 2 : kPi / 2});
    const double reference = 1e-4;
    for (int branch = 0; branch < kBranches; ++branch) {
      INFO("case " << n << ", branch " << branch);
      const ChainTask chain{model, ladder, limits, 1U << branch, 1, {}};
      const Plain plain = plain_programme(chain, branch, reference);
      const auto found = path_through(chain, 0, model.size() - 1);
      const auto best = best_chain(chain, 0, model.size() - 1, {reference, 1});
      REQUIRE(found.has_value() == (plain.largest < kUnreached));
      REQUIRE(best.has_value() == found.has_value());
      ++(found ? through : stopped);
      if (!found) continue;
      CHECK(found->best() == plain.largest);
      CHECK(best->total == Approx(plain.total).epsilon(1e-12));
    }
  }
  CHECK(through > 20);
  CHECK(stopped > 5);
}

}  // namespace
}  // namespace stablecut::robot
