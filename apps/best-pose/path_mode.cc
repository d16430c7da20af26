#include "path_mode.h"

#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/tool.h"
#include "document/measured/tool_path_text.h"
#include "path_words.h"
#include "pose_values.h"
#include "robot/path_offset.h"
#include "words.h"

namespace stablecut {
namespace {

constexpr double kMostPlacedPoints = 1e7;  // some hours where every place has to be searched

Eigen::Isometry3d frame_of(const robot::Plane& plane) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << plane.x_axis, plane.y_axis, plane.x_axis.cross(plane.y_axis);
  frame.translation() = plane.origin;
  return frame;
}

}  // namespace

std::string PathOptions::without_path() const {
  if (!objective.empty()) return "--objective";
  if (!axis.empty()) return "--path-axis";
  if (!joint_speed.empty()) return "--joint-speed";
  if (!joints_csv.empty()) return "--joints";
  if (!offsets_csv.empty()) return "--offsets";
  if (speed_mm_per_s) return "--path-speed";
  if (redundancy_rate_deg_per_mm) return "--redundancy-rate";
  if (!place.empty()) return "--place";
  return partial ? "--partial" : "";
}

void add_path_options(CLI::App& app, PathOptions& options) {
  const auto positive = [](double value) { return value > 0; };
  const auto not_negative = [](double value) { return value >= 0; };
  cli::add_number_option(app, "--path-speed", options.speed_mm_per_s,
                         "Speed along the path where it says none, mm/s", "a number above 0", positive);
  cli::add_choice_option(
      app, "--path-axis", options.axis, "to-holder|to-tip",
      "Where I, J, K of a path's text point (default: to-holder, as post-processors write)");
  cli::add_choice_option(app, "--objective", options.objective, "worst|mean",
                         "Make the worst point of the path as stiff as can be, or the mean (default: worst)");
  app.add_option(
         "--joint-speed", options.joint_speed,
         "Largest speed of the joints, deg/s: one number, or six separated by commas (default: the robot "
         "document's, else 60)")
      ->type_name("DEG/S");
  cli::add_number_option(app, "--redundancy-rate", options.redundancy_rate_deg_per_mm,
                         "Most turning of the tool about its axis, deg per mm of path",
                         "a number not below 0", not_negative);
  app.add_option(
         "--place", options.place,
         "Also search where to put the workpiece: how far along x and y, mm, and its turn about z, deg, or "
         "along x, y and z and its turn")
      ->type_name("FROM:TO:COUNT,...");
  app.add_flag("--partial", options.partial,
               "Write what can be driven of a path that cannot be driven as a whole");
}

document::ToolPathDocument read_path(const document::Input& input, const PathOptions& options,
                                     const SearchOptions& where) {
  document::ToolPathDefaults defaults;
  if (where.has_plane()) defaults.frame = frame_of(search_plane(where).plane);
  if (options.speed_mm_per_s) defaults.speed = *options.speed_mm_per_s * 1e-3;
  defaults.axis_to_tip = options.axis == "to-tip";
  if (input.document.is_null()) return document::tool_path_from_text(input.source, defaults);
  return document::tool_path_from_json(input.document, input.source, defaults);
}

robot::PathTask path_task(robot::ToolPath path, const PathOptions& options, const SearchOptions& where,
                          const robot::Robot& robot, const robot::Elasticity& elasticity,
                          const robot::StiffnessTask& stiffness, bool feed_frame) {
  robot::PathTask task;
  task.path = std::move(path);
  task.stiffness = stiffness;
  task.force_in_feed = feed_frame;
  task.elasticity = elasticity;
  task.mean_objective = options.objective == "mean";
  task.limit_margin_rad = limit_margin(where);
  task.singularity_margin = singularity_margin(where, true);
  task.max_speed = joint_speeds(options.joint_speed, robot);
  if (options.redundancy_rate_deg_per_mm)
    task.most_turn_per_metre = radians_from_degrees(*options.redundancy_rate_deg_per_mm) * 1e3;
  if (const auto& turn = where.redundancy_deg) {
    cli::refuse_if(turn->to - turn->from > 360, "--redundancy: expected at most a full turn");
    cli::refuse_beyond(kMostTurns, "--redundancy", turn->count, "angles");
    task.redundancy = Range{radians_from_degrees(turn->from), radians_from_degrees(turn->to), turn->count};
  }
  return task;
}

document::Json place_path(const robot::Robot& robot, robot::PathTask& task, Eigen::Isometry3d& workpiece,
                          const std::string& place, int threads, const Progress& progress) {
  const robot::PlaceGrid grid = place_grid(place);
  cli::refuse_beyond(kMostPlacedPoints, "--path, --place",
                     static_cast<double>(grid.size()) * static_cast<double>(task.path.size()),
                     "points of the path times places (fewer places, or a path with every tenth point)");
  const robot::PlaceSearch search = robot::search_places(robot, task, grid, workpiece, threads, progress);
  if (!search.best) throw NoAnswer(no_place_text(search));
  const robot::Placement& best = search.map[*search.best].at;
  task.path = robot::placed(task.path, best, workpiece);
  workpiece = best.frame(workpiece);
  return document::placement_to_json(search, *task.stiffness.index, workpiece);
}

PathResult solve_path(const robot::Robot& robot, const robot::PathTask& task,
                      const Eigen::Isometry3d& workpiece, const robot::ElasticityErrors& errors, int threads,
                      const Progress& progress) {
  const robot::PathModel model(robot, task);
  const robot::PathSearch search = robot::search_path(model, threads, progress);
  PathResult result;
  result.undone = obstacles_text(search.obstacles, robot, task);
  if (search.parts.empty()) return result;
  document::PosePathDocument document{task, search, {}, 0, {}, {}};
  std::vector<std::pair<std::size_t, const robot::PathPose*>> poses;
  double worst = 0;
  for (std::size_t p = 0; p < search.parts.size(); ++p) {
    const robot::PathPart& part = search.parts[p];
    for (std::size_t i = 0; i < part.poses.size(); ++i) {
      poses.emplace_back(part.first + i, &part.poses[i]);
      if (!(part.poses[i].cost > worst)) continue;
      worst = part.poses[i].cost;
      document.worst_part = p;
    }
  }
  document.worst = robot::worst_point(model, search.parts[document.worst_part]);
  document.reports.resize(poses.size());
  if (task.stiffness.cut) document.offsets.resize(poses.size());
  const robot::InverseKinematics inverse(robot);
  parallel_for(poses.size(), threads, [&](std::size_t i) {
    const auto& [point, pose] = poses[i];
    const robot::StiffnessTask at = point_task(task, model.frames(), point);
    document.reports[i] = robot::report_pose(robot, pose->angles, at, task.elasticity, errors);
    if (at.cut) {
      document.offsets[i] =
          robot::cancelling_offset(robot, inverse, document.reports[i], at, task.elasticity);
    }
  });
  std::size_t untold = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string text = untold_score_text(document.reports[i], *task.stiffness.index);
    if (!text.empty() && ++untold == 1) result.untold = std::to_string(poses[i].first) + ": " + text;
  }
  if (untold > 0) result.untold = std::to_string(untold) + " points, the first " + result.untold;
  result.document = document::pose_path_to_json(document, robot);
  result.joints_csv = document::joint_angles_csv(search, robot);
  if (task.stiffness.cut) result.offsets_csv = document::offsets_csv(document, workpiece);
  return result;
}

}  // namespace stablecut
