#include "document/assembly.h"

#include <map>
#include <string>

#include "base/range.h"
#include "base/units.h"
#include "document/node.h"

namespace stablecut {
namespace {

constexpr int kMostLines = 10'000'000;
constexpr Bound kPoisson{.least = 0, .most = 0.5, .words = "Poisson's ratio, from 0 to 0.5"};
constexpr Bound kLossFactor{.least = 0, .most = 1, .words = "a loss factor from 0 to 1"};
constexpr Bound kSize{.least = 0, .most = 1e6, .open_least = true, .words = "a size above 0 mm"};

using Materials = std::map<std::string, BeamSegment>;  // segments without sizes

Eigen::VectorXd frequencies_from(const Node& node) {
  if (node.json().is_object()) {
    node.check_names({"from", "to", "count"});
    const Range range{node.at("from").number(kPositive), node.at("to").number(kPositive),
                      node.at("count").integer(1, kMostLines)};
    if (range.count == 1 ? range.from != range.to : !(range.from < range.to)) {
      node.at("to").fail(range.count == 1 ? "expected the same number as from, since count is 1"
                                          : "expected a number above from");
    }
    const std::vector<double> values = range.values();
    return Eigen::Map<const Eigen::VectorXd>(values.data(), range.count);
  }
  const Eigen::VectorXd values = node.numbers(kPositive);
  if (values.size() == 0) node.fail("expected at least one frequency");
  for (Eigen::Index i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1]))
      node.items()[static_cast<std::size_t>(i)].fail("expected increasing frequencies");
  }
  return values;
}

Materials materials_from(const Node& node) {
  Materials materials;
  if (!node.json().is_object()) node.fail("expected an object of materials by name");
  for (const auto& [name, unused] : node.json().items()) {
    const Node item = node.at(name);
    item.check_names({"youngs_modulus_gpa", "density_kg_per_m3", "poisson_ratio", "loss_factor"});
    BeamSegment& material = materials[name];
    material.youngs_modulus_pa = item.at("youngs_modulus_gpa").number(kPositive) * 1e9;
    material.density_kg_per_m3 = item.at("density_kg_per_m3").number(kPositive);
    material.poisson_ratio = item.at("poisson_ratio").number(kPoisson);
    material.loss_factor = item.at("loss_factor").number(kLossFactor);
  }
  return materials;
}

std::vector<BeamSegment> segments_from(const Node& node, const Materials& materials) {
  std::vector<BeamSegment> segments;
  for (const Node& item : node.items(1)) {
    item.check_names({"length_mm", "outer_diameter_mm", "inner_diameter_mm", "material"});
    const Node material = item.at("material");
    const auto found = materials.find(material.text());
    if (found == materials.end()) material.fail("expected one of /materials");
    BeamSegment segment = found->second;
    segment.length_m = metres_from_mm(item.at("length_mm").number(kSize));
    segment.outer_diameter_m = metres_from_mm(item.at("outer_diameter_mm").number(kSize));
    if (const auto inner = item.find("inner_diameter_mm")) {
      segment.inner_diameter_m = metres_from_mm(inner->number(kNotNegative));
      if (!(segment.inner_diameter_m < segment.outer_diameter_m))
        inner->fail("expected less than outer_diameter_mm");
    }
    segments.push_back(segment);
  }
  return segments;
}

void read_holder(const Node& node, const Materials& materials, HeldTool& held) {
  node.check_names({"segments", "end", "modal_table", "receptances"});
  for (const char* other : {"modal_table", "receptances"}) {
    if (const auto found = node.find(other))
      found->fail("expected segments: this version computes holders of beams only");
  }
  held.holder = segments_from(node.at("segments"), materials);
  held.holder_fixed = node.at("end").word({"fixed", "free"}) == "fixed";
}

void read_joint(const Node& node, HeldTool& held) {
  held.joint.reset();
  if (node.json().is_string()) {
    node.word({"rigid"});
    return;
  }
  node.check_names({"k1_n_per_m", "c1_n_s_per_m", "k2_n_m_per_rad", "c2_n_m_s_per_rad"});
  held.joint = ToolJoint{
      node.at("k1_n_per_m").number(kPositive), node.at("c1_n_s_per_m").number(kNotNegative),
      node.at("k2_n_m_per_rad").number(kPositive), node.at("c2_n_m_s_per_rad").number(kNotNegative)};
}

// A value for both directions, or {"x": ..., "y": ...}.
template <typename Read>
void in_each_direction(const Node& node, AssemblyDocument& assembly, const Read& read) {
  const bool apart = node.has("x") || node.has("y");
  assembly.axisymmetric = assembly.axisymmetric && !apart;
  if (apart) node.check_names({"x", "y"});
  read(apart ? node.at("x") : node, assembly.held[0]);
  read(apart ? node.at("y") : node, assembly.held[1]);
}

}  // namespace

AssemblyDocument assembly_from_json(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "assembly");
  root.check_names(
      {"format", "frequency_hz", "beam_theory", "materials", "tool", "holder", "joint", "provenance"});
  AssemblyDocument assembly;
  assembly.frequency_hz = frequencies_from(root.at("frequency_hz"));
  const std::string theory = root.at("beam_theory").word({"timoshenko", "euler-bernoulli"});
  assembly.theory = theory == "timoshenko" ? BeamTheory::kTimoshenko : BeamTheory::kEulerBernoulli;
  const Materials materials = materials_from(root.at("materials"));
  const Node tool = root.at("tool");
  tool.check_names({"segments"});
  assembly.tool = segments_from(tool.at("segments"), materials);
  in_each_direction(root.at("holder"), assembly,
                    [&](const Node& node, HeldTool& held) { read_holder(node, materials, held); });
  in_each_direction(root.at("joint"), assembly, read_joint);
  return assembly;
}

}  // namespace stablecut
