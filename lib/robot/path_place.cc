#include "robot/path_place.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/units.h"
#include "robot/path_search.h"

namespace stablecut::robot {
namespace {

constexpr std::size_t kMostBoundPoints = 200;  // of a path whose worst point counts
constexpr double kBoundsShare = 0.3;           // of the progress

PathTask placed_task(const PathTask& task, const Placement& placement, const Eigen::Isometry3d& workpiece) {
  PathTask there = task;
  there.path = placed(task.path, placement, workpiece);
  return there;
}

// Some points bound the largest cost, but all are needed for the mean.
double bound_of(const Robot& robot, const PathTask& task) {
  const PathModel model(robot, task);
  const Ladder ladder = model.whole_ladder(kLadderStep);
  const std::size_t count = task.mean_objective ? model.size() : std::min(model.size(), kMostBoundPoints);
  PointRungs rungs;
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t point = count > 1 ? i * (model.size() - 1) / (count - 1) : 0;
    model.fill(ladder, point, kAllBranches, rungs);
    const double least = least_cost(rungs);
    if (std::isinf(least)) return kUnreached;
    largest = std::max(largest, least);
    sum += least;
  }
  return task.mean_objective ? sum / static_cast<double>(count) : largest;
}

}  // namespace

Eigen::Isometry3d Placement::frame(const Eigen::Isometry3d& workpiece) const {
  Eigen::Isometry3d moved = workpiece;
  moved.linear() = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix() * workpiece.linear();
  moved.translation() += shift;
  return moved;
}

ToolPath placed(const ToolPath& path, const Placement& placement, const Eigen::Isometry3d& workpiece) {
  return moved(path, placement.frame(workpiece) * workpiece.inverse());
}

std::size_t PlaceGrid::size() const {
  std::size_t size = 1;
  for (const Range* range : {&x, &y, &z, &turn}) size *= static_cast<std::size_t>(range->count);
  return size;
}

Placement PlaceGrid::at(std::size_t i) const {
  const auto next = [&](const Range& range) {
    const auto count = static_cast<std::size_t>(range.count);
    const double value = range.at(static_cast<int>(i % count));
    i /= count;
    return value;
  };
  Placement placement;
  placement.turn = next(turn);
  placement.shift.x() = next(x);
  placement.shift.y() = next(y);
  placement.shift.z() = next(z);
  return placement;
}

PlaceSearch search_places(const Robot& robot, const PathTask& task, const PlaceGrid& grid,
                          const Eigen::Isometry3d& workpiece, int threads, const Progress& progress) {
  PlaceSearch search;
  search.map.resize(grid.size());
  const auto share_of = [&](double from, double length) {
    Progress part;
    if (progress) part = [&progress, from, length](double at) { progress(from + length * at); };
    return part;
  };
  parallel_for(
      grid.size(), threads,
      [&](std::size_t i) {
        search.map[i].at = grid.at(i);
        search.map[i].bound = bound_of(robot, placed_task(task, search.map[i].at, workpiece));
      },
      share_of(0, kBoundsShare));
  // The most promising places first: the first that is searched is near the best, and spares most others.
  std::vector<std::size_t> order(grid.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return search.map[a].bound < search.map[b].bound; });
  double best = kUnreached;
  for (std::size_t n = 0; n < order.size(); ++n) {
    PlacedPath& place = search.map[order[n]];
    if (std::isinf(place.bound)) {
      place.outcome = PlacedPath::Outcome::kNoPose;
      continue;
    }
    if (place.bound * (1 - kBoundSlack) > best) continue;
    const PathTask here = placed_task(task, place.at, workpiece);
    const PathModel model(robot, here);
    const auto motion = search_motion(model, threads);
    if (progress)
      progress(kBoundsShare +
               (1 - kBoundsShare) * static_cast<double>(n) / static_cast<double>(order.size()));
    place.outcome = motion ? PlacedPath::Outcome::kDriven : PlacedPath::Outcome::kNoMotion;
    if (!motion) continue;
    place.objective = motion->objective;
    if (place.objective < best || (place.objective == best && order[n] < *search.best)) {
      best = place.objective;
      search.best = order[n];
    }
  }
  return search;
}

}  // namespace stablecut::robot
