#include "document/kinds/cut_force_json.h"

#include <cmath>

#include "base/units.h"

namespace stablecut::document {
namespace {

constexpr int kWavePoints = 360;

double um(double metres) { return metres * 1e6; }

Json vector3(const milling::ForceParts& parts) { return {parts.x(), parts.y(), parts.z()}; }

Json harmonics_to_json(const CutForceDocument& document, const milling::EdgeForce& force) {
  Json list = Json::array();
  const int per_period = static_cast<int>(std::lround(kTwoPi / force.period_rad()));
  for (int k = 1; k <= document.harmonics; ++k) {
    Json item = {{"per_revolution", k * per_period}};
    if (document.speed_rpm) item["frequency_hz"] = k * per_period * *document.speed_rpm / 60;
    const auto part = force.harmonic(k);
    item["force_n"] = Json::array();
    for (int axis = 0; axis < 3; ++axis) item["force_n"].push_back({part[axis].real(), part[axis].imag()});
    list.push_back(std::move(item));
  }
  return list;
}

Json wave_to_json(const CutForceDocument& document, const milling::EdgeForce& force) {
  std::vector<double> turn, feed, normal, axial, torque;
  for (int i = 0; i < kWavePoints; ++i) {
    const double deg = 360.0 * i / kWavePoints;
    const milling::ForceParts parts = force.at(radians_from_degrees(deg));
    turn.push_back(deg);
    feed.push_back(parts.x());
    normal.push_back(parts.y());
    axial.push_back(parts.z());
    torque.push_back(parts[3] * document.diameter_m / 2);
  }
  return {
      {"turn_deg", turn}, {"feed_n", feed}, {"normal_n", normal}, {"axial_n", axial}, {"torque_n_m", torque}};
}

void describe(Json& item, const CutForceDocument& document, const MeasuredCut& cut,
              const milling::SimulationResult& result) {
  item["growth_error"] = result.growth.error;
  item["stable"] = result.stable();
  item["settled"] = result.settled;
  item["keeps_contact"] = result.keeps_contact;
  if (result.ran_away) item["ran_away"] = true;
  item["teeth_followed"] = result.passes;
  item["steps_per_tooth"] = result.steps_per_tooth;
  if (!result.ran_away) {
    const double torque = result.mean_force_n[3] * document.diameter_m / 2;
    item["mean_force_n"] = vector3(result.mean_force_n);
    item["peak_force_n"] = result.peak_force_n;
    item["torque_n_m"] = torque;
    item["power_w"] = torque * kTwoPi * revolutions_per_s_from_rpm(cut.speed_rpm);
    item["without_contact"] = result.without_contact;
    item["peak_vibration_um"] = um(result.peak_vibration_m);
    item["mean_deflection_um"] = {um(result.mean_deflection_m.x()), um(result.mean_deflection_m.y())};
    item["location_error_um"] = result.location_error_m ? Json(um(*result.location_error_m)) : Json(nullptr);
    item["chatter_frequency_hz"] =
        result.chatter_frequency_hz ? Json(*result.chatter_frequency_hz) : Json(nullptr);
    item["chatter_amplitude_um"] = um(result.chatter_amplitude_m);
    std::vector<double> feed, normal;
    for (const Eigen::Vector2d& tip : result.samples_m) {
      feed.push_back(um(tip.x()));
      normal.push_back(um(tip.y()));
    }
    item["samples_um"] = {{"feed", feed}, {"normal", normal}};
  }
  if (cut.observed_stable) {
    item["observed"] = *cut.observed_stable ? "stable" : "chatter";
    item["agrees"] = *cut.observed_stable == result.stable();
  }
}

}  // namespace

Json cut_force_to_json(const CutForceDocument& document, const milling::EdgeForce& force) {
  const milling::EdgeForce::Peak peak = force.peak();
  const milling::ForceParts mean = force.mean();
  const double torque = mean[3] * document.diameter_m / 2;
  Json result = {{"format", "stablecut/cut-force/1"}, {"cut", document.cut}, {"depth_mm", document.depth_mm}};
  if (document.speed_rpm) result["speed_rpm"] = *document.speed_rpm;
  result["mean_force_n"] = vector3(mean);
  result["peak_force_n"] = peak.force_n;
  result["torque_n_m"] = torque;
  result["peak_torque_n_m"] = peak.along_n * document.diameter_m / 2;
  result["power_w"] = document.speed_rpm
                          ? Json(torque * kTwoPi * revolutions_per_s_from_rpm(*document.speed_rpm))
                          : Json(nullptr);
  result["harmonics"] = harmonics_to_json(document, force);
  result["wave"] = wave_to_json(document, force);
  if (document.points.empty()) return result;
  result["points"] = Json::array();
  for (const SimulatedPoint& point : document.points) {
    Json item = {{"depth_mm", point.cut.depth_mm},
                 {"speed_rpm", point.cut.speed_rpm},
                 {"growth_per_tooth", nullptr},
                 {"stable", nullptr}};
    if (point.result) {
      item["growth_per_tooth"] = point.result->growth.per_tooth;
      describe(item, document, point.cut, *point.result);
    } else {
      item["not_simulated"] = point.failure;
    }
    result["points"].push_back(std::move(item));
  }
  return result;
}

}  // namespace stablecut::document
