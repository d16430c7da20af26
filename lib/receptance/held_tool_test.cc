#include "receptance/held_tool.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "receptance/assembly.h"
#include "receptance/receptance_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::receptance;
using namespace stablecut::receptance::fixtures;

namespace {

const BeamChain kTool = {bar(60), bar(3), bar(55.92)};

// A stepped tool, so that places along it differ.
BeamChain stepped() {
  BeamChain chain = {bar(40), bar(25), bar(30)};
  chain[1].outer_diameter_m = 0.016;
  chain[2].outer_diameter_m = 0.02;
  return chain;
}

// Something unsymmetric that holds: a spring with a little of everything.
Receptance<2> some_holder() {
  return Receptance<2>{{{2e-8, -1e-9}, {3e-7, -2e-8}}, {{2e-7, -1e-8}, {1e-5, -4e-7}}};
}

Receptance<4> some_coupled_holder() {
  Receptance<4> holder = in_all_directions<4>(some_holder());
  holder.topRightCorner<2, 2>() = 0.3 * some_holder();
  holder.bottomLeftCorner<2, 2>() = -0.2 * some_holder();
  return holder;
}

}  // namespace

TEST_CASE("a cantilever of short held segments is the cantilever, from 1 Hz on") {
  for (const BeamTheory theory : kBoth) {
    double worst = 0;
    for (double f = 1; f <= 20000; f *= 1.03) {
      const double omega = rad_per_s_from_hz(f);
      const Receptance<2> holder =
          held_chain<2>({bar(10), bar(2), bar(38.90)}, theory, omega, Receptance<2>::Zero());
      const Receptance<2> tip = held_chain<2>(kTool, theory, omega, holder);
      worst = std::max(worst, relative(tip, fixed_free_receptance(bar(169.82), theory, omega)));
    }
    CHECK(worst < 1e-11);
  }
}

TEST_CASE("free parts joined are the one free part") {
  for (const BeamTheory theory : kBoth) {
    for (const double f : {300.0, 2000.0, 9000.0}) {
      const double omega = rad_per_s_from_hz(f);
      const BeamReceptances parts = free_chain(kTool, theory, omega),
                            whole = SegmentMotion(bar(118.92), theory, omega).free();
      CHECK(relative(parts.r11, whole.r11) < 1e-9);
      CHECK(relative(parts.r12, whole.r12) < 1e-9);
      CHECK(relative(parts.r21, whole.r21) < 1e-9);
      CHECK(relative(parts.r22, whole.r22) < 1e-9);
    }
  }
}

TEST_CASE(
    "a segment of 1e-6 mm is a piece of the bar like any other: held, free, through a joint, along the "
    "tool") {
  const double thin = 1e-6;  // mm
  const ToolJoint joint{5e7, 200, 5e4, 0.5};
  const BeamChain whole = {bar(118.92)};
  const BeamChain cut[] = {{bar(60), bar(thin), bar(58.92 - thin)},
                           {bar(thin), bar(118.92 - thin)},
                           {bar(118.92 - thin), bar(thin)},
                           {bar(thin), bar(thin), bar(118.92 - 4 * thin), bar(thin), bar(thin)}};
  for (const BeamTheory theory : kBoth) {
    for (double f = 1; f <= 20000; f *= 1.3) {
      const double omega = rad_per_s_from_hz(f);
      const Receptance<2> held = held_chain<2>(whole, theory, omega, some_holder());
      const BeamReceptances free = free_chain(whole, theory, omega);
      const Receptance<2> tip =
          joint_plane<2>(whole, theory, omega, some_holder()).tip(joint.stiffness(omega));
      const Receptance<2> along = receptance_along<2>(whole, theory, omega, some_holder(), 0, 0.05);
      for (const BeamChain& chain : cut) {
        CHECK(relative(held_chain<2>(chain, theory, omega, some_holder()), held) < 1e-9);
        const BeamReceptances parts = free_chain(chain, theory, omega);
        CHECK(relative(parts.r11, free.r11) < 1e-9);
        CHECK(relative(parts.r12, free.r12) < 1e-9);
        CHECK(relative(parts.r21, free.r21) < 1e-9);
        CHECK(relative(parts.r22, free.r22) < 1e-9);
        CHECK(relative(joint_plane<2>(chain, theory, omega, some_holder()).tip(joint.stiffness(omega)), tip) <
              1e-9);
        CHECK(relative(receptance_along<2>(chain, theory, omega, some_holder(), 0, 0.05), along) < 1e-8);
      }
    }
  }
}

TEST_CASE("through a joint: as the joint sees it, or by coupling, the same tip") {
  const ToolJoint joint{5e7, 200, 5e4, 0.5};
  for (const BeamTheory theory : kBoth) {
    for (const double f : {50.0, 800.0, 5000.0}) {
      const double omega = rad_per_s_from_hz(f);
      for (const Receptance<2>& holder : {fixed_free_receptance(bar(50.90), theory, omega), some_holder()}) {
        Receptance<2> with_joint = holder;
        with_joint.diagonal() += joint.stiffness(omega).cwiseInverse();
        const Receptance<2> coupled = coupled_tip<2>(free_chain(stepped(), theory, omega), with_joint);
        const JointPlane<2> plane = joint_plane<2>(stepped(), theory, omega, holder);
        CHECK(relative(plane.tip(joint.stiffness(omega)), coupled) < 1e-9);
        CHECK(relative(holder_of_tip<2>(free_chain(stepped(), theory, omega), coupled), with_joint) < 1e-8);
      }
    }
  }
}

TEST_CASE("a holder that couples x and y: carried outwards, by the joint's plane and by coupling, the same") {
  const double omega = rad_per_s_from_hz(1200);
  const BeamTheory theory = BeamTheory::kTimoshenko;
  const Receptance<4> holder = some_coupled_holder();
  const Receptance<4> carried = held_chain<4>(stepped(), theory, omega, holder);
  const Receptance<4> coupled = coupled_tip<4>(free_chain(stepped(), theory, omega), holder);
  CHECK((carried - coupled).norm() < 1e-10 * coupled.norm());
  CHECK(carried.topRightCorner<2, 2>().norm() > 1e-3 * carried.norm());
  Eigen::Vector4cd stiffness;
  stiffness << ToolJoint{1e7, 10, 1e5, 1}.stiffness(omega), ToolJoint{3e7, 20, 2e5, 2}.stiffness(omega);
  Receptance<4> with_joint = holder;
  with_joint.diagonal() += stiffness.cwiseInverse();
  const Receptance<4> expected = coupled_tip<4>(free_chain(stepped(), theory, omega), with_joint);
  CHECK((joint_plane<4>(stepped(), theory, omega, holder).tip(stiffness) - expected).norm() <
        1e-10 * expected.norm());
}

TEST_CASE("a mass on the tip: a short heavy stub, on the tip and as the joint sees it") {
  // A stub so short that it is a mass, of 20 g.
  BeamSegment stub = bar(0.01);
  stub.density_kg_per_m3 = 0.02 / (stub.length_m * 3.141592653589793 / 4 * 0.012 * 0.012);
  const ToolJoint joint{5e7, 200, 5e4, 0.5};
  const BeamTheory theory = BeamTheory::kTimoshenko;
  for (const double f : {100.0, 700.0, 3000.0}) {
    const double omega = rad_per_s_from_hz(f);
    const JointPlane<2> plane = joint_plane<2>(stepped(), theory, omega, some_holder());
    const std::complex<double> with = with_tip_mass<2>(plane, 0.02, omega).tip(joint.stiffness(omega))(0, 0);
    const Receptance<2> bare = plane.tip(joint.stiffness(omega));
    CHECK(std::abs(with - with_mass<2>(bare, 0.02, omega)(0, 0)) < 1e-12 * std::abs(with));
    CHECK((with_mass<2>(with_mass<2>(bare, 0.02, omega), -0.02, omega) - bare).norm() < 1e-12 * bare.norm());
    const std::complex<double> stubbed =
        held_chain<2>({stub}, BeamTheory::kEulerBernoulli, omega, bare)(0, 0);
    CHECK(std::abs(with - stubbed) < 3e-3 * std::abs(with));
    CHECK(std::abs(with - bare(0, 0)) > 1e-3 * std::abs(with));
  }
}

TEST_CASE("along the tool: the ends, reciprocity, and a load between two parts") {
  const BeamTheory theory = BeamTheory::kTimoshenko;
  const BeamChain tool = stepped();
  for (const double f : {150.0, 1200.0, 6000.0}) {
    const double omega = rad_per_s_from_hz(f);
    const Receptance<2> holder = fixed_free_receptance(bar(50), theory, omega);
    const auto along = [&](double a, double b) {
      return receptance_along<2>(tool, theory, omega, holder, a, b);
    };
    CHECK(relative(along(0, 0), held_chain<2>(tool, theory, omega, holder)) < 1e-9);
    for (const auto& [a, b] : {std::pair(0.0, 0.03), std::pair(0.01, 0.07), std::pair(0.02, 0.095)}) {
      CHECK(relative(along(a, b), along(b, a).transpose()) < 1e-9);
    }
    // Slopes are what deflections do between near places.
    const double near = 1e-5;
    const std::complex<double> slope = (along(0, 0.05) - along(near, 0.05))(0, 0) / near;
    CHECK(std::abs(slope - along(near / 2, 0.05)(1, 0)) < 1e-4 * std::abs(slope));
    // The free tool is the one that nothing holds: a holder that gives way to everything.
    const Receptance<2> nothing = 1e6 * Receptance<2>::Identity();
    CHECK(relative(free_receptance_along(tool, theory, omega, 0.01, 0.06),
                   receptance_along<2>(tool, theory, omega, nothing, 0.01, 0.06)) < 1e-5);
    const BeamReceptances free = free_chain(tool, theory, omega);
    CHECK(relative(free_response_to_end(tool, theory, omega, 0), free.r12) < 1e-12);
    CHECK(relative(free_response_to_end(tool, theory, omega, 0.095), free.r22) < 1e-12);
    CHECK(relative(free_receptance_along(tool, theory, omega, 0.095, 0), free.r21) < 1e-9);
    CHECK(relative(free_response_to_end(tool, theory, omega, 0.03),
                   free_receptance_along(tool, theory, omega, 0.03, 0.095)) < 1e-9);
  }
  // 0.1 + 0.2 is above 0.3 in double precision: the place is the end all the same, and no piece of 3e-17 m.
  const BeamChain decimal = {bar(100), bar(200)};
  const double omega = rad_per_s_from_hz(1200);
  CHECK(relative(free_receptance_along(decimal, theory, omega, 0.3, 0),
                 free_chain(decimal, theory, omega).r21) < 1e-12);
  CHECK(relative(receptance_along<2>(decimal, theory, omega, some_holder(), 0.3, 0.3),
                 receptance_along<2>(decimal, theory, omega, some_holder(), 0.1 + 0.2, 0.1 + 0.2)) < 1e-12);
  CHECK_THROWS_AS(receptance_along<2>(tool, theory, 1, Receptance<2>::Zero(), 0, 0.1), InvalidArgument);
  CHECK_THROWS_AS(receptance_along<2>(tool, theory, 1, Receptance<2>::Zero(), -1e-3, 0), InvalidArgument);
}

TEST_CASE("an assembly: coupled directions without coupling are the uncoupled ones") {
  Assembly assembly;
  assembly.frequency_hz = Eigen::VectorXd::LinSpaced(3, 200, 2000);
  assembly.tool = stepped();
  assembly.axisymmetric = false;
  assembly.tip_mass_kg = 0.01;
  for (HeldBy& held : assembly.held) held = {{bar(20)}, HolderEnd::kGiven, ToolJoint{5e7, 200, 5e4, 0.5}};
  assembly.held[1].joint->k2 = 1e5;
  assembly.given.assign(3, in_all_directions<4>(some_holder()));
  const Receptance<4> apart = assembly.tip(1), along = assembly.along_tool(1, 0.01, 0.02);
  assembly.couples_directions = true;
  CHECK((assembly.tip(1) - apart).norm() < 1e-10 * apart.norm());
  CHECK((assembly.along_tool(1, 0.01, 0.02) - along).norm() < 1e-10 * along.norm());
  CHECK((apart.topLeftCorner<2, 2>() - apart.bottomRightCorner<2, 2>()).norm() > 1e-4 * apart.norm());
  assembly.given.assign(3, some_coupled_holder());
  CHECK(assembly.tip(1).topRightCorner<2, 2>().norm() > 1e-3 * apart.norm());
}
