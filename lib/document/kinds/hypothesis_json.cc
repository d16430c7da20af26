#include "document/kinds/hypothesis_json.h"

#include <cmath>

#include "base/units.h"

namespace stablecut::document {
namespace {

using Kind = robot::Hypothesis::Kind;

struct NamedUnit {
  const char* name;
  double to_si;
};
constexpr NamedUnit kDeflectionUnits[] = {{"mm", 1e-3}, {"m", 1}, {"um", 1e-6}, {"inch", 0.0254}};
constexpr NamedUnit kForceUnits[] = {{"N", 1}, {"kgf", kStandardGravity}};
constexpr double kSameUnit = 1e-6;  // relative

template <std::size_t N>
std::vector<double> other_units(const NamedUnit (&units)[N], const std::optional<double>& stated) {
  std::vector<double> factors;
  for (const NamedUnit& unit : units) {
    if (stated && std::abs(unit.to_si / *stated - 1) > kSameUnit) factors.push_back(unit.to_si / *stated);
  }
  return factors;
}

template <std::size_t N>
std::string unit_name(const NamedUnit (&units)[N], double to_si) {
  for (const NamedUnit& unit : units) {
    if (std::abs(unit.to_si / to_si - 1) < kSameUnit) return unit.name;
  }
  return "";
}

// The fitted vector, where there is one.
void add_fitted(const robot::Hypothesis& hypothesis, Json& json) {
  const auto list = [&](double scale) {
    const Eigen::Vector3d v = scale * hypothesis.vector;
    return Json::array({v[0], v[1], v[2]});
  };
  if (hypothesis.kind == Kind::kRotated) json["rotation_deg"] = list(180 / kPi);
  if (hypothesis.kind == Kind::kLoadPoint) json["offset_mm"] = list(1e3);
  if (hypothesis.kind == Kind::kLength) json["longer_mm"] = 1e3 * hypothesis.vector[0];
}

}  // namespace

robot::HypothesisOptions hypothesis_options(const LoadSamplesDocument& samples,
                                            const std::array<bool, 3>& components) {
  return {components, other_units(kDeflectionUnits, samples.deflection_unit_m),
          other_units(kForceUnits, samples.force_unit_n)};
}

std::string hypothesis_name(const robot::Hypothesis& hypothesis, const robot::Robot& robot,
                            const LoadSamplesDocument& samples) {
  const std::string& joint = robot.joints[hypothesis.joint].name;
  switch (hypothesis.kind) {
    case Kind::kNone:
      return "";
    case Kind::kSign:
      return "sign:" + joint;
    case Kind::kCoupling:
      return "coupling:" + joint + "=" + std::to_string(std::lround(hypothesis.ratio));
    case Kind::kTurned: {
      Eigen::Index axis = 0;
      hypothesis.vector.cwiseAbs().maxCoeff(&axis);
      return std::string("turned:") + "xyz"[axis] +
             std::to_string(std::lround(degrees_from_radians(hypothesis.vector[axis])));
    }
    case Kind::kRotated:
      return "turned";
    case Kind::kRadians:
      return "angles:rad";
    case Kind::kLoadPoint:
      return "load-point";
    case Kind::kOwnWeight:
      return "own-weight";
    case Kind::kLength:
      return "length:" + joint;
    case Kind::kDeflectionUnit:
      return "deflection:" +
             unit_name(kDeflectionUnits, hypothesis.factor * samples.deflection_unit_m.value_or(1));
    case Kind::kForceUnit:
      return "force:" + unit_name(kForceUnits, hypothesis.factor * samples.force_unit_n.value_or(1));
  }
  return "";
}

Json applied_to_json(const std::vector<robot::Hypothesis>& applied, const robot::Robot& robot,
                     const LoadSamplesDocument& samples) {
  Json list = Json::array();
  for (const robot::Hypothesis& hypothesis : applied) {
    list.push_back({{"name", hypothesis_name(hypothesis, robot, samples)}});
    add_fitted(hypothesis, list.back());
  }
  return list;
}

Json better_fits_to_json(const std::vector<robot::BetterFit>& better, const robot::Robot& robot,
                         const LoadSamplesDocument& samples) {
  Json list = Json::array();
  for (const robot::BetterFit& fit : better) {
    list.push_back({{"name", hypothesis_name(fit.hypothesis, robot, samples)},
                    {"residual_before_um", fit.residual_before_m * 1e6},
                    {"residual_after_um", fit.residual_after_m * 1e6},
                    {"poses_better", fit.poses_better},
                    {"poses", fit.poses}});
    add_fitted(fit.hypothesis, list.back());
  }
  return list;
}

}  // namespace stablecut::document
