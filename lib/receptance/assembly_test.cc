#include "receptance/assembly.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "base/error.h"
#include "numerics/random.h"
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

TEST_CASE("a tool on a wall: clamped by a rigid joint, on springs by another") {
  Assembly assembly = two_joints();
  for (HeldBy& held : assembly.held) held.segments.clear();
  assembly.set_joints({std::nullopt, ToolJoint{5e7, 200, 5e4, 0.5}});
  const BeamSegment tool = bar(118.92);
  const double pi = std::numbers::pi, d = tool.outer_diameter_m, length = tool.length_m;
  for (Eigen::Index line = 10; line < assembly.frequency_hz.size(); line += 17) {
    const double omega = rad_per_s_from_hz(assembly.frequency_hz[line]);
    // The clamped beam's closed form [Bishop1960].
    const std::complex<double> ei =
        tool.youngs_modulus_pa * std::complex<double>(1, tool.loss_factor) * (pi / 64 * std::pow(d, 4));
    const std::complex<double> lambda =
        std::pow(tool.density_kg_per_m3 * (pi / 4) * d * d * omega * omega / ei, 0.25);
    const std::complex<double> x = lambda * length;
    const std::complex<double> clamped = (std::sin(x) * std::cosh(x) - std::cos(x) * std::sinh(x)) /
                                         (lambda * lambda * lambda * ei * (1.0 + std::cos(x) * std::cosh(x)));
    const Receptance<4> tip = assembly.tip(line);
    CHECK(std::abs(tip(0, 0) - clamped) < 1e-9 * std::abs(clamped));
    CHECK(assembly.along_tool(line, length, length).topLeftCorner<2, 2>().isZero(0));
    // On springs: the free beam, coupled to them.
    const Receptance<2> springs = assembly.held[1].joint->stiffness(omega).cwiseInverse().asDiagonal();
    const Receptance<2> sprung = coupled_tip<2>(SegmentMotion(tool, assembly.theory, omega).free(), springs);
    CHECK(relative(tip.bottomRightCorner<2, 2>(), sprung) < 1e-9);
  }
  // At rest the springs and the beam add up: 1 / k1 + l^2 / k2 + l^3 / (3 E I).
  assembly.frequency_hz = Eigen::VectorXd::Constant(1, 1e-3);
  const double ei = tool.youngs_modulus_pa * pi / 64 * std::pow(d, 4);
  CHECK(assembly.tip(0)(2, 2).real() ==
        Approx(1 / 5e7 + length * length / 5e4 + std::pow(length, 3) / (3 * ei) / (1 + 0.02 * 0.02))
            .epsilon(1e-7));
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

TEST_CASE("taps of two averages: intervals cover, as their variance is pooled over lines") {
  const Assembly model = two_joints();
  const std::array<JointValues, 2> truth = {values_of(*model.held[0].joint), values_of(*model.held[1].joint)};
  dynamics::FrequencyResponse clean = assembly_response(model, {}, 1);
  std::mt19937_64 random(11);
  int counted = 0, covered = 0;
  for (int run = 0; run < 40; ++run) {
    dynamics::FrequencyResponse tap = clean;
    for (dynamics::FrequencyResponseEntry& entry : tap.entries) {
      entry.averages = 2;
      entry.variance.resize(entry.h.size());
      for (Eigen::Index i = 0; i < entry.h.size(); ++i) {
        // One degree of freedom, independent of the mean's error.
        const double deviation = 0.02 * std::abs(entry.h[i]);
        entry.variance[i] = std::norm(deviation * numerics::unit_complex_normal(random));
        entry.h[i] += deviation * numerics::unit_complex_normal(random);
      }
    }
    const IdentifiedJoints found = identify_joints(model, tip_entries(tap), {}, JointObjective::kComplex, 2);
    for (std::size_t d = 0; d < 2; ++d) {
      const JointValues values = values_of(found.estimate[d]->joint);
      for (std::size_t i = 0; i < 4; ++i) {
        if (!found.estimate[d]->identifiable[i]) continue;
        ++counted;
        covered += std::abs(values[i] - truth[d][i]) < 1.96 * found.estimate[d]->deviation[i] ? 1 : 0;
      }
    }
  }
  CHECK(counted > 200);
  CHECK(covered > 0.89 * counted);  // 94 % of 200 to 320: three of their deviations lower
}
