#include "document/kinds/load_samples_json.h"

#include "base/units.h"
#include "document/kinds/joints_json.h"
#include "document/text/data_error.h"

namespace stablecut::document {
namespace {

constexpr Bound kDeviation{
    .least = 1e3 * kLeastDeviation, .most = 1e3 * kLargestLength, .words = "a standard deviation above 0"};
constexpr Bound kLength{
    .least = -1e3 * kLargestLength, .most = 1e3 * kLargestLength, .words = "a length in mm"};
constexpr Bound kRotation{.least = -kLargestAngle, .most = kLargestAngle, .words = "an angle in rad"};

constexpr Bound kLoad{
    .least = -kLargestLoad, .most = kLargestLoad, .words = "a force in N or a moment in N m"};

// One number for all directions or one for each.
Eigen::Vector3d deviations_from(const Node& node) {
  if (node.json().is_array()) return vector_from(node, kDeviation);
  return Eigen::Vector3d::Constant(node.number(kDeviation));
}

Eigen::Vector3d measured(const Node& node, const std::array<bool, 3>& components) {
  const auto items = node.items();
  if (items.size() != 3) node.fail("expected 3 numbers");
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (int d = 0; d < 3; ++d) {
    const Node& item = items[d];
    if (components[d] || !item.is_null()) value[d] = item.number(kLength);
  }
  return value;
}

}  // namespace

LoadSamplesDocument load_samples_from_json(const Json& document, const Source& source,
                                           const robot::Robot& robot, const std::array<bool, 3>& components) {
  const Node root = document_root(document, source, "load-samples");
  root.check_document_names({"frame", "samples"});
  if (const auto frame = root.find("frame")) frame->word({"base"});
  LoadSamplesDocument result;
  for (const Node& item : root.at("samples").items(1)) {
    item.check_names({"name", "joints_deg", "force_n", "deflection_mm", "moment_n_m", "rotation_rad",
                      "force_point_mm", "measuring_point_mm", "std_mm", "std_rad"});
    robot::LoadSample sample;
    sample.angles = joint_angles_from(item.at("joints_deg"));
    sample.force_n = vector_from(item.at("force_n"), kLoad);
    sample.deflection_m = measured(item.at("deflection_mm"), components) * 1e-3;
    if (const auto moment = item.find("moment_n_m")) sample.moment_n_m = vector_from(*moment, kLoad);
    if (const auto rotation = item.find("rotation_rad"))
      sample.rotation_rad = vector_from(*rotation, kRotation);
    const Eigen::Vector3d tool_point = robot.tool.translation();
    const auto point = [&](const char* name) {
      const auto node = item.find(name);
      return node ? Eigen::Vector3d(vector_from(*node, kLength) * 1e-3) : tool_point;
    };
    sample.force_point = point("force_point_mm");
    sample.measuring_point = point("measuring_point_mm");
    if (const auto std = item.find("std_mm")) sample.deflection_std_m = deviations_from(*std) * 1e-3;
    if (const auto std = item.find("std_rad")) sample.rotation_std_rad = deviations_from(*std);
    if (!result.samples.empty() &&
        sample.deflection_std_m.has_value() != result.samples.front().deflection_std_m.has_value()) {
      throw DataError(source.name, item.pointer() + "/std_mm", "",
                      "expected std_mm in all samples or in none");
    }
    if (sample.rotation_rad && sample.rotation_std_rad.has_value() != sample.deflection_std_m.has_value()) {
      throw DataError(source.name, item.pointer() + "/std_rad", "",
                      "expected std_rad with std_mm where rotations are measured, or neither");
    }
    result.samples.push_back(std::move(sample));
    result.places.push_back(item.pointer());
    const auto name = item.find("name");
    result.names.push_back(name ? name->text() : "");
  }
  return result;
}

}  // namespace stablecut::document
