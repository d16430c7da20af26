#include "document/kinds/beam_segments_json.h"

#include "base/number_text.h"
#include "base/units.h"

namespace stablecut::document {
namespace {

constexpr Bound kPoisson{.least = 0, .most = 0.5, .words = "Poisson's ratio, from 0 to 0.5"};
constexpr Bound kLossFactor{.least = 0, .most = 1, .words = "a loss factor from 0 to 1"};
constexpr int kMostFlutes = 40;
constexpr double kFlutedDiameter = 0.8;  // equivalent diameter over the cutter's, for bending [Kops1990]
constexpr Bound kSize{.least = 0, .most = 1e6, .open_least = true, .words = "a size above 0 mm"};

// A fluted length bends, and weighs, about as a round bar of its equivalent diameter [Kops1990].
void take_flutes(const Node& item, receptance::BeamSegment& segment) {
  const auto flutes = item.find("flutes"), equivalent = item.find("equivalent_diameter_mm");
  if (flutes) flutes->integer(1, kMostFlutes);
  if (flutes && !equivalent) segment.outer_diameter_m *= kFlutedDiameter;
  if (equivalent) {
    const double diameter = metres_from_mm(equivalent->number(kSize));
    if (!(diameter <= segment.outer_diameter_m)) equivalent->fail("expected at most outer_diameter_mm");
    segment.outer_diameter_m = diameter;
  }
  if (!(segment.inner_diameter_m < segment.outer_diameter_m)) {
    item.at("inner_diameter_mm")
        .fail("expected less than the equivalent diameter of the flutes, " +
              number_text(mm_from_metres(segment.outer_diameter_m)) + " mm");
  }
}

}  // namespace

Materials materials_from(const Node& node) {
  Materials materials;
  if (!node.json().is_object()) node.fail("expected an object of materials by name");
  for (const auto& [name, unused] : node.json().items()) {
    const Node item = node.at(name);
    item.check_names({"youngs_modulus_gpa", "density_kg_per_m3", "poisson_ratio", "loss_factor"});
    receptance::BeamSegment& material = materials[name];
    material.youngs_modulus_pa = item.at("youngs_modulus_gpa").number(kPositive) * 1e9;
    material.density_kg_per_m3 = item.at("density_kg_per_m3").number(kPositive);
    material.poisson_ratio = item.at("poisson_ratio").number(kPoisson);
    material.loss_factor = item.at("loss_factor").number(kLossFactor);
  }
  return materials;
}

receptance::BeamChain segments_from(const Node& node, const Materials& materials, std::size_t least) {
  receptance::BeamChain segments;
  for (const Node& item : node.items(least)) {
    item.check_names({"length_mm", "outer_diameter_mm", "inner_diameter_mm", "material", "flutes",
                      "equivalent_diameter_mm"});
    const Node material = item.at("material");
    const auto found = materials.find(material.text());
    if (found == materials.end()) material.fail("expected one of /materials");
    receptance::BeamSegment segment = found->second;
    segment.length_m = metres_from_mm(item.at("length_mm").number(kSize));
    segment.outer_diameter_m = metres_from_mm(item.at("outer_diameter_mm").number(kSize));
    if (const auto inner = item.find("inner_diameter_mm")) {
      segment.inner_diameter_m = metres_from_mm(inner->number(kNotNegative));
      if (!(segment.inner_diameter_m < segment.outer_diameter_m))
        inner->fail("expected less than outer_diameter_mm");
    }
    take_flutes(item, segment);
    segments.push_back(segment);
  }
  return segments;
}

}  // namespace stablecut::document
