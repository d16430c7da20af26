#include "document/kinds/pose_path_json.h"

#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "document/kinds/cut_deflection_json.h"
#include "document/kinds/frame_json.h"
#include "document/kinds/joints_json.h"
#include "document/kinds/pose_json.h"

namespace stablecut::document {
namespace {

double score_of(double cost, const robot::StiffnessIndex& index) {
  return robot::path_cost(index, cost) * index.units_per_score;
}

const char* fault_word(robot::PoseFault::Kind kind) {
  switch (kind) {
    case robot::PoseFault::Kind::kReach:
      return "reach";
    case robot::PoseFault::Kind::kRedundancy:
      return "redundancy";
    case robot::PoseFault::Kind::kLimit:
      return "joint-limit";
    case robot::PoseFault::Kind::kSingularity:
      return "singularity-margin";
    case robot::PoseFault::Kind::kKeepOut:
      return "keep-out";
    case robot::PoseFault::Kind::kNone:
      break;
  }
  return "continuity";
}

void add_fault(Json& to, const robot::PoseFault& fault, const robot::Robot& robot) {
  to["constraint"] = fault_word(fault.kind);
  if (fault.kind == robot::PoseFault::Kind::kLimit) {
    to["joint"] = robot.joints[fault.joint].name;
    to["missing_deg"] = document_degrees(fault.missing);
  }
  if (fault.kind == robot::PoseFault::Kind::kKeepOut) to["missing_mm"] = mm_from_metres(fault.missing);
}

Json obstacle_to_json(const robot::PathObstacle& obstacle, const robot::Robot& robot) {
  Json json = {{"first", obstacle.first}, {"last", obstacle.last}, {"between", obstacle.between}};
  if (obstacle.speed) {
    json["constraint"] = "joint-speed";
    json["joint"] = robot.joints[obstacle.fault.joint].name;
    json["times_the_limit"] = obstacle.fault.missing;
  } else {
    add_fault(json, obstacle.fault, robot);
  }
  return json;
}

Json worst_to_json(const PosePathDocument& document, const robot::Robot& robot) {
  const robot::WorstPoint& worst = document.worst;
  const robot::PathPart& part = document.search.parts[document.worst_part];
  const robot::StiffnessIndex& index = *document.task.stiffness.index;
  Json json = {{"point", worst.point}, {"score", score_of(part.poses[worst.point - part.first].cost, index)}};
  switch (worst.reason) {
    case robot::WorstPoint::Reason::kPlace:
      json["because"] = "place";
      return json;
    case robot::WorstPoint::Reason::kFault:
      json["because"] = "constraint";
      add_fault(json, worst.fault, robot);
      break;
    case robot::WorstPoint::Reason::kBranch:
      json["because"] = "branch";
      break;
    case robot::WorstPoint::Reason::kNeighbours:
      json["because"] = "neighbours";
      break;
  }
  json["better_score"] = score_of(worst.better_cost, index);
  return json;
}

const char* outcome_word(robot::PlacedPath::Outcome outcome) {
  switch (outcome) {
    case robot::PlacedPath::Outcome::kDriven:
      return "driven";
    case robot::PlacedPath::Outcome::kNotBetter:
      return "not-better";
    case robot::PlacedPath::Outcome::kNoPose:
      return "no-pose";
    case robot::PlacedPath::Outcome::kNoMotion:
      break;
  }
  return "no-motion";
}

void add_offset(Json& to, const Eigen::Vector3d& offset, const robot::PoseReport& report) {
  to["offset_mm"] = Json::array();
  for (const double part : offset) to["offset_mm"].push_back(mm_from_metres(part));
  to["offset_normal_mm"] = mm_from_metres(offset.dot(report.cut->frame.col(1)));
}

Json place_to_json(const robot::Placement& at) {
  return {{"x_mm", mm_from_metres(at.shift.x())},
          {"y_mm", mm_from_metres(at.shift.y())},
          {"z_mm", mm_from_metres(at.shift.z())},
          {"turn_deg", document_degrees(at.turn)}};
}

}  // namespace

Json placement_to_json(const robot::PlaceSearch& search, const robot::StiffnessIndex& index,
                       const Eigen::Isometry3d& frame) {
  Json map = Json::array();
  for (const robot::PlacedPath& place : search.map) {
    Json json = place_to_json(place.at);
    json["outcome"] = outcome_word(place.outcome);
    const bool driven = place.outcome == robot::PlacedPath::Outcome::kDriven;
    json["objective"] = driven ? Json(score_of(place.objective, index)) : Json();
    json["bound"] = std::isfinite(place.bound) ? Json(score_of(place.bound, index)) : Json();
    map.push_back(std::move(json));
  }
  Json best = place_to_json(search.map[*search.best].at);
  best["objective"] = score_of(search.map[*search.best].objective, index);
  return {{"best", std::move(best)}, {"frame", frame_to_json(frame)}, {"map", std::move(map)}};
}

Json pose_path_to_json(const PosePathDocument& document, const robot::Robot& robot) {
  const robot::StiffnessIndex& index = *document.task.stiffness.index;
  const robot::PathFrames frames = robot::path_frames(document.task.path);
  Json parts = Json::array(), points = Json::array();
  std::size_t at = 0;
  for (const robot::PathPart& part : document.search.parts) {
    parts.push_back({{"first", part.first},
                     {"last", part.last()},
                     {"branch", part.branch},
                     {"objective", score_of(part.objective, index)}});
    for (std::size_t i = 0; i < part.poses.size(); ++i, ++at) {
      const robot::PathPose& pose = part.poses[i];
      Json json = {{"point", part.first + i}, {"time_s", pose.time}};
      json.update(
          pose_report_to_json(document.reports[at], point_task(document.task, frames, part.first + i)));
      if (!document.offsets.empty()) add_offset(json, document.offsets[at], document.reports[at]);
      json["branch"] = part.branch;
      json["turn_deg"] = document_degrees(pose.turn + frames.redundancy[0]);
      json["joint_speed_deg_per_s"] = joint_angles_to_json(pose.speed);
      points.push_back(std::move(json));
    }
  }
  Json result = {{"format", "stablecut/pose-path/1"},
                 {"index", {{"name", index.name}, {"unit", index.unit}}},
                 {"objective", document.task.mean_objective ? "mean" : "worst"},
                 {"worst", worst_to_json(document, robot)},
                 {"parts", std::move(parts)}};
  if (const auto& cut = document.task.stiffness.cut) result["cut"] = cut_load_to_json(*cut);
  Json obstacles = Json::array();
  for (const robot::PathObstacle& obstacle : document.search.obstacles)
    obstacles.push_back(obstacle_to_json(obstacle, robot));
  result["obstacles"] = std::move(obstacles);
  Json speeds = Json::array();
  for (const double speed : document.task.max_speed)
    speeds.push_back(number_or_null(document_degrees(speed)));
  result["joint_speed_limit_deg_per_s"] = std::move(speeds);
  result["limit_margin_deg"] = document_degrees(document.task.limit_margin_rad);
  result["singularity_margin"] = document.task.singularity_margin;
  result["keep_out"] = keep_out_to_json(robot);
  result["points"] = std::move(points);
  return result;
}

std::string joint_angles_csv(const robot::PathSearch& search, const robot::Robot& robot) {
  std::string text = "point,time_s";
  for (const robot::Joint& joint : robot.joints) text += "," + joint.name + "_deg";
  text += "\n";
  for (const robot::PathPart& part : search.parts) {
    for (std::size_t i = 0; i < part.poses.size(); ++i) {
      text += std::to_string(part.first + i) + "," + printed("%.6f", part.poses[i].time);
      for (const double angle : part.poses[i].angles)
        text += "," + printed("%.9f", degrees_from_radians(angle));
      text += "\n";
    }
  }
  return text;
}

std::string offsets_csv(const PosePathDocument& document, const Eigen::Isometry3d& workpiece) {
  std::string text =
      "point,x_mm,y_mm,z_mm,base_x_mm,base_y_mm,base_z_mm,offset_x_mm,offset_y_mm,offset_z_mm,"
      "offset_feed_mm,offset_normal_mm,offset_axial_mm\n";
  const Eigen::Isometry3d into_workpiece = workpiece.inverse();
  std::size_t at = 0;
  for (const robot::PathPart& part : document.search.parts) {
    for (std::size_t i = 0; i < part.poses.size(); ++i, ++at) {
      const Eigen::Vector3d offset = document.offsets[at];
      const Eigen::Vector3d base = document.task.path[part.first + i].position + offset;
      const Eigen::Vector3d in_cut = document.reports[at].cut->frame.transpose() * offset;
      text += std::to_string(part.first + i);
      for (const Eigen::Vector3d& v : {Eigen::Vector3d(into_workpiece * base), base, offset, in_cut})
        for (const double component : v) text += "," + printed("%.6f", mm_from_metres(component));
      text += "\n";
    }
  }
  return text;
}

}  // namespace stablecut::document
