#include "robot/pose_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "base/parallel.h"
#include "base/units.h"
#include "robot/pose_refinement.h"
#include "robot/pose_starts.h"

namespace stablecut::robot {
namespace {

constexpr double kLargestStep = 0.05;           // m, of the search's grid
constexpr double kLargestTurn = 5 * kPi / 180;  // rad
constexpr int kLeastSamples = 25;               // of an interval, however short
constexpr double kStepRounding = 1e-9;          // of a step: an interval that is whole steps up to rounding
constexpr double kLeastRadius = 1e-3;           // m and rad, of the refinement's first steps
constexpr double kSameTurn = 1e-6;              // rad: margins and turns that differ by less are equal

// The range in steps of at most `step`, and not coarser than it was.
Range refined_range(const Range& range, double step) {
  if (range.is_point()) return {range.from, range.to, 1};
  const int count = 1 + static_cast<int>(std::ceil((range.to - range.from) / step - kStepRounding));
  return {range.from, range.to, std::max({count, kLeastSamples, range.count})};
}

Range reachable_part(const Range& range, const Range& reach) {
  const Range part{std::max(range.from, reach.from), std::min(range.to, reach.to), range.count};
  if (!(part.from <= part.to)) throw NoPose({Obstacle::Kind::kOutOfReach});
  return part;
}

// The task on the search's own grid, over the part of the plane that the arm may reach.
PoseTask with_search_grid(const Robot& robot, const PoseTask& task) {
  const auto reach = plane_reach(robot, task.plane, task.tool_axis);
  PoseTask grid = task;
  grid.x = refined_range(reachable_part(task.x, reach.x), kLargestStep);
  grid.y = refined_range(reachable_part(task.y, reach.y), kLargestStep);
  grid.redundancy = refined_range(task.redundancy, kLargestTurn);
  return grid;
}

bool same_grid(const PoseTask& a, const PoseTask& b) {
  const auto same = [](const Range& r, const Range& s) {
    return r.from == s.from && r.to == s.to && r.count == s.count;
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.redundancy, b.redundancy);
}

// What stands in the way where no pose of a scanned plane is allowed.
Obstacle obstacle_of(const PoseScanner& scanner, const PlaneScan& scan) {
  double margin = -std::numeric_limits<double>::infinity();
  PlanePoint at;
  for (const PointScan& point : scan.points) {
    if (point.best_limit_margin_rad <= margin) continue;
    margin = point.best_limit_margin_rad;
    at = point.most_central;
  }
  const auto evaluation = std::isfinite(margin) ? scanner.evaluate(at) : std::nullopt;
  if (!evaluation) return {Obstacle::Kind::kOutOfReach};
  Obstacle obstacle{Obstacle::Kind::kJointLimit, 0, std::numeric_limits<double>::infinity()};
  for (int j = 0; j < kJoints; ++j) {
    const double left = scanner.robot().range(j, evaluation->angles).margin_rad(evaluation->angles[j]);
    if (left < obstacle.margin_rad) obstacle = {Obstacle::Kind::kJointLimit, j, left};
  }
  if (obstacle.margin_rad < scanner.task().limit_margin_rad) return obstacle;
  const RobotPose pose = robot_pose(scanner.robot(), evaluation->angles);
  const bool away = is_away_from_singularities(pose, scanner.task().singularity_margin);
  return {away ? Obstacle::Kind::kKeepOut : Obstacle::Kind::kSingularity};
}

// Of a pose's symmetric equals the one that is turned least: of a wrist and its flip the one whose joint 4 is
// nearer to 0, then the member of the families whose free joints are.
FoundPose least_turned_equal(const PoseScanner& scanner, const FoundPose& pose, const Symmetry& symmetry) {
  FoundPose chosen = pose;
  if (const auto flip = flipped_wrist(scanner, pose)) {
    if (std::abs(flip->angles[3]) < std::abs(pose.angles[3]) - kSameTurn) chosen = *flip;
  }
  if (symmetry.base_turn || symmetry.tool_turn) chosen = central_member(scanner, chosen, symmetry);
  return chosen;
}

// The local optima of a scanned plane, best first.
std::vector<FoundPose> local_optima(const PoseScanner& scanner, const PlaneScan& scan,
                                    const Symmetry& symmetry, int threads) {
  std::vector<PlanePoint> starts = starts_at_optima(scan);
  if (starts.empty()) starts = starts_nearest_to_limits(scan);
  const double radius =
      std::max({scan.task.x.step(), scan.task.y.step(), scan.task.redundancy.step(), kLeastRadius});
  std::vector<std::optional<FoundPose>> refined(starts.size());
  parallel_for(starts.size(), threads,
               [&](std::size_t i) { refined[i] = refined_pose(scanner, starts[i], radius); });
  std::vector<FoundPose> found;
  for (const auto& pose : refined) {
    if (pose) found.push_back(least_turned_equal(scanner, *pose, symmetry));
  }
  const bool larger = scanner.task().stiffness.index->larger_is_better;
  std::stable_sort(found.begin(), found.end(), [&](const FoundPose& a, const FoundPose& b) {
    return larger ? a.score > b.score : a.score < b.score;
  });
  return found;
}

// Of poses of equal score: the one with the largest margin to the limits, then the one that is turned least,
// then the one at the larger y, so that rounding does not choose.
bool preferred(const Robot& robot, const FoundPose& a, const FoundPose& b) {
  const double margin = limit_margin_rad(robot, a.angles) - limit_margin_rad(robot, b.angles);
  if (std::abs(margin) > kSameTurn) return margin > 0;
  const double turn = a.angles.norm() - b.angles.norm();
  return std::abs(turn) > kSameTurn ? turn < 0 : a.at.y > b.at.y;
}

// Puts the preferred of the poses that are as good as the first in front.
void lead_with_preferred(std::vector<FoundPose>& found, const Robot& robot) {
  auto best = found.begin();
  for (auto other = found.begin(); other != found.end() && equal_scores(other->score, found.front().score);
       ++other) {
    if (preferred(robot, *other, *best)) best = other;
  }
  std::rotate(found.begin(), best, best + 1);
}

void add_symmetric_families(const PoseScanner& scanner, const Symmetry& symmetry, PoseSearch& search) {
  for (const auto& [applies, kind, joint] :
       {std::tuple{symmetry.base_turn, PoseFamily::Kind::kBaseTurn, 0},
        std::tuple{symmetry.tool_turn, PoseFamily::Kind::kToolTurn, 5}}) {
    if (!applies) continue;
    const PoseFamily family = family_of(scanner, search.best, kind, joint);
    if (family.to_rad - family.from_rad > kSameTurn) search.families.push_back(family);
  }
}

// Sorts the other optima into equals of the best and alternatives, without repeating a pose.
void list_others(const PoseScanner& scanner, const std::vector<FoundPose>& found, const Symmetry& symmetry,
                 int most_alternatives, PoseSearch& search) {
  std::vector<FoundPose> listed{search.best};
  if (const auto flip = flipped_wrist(scanner, search.best)) {
    search.families.push_back({PoseFamily::Kind::kFlippedWrist, 0, 0, flip->angles});
    listed.push_back(*flip);
  }
  for (const FoundPose& pose : found) {
    const bool known = std::any_of(listed.begin(), listed.end(),
                                   [&](const FoundPose& other) { return same_pose(pose, other, symmetry); });
    if (known) continue;
    listed.push_back(pose);
    if (equal_scores(pose.score, search.best.score)) {
      search.families.push_back({PoseFamily::Kind::kEqual, 0, 0, pose.angles});
      continue;
    }
    // An alternative that differs by a turn of the tool alone and scores the same is the same again.
    const bool repeats =
        std::any_of(search.alternatives.begin(), search.alternatives.end(), [&](const FoundPose& other) {
          return equal_scores(pose.score, other.score) && same_pose(pose, other, {symmetry.base_turn, true});
        });
    if (!repeats && static_cast<int>(search.alternatives.size()) < most_alternatives) {
      search.alternatives.push_back(pose);
    }
  }
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
  const PoseScanner scanner(robot, task);
  const Symmetry symmetry = symmetry_of(scanner);
  std::vector<FoundPose> found = local_optima(scanner, *known, symmetry, threads);
  if (found.empty()) throw NoPose(obstacle_of(scanner, *known));
  lead_with_preferred(found, robot);
  PoseSearch search;
  search.best = found.front();
  search.redundancy_matters = scanner.redundancy_matters();
  add_symmetric_families(scanner, symmetry, search);
  list_others(scanner, found, symmetry, most_alternatives, search);
  return search;
}

}  // namespace stablecut::robot
