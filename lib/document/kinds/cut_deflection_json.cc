#include "document/kinds/cut_deflection_json.h"

#include "base/units.h"

namespace stablecut::document {
namespace {

using Value = robot::CutDeflection::Value;

constexpr double kUmPerMetre = 1e6;

Json to_json(const Eigen::Vector3d& v) { return Json::array({v[0], v[1], v[2]}); }

const char* side(bool left) { return left ? "left" : "right"; }

// Feed, normal and axial, and their deviations where there are any.
void add_values(Json& to, const std::string& name, const std::array<Value, 3>& values) {
  Json numbers = Json::array(), deviations = Json::array();
  for (const Value& value : values) {
    numbers.push_back(value.m * kUmPerMetre);
    if (value.std_m) deviations.push_back(*value.std_m * kUmPerMetre);
  }
  to[name + "_um"] = std::move(numbers);
  if (!deviations.empty()) to[name + "_std_um"] = std::move(deviations);
}

}  // namespace

Json cut_load_to_json(const robot::CutLoad& cut) {
  Json walls = Json::array();
  for (const robot::CutLoad::Wall& wall : cut.walls) walls.push_back(side(wall.left));
  return {{"depth_mm", mm_from_metres(cut.depth_m)},
          {"mean_force_n", to_json(cut.mean_n)},
          {"peak_force_n", cut.peak_n()},
          {"walls", std::move(walls)}};
}

Json cut_deflection_to_json(const robot::CutDeflection& deflection) {
  Json json = {{"feed", to_json(deflection.frame.col(0))}, {"normal", to_json(deflection.frame.col(1))}};
  add_values(json, "mean", deflection.mean);
  add_values(json, "largest", deflection.largest);
  Json walls = Json::array();
  for (const robot::CutDeflection::Wall& wall : deflection.walls) {
    Json one = {{"side", side(wall.left)}, {"mean_error_um", wall.mean_error.m * kUmPerMetre}};
    one["error_um"] = wall.error ? Json(wall.error->m * kUmPerMetre) : Json(nullptr);
    if (wall.error && wall.error->std_m) one["error_std_um"] = *wall.error->std_m * kUmPerMetre;
    walls.push_back(std::move(one));
  }
  json["walls"] = std::move(walls);
  return json;
}

}  // namespace stablecut::document
