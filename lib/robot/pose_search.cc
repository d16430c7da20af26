#include "robot/pose_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "base/error.h"
#include "base/parallel.h"
#include "base/units.h"
#include "robot/constrained_maximum.h"

namespace stablecut {
namespace {

constexpr double kLargestStep = 0.05;           // m, of the search's grid
constexpr double kLargestTurn = 5 * kPi / 180;  // rad
constexpr int kLeastSamples = 25;               // of an interval, however short
constexpr int kMostStartsPerArm = 30;
constexpr int kMostRestarts = 10;
constexpr int kBlocks = 4;             // along x and along y
constexpr double kStartsApart = 0.03;  // of the plane's extent
constexpr double kEqualScore = 1e-7;   // relative
constexpr double kSameAngle = 1e-4;    // rad: nearer poses are one

Range at_most_apart(const Range& range, double step) {
  if (range.is_point()) return {range.from, range.to, 1};
  const int count = 1 + static_cast<int>(std::ceil((range.to - range.from) / step - 1e-9));
  return {range.from, range.to, std::max({count, kLeastSamples, range.count})};
}

// The task's samples where they are fine enough, else finer ones.
PoseTask with_search_grid(const PoseTask& task) {
  PoseTask grid = task;
  grid.x = at_most_apart(task.x, kLargestStep);
  grid.y = at_most_apart(task.y, kLargestStep);
  grid.redundancy = at_most_apart(task.redundancy, kLargestTurn);
  return grid;
}

bool same_grid(const PoseTask& a, const PoseTask& b) {
  return a.x.count == b.x.count && a.y.count == b.y.count && a.redundancy.count == b.redundancy.count;
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

// Refinement over those of x, y and redundancy that are free and matter.
class Refinement {
 public:
  explicit Refinement(const PoseScanner& scanner) : scanner_(scanner), task_(scanner.task()) {}

  // The weakest principal stiffness has a ridge where two are equal, on which a smooth model fails. There a
  // power mean of the compliances stands for the largest of them, sharper and sharper, each from the best
  // point so far.
  std::optional<FoundPose> from(const PlanePoint& start, double radius) const {
    auto best = from(start, radius, 0);
    // On a narrow curved ridge a search may stop early; another from where it stopped goes on.
    for (int i = 0; best && i < kMostRestarts; ++i) {
      const auto again = from(best->at, radius, 0);
      if (!again || !(std::abs(again->score - best->score) > kEqualScore * best->score)) break;
      best = again;
    }
    if (!best || task_.stiffness.index != StiffnessIndex::kWeakest) return best;
    for (const double power : {30.0, 300.0, 3000.0}) {
      const auto smoothed = from(best->at, radius, power);
      if (smoothed && smoothed->score > best->score) best = smoothed;
      radius *= 0.3;
    }
    return best;
  }

 private:
  static constexpr double kDifference = 1e-4;  // m and rad

  struct Freedom {
    double PlanePoint::*coordinate;
    double lower, upper;
  };

  std::optional<FoundPose> from(const PlanePoint& start, double radius, double power) const {
    std::vector<Freedom> free;
    if (!task_.x.is_point()) free.push_back({&PlanePoint::x, task_.x.from, task_.x.to});
    if (!task_.y.is_point()) free.push_back({&PlanePoint::y, task_.y.from, task_.y.to});
    if (!task_.redundancy.is_point() && scanner_.redundancy_matters()) {
      const bool open = task_.full_turn();
      free.push_back(
          {&PlanePoint::redundancy, open ? -100 : task_.redundancy.from, open ? 100 : task_.redundancy.to});
    }
    const auto n = static_cast<Eigen::Index>(free.size());
    Variables first(n), lower(n), upper(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      first[i] = start.*free[i].coordinate;
      lower[i] = free[i].lower;
      upper[i] = free[i].upper;
    }
    const auto point = [&](const Variables& x) {
      PlanePoint at = start;
      for (Eigen::Index i = 0; i < n; ++i) at.*free[i].coordinate = x[i];
      return at;
    };
    const auto found = constrained_maximum([&](const Variables& x) { return value(point(x), power); }, first,
                                           lower, upper, radius, kDifference);
    if (!found) return std::nullopt;
    PlanePoint at = point(found->point);
    if (task_.full_turn()) at.redundancy = std::remainder(at.redundancy, kTwoPi);
    const auto evaluation = scanner_.evaluate(at);
    if (!evaluation) return std::nullopt;
    return FoundPose{at, evaluation->angles, evaluation->score};
  }

  std::optional<ConstrainedValue> value(const PlanePoint& at, double power) const {
    const auto evaluation = scanner_.evaluate(at);
    if (!evaluation || !(evaluation->score > 0)) return std::nullopt;
    ConstrainedValue result;
    double logarithm = std::log(evaluation->score);
    if (power > 0) {
      const Eigen::Vector3d compliances = principal_compliances(evaluation->compliance);
      logarithm -= std::log((compliances / compliances[0]).cwiseMax(0.0).array().pow(power).sum()) / power;
    }
    result.value = task_.stiffness.larger_is_better() ? logarithm : -logarithm;
    const bool away = task_.singularity_margin > 0;
    result.constraints.resize(kJoints + (away ? 1 : 0));
    for (int j = 0; j < kJoints; ++j) {
      const Joint& joint = scanner_.robot().joints[j];
      result.constraints[j] = joint.half_range_rad() - std::abs(evaluation->angles[j] - joint.middle_rad()) -
                              task_.limit_margin_rad;
    }
    if (away) {
      result.constraints[kJoints] =
          singularity_margin(robot_pose(scanner_.robot(), evaluation->angles)) - task_.singularity_margin;
    }
    return result;
  }

  const PoseScanner& scanner_;
  const PoseTask& task_;
};

// What may be turned without changing the score.
struct Symmetry {
  bool base_turn = false, tool_turn = false;
};

Symmetry symmetry_of(const PoseScanner& scanner) {
  constexpr double kParallel = 1e-12;
  const PoseTask& task = scanner.task();
  const Robot& robot = scanner.robot();
  const Eigen::Vector3d axis1(0, -robot.joints[0].sin_alpha(), robot.joints[0].cos_alpha());
  const auto along_axis1 = [&](const Eigen::Vector3d& v) {
    return v.cross(axis1).norm() <= kParallel * v.norm();
  };
  Symmetry symmetry;
  symmetry.tool_turn = !scanner.redundancy_matters() && !task.redundancy.is_point();
  const bool load_turns = task.stiffness.index != StiffnessIndex::kDeflection ||
                          task.stiffness.force_in_tool || along_axis1(*task.stiffness.force_n);
  symmetry.base_turn = load_turns && along_axis1(task.tool_axis) &&
                       along_axis1(task.plane.x_axis.cross(task.plane.y_axis)) && !task.x.is_point() &&
                       !task.y.is_point() && (!task.redundancy.is_point() || symmetry.tool_turn);
  return symmetry;
}

bool inside(const Range& range, double value) {
  return value >= range.from - 1e-12 && value <= range.to + 1e-12;
}

// The pose with one joint elsewhere, if the task's intervals and limits allow it.
std::optional<FoundPose> turned(const PoseScanner& scanner, const FoundPose& found, int joint, double angle) {
  const PoseTask& task = scanner.task();
  FoundPose pose = found;
  pose.angles[joint] = angle;
  if (limit_margin_rad(scanner.robot(), pose.angles) < task.limit_margin_rad - 1e-9) return std::nullopt;
  const Eigen::Isometry3d tool = robot_pose(scanner.robot(), pose.angles).tool;
  const Eigen::Vector3d offset = tool.translation() - task.plane.origin;
  const auto tidy = [](double value) { return std::abs(value) < 1e-12 ? 0 : value; };
  pose.at.x = tidy(offset.dot(task.plane.x_axis));
  pose.at.y = tidy(offset.dot(task.plane.y_axis));
  // The turn of the interval, of all copies by whole turns.
  const double turn = redundancy_angle(tool), middle = 0.5 * (task.redundancy.from + task.redundancy.to);
  pose.at.redundancy = task.full_turn() ? turn : turn + kTwoPi * std::nearbyint((middle - turn) / kTwoPi);
  const bool turn_allowed = task.full_turn() || inside(task.redundancy, pose.at.redundancy);
  if (!turn_allowed || !inside(task.x, pose.at.x) || !inside(task.y, pose.at.y)) return std::nullopt;
  return pose;
}

// As far as a joint can be turned either way with all intervals and limits held: in steps, then by bisection.
PoseFamily family_of(const PoseScanner& scanner, const FoundPose& found, PoseFamily::Kind kind, int joint) {
  constexpr double kStep = kPi / 720;
  PoseFamily family{kind, found.angles[joint], found.angles[joint]};
  const Joint& limits = scanner.robot().joints[static_cast<std::size_t>(joint)];
  for (const double sense : {-1.0, 1.0}) {
    const double margin = scanner.task().limit_margin_rad;
    const double end = sense < 0 ? limits.min_rad + margin : limits.max_rad - margin;
    double good = found.angles[joint], bad = end;
    bool open = true;
    for (double next = good + sense * kStep; open && sense * (end - next) > 0; next += sense * kStep) {
      open = turned(scanner, found, joint, next).has_value();
      (open ? good : bad) = next;
    }
    if (open && turned(scanner, found, joint, end)) good = bad = end;
    for (int i = 0; i < 50 && good != bad; ++i) {
      const double middle = 0.5 * (good + bad);
      (turned(scanner, found, joint, middle) ? good : bad) = middle;
    }
    (sense < 0 ? family.from_rad : family.to_rad) = good;
  }
  return family;
}

// The member of the families that a symmetry makes whose free joints stand nearest to 0, if the intervals
// allow it.
FoundPose centred(const PoseScanner& scanner, FoundPose found, const Symmetry& symmetry) {
  for (const int j : {0, 5}) {
    if (!(j == 0 ? symmetry.base_turn : symmetry.tool_turn)) continue;
    const Joint& joint = scanner.robot().joints[static_cast<std::size_t>(j)];
    const double margin = scanner.task().limit_margin_rad;
    const double central = std::clamp(0.0, joint.min_rad + margin, joint.max_rad - margin);
    if (const auto moved = turned(scanner, found, j, central)) found = *moved;
  }
  return found;
}

// The same pose, up to joints that a symmetry leaves free.
bool same_pose(const FoundPose& a, const FoundPose& b, const Symmetry& symmetry) {
  for (int j = 0; j < kJoints; ++j) {
    if ((j == 0 && symmetry.base_turn) || (j == 5 && symmetry.tool_turn)) continue;
    if (std::abs(std::remainder(a.angles[j] - b.angles[j], kTwoPi)) > kSameAngle) return false;
  }
  return true;
}

bool equal_scores(double a, double b) { return std::abs(a - b) <= kEqualScore * std::abs(b); }

// The same tool frame with the wrist the other way round, where the limits allow it.
std::optional<FoundPose> flipped(const PoseScanner& scanner, const FoundPose& found) {
  FoundPose other = found;
  other.at.branch = (found.at.branch + kArms) % kBranches;
  const auto evaluation = scanner.evaluate(other.at);
  if (!evaluation) return std::nullopt;
  other.angles = evaluation->angles;
  if (limit_margin_rad(scanner.robot(), other.angles) < scanner.task().limit_margin_rad) return std::nullopt;
  return other;
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
  if (!evaluation) {
    throw NoAnswer("no reachable pose: nothing of the plane is within the arm's reach with this tool axis");
  }
  int worst = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < kJoints; ++j) {
    const Joint& joint = robot.joints[j];
    const double left = joint.half_range_rad() - std::abs(evaluation->angles[j] - joint.middle_rad());
    if (left < least) {
      least = left;
      worst = j;
    }
  }
  const auto degrees = [](double rad) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", degrees_from_radians(rad));
    return std::string(text);
  };
  if (least < task.limit_margin_rad) {
    throw NoAnswer("no reachable pose: at best joint " + robot.joints[worst].name + " would be " +
                   (least < 0 ? degrees(-least) + " degrees outside its limits"
                              : degrees(least) + " degrees from a limit, nearer than the limit margin"));
  }
  throw NoAnswer(
      "no reachable pose: all that the limits allow is nearer to a singularity than the singularity margin");
}

}  // namespace

PlaneScan scan_plane(const Robot& robot, const PoseTask& task, int threads, const Progress& progress) {
  PlaneScan scan{task, {}};
  scan.points.resize(static_cast<std::size_t>(task.x.count) * task.y.count);
  const PoseScanner scanner(robot, task);
  parallel_for(
      static_cast<std::size_t>(task.y.count), threads,
      [&](std::size_t j) {
        for (int i = 0; i < task.x.count; ++i) {
          scan.points[j * task.x.count + i] = scanner.scan(task.x.at(i), task.y.at(static_cast<int>(j)));
        }
      },
      progress);
  return scan;
}

PoseSearch search_poses(const Robot& robot, const PoseTask& task, int most_alternatives, int threads,
                        const Progress& progress, const PlaneScan* known) {
  const PoseTask grid = with_search_grid(task);
  PlaneScan own;
  if (!known || !same_grid(known->task, grid)) {
    own = scan_plane(robot, grid, threads, progress);
    known = &own;
  }
  std::vector<ScanBest> starts = starts_of(*known);
  if (starts.empty()) starts = starts_outside(*known);

  const PoseScanner scanner(robot, task);
  const Refinement refinement(scanner);
  const double radius =
      std::max({known->task.x.step(), known->task.y.step(), known->task.redundancy.step(), 1e-3});
  std::vector<std::optional<FoundPose>> refined(starts.size());
  parallel_for(starts.size(), threads,
               [&](std::size_t i) { refined[i] = refinement.from(starts[i].at, radius); });

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
  const bool larger = task.stiffness.larger_is_better();
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

PoseMap pose_map(const Robot& robot, const PlaneScan& scan) {
  const PoseScanner scanner(robot, scan.task);
  const Eigen::Index rows = scan.task.y.count, columns = scan.task.x.count;
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  PoseMap map{Eigen::MatrixXd::Constant(rows, columns, kNowhere),
              Eigen::MatrixXd::Constant(rows, columns, kNowhere),
              Eigen::MatrixXi::Constant(rows, columns, -1),
              {}};
  map.stiffness.fill(map.score);
  for (Eigen::Index j = 0; j < rows; ++j) {
    for (Eigen::Index i = 0; i < columns; ++i) {
      const auto best = scan.at(static_cast<int>(i), static_cast<int>(j)).best();
      if (!best) continue;
      const auto evaluation = scanner.evaluate(best->at);
      map.score(j, i) = evaluation->score;
      map.redundancy_rad(j, i) = best->at.redundancy;
      map.branch(j, i) = best->at.branch;
      for (int d = 0; d < 3; ++d) {
        map.stiffness[static_cast<std::size_t>(d)](j, i) =
            directional_stiffness(evaluation->compliance, evaluation->tool.linear().col(d));
      }
    }
  }
  return map;
}

}  // namespace stablecut
