#include "receptance/assembly.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "receptance/assembly_identification.h"
#include "receptance/assembly_response.h"
#include "receptance/receptance_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::receptance;
using namespace stablecut::receptance::fixtures;

namespace {

// Section 3 of [Liu2014] on a few lines, with another joint in y.
Assembly two_joints() {
  Assembly assembly;
  assembly.frequency_hz = Eigen::VectorXd::LinSpaced(200, 20, 4000);
  assembly.theory = BeamTheory::kEulerBernoulli;
  assembly.tool = {bar(118.92)};
  for (HeldBy& held : assembly.held) held = {{bar(50.90)}, HolderEnd::kFixed, std::nullopt};
  assembly.set_joints({ToolJoint{5e7, 200, 5e4, 0.5}, ToolJoint{3e7, 100, 8e4, 0.5}});
  return assembly;
}

}  // namespace

TEST_CASE("an assembly is axisymmetric until its joints differ") {
  Assembly assembly = two_joints();
  CHECK_FALSE(assembly.axisymmetric);
  assembly.axisymmetric = true;
  assembly.set_joints({ToolJoint{5e7, 200, 5e4, 0.5}, ToolJoint{5e7, 200, 5e4, 0.5}});
  CHECK(assembly.axisymmetric);
  assembly.set_joints({});
  CHECK(assembly.axisymmetric);
  assembly.set_joints({ToolJoint{5e7, 200, 5e4, 0.5}, std::nullopt});
  CHECK_FALSE(assembly.axisymmetric);
}

TEST_CASE("a holder whose inner end is free: the free beam's receptance at its face") {
  Assembly assembly = two_joints();
  assembly.held[0].end = HolderEnd::kFree;
  const double omega = rad_per_s_from_hz(assembly.frequency_hz[7]);
  CHECK(relative(assembly.holder(0, 7), SegmentMotion(bar(50.90), assembly.theory, omega).free().r11) <
        1e-12);
  assembly.held[0].segments = {bar(20), bar(30.90)};
  CHECK(relative(assembly.holder(0, 7), SegmentMotion(bar(50.90), assembly.theory, omega).free().r11) < 1e-9);
  assembly.held[0].segments.clear();
  CHECK_THROWS_AS(assembly.holder(0, 7), InvalidArgument);
}

TEST_CASE("responses of an assembly: entries in order, values of the tip and along the tool") {
  const Assembly assembly = two_joints();
  const dynamics::FrequencyResponse tip = assembly_response(assembly, {}, 1);
  REQUIRE(tip.entries.size() == 4);
  CHECK(tip.entries[1].response + tip.entries[1].reference == "xy");
  CHECK_FALSE(tip.entries[0].response_position_m.has_value());
  CHECK(tip.entries[3].h[50] == assembly.tip(50)(2, 2));
  CHECK(tip.entries[1].h.isZero(0));
  const dynamics::FrequencyResponse along = assembly_response(assembly, {true, {0, 0.04}}, 2);
  REQUIRE(along.entries.size() == 4 * 16);
  const auto& entry = along.entries[16 + 4];  // response at 0, reference at 40 mm; slope_x by x
  CHECK(entry.response + " " + entry.reference == "slope_x x");
  CHECK(*entry.response_position_m == 0);
  CHECK(*entry.reference_position_m == 0.04);
  CHECK(entry.h[50] == assembly.along_tool(50, 0, 0.04)(1, 0));
}

TEST_CASE("the joints of an assembly from its tip, direction by direction") {
  const Assembly assembly = two_joints();
  dynamics::FrequencyResponse measured = assembly_response(assembly, {}, 1);
  const auto found = [&](const Assembly& model) {
    return identify_joints(model, tip_entries(measured), {}, JointObjective::kComplex, 2);
  };
  IdentifiedJoints joints = found(assembly);
  REQUIRE((joints.estimate[0] && joints.estimate[1]));
  CHECK_FALSE(joints.one_for_both);
  CHECK(joints.estimate[0]->joint.k1 == Approx(5e7).epsilon(1e-6));
  CHECK(joints.estimate[1]->joint.k1 == Approx(3e7).epsilon(1e-6));
  // Equal in x and y only where both the assembly and the measurement are.
  Assembly round = assembly;
  round.axisymmetric = true;
  measured.entries[3].h = measured.entries[0].h;
  CHECK(found(round).one_for_both);
  CHECK_FALSE(found(assembly).one_for_both);
  measured.entries[3].variance = Eigen::VectorXd::Constant(200, 1e-20);
  CHECK_FALSE(found(round).one_for_both);
  // A direction that was not measured, or not at the tip.
  measured.entries[0].reference_position_m = 0.01;
  joints = found(round);
  CHECK_FALSE(joints.estimate[0].has_value());
  CHECK(joints.estimate[1].has_value());
}
