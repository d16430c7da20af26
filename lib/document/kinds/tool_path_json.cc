#include "document/kinds/tool_path_json.h"

#include "base/units.h"
#include "document/kinds/frame_json.h"
#include "document/kinds/joints_json.h"
#include "document/text/node.h"

namespace stablecut::document {
namespace {

constexpr Bound kPosition{.least = -1e6, .most = 1e6, .words = "a length in mm"};
constexpr Bound kSpeed{.least = 0, .most = 1e6, .open_least = true, .words = "a speed above 0 mm/s"};

Eigen::Vector3d direction_from(const Node& node) {
  const Eigen::Vector3d v = vector_from(node);
  if (!(v.stableNorm() > 0)) node.fail("expected a direction");
  return v.stableNormalized();
}

}  // namespace

ToolPathDocument in_base_frame(robot::ToolPath path, const std::optional<Eigen::Isometry3d>& frame) {
  if (!frame) return {std::move(path), Eigen::Isometry3d::Identity()};
  return {robot::moved(std::move(path), *frame), *frame};
}

ToolPathDocument tool_path_from_json(const Json& document, const Source& source,
                                     const ToolPathDefaults& defaults) {
  const Node root = document_root(document, source, "tool-path");
  root.check_document_names({"frame", "speed_mm_per_s", "points"});
  std::optional<Eigen::Isometry3d> frame = defaults.frame;
  if (const auto given = root.find("frame")) {
    if (defaults.frame) given->fail("expected the workpiece's frame from one place only");
    frame = frame_from(*given);
  }
  std::optional<double> speed = defaults.speed;
  if (const auto given = root.find("speed_mm_per_s")) speed = given->number(kSpeed) * 1e-3;
  robot::ToolPath path;
  const auto points = root.at("points").items(1);
  if (points.size() > kMostPathPoints)
    root.at("points").fail("expected at most " + std::to_string(kMostPathPoints) +
                           " points (divide the path)");
  for (const Node& item : points) {
    item.check_names({"position_mm", "axis", "feed", "speed_mm_per_s"});
    robot::ToolPathPoint point;
    point.position = vector_from(item.at("position_mm"), kPosition) * 1e-3;
    point.axis = direction_from(item.at("axis"));
    if (const auto feed = item.find("feed")) point.feed = direction_from(*feed);
    const auto own = item.find("speed_mm_per_s");
    if (!own && !speed) item.fail("expected speed_mm_per_s here or beside points");
    point.speed = own ? own->number(kSpeed) * 1e-3 : *speed;
    path.push_back(point);
  }
  return in_base_frame(std::move(path), frame);
}

}  // namespace stablecut::document
