#include "robot/pose_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/units.h"
#include "robot/pose_refinement.h"

namespace stablecut::robot {
namespace {

constexpr double kLargestStep = 0.05;           // m, of the search's grid
constexpr double kLargestTurn = 5 * kPi / 180;  // rad
constexpr int kLeastSamples = 25;               // of an interval, however short
constexpr int kMostStartsPerArm = 30;
constexpr int kBlocks = 4;             // along x and along y
constexpr double kStartsApart = 0.03;  // of the plane's extent

Range at_most_apart(const Range& range, double step) {
  if (range.is_point()) return {range.from, range.to, 1};
  const int count = 1 + static_cast<int>(std::ceil((range.to - range.from) / step - 1e-9));
  return {range.from, range.to, std::max({count, kLeastSamples, range.count})};
}

// What of an interval is within reach.
Range within(const Range& range, const Range& reach) {
  const Range part{std::max(range.from, reach.from), std::min(range.to, reach.to), range.count};
  if (!(part.from <= part.to)) throw NoAnswer(kOutOfReach);
  return part;
}

// The task's samples where they are fine enough, else finer ones, where the arm may reach.
PoseTask with_search_grid(const Robot& robot, const PoseTask& task) {
  const auto reach = plane_reach(robot, task.plane, task.tool_axis);
  PoseTask grid = task;
  grid.x = at_most_apart(within(task.x, reach.x), kLargestStep);
  grid.y = at_most_apart(within(task.y, reach.y), kLargestStep);
  grid.redundancy = at_most_apart(task.redundancy, kLargestTurn);
  return grid;
}

bool same_grid(const PoseTask& a, const PoseTask& b) {
  const auto same = [](const Range& r, const Range& s) {
    return r.from == s.from && r.to == s.to && r.count == s.count;
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.redundancy, b.redundancy);
}

// The best point of each of some blocks of the grid: basins whose peak the sampling of the redundancy hides.
std::vector<ScanBest> best_of_blocks(const PlaneScan& scan, std::size_t arm) {
  std::vector<std::optional<ScanBest>> best(kBlocks * kBlocks);
  for (int j = 0; j < scan.task.y.count; ++j) {
    for (int i = 0; i < scan.task.x.count; ++i) {
      const auto& here = scan.at(i, j).arms[arm];
      auto& block = best[static_cast<std::size_t>(kBlocks * j / scan.task.y.count * kBlocks +
                                                  kBlocks * i / scan.task.x.count)];
      if (here && (!block || here->merit > block->merit)) block = here;
    }
  }
  std::vector<ScanBest> result;
  for (const auto& block : best) {
    if (block) result.push_back(*block);
  }
  return result;
}

// Points of the grid that are not worse than their neighbours, of each arm; the best first, and not close
// together.
std::vector<ScanBest> starts_of(const PlaneScan& scan) {
  std::vector<ScanBest> starts;
  const double apart =
      kStartsApart * std::max(scan.task.x.to - scan.task.x.from, scan.task.y.to - scan.task.y.from);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    std::vector<ScanBest> peaks;
    for (int j = 0; j < scan.task.y.count; ++j) {
      for (int i = 0; i < scan.task.x.count; ++i) {
        const auto& here = scan.at(i, j).arms[arm];
        if (!here) continue;
        bool peak = true;
        for (int dj = -1; dj <= 1 && peak; ++dj) {
          for (int di = -1; di <= 1 && peak; ++di) {
            if (i + di < 0 || j + dj < 0 || i + di >= scan.task.x.count || j + dj >= scan.task.y.count)
              continue;
            const auto& neighbour = scan.at(i + di, j + dj).arms[arm];
            peak = !neighbour || neighbour->merit <= here->merit;
          }
        }
        if (peak) peaks.push_back(*here);
      }
    }
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const ScanBest& a, const ScanBest& b) { return a.merit > b.merit; });
    std::vector<ScanBest> chosen = best_of_blocks(scan, arm);
    const std::size_t most = chosen.size() + kMostStartsPerArm;
    for (const ScanBest& peak : peaks) {
      const bool close = std::any_of(chosen.begin(), chosen.end(), [&](const ScanBest& other) {
        return std::hypot(peak.at.x - other.at.x, peak.at.y - other.at.y) < apart;
      });
      if (!close) chosen.push_back(peak);
      if (chosen.size() == most) break;
    }
    starts.insert(starts.end(), chosen.begin(), chosen.end());
  }
  return starts;
}

// Perhaps a sliver between the samples: from where the limits are missed least.
std::vector<ScanBest> starts_outside(const PlaneScan& scan) {
  std::vector<ScanBest> starts;
  for (const PointScan& point : scan.points) {
    if (!std::isfinite(point.best_limit_margin_rad)) continue;
    starts.push_back(point.least_outside);
    starts.back().merit = point.best_limit_margin_rad;
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const ScanBest& a, const ScanBest& b) { return a.merit > b.merit; });
  starts.resize(std::min<std::size_t>(starts.size(), kMostStartsPerArm));
  return starts;
}

[[noreturn]] void nothing_allowed(const PoseScanner& scanner, const PlaneScan& scan) {
  const Robot& robot = scanner.robot();
  const PoseTask& task = scanner.task();
  double margin = -std::numeric_limits<double>::infinity();
  PlanePoint at;
  for (const PointScan& point : scan.points) {
    if (point.best_limit_margin_rad <= margin) continue;
    margin = point.best_limit_margin_rad;
    at = point.least_outside.at;
  }
  const auto evaluation = std::isfinite(margin) ? scanner.evaluate(at) : std::nullopt;
  if (!evaluation) throw NoAnswer(kOutOfReach);
  int worst = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < kJoints; ++j) {
    const Joint& joint = robot.joints[j];
    const double left = joint.margin_rad(evaluation->angles[j]);
    if (left < least) {
      least = left;
      worst = j;
    }
  }
  const auto degrees = [](double rad) { return number_text(degrees_from_radians(rad), 3); };
  if (least < task.limit_margin_rad) {
    throw NoAnswer("no reachable pose: at best joint " + robot.joints[worst].name + " would be " +
                   (least < 0 ? degrees(-least) + " degrees outside its limits"
                              : degrees(least) + " degrees from a limit, nearer than the limit margin"));
  }
  throw NoAnswer(
      "no reachable pose: all that the limits allow is nearer to a singularity than the singularity margin");
}

}  // namespace

PoseSearch search_poses(const Robot& robot, const PoseTask& task, int most_alternatives, int threads,
                        const Progress& progress, const PlaneScan* known) {
  const PoseTask grid = with_search_grid(robot, task);
  PlaneScan own;
  if (!known || !same_grid(known->task, grid)) {
    own = scan_plane(robot, grid, threads, progress);
    known = &own;
  }
  std::vector<ScanBest> starts = starts_of(*known);
  if (starts.empty()) starts = starts_outside(*known);

  const PoseScanner scanner(robot, task);
  const double radius =
      std::max({known->task.x.step(), known->task.y.step(), known->task.redundancy.step(), 1e-3});
  std::vector<std::optional<FoundPose>> refined(starts.size());
  parallel_for(starts.size(), threads,
               [&](std::size_t i) { refined[i] = refined_pose(scanner, starts[i].at, radius); });

  const Symmetry symmetry = symmetry_of(scanner);
  std::vector<FoundPose> found;
  for (const auto& pose : refined) {
    if (!pose) continue;
    // Of a wrist and its flip, the one whose joint 4 is turned less.
    found.push_back(*pose);
    if (const auto other = flipped(scanner, *pose)) {
      if (std::abs(other->angles[3]) < std::abs(pose->angles[3]) - 1e-6) found.back() = *other;
    }
    if (symmetry.base_turn || symmetry.tool_turn) found.back() = centred(scanner, found.back(), symmetry);
  }
  if (found.empty()) nothing_allowed(scanner, *known);
  const bool larger = task.stiffness.index->larger_is_better;
  std::stable_sort(found.begin(), found.end(), [&](const FoundPose& a, const FoundPose& b) {
    return larger ? a.score > b.score : a.score < b.score;
  });

  PoseSearch result;
  // Among equals the one with the largest margin to the limits leads, then the one that is turned least, then
  // the one at the larger y, so that rounding does not choose.
  auto best = found.begin();
  const auto leads = [&](const FoundPose& a, const FoundPose& b) {
    const double margin = limit_margin_rad(robot, a.angles) - limit_margin_rad(robot, b.angles);
    if (std::abs(margin) > 1e-6) return margin > 0;
    const double turn = a.angles.norm() - b.angles.norm();
    return std::abs(turn) > 1e-6 ? turn < 0 : a.at.y > b.at.y;
  };
  for (auto other = found.begin(); other != found.end() && equal_scores(other->score, found.front().score);
       ++other) {
    if (leads(*other, *best)) best = other;
  }
  std::rotate(found.begin(), best, best + 1);
  result.best = found.front();
  result.redundancy_matters = scanner.redundancy_matters();

  std::vector<FoundPose> listed{result.best};
  for (const auto& [applies, kind, joint] :
       {std::tuple{symmetry.base_turn, PoseFamily::Kind::kBaseTurn, 0},
        std::tuple{symmetry.tool_turn, PoseFamily::Kind::kToolTurn, 5}}) {
    if (!applies) continue;
    const PoseFamily family = family_of(scanner, result.best, kind, joint);
    if (family.to_rad - family.from_rad > 1e-6) result.families.push_back(family);
  }
  if (const auto other = flipped(scanner, result.best)) {
    result.families.push_back({PoseFamily::Kind::kFlippedWrist, 0, 0, other->angles});
    listed.push_back(*other);
  }
  for (const FoundPose& pose : found) {
    const bool seen = std::any_of(listed.begin(), listed.end(),
                                  [&](const FoundPose& other) { return same_pose(pose, other, symmetry); });
    if (seen) continue;
    listed.push_back(pose);
    if (equal_scores(pose.score, result.best.score)) {
      result.families.push_back({PoseFamily::Kind::kEqual, 0, 0, pose.angles});
      continue;
    }
    const bool repeats =
        std::any_of(result.alternatives.begin(), result.alternatives.end(), [&](const auto& other) {
          return equal_scores(pose.score, other.score) && same_pose(pose, other, {symmetry.base_turn, true});
        });
    if (!repeats && static_cast<int>(result.alternatives.size()) < most_alternatives) {
      result.alternatives.push_back(pose);
    }
  }
  return result;
}

}  // namespace stablecut::robot
