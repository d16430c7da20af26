#include "search_task.h"

#include <cmath>
#include <string>

#include "base/units.h"
#include "cli/exit_status.h"
#include "cut_options.h"

namespace stablecut {
namespace {

constexpr double kDefaultStepMm = 50;
constexpr double kDefaultLimitMarginDeg = 2;
// 6 m/min need at most 0.1 m/s / 0.1 = 1 rad/s of any joint there.
constexpr double kDefaultSingularityMargin = 0.1;
constexpr double kPathSingularityMargin = 0.01;
constexpr Range kDefaultRedundancyDeg{-180, 175, 72};
constexpr double kSquare = 1e-6;  // cosine of the angle between plane axes at right angles
constexpr int kMostPoints = 4'000'000;

Eigen::Vector3d direction(const SearchOptions::Vector& value, const Eigen::Vector3d& otherwise,
                          const std::string& option) {
  if (!value) return otherwise;
  const Eigen::Vector3d v(value->data());
  cli::refuse_if(v.isZero(0), option + ": 0,0,0: expected a direction");
  return v.stableNormalized();
}

// The given interval, or all that the robot reaches in whole default steps; m.
Range interval(const std::optional<Range>& given_mm, const Range& reach) {
  if (given_mm) return {metres_from_mm(given_mm->from), metres_from_mm(given_mm->to), given_mm->count};
  const double from = std::floor(mm_from_metres(reach.from) / kDefaultStepMm) * kDefaultStepMm;
  const double to = std::ceil(mm_from_metres(reach.to) / kDefaultStepMm) * kDefaultStepMm;
  return {metres_from_mm(from), metres_from_mm(to),
          1 + static_cast<int>(std::lround((to - from) / kDefaultStepMm))};
}

}  // namespace

document::PlaneDocument search_plane(const SearchOptions& options) {
  document::PlaneDocument document;
  document.height_mm = options.height_mm;
  if (options.height_mm) {
    cli::refuse_if(options.plane_origin_mm || options.plane_x || options.plane_y,
                   "--height: expected either a height or --plane-origin");
    document.plane.origin = {0, 0, metres_from_mm(*options.height_mm)};
    return document;
  }
  robot::Plane& plane = document.plane;
  if (options.plane_origin_mm) plane.origin = Eigen::Vector3d(options.plane_origin_mm->data()) * 1e-3;
  plane.x_axis = direction(options.plane_x, Eigen::Vector3d::UnitX(), "--plane-x");
  plane.y_axis = direction(options.plane_y, Eigen::Vector3d::UnitY(), "--plane-y");
  cli::refuse_if(std::abs(plane.x_axis.dot(plane.y_axis)) > kSquare,
                 "--plane-y: expected a direction square to --plane-x");
  plane.y_axis -= plane.x_axis.dot(plane.y_axis) * plane.x_axis;
  plane.y_axis.normalize();
  return document;
}

double limit_margin(const SearchOptions& options) {
  return radians_from_degrees(options.limit_margin_deg.value_or(kDefaultLimitMarginDeg));
}

double singularity_margin(const SearchOptions& options, bool along_path) {
  return options.singularity_margin.value_or(along_path ? kPathSingularityMargin : kDefaultSingularityMargin);
}

bool height_may_be_metres(const SearchOptions& options, const robot::Robot& robot) {
  if (!options.height_mm || *options.height_mm == 0) return false;
  robot::Plane plane;
  plane.origin.z() = *options.height_mm;
  try {
    robot::plane_reach(robot, plane, direction(options.tool_axis, -Eigen::Vector3d::UnitZ(), "--tool-axis"));
  } catch (const robot::NoPose&) {
    return false;
  }
  return true;
}

void add_margin_options(CLI::App& app, SearchOptions& options) {
  const auto not_negative = [](double value) { return value >= 0; };
  cli::add_number_option(app, "--limit-margin", options.limit_margin_deg,
                         "Least distance to keep from every joint limit, deg (default: 2)",
                         "a number not below 0", not_negative);
  cli::add_number_option(
      app, "--singularity-margin", options.singularity_margin,
      "Least singular value of the Jacobian to keep, lengths in m (default: 0.1; with --path 0.01)",
      "a number not below 0", not_negative);
}

robot::PoseTask search_task(const SearchOptions& options, const robot::Plane& plane,
                            const robot::Robot& robot, const robot::Elasticity& elasticity,
                            const robot::StiffnessTask& stiffness) {
  robot::PoseTask task;
  task.plane = plane;
  task.tool_axis = direction(options.tool_axis, task.tool_axis, "--tool-axis");
  task.stiffness = stiffness;
  task.elasticity = elasticity;
  check_feed(stiffness, task.tool_axis, "");
  task.limit_margin_rad = limit_margin(options);
  task.singularity_margin = singularity_margin(options, false);
  const auto reach = robot::plane_reach(robot, task.plane, task.tool_axis);
  task.x = interval(options.x_mm, reach.x);
  task.y = interval(options.y_mm, reach.y);
  cli::refuse_if(static_cast<double>(task.x.count) * task.y.count > kMostPoints,
                 "--x, --y: expected at most " + std::to_string(kMostPoints) + " points");
  const Range turn = options.redundancy_deg.value_or(kDefaultRedundancyDeg);
  cli::refuse_if(turn.to - turn.from > 360, "--redundancy: expected at most a full turn");
  cli::refuse_if(turn.count > kMostTurns,
                 "--redundancy: expected at most " + std::to_string(kMostTurns) + " angles");
  task.redundancy = {radians_from_degrees(turn.from), radians_from_degrees(turn.to), turn.count};
  return task;
}

}  // namespace stablecut
