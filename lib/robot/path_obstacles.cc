#include "robot/path_obstacles.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr double kLookStep = 5 * kPi / 180;  // of the redundancy, to find out what is broken
constexpr double kWorstStep = kPi / 180;     // the same at the worst point
constexpr int kLookAround = 15;              // degrees of redundancy that a next pose may be off
constexpr double kWorthAWord = 1e-3;         // relative: a pose that much better is worth a word
constexpr double kTurnRounding = 1e-9;       // rad: rounding of the rungs
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The rule that stands last in the way is the nearest to being kept.
bool nearer(const PoseFault& a, const PoseFault& b) {
  return a.kind != b.kind ? a.kind > b.kind : a.missing < b.missing;
}

// What is broken by the least at a point where nothing is allowed.
PoseFault fault_of_point(const PathModel& model, const Ladder& ladder, std::size_t point) {
  PoseFault least{PoseFault::Kind::kReach};
  for (int k = 0; k < ladder.rungs; ++k) {
    for (int b = 0; b < kBranches; ++b) {
      const PoseFault fault = model.fault(point, ladder.turn(point, k), b);
      if (fault.kind != PoseFault::Kind::kNone && nearer(fault, least)) least = fault;
    }
  }
  return least;
}

struct Overspeed {
  double factor = kInfinity;  // of the joint's limit
  int joint = 0;
};

// Of the step between two poses, whole turns aside.
Overspeed overspeed(const StepLimit& limit, const JointAngles& from, const JointAngles& to) {
  Overspeed worst{0, 0};
  for (int j = 0; j < kJoints; ++j) {
    const double factor = std::abs(std::remainder(to[j] - from[j], kTwoPi)) / limit.joint[j];
    if (factor > worst.factor) worst = {factor, j};
  }
  return worst;
}

// The ladders of all points on which steps are looked at: that of the point before, and of the point itself.
struct LookLadders {
  Ladder before, here;
};

// The slowest step from any pose that is allowed before a point to one that is allowed there.
Overspeed slowest_step(const PathModel& model, const LookLadders& ladders, const StepLimit& limit,
                       std::size_t point) {
  const auto& [before, here] = ladders;
  PointRungs from, to;
  model.fill(before, point - 1, kAllBranches, from);
  model.fill(here, point, kAllBranches, to);
  const double most_turn = std::min(limit.turn, radians_from_degrees(kLookAround));
  Overspeed slowest;
  for (int b = 0; b < kBranches; ++b) {
    for (int k = 0; k < before.rungs && from[b].any; ++k) {
      if (from[b].copies[k] == 0) continue;
      for (int n = 0; n < here.rungs; ++n) {
        const double turn = here.turn(point, n) - before.turn(point - 1, k);
        if (to[b].copies[n] == 0 ||
            std::abs(before.closed ? std::remainder(turn, kTwoPi) : turn) > most_turn + kTurnRounding)
          continue;
        const Overspeed step = overspeed(limit, from[b].at(k), to[b].at(n));
        if (step.factor < slowest.factor) slowest = step;
      }
    }
  }
  return slowest;
}

// Why the motion of `part` does not lead on to the next point.
PathObstacle obstacle_between(const PathModel& model, const LookLadders& ladders, const StepLimit& limit,
                              const PathPart& part, std::size_t next) {
  PathObstacle obstacle{part.last(), next, true, false, {}};
  Overspeed slowest = slowest_step(model, ladders, limit, next);
  if (!(slowest.factor > 1)) {
    // Single poses would lead on: it is the motion up to here that does not.
    slowest = {};
    PoseFault least;
    const PathPose& pose = part.poses.back();
    for (int d = -kLookAround; d <= kLookAround; ++d) {
      const double turn = pose.turn + radians_from_degrees(d);
      const auto found = model.pose(next, turn, part.branch);
      if (!found) continue;
      JointAngles angles = found->angles;
      for (int j = 0; j < kJoints; ++j)
        angles[j] = pose.angles[j] + std::remainder(angles[j] - pose.angles[j], kTwoPi);
      const PoseFault fault = model.fault_of(next, turn, angles);
      const Overspeed step = overspeed(limit, pose.angles, angles);
      if (fault.kind == PoseFault::Kind::kNone) {
        if (step.factor < slowest.factor) slowest = step;
      } else if (step.factor <= 1 &&
                 (least.kind == PoseFault::Kind::kNone || fault.missing < least.missing)) {
        least = fault;
      }
    }
    if (least.kind != PoseFault::Kind::kNone || std::isinf(slowest.factor)) {
      obstacle.fault = least;
      return obstacle;
    }
  }
  obstacle.speed = true;
  obstacle.fault = {PoseFault::Kind::kNone, slowest.joint, slowest.factor};
  return obstacle;
}

bool same_kind(const PathObstacle& a, const PathObstacle& b) {
  return a.between == b.between && a.speed == b.speed && a.fault.kind == b.fault.kind &&
         a.fault.joint == b.fault.joint;
}

void add(std::vector<PathObstacle>& obstacles, const PathObstacle& next) {
  if (!obstacles.empty() && same_kind(obstacles.back(), next) &&
      next.first <= obstacles.back().last + (next.between ? 0 : 1)) {
    obstacles.back().last = next.last;
    obstacles.back().fault.missing = std::max(obstacles.back().fault.missing, next.fault.missing);
  } else {
    obstacles.push_back(next);
  }
}

}  // namespace

std::vector<PathObstacle> path_obstacles(const PathModel& model, const std::vector<StepLimit>& limits,
                                         const std::vector<PathPart>& parts, int threads) {
  std::vector<PathObstacle> gaps;
  std::size_t next = 0;
  for (std::size_t p = 0; p <= parts.size(); ++p) {
    const std::size_t begin = p < parts.size() ? parts[p].first : model.size();
    for (std::size_t i = next; i < begin; ++i) gaps.push_back({i, i, false, false, {}});
    if (p < parts.size() && begin > 0 && begin == next) gaps.push_back({begin - 1, begin, true, false, {}});
    if (p < parts.size()) next = parts[p].last() + 1;
  }
  const LookLadders ladders{model.whole_ladder(kLookStep), model.whole_ladder(kWorstStep)};
  parallel_for(gaps.size(), threads, [&](std::size_t g) {
    PathObstacle& gap = gaps[g];
    if (!gap.between) {
      gap.fault = fault_of_point(model, ladders.before, gap.first);
      return;
    }
    const auto part = std::lower_bound(parts.begin(), parts.end(), gap.first,
                                       [](const PathPart& p, std::size_t last) { return p.last() < last; });
    gap = obstacle_between(model, ladders, limits[gap.last], *part, gap.last);
  });
  std::vector<PathObstacle> obstacles;
  for (const PathObstacle& gap : gaps) add(obstacles, gap);
  return obstacles;
}

WorstPoint worst_point(const PathModel& model, const PathPart& part) {
  const auto worst = std::max_element(part.poses.begin(), part.poses.end(),
                                      [](const PathPose& a, const PathPose& b) { return a.cost < b.cost; });
  WorstPoint result;
  result.point = part.first + static_cast<std::size_t>(worst - part.poses.begin());
  const Ladder ladder = model.whole_ladder(kWorstStep);
  double same_branch = kInfinity, any_branch = kInfinity, forbidden = kInfinity;
  PoseFault fault;
  for (int k = 0; k < ladder.rungs; ++k) {
    for (int b = 0; b < kBranches; ++b) {
      const double turn = ladder.turn(result.point, k);
      const auto pose = model.pose(result.point, turn, b);
      if (!pose) continue;
      const PoseFault broken = model.fault(result.point, turn, b);
      if (broken.kind == PoseFault::Kind::kNone) {
        any_branch = std::min(any_branch, pose->cost);
        if (b == part.branch) same_branch = std::min(same_branch, pose->cost);
      } else if (pose->cost < forbidden) {
        forbidden = pose->cost;
        fault = broken;
      }
    }
  }
  const double enough = worst->cost * (1 - kWorthAWord);
  result.better_cost = worst->cost;
  const auto because = [&](WorstPoint::Reason reason, double cost) {
    result.reason = reason;
    result.better_cost = cost;
  };
  if (same_branch < enough) {
    because(WorstPoint::Reason::kNeighbours, same_branch);
  } else if (any_branch < enough) {
    because(WorstPoint::Reason::kBranch, any_branch);
  } else if (forbidden < enough) {
    because(WorstPoint::Reason::kFault, forbidden);
    result.fault = fault;
  }
  return result;
}

}  // namespace stablecut::robot
