// Where a search looks: the options of the plane, the redundancy and the margins, and the task that they
// make.
#pragma once

#include <array>
#include <optional>

#include "base/range.h"
#include "cli/tool.h"
#include "document/kinds/pose_json.h"
#include "robot/pose_task.h"

namespace stablecut {

/// Angles of the redundancy that a search looks at, at most.
inline constexpr int kMostTurns = 3600;

/// As the options give it; what is not given has a default.
struct SearchOptions {
  using Vector = std::optional<std::array<double, 3>>;

  std::optional<double> height_mm;
  Vector plane_origin_mm, plane_x, plane_y, tool_axis;
  std::optional<Range> x_mm, y_mm, redundancy_deg;
  std::optional<double> limit_margin_deg, singularity_margin;

  bool has_plane() const { return height_mm || plane_origin_mm; }
};

/// The plane of --height, or of --plane-origin, --plane-x and --plane-y. Throws WrongUsage.
document::PlaneDocument search_plane(const SearchOptions& options);

void add_margin_options(CLI::App& app, SearchOptions& options);

/// What a pose has to keep: rad from every joint limit, and the least singularity margin. On a path the
/// joints' speeds are kept by themselves, and the margin only has to keep branches apart.
double limit_margin(const SearchOptions& options);
double singularity_margin(const SearchOptions& options, bool along_path);

/// True where a height given in mm would be within reach as one in metres too; not 0, which is both.
bool height_may_be_metres(const SearchOptions& options, const robot::Robot& robot);

/// The task of a search on that plane. Throws WrongUsage, and NoPose where the plane is out of reach.
robot::PoseTask search_task(const SearchOptions& options, const robot::Plane& plane,
                            const robot::Robot& robot, const robot::Elasticity& elasticity,
                            const robot::StiffnessTask& stiffness);

}  // namespace stablecut
