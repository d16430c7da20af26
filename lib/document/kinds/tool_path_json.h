// Kind `tool-path`: where a tool goes, in the frame of the workpiece.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "document/text/json_text.h"
#include "robot/tool_path.h"

namespace stablecut::document {

/// What a path may leave open.
struct ToolPathDefaults {
  std::optional<Eigen::Isometry3d> frame;  ///< of the workpiece in the base frame, m
  std::optional<double> speed;             ///< m/s
  /// In text alone: the axis is that of the tool's z, from the holder to the tip. Post-processors write the
  /// other direction.
  bool axis_to_tip = false;
};

inline constexpr int kMostPathPoints = 100'000;

/// A path in the base frame, and its workpiece's frame there; the base frame itself where nothing says.
struct ToolPathDocument {
  robot::ToolPath path;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
};

/// Throws DataError, also where the document has a frame and the defaults another.
ToolPathDocument tool_path_from_json(const Json& document, const Source& source,
                                     const ToolPathDefaults& defaults);

/// A path in the workpiece's frame, moved into the base frame.
ToolPathDocument in_base_frame(robot::ToolPath path, const std::optional<Eigen::Isometry3d>& frame);

}  // namespace stablecut::document
