#include "document/kinds/joint_stiffness_json.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "document/kinds/robot_json.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

robot::Robot kr360() {
  std::ifstream file(std::string(STABLECUT_TESTDATA) + "/kr360.json");
  return robot_from_json(Json::parse(file), {"kr360.json", ""});
}

Json six() {
  return {{"format", "stablecut/joint-stiffness/1"},
          {"stiffness_n_m_per_rad", {6e6, 5e6, 4e6, 3e6, 2e6, 1e6}}};
}

robot::JointStiffness read(const Json& document) {
  const Source source{"stiffness.json", ""};
  return joint_stiffness_from_json(document, source, kr360());
}

// An identification of the model with made-up estimates: spring k has compliance (k + 1) 1e-8, joint 4 is
// uncertain, the springs from the tenth on have the verdicts in turn.
robot::Identification made_up(robot::ElasticModel model) {
  robot::Identification found;
  found.model = model;
  found.springs = robot::springs_of(kr360(), model);
  const auto n = static_cast<Eigen::Index>(found.springs.size());
  found.compliance.resize(n);
  found.covariance = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const robot::Verdict verdict = k == 3 || k % 4 == 2  ? robot::Verdict::kUncertain
                                   : k > 9 && k % 4 == 0 ? robot::Verdict::kInseparable
                                                         : robot::Verdict::kIdentified;
    const bool estimated = verdict != robot::Verdict::kInseparable;
    found.verdict.push_back(verdict);
    found.compliance[k] = estimated ? 1e-8 * static_cast<double>(k + 1) : 0;
    for (Eigen::Index i = 0; i <= k && estimated; ++i) {
      if (found.verdict[i] != robot::Verdict::kInseparable)
        found.covariance(i, k) = found.covariance(k, i) = i == k ? 4e-18 : 1e-18;
    }
    found.low.push_back(found.compliance[k] - 4e-9);
    found.high.push_back(found.compliance[k] + 4e-9);
  }
  found.deviations_known = true;
  found.discrepancy = {0.125, 20e-6, 500};
  return found;
}

std::string place_of_error(const Json& document) {
  try {
    read(document);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a joint stiffness that is written reads back: springs, covariance, discrepancy") {
  for (const auto model :
       {robot::ElasticModel::kJointsOnly, robot::ElasticModel::kBase, robot::ElasticModel::kThreeAxis}) {
    const robot::Identification found = made_up(model);
    const Json document = identification_to_json({found, {}, {}, {}}, kr360());
    INFO(document.dump());
    CHECK(document.at("model") == model_name(model));
    const robot::JointStiffness joints = read(document);
    CHECK_FALSE(joints.stiffness[3]);
    CHECK(*joints.least[3] == Approx(1 / found.high[3]).epsilon(1e-14));
    REQUIRE(joints.others.size() + robot::kJoints == found.springs.size());
    REQUIRE(joints.errors.covariance);
    const Eigen::MatrixXd& covariance = *joints.errors.covariance;
    REQUIRE(covariance.rows() == found.covariance.rows());
    std::vector<bool> stated;
    for (std::size_t k = 0; k < found.springs.size(); ++k) {
      const bool estimated = found.verdict[k] != robot::Verdict::kInseparable;
      stated.push_back(k < robot::kJoints ? found.identified(static_cast<int>(k)) : estimated);
      if (k < robot::kJoints) {
        if (stated[k]) CHECK(*joints.stiffness[k] * found.compliance[k] == Approx(1).epsilon(1e-14));
        continue;
      }
      CHECK(joints.others[k - robot::kJoints] == found.springs[k]);
      const auto& compliance = joints.other_compliance[k - robot::kJoints];
      REQUIRE(compliance.has_value() == estimated);
      if (compliance) CHECK(*compliance == found.compliance[k]);
    }
    for (std::size_t i = 0; i < stated.size(); ++i) {
      for (std::size_t k = 0; k < stated.size(); ++k)
        CHECK(covariance(i, k) == (stated[i] && stated[k] ? found.covariance(i, k) : 0));
    }
    CHECK(joints.errors.discrepancy.relative == 0.125);
    CHECK(joints.errors.discrepancy.absolute_m == Approx(20e-6).epsilon(1e-15));
    CHECK(joints.errors.discrepancy.force_n == 500);
  }
}

TEST_CASE("springs by hand: deviations alone, without a model, and without deviations") {
  Json document = six();
  document["springs"] = {{{"name", "base.z"}, {"compliance_m_per_n", 2e-8}, {"std_m_per_n", 1e-9}},
                         {{"name", "A2.y"}, {"compliance_rad_per_n_m", 1e-7}},
                         {{"name", "A6.x"}, {"compliance_rad_per_n_m", nullptr}}};
  const robot::JointStiffness joints = read(document);
  REQUIRE(joints.others.size() == 3);
  CHECK(joints.others[0] == robot::Spring{robot::Spring::Kind::kBase, 0, 2});
  CHECK(joints.others[1] == robot::Spring{robot::Spring::Kind::kBearing, 1, 1});
  CHECK(*joints.other_compliance[1] == 1e-7);
  CHECK_FALSE(joints.other_compliance[2]);
  REQUIRE(joints.errors.covariance);
  CHECK((*joints.errors.covariance)(6, 6) == Approx(1e-18).epsilon(1e-14));
  CHECK(joints.errors.covariance->sum() == Approx(1e-18).epsilon(1e-14));
  CHECK(joints.errors.discrepancy.none());
  document["springs"][0].erase("std_m_per_n");
  CHECK_FALSE(read(document).errors.known());
  document["discrepancy"] = {{"relative", 0.1}, {"absolute_um", 0}};
  CHECK(read(document).errors.known());
  document["discrepancy"] = nullptr;
  CHECK_FALSE(read(document).errors.known());
}

TEST_CASE("springs that cannot be are refused with their place") {
  const Json base = {{"name", "base.x"}, {"compliance_m_per_n", 1e-8}};
  const Json bearing = {{"name", "A2.x"}, {"compliance_rad_per_n_m", 1e-8}};
  const auto refused = [&](const char* model, const Json& springs, const std::string& expected) {
    Json document = six();
    document["model"] = model;
    document["springs"] = springs;
    INFO(place_of_error(document));
    CHECK(place_of_error(document).find(expected) != std::string::npos);
  };
  refused("joints", Json::array({base}),
          "/springs/0/name: \"base.x\": expected no such spring in the model joints");
  refused("base", Json::array({base, bearing}),
          "/springs/1/name: \"A2.x\": expected no such spring in the model base");
  refused("stiff", Json::array({base}), "/model: \"stiff\": expected");
  refused("base", Json::array({base, base}), "/springs/1/name: \"base.x\": expected each spring once");
  refused("three-axis", {{{"name", "A2.z"}, {"compliance_rad_per_n_m", 1}}},
          "/springs/0/name: \"A2.z\": expected");
  refused("three-axis", {{{"name", "J2.x"}, {"compliance_rad_per_n_m", 1}}},
          "/springs/0/name: \"J2.x\": expected");
  refused("base", {{{"name", "base.x"}}}, "/springs/0/compliance_m_per_n: missing");
  refused("base", {{{"name", "base.x"}, {"compliance_m_per_n", -1}}},
          "/springs/0/compliance_m_per_n: -1: expected");
  refused("base", {{{"name", "base.x"}, {"compliance_rad_per_n_m", 1}}},
          "/springs/0/compliance_rad_per_n_m: 1: expected compliance_m_per_n");
  Json document = six();
  document["model"] = "base";
  CHECK(place_of_error(document).find("/springs: missing") != std::string::npos);
  document["springs"] = Json::array({base});
  document["spring_covariance"] = {{"springs", {"A1.z", "base.y"}}, {"matrix", {{1, 0}, {0, 1}}}};
  CHECK(place_of_error(document).find(
            "/spring_covariance/springs/1: \"base.y\": expected a spring of this") != std::string::npos);
  document["spring_covariance"] = {{"springs", {"A1.z", "base.x"}}, {"matrix", {{1, 2}, {2, 1}}}};
  CHECK(place_of_error(document).find("/spring_covariance/matrix: ") != std::string::npos);
  document["spring_covariance"]["matrix"] = {{1, 0}};
  CHECK(place_of_error(document).find("/spring_covariance/matrix: a list of 1: expected 2 rows") !=
        std::string::npos);
  document.erase("spring_covariance");
  document["discrepancy"] = {{"relative", -0.1}, {"absolute_um", 1}};
  CHECK(place_of_error(document).find("/discrepancy/relative: -0.1: expected") != std::string::npos);
}
