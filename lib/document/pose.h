// Kinds `pose` and `pose-map`: what a pose search or an evaluation found.
#pragma once

#include <optional>
#include <vector>

#include "document/json_text.h"
#include "robot/pose_report.h"
#include "robot/pose_search.h"

namespace stablecut {

/// The plane as the user gave it.
struct PlaneDocument {
  std::optional<double> height_mm;
  Plane plane;  ///< where no height was given
};

struct PoseDocument {
  StiffnessTask task;
  std::optional<Matrix6d> covariance;
  // A search.
  PlaneDocument plane;
  PoseSearch search;
  std::vector<PoseReport> reports;  ///< best, then the alternatives
  RedundancySweep sweep;            ///< at the best point
  // An evaluation.
  std::vector<PoseReport> evaluated;
};

/// The documents without provenance.
Json pose_to_json(const PoseDocument& document, const Robot& robot);
Json evaluation_to_json(const PoseDocument& document);
Json pose_map_to_json(const PoseMap& map, const PoseTask& task, const PlaneDocument& plane);

}  // namespace stablecut
