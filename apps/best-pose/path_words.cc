#include "path_words.h"

#include <algorithm>

#include "base/number_text.h"
#include "base/units.h"

namespace stablecut {
namespace {

constexpr std::size_t kMostNamed = 8;

std::string degrees(double rad) { return number_text(degrees_from_radians(rad), 3) + " degrees"; }

std::string fault_text(const robot::PoseFault& fault, const robot::Robot& robot,
                       const robot::PathTask& task) {
  switch (fault.kind) {
    case robot::PoseFault::Kind::kReach:
      return "out of reach";
    case robot::PoseFault::Kind::kRedundancy:
      return "not in the interval of the redundancy";
    case robot::PoseFault::Kind::kLimit: {
      const double outside = fault.missing - task.limit_margin_rad;
      return "limit of joint " + robot.joints[fault.joint].name + ": " +
             (outside > 0 ? degrees(outside) + " outside" : "only " + degrees(-outside) + " from it");
    }
    case robot::PoseFault::Kind::kSingularity:
      return "nearer to a singularity than the singularity margin, " +
             number_text(task.singularity_margin - fault.missing, 3);
    case robot::PoseFault::Kind::kKeepOut:
      return "tool or links in what they keep out of by " + number_text(mm_from_metres(fault.missing), 3) +
             " mm";
    case robot::PoseFault::Kind::kNone:
      break;
  }
  return "no motion that goes on";
}

std::string obstacle_text(const robot::PathObstacle& obstacle, const robot::Robot& robot,
                          const robot::PathTask& task) {
  std::string text = obstacle.first == obstacle.last ? "point " + std::to_string(obstacle.first)
                                                     : "points " + std::to_string(obstacle.first) + " to " +
                                                           std::to_string(obstacle.last);
  if (obstacle.speed) {
    const int joint = obstacle.fault.joint;
    return text + ": joint speed between points: " + robot.joints[joint].name + " would need " +
           number_text(obstacle.fault.missing * degrees_from_radians(task.max_speed[joint]), 3) + " of " +
           number_text(degrees_from_radians(task.max_speed[joint]), 3) + " deg/s";
  }
  text += obstacle.between ? ": no motion from one to the next: " : ": ";
  return text + fault_text(obstacle.fault, robot, task);
}

}  // namespace

std::string no_place_text(const robot::PlaceSearch& search) {
  const auto no_pose = std::count_if(
      search.map.begin(), search.map.end(),
      [](const robot::PlacedPath& place) { return place.outcome == robot::PlacedPath::Outcome::kNoPose; });
  return "--place: the path is driven at none of " + std::to_string(search.map.size()) + " places: at " +
         std::to_string(no_pose) +
         " some point has no pose that is allowed, at the others no motion leads through";
}

std::string obstacles_text(const std::vector<robot::PathObstacle>& obstacles, const robot::Robot& robot,
                           const robot::PathTask& task) {
  std::string text;
  for (std::size_t i = 0; i < std::min(obstacles.size(), kMostNamed); ++i)
    text += (i > 0 ? "; " : "") + obstacle_text(obstacles[i], robot, task);
  if (obstacles.size() > kMostNamed)
    text += "; and " + std::to_string(obstacles.size() - kMostNamed) + " more stretches";
  return text;
}

}  // namespace stablecut
