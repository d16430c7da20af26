#include "document/kinds/pose_list_json.h"

#include "document/kinds/joints_json.h"

namespace stablecut::document {

std::vector<robot::JointAngles> pose_list_from_json(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "pose-list");
  root.check_names({"format", "poses", "provenance"});
  std::vector<robot::JointAngles> poses;
  for (const Node& item : root.at("poses").items(1)) {
    item.check_names({"joints_deg"});
    poses.push_back(joint_angles_from(item.at("joints_deg")));
  }
  return poses;
}

}  // namespace stablecut::document
