// Kinds `pose` and `pose-map`: what a pose search or an evaluation found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "document/text/node.h"
#include "robot/pose_report.h"
#include "robot/pose_search.h"
#include "robot/pose_standing.h"

namespace stablecut::document {

/// The plane as the user gave it.
struct PlaneDocument {
  std::optional<double> height_mm;
  robot::Plane plane;  ///< where no height was given
};

struct PoseDocument {
  robot::StiffnessTask task;
  robot::ElasticityErrors errors;
  // A search.
  PlaneDocument plane;
  robot::PoseTask pose_task;
  robot::PoseSearch search;
  std::vector<robot::PoseReport> reports;  ///< best, then the alternatives
  robot::RedundancySweep sweep;            ///< at the best point
  std::vector<robot::PartMove> moves;      ///< of the best pose
  // An evaluation.
  std::vector<robot::PoseReport> evaluated;
  std::vector<std::string> names;  ///< of the evaluated poses; empty where one has none
};

/// What tool and links keep out of, as a search took it.
Json keep_out_to_json(const robot::Robot& robot);

/// One pose, as in every document of poses.
Json pose_report_to_json(const robot::PoseReport& report, const robot::StiffnessTask& task);

/// The documents without provenance.
Json pose_to_json(const PoseDocument& document, const robot::Robot& robot);
Json evaluation_to_json(const PoseDocument& document);
/// The compliance of a pose document's best pose, or of the only one that was evaluated, in the tool's frame,
/// m/N.
Eigen::Matrix3d tool_compliance(const Json& document, const Source& source);

Json pose_map_to_json(const robot::PoseMap& map, const robot::PoseTask& task, const PlaneDocument& plane);

}  // namespace stablecut::document
