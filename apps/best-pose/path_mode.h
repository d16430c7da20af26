// --path: the stiffest motion along a tool path.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "base/progress.h"
#include "document/kinds/pose_path_json.h"
#include "document/kinds/tool_path_json.h"
#include "search_task.h"

namespace stablecut {

/// As the options give it.
struct PathOptions {
  std::string path, objective, axis, joint_speed, joints_csv, offsets_csv, place;
  std::optional<double> speed_mm_per_s, redundancy_rate_deg_per_mm;
  bool partial = false;

  bool given() const { return !path.empty(); }
  /// The first option that makes no sense without a path; empty where there is none.
  std::string without_path() const;
};

/// Declares --path and what belongs to it, --joints and --offsets (files) apart.
void add_path_options(CLI::App& app, PathOptions& options);

/// The path in the base frame, and its workpiece's. Throws DataError and WrongUsage.
document::ToolPathDocument read_path(const document::Input& input, const PathOptions& options,
                                     const SearchOptions& where);

/// The task of the path. `feed_frame`: the force is in the frame of the feed. Throws WrongUsage.
robot::PathTask path_task(robot::ToolPath path, const PathOptions& options, const SearchOptions& where,
                          const robot::Robot& robot, const robot::Elasticity& elasticity,
                          const robot::StiffnessTask& stiffness, bool feed_frame);

/// --place: moves the task's path to the best place of its workpiece, and its frame with it, and gives the
/// field `placement` of the document. Throws WrongUsage, and NoAnswer where no place lets it be driven.
document::Json place_path(const robot::Robot& robot, robot::PathTask& task, Eigen::Isometry3d& workpiece,
                          const std::string& place, int threads, const Progress& progress);

/// What the search of a path gives: the documents, and in words what it could not do, empty where all is
/// done.
struct PathResult {
  document::Json document;  ///< null where no part of the path is driven
  std::string joints_csv;
  std::string offsets_csv;  ///< with a cut
  std::string undone;
  std::string untold;  ///< points whose score is smaller than its own standard deviation; empty where none
};
PathResult solve_path(const robot::Robot& robot, const robot::PathTask& task,
                      const Eigen::Isometry3d& workpiece, const robot::ElasticityErrors& errors, int threads,
                      const Progress& progress);

}  // namespace stablecut
