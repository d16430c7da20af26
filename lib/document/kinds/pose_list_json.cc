#include "document/kinds/pose_list_json.h"

#include "document/kinds/joints_json.h"

namespace stablecut::document {

PoseListDocument pose_list_from_json(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "pose-list");
  root.check_document_names({"poses"});
  PoseListDocument list;
  for (const Node& item : root.at("poses").items(1)) {
    item.check_names({"name", "joints_deg"});
    list.poses.push_back(joint_angles_from(item.at("joints_deg")));
    const auto name = item.find("name");
    list.names.push_back(name ? name->text() : "");
  }
  return list;
}

}  // namespace stablecut::document
