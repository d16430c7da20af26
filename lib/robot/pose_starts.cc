#include "robot/pose_starts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stablecut::robot {
namespace {

constexpr int kMostStartsPerArm = 30;
constexpr int kBlocks = 4;             // along x and along y
constexpr double kStartsApart = 0.03;  // of the plane's extent

// The best point of each of the blocks into which the grid is cut: basins whose optimum falls between the
// samples of the redundancy.
std::vector<ScanBest> best_of_blocks(const PlaneScan& scan, std::size_t arm) {
  const int columns = scan.task.x.count, rows = scan.task.y.count;
  std::vector<std::optional<ScanBest>> best(kBlocks * kBlocks);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto& here = scan.at(i, j).arms[arm];
      auto& block = best[static_cast<std::size_t>(kBlocks * j / rows * kBlocks + kBlocks * i / columns)];
      if (here && (!block || here->merit > block->merit)) block = here;
    }
  }
  std::vector<ScanBest> result;
  for (const auto& block : best) {
    if (block) result.push_back(*block);
  }
  return result;
}

// True where no neighbour of the point is better.
bool is_local_optimum(const PlaneScan& scan, std::size_t arm, int i, int j) {
  const ScanBest& here = *scan.at(i, j).arms[arm];
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      if (i + di < 0 || j + dj < 0 || i + di >= scan.task.x.count || j + dj >= scan.task.y.count) continue;
      const auto& neighbour = scan.at(i + di, j + dj).arms[arm];
      if (neighbour && !(neighbour->merit <= here.merit)) return false;
    }
  }
  return true;
}

void sort_best_first(std::vector<ScanBest>& points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const ScanBest& a, const ScanBest& b) { return a.merit > b.merit; });
}

}  // namespace

std::vector<PlanePoint> starts_at_optima(const PlaneScan& scan) {
  const double apart =
      kStartsApart * std::max(scan.task.x.to - scan.task.x.from, scan.task.y.to - scan.task.y.from);
  std::vector<PlanePoint> starts;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    std::vector<ScanBest> optima;
    for (int j = 0; j < scan.task.y.count; ++j) {
      for (int i = 0; i < scan.task.x.count; ++i) {
        const auto& here = scan.at(i, j).arms[arm];
        if (here && is_local_optimum(scan, arm, i, j)) optima.push_back(*here);
      }
    }
    sort_best_first(optima);
    std::vector<ScanBest> chosen = best_of_blocks(scan, arm);
    const std::size_t most = chosen.size() + kMostStartsPerArm;
    for (const ScanBest& optimum : optima) {
      const bool close = std::any_of(chosen.begin(), chosen.end(), [&](const ScanBest& other) {
        return std::hypot(optimum.at.x - other.at.x, optimum.at.y - other.at.y) < apart;
      });
      if (!close) chosen.push_back(optimum);
      if (chosen.size() == most) break;
    }
    for (const ScanBest& start : chosen) starts.push_back(start.at);
  }
  return starts;
}

std::vector<PlanePoint> starts_nearest_to_limits(const PlaneScan& scan) {
  std::vector<ScanBest> nearest;
  for (const PointScan& point : scan.points) {
    if (std::isfinite(point.best_limit_margin_rad)) {
      nearest.push_back({point.best_limit_margin_rad, point.most_central});
    }
  }
  sort_best_first(nearest);
  std::vector<PlanePoint> starts;
  for (const ScanBest& point : nearest) {
    if (starts.size() == kMostStartsPerArm) break;
    starts.push_back(point.at);
  }
  return starts;
}

}  // namespace stablecut::robot
