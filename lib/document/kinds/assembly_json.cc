#include "document/kinds/assembly_json.h"

#include <initializer_list>

#include "base/error.h"
#include "base/number_text.h"
#include "base/range.h"
#include "base/units.h"
#include "document/kinds/beam_segments_json.h"
#include "document/kinds/frf_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/kinds/tool_joint_json.h"
#include "document/measured/frf_import.h"
#include "document/text/data_error.h"
#include "document/text/node.h"

namespace stablecut::document {
namespace {

constexpr int kMostLines = 10'000'000;
constexpr Bound kPosition{.least = 0, .words = "a distance from the tip, not below 0 mm"};

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
    if (!(values[i] > values[i - 1])) node.items()[i].fail("expected increasing frequencies");
  }
  return values;
}

// ---- documents inside ----

// A document and where it begins: in a file of its own, or inside the assembly document.
struct Found {
  Input input;
  std::string pointer;
};

Found document_at(const Node& node, const DocumentLoader& load) {
  if (const auto file = node.find("file")) {
    if (file->text().empty()) file->fail("expected the path of a file");
    return {load(file->text()), ""};
  }
  return {{node.source(), node.json()}, node.pointer()};
}

// One item of `receptances`: a frequency response document, or a measured file and the places of its entries.
dynamics::FrequencyResponse responses_of(const Node& node, const DocumentLoader& load,
                                         std::vector<Remark>& remarks) {
  const Found found = document_at(node, load);
  dynamics::FrequencyResponse frf;
  if (found.input.document.is_null()) {
    FrfChoice choice;
    if (const auto name = node.find("quantity"))
      choice.quantity = quantity_from_name(name->word({"receptance", "mobility", "accelerance"}));
    if (const auto unit = node.find("unit")) {
      choice.unit = frf_unit(unit->text());
      if (!choice.unit) unit->fail("expected a unit of a response over a force, as um/N");
    }
    frf = import_frf(found.input, choice, remarks);
  } else {
    frf = frf_from_json(found.input.document, found.input.source, found.pointer);
  }
  refuse_window(frf, found.input.source, found.pointer);
  if (!node.has("file")) return frf;
  node.check_names({"file", "quantity", "unit", "response_position_mm", "reference_position_mm"});
  for (auto& entry : frf.entries) {
    if (const auto place = node.find("response_position_mm"))
      entry.response_position_m = metres_from_mm(place->number(kPosition));
    if (const auto place = node.find("reference_position_mm"))
      entry.reference_position_m = metres_from_mm(place->number(kPosition));
  }
  return frf;
}

dynamics::FrequencyResponse receptances_from(const Node& node, const DocumentLoader& load,
                                             std::vector<Remark>& remarks) {
  if (!node.json().is_array()) return responses_of(node, load, remarks);
  const auto items = node.items(1);
  dynamics::FrequencyResponse all = responses_of(items[0], load, remarks);
  for (std::size_t i = 1; i < items.size(); ++i) {
    dynamics::FrequencyResponse more = responses_of(items[i], load, remarks);
    if (more.quantity != all.quantity)
      items[i].fail("expected the same quantity as in the first item of the list");
    if (!dynamics::same_values(more.frequency_hz, all.frequency_hz))
      items[i].fail("expected the same lines as in the first item of the list");
    for (auto& entry : more.entries) {
      for (const auto& other : all.entries) {
        if (!other.same_places(entry)) continue;
        items[i].fail(entry.response + entry.reference +
                      " at these places is in the list already: expected each entry once");
      }
      all.entries.push_back(std::move(entry));
    }
  }
  return all;
}

// ---- holder and joint ----

class AssemblyReader {
 public:
  AssemblyReader(const Node& root, const Eigen::VectorXd& frequency_hz, const DocumentLoader& load)
      : root_(root), load_(load), materials_(materials_from(root.at("materials"))) {
    assembly_.frequency_hz = frequency_hz;
  }

  AssemblyDocument read() {
    const std::string theory = root_.at("beam_theory").word({"timoshenko", "euler-bernoulli"});
    assembly_.theory = theory == "timoshenko" ? receptance::BeamTheory::kTimoshenko
                                              : receptance::BeamTheory::kEulerBernoulli;
    const Node tool = root_.at("tool");
    tool.check_names({"segments"});
    find_material_doubts(root_.at("materials"));
    assembly_.tool = chain_from(tool.at("segments"), 1);
    if (const auto mass = root_.find("sensor_mass_g"))
      assembly_.tip_mass_kg = 1e-3 * mass->number(kNotNegative);
    in_each_direction(root_.at("holder"), [&](const Node& node, bool x, bool y) { read_holder(node, x, y); });
    in_each_direction(root_.at("joint"), [&](const Node& node, bool x, bool y) {
      std::optional<receptance::ToolJoint> joint;
      if (node.json().is_string()) {
        node.word({"rigid"});
      } else {
        node.check_names({"k1_n_per_m", "c1_n_s_per_m", "k2_n_m_per_rad", "c2_n_m_s_per_rad"});
        joint = tool_joint_from(node);
      }
      if (x) assembly_.held[0].joint = joint;
      if (y) assembly_.held[1].joint = joint;
    });
    return std::move(document_);
  }

 private:
  // A value for both directions, or {"x": ..., "y": ...}.
  template <typename Read>
  void in_each_direction(const Node& node, const Read& read) {
    if (!node.json().is_object() || !(node.has("x") || node.has("y"))) return read(node, true, true);
    node.check_names({"x", "y"});
    assembly_.axisymmetric = false;
    read(node.at("x"), true, false);
    read(node.at("y"), false, true);
  }

  receptance::BeamChain chain_from(const Node& node, std::size_t least) {
    receptance::BeamChain chain = segments_from(node, materials_, least);
    if (chain.empty()) return chain;
    if (const auto doubt = receptance::size_doubt(chain))
      document_.size_doubts.push_back({place(node), *doubt, chain});
    return chain;
  }

  void find_material_doubts(const Node& node) {
    for (const auto& [name, material] : materials_) {
      if (const auto doubt =
              receptance::material_doubt(material.youngs_modulus_pa, material.density_kg_per_m3))
        document_.material_doubts.push_back({place(node.at(name)), *doubt, material});
    }
  }

  static void forbid(const Node& node, std::initializer_list<const char*> names, const char* expected) {
    for (const char* name : names) {
      if (const auto found = node.find(name)) found->fail(expected);
    }
  }

  void read_holder(const Node& node, bool x, bool y) {
    receptance::HeldBy held;
    std::optional<Node> given;
    if (node.json().is_string()) {
      node.word({"fixed"});
    } else if (node.has("modal_table") || node.has("receptances")) {
      forbid(node, {"segments", "end"},
             "expected either segments and an end, which may hold modal_table or receptances, or one of "
             "these alone");
      given = node;
    } else {
      node.check_names({"segments", "end", "sensor_mass_g", "artefact"});
      forbid(node, {"sensor_mass_g", "artefact"}, "expected only beside receptances");
      const Node end = node.at("end");
      if (end.json().is_object()) {
        given = end;
      } else if (end.word({"fixed", "free"}) == "free") {
        held.end = receptance::HolderEnd::kFree;
      }
      // Only what is free needs a segment: any other end may be the joint's face itself.
      const bool free = held.end == receptance::HolderEnd::kFree;
      if (free || node.has("segments")) held.segments = chain_from(node.at("segments"), free ? 1 : 0);
    }
    if (given) held.end = receptance::HolderEnd::kGiven;
    if (x) assembly_.held[0] = held;
    if (y) assembly_.held[1] = held;
    if (given) take_given(*given, x, y);
  }

  void take_given(const Node& node, bool x, bool y) {
    node.check_names({"modal_table", "receptances", "sensor_mass_g", "artefact"});
    const bool modal = node.has("modal_table");
    const Node content = node.at(modal ? "modal_table" : "receptances");
    if (modal && node.has("receptances"))
      node.at("receptances").fail("expected modal_table or receptances, not both");
    if (modal) forbid(node, {"sensor_mass_g", "artefact"}, "expected only beside receptances");
    const receptance::MeasuredHolder holder = modal ? of_modes(content) : of_taps(node, content);
    auto& given = assembly_.given;
    if (given.empty()) given.assign(holder.receptance.size(), receptance::Receptance<4>::Zero());
    for (int d = 0; d < 2; ++d) {
      if (!(d == 0 ? x : y)) continue;
      int from = d;
      if (!holder.quality[d].measured) {
        from = 1 - d;
        document_.findings.push_back({HolderFinding::Kind::kTakenFromOther, place(content), d, {}, 0});
      } else if (x && y && d == 1 && holder.quality[0].measured) {
        assembly_.axisymmetric = false;
      }
      for (std::size_t i = 0; i < given.size(); ++i)
        given[i].block<2, 2>(2 * d, 2 * d) = holder.receptance[i].block<2, 2>(2 * from, 2 * from);
      if (!modal) document_.quality[d] = holder.quality[from];
    }
    if (x && y && holder.couples_directions) {
      assembly_.couples_directions = true;
      given = holder.receptance;
    }
    if (!modal) find_limits(content, holder, {x, y});
  }

  receptance::MeasuredHolder of_modes(const Node& content) {
    const Found found = document_at(content, load_);
    const dynamics::ModalModel model =
        modal_table_from_json(found.input.document, found.input.source, found.pointer);
    try {
      return receptance::modal_holder(model, assembly_.frequency_hz);
    } catch (const InvalidArgument& error) {
      throw DataError(found.input.source.name, found.pointer + "/dofs", "", error.what());
    }
  }

  receptance::MeasuredHolder of_taps(const Node& node, const Node& content) {
    receptance::HolderMeasurement measurement{receptances_from(content, load_, document_.remarks), 0, {}};
    if (const auto mass = node.find("sensor_mass_g"))
      measurement.sensor_mass_kg = 1e-3 * mass->number(kNotNegative);
    if (const auto artefact = node.find("artefact")) {
      artefact->check_names({"segments"});
      measurement.artefact = chain_from(artefact->at("segments"), 1);
    }
    try {
      return receptance::measured_holder(measurement, assembly_.theory, assembly_.frequency_hz);
    } catch (const InvalidArgument& error) {
      throw DataError(content.source().name, content.pointer(), "", error.what());
    }
  }

  static std::string place(const Node& content) { return content.source().name + ": " + content.pointer(); }

  // What the user should know of the directions that were measured and are used.
  void find_limits(const Node& content, const receptance::MeasuredHolder& holder,
                   const std::array<bool, 2>& used) {
    const std::size_t lines = holder.receptance.size();
    for (int d = 0; d < 2; ++d) {
      const receptance::HolderQuality& quality = holder.quality[d];
      if (!quality.measured || !quality.limited() || !(used[d] || !holder.quality[1 - d].measured)) continue;
      document_.findings.push_back({HolderFinding::Kind::kLimits, place(content), d, quality, lines});
    }
    if (holder.cross_left_out)
      document_.findings.push_back({HolderFinding::Kind::kCrossLeftOut, place(content), 0, {}, lines});
  }

  const Node& root_;
  const DocumentLoader& load_;
  Materials materials_;
  AssemblyDocument document_;
  receptance::Assembly& assembly_ = document_.assembly;
};

Node checked_root(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "assembly");
  root.check_document_names(
      {"frequency_hz", "beam_theory", "materials", "tool", "holder", "joint", "sensor_mass_g"});
  return root;
}

Json band_of(const std::vector<double>& lines) {
  Json band = {{"lines", lines.size()}};
  if (!lines.empty()) band["band_hz"] = {lines.front(), lines.back()};
  return band;
}

}  // namespace

Eigen::VectorXd assembly_frequencies(const Json& document, const Source& source) {
  return frequencies_from(checked_root(document, source).at("frequency_hz"));
}

AssemblyDocument assembly_from_json(const Json& document, const Source& source,
                                    const Eigen::VectorXd& frequency_hz, const DocumentLoader& load) {
  const Node root = checked_root(document, source);
  return AssemblyReader(root, frequency_hz, load).read();
}

Json holder_quality_to_json(const AssemblyDocument& document) {
  Json result;
  for (std::size_t d = 0; d < 2; ++d) {
    if (!document.quality[d]) continue;
    const receptance::HolderQuality& quality = *document.quality[d];
    Json item;
    switch (quality.slopes) {
      case receptance::SlopeSource::kMeasured:
        item["slopes"] = "measured";
        break;
      case receptance::SlopeSource::kFiniteDifference:
        item = {{"slopes", "finite difference"},
                {"spacing_mm", mm_from_metres(quality.spacing_m)},
                {"moment_to_slope", quality.second_difference ? "second difference" : "l n / h"}};
        break;
      case receptance::SlopeSource::kArtefact:
        item["slopes"] = "artefact";
        break;
    }
    item["below_noise"] = band_of(quality.noisy_hz);
    item["not_passive"] = band_of(quality.unphysical_hz);
    for (const auto& gap : quality.doubtful)
      item["interpolated"].push_back({{"band_hz", {gap.from_hz, gap.to_hz}}, {"error", gap.error}});
    result[d == 0 ? "x" : "y"] = item;
  }
  return result;
}

}  // namespace stablecut::document
