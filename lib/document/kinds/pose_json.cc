#include "document/kinds/pose_json.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/units.h"
#include "document/kinds/cut_deflection_json.h"
#include "document/kinds/joints_json.h"

namespace stablecut::document {
namespace {

Json index_to_json(const robot::StiffnessIndex& index) {
  return {{"name", index.name}, {"unit", index.unit}};
}

Json to_json(const Eigen::Vector3d& v) { return Json::array({v[0], v[1], v[2]}); }

Json to_json(const robot::PoseReport& report, const robot::StiffnessTask& task) {
  Json pose = {{"joints_deg", joint_angles_to_json(report.angles)},
               {"tcp_mm", to_json(report.tool.translation() * 1e3)},
               {"redundancy_deg", document_degrees(report.redundancy_rad)},
               {"score", number_or_null(report.score * task.index->units_per_score)}};
  if (report.score_std) pose["score_std"] = *report.score_std * task.index->units_per_score;
  Json principal = Json::array();
  for (const double compliance : report.principal_compliance) {
    principal.push_back(compliance > 0 ? Json(1 / compliance) : Json(nullptr));
  }
  pose["principal_stiffness_n_per_m"] = std::move(principal);
  Json directional = Json::array();
  for (const double stiffness : report.directional_stiffness)
    directional.push_back(number_or_null(stiffness));
  pose["stiffness_n_per_m"] = std::move(directional);
  pose["compliance_um_per_n"] = Json::array();
  for (const auto& row : report.compliance.rowwise())
    pose["compliance_um_per_n"].push_back(to_json(Eigen::Vector3d(row * 1e6)));
  pose["deflection_um"] = nullptr;  // without a force
  if (report.deflection_m) {
    pose["deflection_um"] = report.deflection_m->norm() * 1e6;
    if (report.deflection_std_m) pose["deflection_std_um"] = *report.deflection_std_m * 1e6;
    pose["displacement_um"] = to_json(*report.deflection_m * 1e6);
  }
  if (report.worst_force_n) pose["worst_force_n"] = to_json(*report.worst_force_n);
  if (report.cut) pose["cut"] = cut_deflection_to_json(*report.cut);
  pose["limit_margin_deg"] = document_degrees(report.limit_margin_rad);
  pose["joint_margin_deg"] = joint_angles_to_json(report.joint_margin_rad);
  pose["singularity_margin"] = report.singularity_margin;
  if (std::isfinite(report.keep_out_margin_m))
    pose["keep_out_margin_mm"] = mm_from_metres(report.keep_out_margin_m);
  return pose;
}

// What holds a pose: names of joints for their limits.
Json to_json(const robot::Standing& standing, const robot::Robot& robot) {
  Json joints = Json::array(), others = Json::array();
  for (const int j : standing.joints) joints.push_back(robot.joints[j].name);
  for (const auto& [holds, name] :
       {std::pair{standing.singularity, "singularity-margin"}, std::pair{standing.keep_out, "keep-out"},
        std::pair{standing.x, "x"}, std::pair{standing.y, "y"},
        std::pair{standing.redundancy, "redundancy"}}) {
    if (holds) others.push_back(name);
  }
  const bool interior = joints.empty() && others.empty();
  return {{"interior", interior}, {"joint_limits", std::move(joints)}, {"others", std::move(others)}};
}

Json to_json(const std::vector<robot::PartMove>& moves, const robot::StiffnessTask& task) {
  Json list = Json::array();
  for (const robot::PartMove& move : moves) {
    const char* const axes[] = {"x", "y", "normal"};
    Json one = {{"axis", axes[move.axis]}};
    if (move.turn)
      one["turned_deg"] = document_degrees(move.amount);
    else
      one["moved_mm"] = mm_from_metres(move.amount);
    one["score"] = move.score ? Json(*move.score * task.index->units_per_score) : Json(nullptr);
    list.push_back(std::move(one));
  }
  return list;
}

Json family_to_json(const robot::PoseFamily& family, const robot::Robot& robot) {
  const auto interval = [&](const char* kind, int joint) {
    return Json{{"kind", kind},
                {"joint", robot.joints[joint].name},
                {"from_deg", document_degrees(family.from_rad)},
                {"to_deg", document_degrees(family.to_rad)}};
  };
  switch (family.kind) {
    case robot::PoseFamily::Kind::kBaseTurn:
      return interval("base-turn", 0);
    case robot::PoseFamily::Kind::kToolTurn:
      return interval("tool-turn", 5);
    case robot::PoseFamily::Kind::kFlippedWrist:
      return {{"kind", "flipped-wrist"}, {"joints_deg", joint_angles_to_json(family.angles)}};
    case robot::PoseFamily::Kind::kEqual:
      break;
  }
  return {{"kind", "equal"}, {"joints_deg", joint_angles_to_json(family.angles)}};
}

void add_plane(Json& document, const PlaneDocument& plane) {
  if (plane.height_mm) {
    document["height_mm"] = *plane.height_mm;
  } else {
    document["plane"] = {{"origin_mm", to_json(plane.plane.origin * 1e3)},
                         {"x_axis", to_json(plane.plane.x_axis)},
                         {"y_axis", to_json(plane.plane.y_axis)}};
  }
}

template <typename Value>
Json rows_of(Eigen::Index rows, Eigen::Index columns, const Value& value) {
  Json result = Json::array();
  for (Eigen::Index j = 0; j < rows; ++j) {
    Json row = Json::array();
    for (Eigen::Index i = 0; i < columns; ++i) row.push_back(value(j, i));
    result.push_back(std::move(row));
  }
  return result;
}

Json samples_of(const Range& range) {
  Json list = Json::array();
  for (int i = 0; i < range.count; ++i) list.push_back(mm_from_metres(range.at(i)));
  return list;
}

}  // namespace

Json keep_out_to_json(const robot::Robot& robot) {
  Json boxes = Json::array();
  for (const robot::Box& box : robot.keep_out_boxes)
    boxes.push_back({{"least_mm", to_json(box.least_m * 1e3)}, {"most_mm", to_json(box.most_m * 1e3)}});
  Json result = {{"radius_mm", mm_from_metres(robot.keep_out_radius_m)}, {"boxes", std::move(boxes)}};
  result["floor_mm"] = robot.floor_m ? Json(mm_from_metres(*robot.floor_m)) : Json(nullptr);
  return result;
}

Json pose_report_to_json(const robot::PoseReport& report, const robot::StiffnessTask& task) {
  return to_json(report, task);
}

Json pose_to_json(const PoseDocument& document, const robot::Robot& robot) {
  Json result = {{"format", "stablecut/pose/1"}, {"index", index_to_json(*document.task.index)}};
  if (document.task.cut) result["cut"] = cut_load_to_json(*document.task.cut);
  add_plane(result, document.plane);
  const auto one = [&](const robot::PoseReport& report, const robot::FoundPose& found) {
    Json pose = to_json(report, document.task);
    pose["branch"] = found.at.branch;
    pose["stands_on"] = to_json(robot::standing_of(document.pose_task, report, found.at), robot);
    return pose;
  };
  result["best"] = one(document.reports.front(), document.search.best);
  Json alternatives = Json::array();
  for (std::size_t i = 0; i < document.search.alternatives.size(); ++i) {
    alternatives.push_back(one(document.reports[i + 1], document.search.alternatives[i]));
    if (document.errors.known()) {
      alternatives.back()["probability_better"] = robot::probability_better(
          document.reports[i + 1], document.reports.front(), document.task, document.errors);
    }
  }
  result["alternatives"] = std::move(alternatives);
  Json families = Json::array();
  for (const robot::PoseFamily& family : document.search.families)
    families.push_back(family_to_json(family, robot));
  result["families"] = std::move(families);
  result["keep_out"] = keep_out_to_json(robot);
  result["part_moved"] = to_json(document.moves, document.task);
  result["redundancy_matters"] = document.search.redundancy_matters;
  Json angles = Json::array(), scores = Json::array();
  for (std::size_t i = 0; i < document.sweep.redundancy_rad.size(); ++i) {
    angles.push_back(document_degrees(document.sweep.redundancy_rad[i]));
    const auto& score = document.sweep.score[i];
    scores.push_back(score ? Json(*score * document.task.index->units_per_score) : Json(nullptr));
  }
  result["redundancy_sweep"] = {{"redundancy_deg", std::move(angles)}, {"score", std::move(scores)}};
  return result;
}

Json evaluation_to_json(const PoseDocument& document) {
  const auto& poses = document.evaluated;
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (std::isnan(poses[a].score) || std::isnan(poses[b].score))
      return !std::isnan(poses[a].score) && std::isnan(poses[b].score);
    return document.task.index->larger_is_better ? poses[a].score > poses[b].score
                                                 : poses[a].score < poses[b].score;
  });
  std::vector<int> rank(poses.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<int>(i) + 1;
  Json evaluated = Json::array();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Json pose = to_json(poses[i], document.task);
    pose["rank"] = rank[i];
    if (!document.names[i].empty()) pose["name"] = document.names[i];
    if (document.errors.known() && i != order.front() && std::isfinite(poses[i].score)) {
      pose["probability_better"] =
          robot::probability_better(poses[i], poses[order.front()], document.task, document.errors);
    }
    evaluated.push_back(std::move(pose));
  }
  Json result = {{"format", "stablecut/pose/1"},
                 {"index", index_to_json(*document.task.index)},
                 {"evaluated", std::move(evaluated)}};
  if (document.task.cut) result["cut"] = cut_load_to_json(*document.task.cut);
  return result;
}

Eigen::Matrix3d tool_compliance(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "pose");
  Node pose = root;
  if (root.has("evaluated")) {
    const auto poses = root.at("evaluated").items();
    if (poses.size() != 1) root.at("evaluated").fail("expected one pose");
    pose = poses.front();
  } else {
    pose = root.at("best");
  }
  Eigen::Matrix3d compliance;
  const Node matrix = pose.at("compliance_um_per_n");
  const auto rows = matrix.items(3);
  if (rows.size() != 3) matrix.fail("expected 3 rows of 3 numbers");
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd row = rows[i].numbers();
    if (row.size() != 3) rows[i].fail("expected 3 numbers");
    compliance.row(i) = row.transpose() * 1e-6;
  }
  return compliance;
}

Json pose_map_to_json(const robot::PoseMap& map, const robot::PoseTask& task, const PlaneDocument& plane) {
  Json result = {{"format", "stablecut/pose-map/1"}, {"index", index_to_json(*task.stiffness.index)}};
  add_plane(result, plane);
  result["x_mm"] = samples_of(task.x);
  result["y_mm"] = samples_of(task.y);
  const auto rows = map.score.rows(), columns = map.score.cols();
  const auto number = [&](const Eigen::MatrixXd& values, double factor) {
    return rows_of(rows, columns, [&](auto j, auto i) { return number_or_null(values(j, i) * factor); });
  };
  result["score"] = number(map.score, task.stiffness.index->units_per_score);
  result["redundancy_deg"] = rows_of(rows, columns, [&](auto j, auto i) {
    return number_or_null(document_degrees(map.redundancy_rad(j, i)));
  });
  result["branch"] = rows_of(rows, columns, [&](auto j, auto i) {
    return map.branch(j, i) < 0 ? Json(nullptr) : Json(map.branch(j, i));
  });
  result["stiffness_x_n_per_m"] = number(map.stiffness[0], 1);
  result["stiffness_y_n_per_m"] = number(map.stiffness[1], 1);
  result["stiffness_z_n_per_m"] = number(map.stiffness[2], 1);
  return result;
}

}  // namespace stablecut::document
