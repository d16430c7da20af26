#include "document/kinds/assembly_json.h"

#include <catch2/catch.hpp>

#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

// A bar on a holder that was measured on two lines; `entries` are those of its frequency response document.
AssemblyDocument assembly_on(const Json& entries) {
  Json document = {
      {"format", "stablecut/assembly/1"},
      {"frequency_hz", {100, 200}},
      {"beam_theory", "timoshenko"},
      {"materials",
       {{"steel",
         {{"youngs_modulus_gpa", 205},
          {"density_kg_per_m3", 7850},
          {"poisson_ratio", 0.29},
          {"loss_factor", 0}}}}},
      {"tool", {{"segments", {{{"length_mm", 80}, {"outer_diameter_mm", 12}, {"material", "steel"}}}}}},
      {"joint", "rigid"}};
  document["holder"]["receptances"] = {{"format", "stablecut/frf/1"},
                                       {"quantity", "receptance"},
                                       {"frequency_hz", {100, 200}},
                                       {"h", entries}};
  const Source source{"a.json", ""};
  return assembly_from_json(document, source, assembly_frequencies(document, source),
                            [](const std::string&) -> Input { throw std::logic_error("no file is named"); });
}

Json entry(const char* response, const char* reference, double places_mm, double size, double sign = -1) {
  return {{"response", response},       {"reference", reference},
          {"re", {size, size}},         {"im", {sign * 0.1 * size, sign * 0.1 * size}},
          {"variance", {1e-20, 1e-20}}, {"reference_position_mm", places_mm}};
}

}  // namespace

TEST_CASE("findings of a measured holder: kinds, places and numbers") {
  using Kind = HolderFinding::Kind;
  const AssemblyDocument one = assembly_on({entry("x", "x", 0, 1e-7), entry("x", "x", 20, 0.8e-7)});
  REQUIRE(one.findings.size() == 2);
  CHECK(one.findings[0].kind == Kind::kTakenFromOther);
  CHECK(one.findings[0].direction == 1);
  CHECK(one.findings[0].place == "a.json: /holder/receptances");
  CHECK(one.findings[1].kind == Kind::kLimits);
  CHECK(one.findings[1].direction == 0);
  CHECK(one.findings[1].quality.spacing_m == Approx(0.02));
  CHECK(one.findings[1].quality.unphysical_hz.empty());
  CHECK(one.findings[1].lines == 2);
  CHECK(one.assembly.given[1](2, 2) == one.assembly.given[1](0, 0));
  // Of the wrong sign: both lines give energy away. An entry across of a direction that was not measured.
  const AssemblyDocument wrong =
      assembly_on({entry("x", "x", 0, 1e-7, 1), entry("x", "x", 20, 0.8e-7, 1), entry("y", "x", 0, 1e-8)});
  REQUIRE(wrong.findings.size() == 3);
  CHECK(wrong.findings[1].quality.unphysical_hz.size() == 2);
  CHECK(wrong.findings[2].kind == Kind::kCrossLeftOut);
  CHECK_FALSE(wrong.assembly.couples_directions);
}

TEST_CASE("a holder whose slopes were measured well has no findings") {
  Json entries = Json::array();
  for (const char* d : {"x", "y"}) {
    const std::string slope = std::string("slope_") + d;
    entries.push_back(entry(d, d, 0, 1e-7));
    entries.push_back(entry(d, slope.c_str(), 0, 1e-6));
    entries.push_back(entry(slope.c_str(), d, 0, 1e-6));
    entries.push_back(entry(slope.c_str(), slope.c_str(), 0, 1e-4));
  }
  const AssemblyDocument document = assembly_on(entries);
  CHECK(document.findings.empty());
  REQUIRE(document.quality[1].has_value());
  CHECK(document.quality[1]->slopes == receptance::SlopeSource::kMeasured);
  CHECK(holder_quality_to_json(document)["x"]["slopes"] == "measured");
}
