// Kind `pose-path`: the joint angles along a tool path.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "robot/path_place.h"
#include "robot/path_search.h"
#include "robot/pose_report.h"

namespace stablecut::document {

struct PosePathDocument {
  const robot::PathTask& task;
  const robot::PathSearch& search;
  std::vector<robot::PoseReport> reports;  ///< of all poses, part after part
  std::size_t worst_part = 0;              ///< the part that holds the worst point
  robot::WorstPoint worst;
  /// Of all poses, m, base frame: cancelling_offset(). Empty without a cut.
  std::vector<Eigen::Vector3d> offsets;
};

/// Field `placement`: the best place, the workpiece's frame (base frame) there, and the map. `search.best`
/// must be there.
Json placement_to_json(const robot::PlaceSearch& search, const robot::StiffnessIndex& index,
                       const Eigen::Isometry3d& frame);

/// Without provenance.
Json pose_path_to_json(const PosePathDocument& document, const robot::Robot& robot);

/// Columns `time_s`, the point's number, the joints by name in degrees; a header, and a line for each pose.
std::string joint_angles_csv(const robot::PathSearch& search, const robot::Robot& robot);

/// Where to send the tool point, in the workpiece's frame and in the base frame, and by how much that is off
/// the path in the base frame; mm. A header, and a line for each pose.
std::string offsets_csv(const PosePathDocument& document, const Eigen::Isometry3d& workpiece);

}  // namespace stablecut::document
