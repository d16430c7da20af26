#include "receptance/plausibility.h"

#include <catch2/catch.hpp>

#include "receptance/receptance_fixtures_test.h"

using namespace stablecut::receptance;
using namespace stablecut::receptance::fixtures;

namespace {

struct Solid {
  const char* name;
  double modulus_gpa, density;
};

// Of handbooks: the slowest and the fastest, the lightest and the heaviest, and what tools are made of.
const Solid kSolids[] = {{"steel", 210, 7850},        {"carbide", 600, 14500},        {"aluminium", 70, 2700},
                         {"titanium", 114, 4430},     {"tungsten", 411, 19300},       {"invar", 141, 8100},
                         {"carbon fibre", 140, 1600}, {"polymer concrete", 40, 2400}, {"granite", 50, 2700},
                         {"diamond", 1220, 3515},     {"beryllium", 287, 1850},       {"osmium", 560, 22590},
                         {"lead", 16, 11340},         {"thallium", 8, 11850},         {"gold", 79, 19300},
                         {"polyethylene", 0.2, 920},  {"teflon", 0.5, 2200},          {"balsa", 3, 160},
                         {"magnesium", 45, 1740},     {"cast iron", 110, 7200}};

}  // namespace

TEST_CASE("no solid is doubted, and each is found again from numbers in other units") {
  for (const Solid& solid : kSolids) {
    INFO(solid.name);
    CHECK_FALSE(material_doubt(solid.modulus_gpa * 1e9, solid.density));
    const auto factors = [&](double modulus, double density) {
      return material_doubt(modulus * solid.modulus_gpa * 1e9, density * solid.density);
    };
    // In Pa, and in the units of finite elements: MPa and t/mm3.
    CHECK(factors(1e9, 1));
    CHECK(factors(1e3, 1e-12));
    CHECK(factors(1, 1e-3));  // g/cm3
    CHECK(factors(1, 1e3));
  }
  // Of what tools are made of: the very factor, for one or both numbers.
  for (int i = 0; i < 6; ++i) {
    INFO(kSolids[i].name);
    for (const double modulus : {1.0, 1e3, 1e9, 1e-3}) {
      for (const double density : {1.0, 1e-3, 1e-9, 1e-12}) {
        if (modulus == 1 && density == 1) continue;
        if (modulus == 1e-3 && density == 1e-3) continue;  // the wave speed is right
        const auto doubt =
            material_doubt(modulus * kSolids[i].modulus_gpa * 1e9, density * kSolids[i].density);
        REQUIRE(doubt);
        CHECK(doubt->modulus_factor * modulus == Approx(1));
        CHECK(doubt->density_factor * density == Approx(1));
      }
    }
  }
}

TEST_CASE("which number is doubted, and numbers that no unit explains") {
  using Kind = MaterialDoubt::Kind;
  CHECK(material_doubt(200e12, 7800)->kind == Kind::kModulus);
  CHECK(material_doubt(200e9, 7.8)->kind == Kind::kDensity);
  CHECK(material_doubt(200e9, 7.8e6)->kind == Kind::kDensity);
  const auto slow = material_doubt(0.2e9, 7800);
  REQUIRE(slow);
  CHECK(slow->kind == Kind::kWaveSpeed);
  CHECK(slow->wave_speed_m_per_s == Approx(160.13).epsilon(1e-4));
  const auto absurd = material_doubt(1e200, 1e200);
  REQUIRE(absurd);
  CHECK(absurd->modulus_factor == 1);
  CHECK(absurd->density_factor == 1);
}

TEST_CASE("sizes in metres taken for millimetres; a micro tool is none") {
  BeamChain tool = {bar(40), bar(60)};
  CHECK_FALSE(size_doubt(tool));
  for (BeamSegment& segment : tool) segment.outer_diameter_m *= 1e-3;
  CHECK(size_doubt(tool) == SizeDoubt::kDiameter);
  tool = {bar(0.04), bar(0.06)};
  CHECK(size_doubt(tool) == SizeDoubt::kLength);
  // A cutter of 10 um on a shank of 3 mm.
  tool = {bar(0.03), bar(38)};
  tool[0].outer_diameter_m = 1e-5;
  tool[1].outer_diameter_m = 3e-3;
  CHECK_FALSE(size_doubt(tool));
}
