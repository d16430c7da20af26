#include "options.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "document/kinds/modal_table_json.h"
#include "document/kinds/mode_labels.h"
#include "document/text/data_error.h"
#include "lobe_values.h"

namespace stablecut {
namespace {

// What one run computes at most: some hours, or a gigabyte.
constexpr double kMostRadii = 1e7, kMostSpeeds = 1e6, kMostIntervals = 1e11;
constexpr double kLeastRatio = 0.01;  // Kr/Kt of metals is 0.1 to 1
// Kt of foam is above 5 N/mm2, of hardened steel in thin chips below 20 000.
constexpr double kLeastKt = 5e6, kLargestKt = 5e10;  // N/m2

bool is_positive(double value) { return value > 0; }
bool is_not_negative(double value) { return value >= 0; }
bool is_margin(double value) { return value >= 0 && value < 1; }
bool is_immersion(double value) { return value > 0 && value <= 1; }

}  // namespace

void CutOptions::declare(CLI::App& app) {
  declared_ = {cli::add_integer_option(app, "--teeth", teeth_, 1, "Number of teeth"),
               cli::add_number_option(app, "--kt", kt_, "Tangential cutting coefficient, N/mm2",
                                      "a number above 0", is_positive),
               cli::add_number_option(app, "--kr", kr_, "Radial cutting coefficient, N/mm2",
                                      "a number not below 0", is_not_negative),
               cli::add_choice_option(app, "--milling", milling_, "up|down", "Up- or down-milling"),
               cli::add_number_option(app, "--immersion", immersion_,
                                      "Radial immersion ae/D: width of cut by diameter",
                                      "a ratio above 0 and at most 1", is_immersion)};
}

document::Json CutOptions::read_document(const Reader& read_input) {
  if (!path.empty()) {
    const document::Input input = read_input(path, cli::InputForm::kJson);
    source_ = input.source;
    document::Json cut = input.document;
    if (cut.is_object()) put_options(cut);
    return cut;
  }
  for (const CLI::Option* option : declared_) {
    cli::refuse_if(
        option->count() == 0,
        option->get_name() + ": missing: expected --cut, or --teeth --kt --kr --milling --immersion");
  }
  source_.name = "options";
  document::Json cut = {{"format", "stablecut/cut/1"}};
  put_options(cut);
  return cut;
}

void CutOptions::put_options(document::Json& cut) const {
  if (teeth_) cut["teeth"] = *teeth_;
  if (kt_) cut["kt_n_per_mm2"] = *kt_;
  if (kr_) cut["kr_n_per_mm2"] = *kr_;
  if (milling_.empty() && !immersion_) return;
  // The same arc in other words.
  cut.erase("entry_deg");
  cut.erase("exit_deg");
  if (!milling_.empty()) cut["milling"] = milling_;
  if (immersion_) cut["radial_immersion"] = *immersion_;
}

void CutOptions::read(const Reader& read_input) {
  document_ = read_document(read_input);
  try {
    cut_ = document::cut_from_json(document_, source_);
  } catch (const document::DataError& error) {
    if (!path.empty()) throw;
    throw cli::WrongUsage(error.what());
  }
}

void CutOptions::check(const std::string& method, const std::function<void(const std::string&)>& warn) const {
  const milling::Cutter& cutter = cut_.cutter;
  cli::refuse_if(
      method == "sdm" && (!cutter.equal_pitch() || cutter.changes_with_depth() || cutter.damping_n_per_m > 0),
      "--method: sdm: expected straight teeth of equal pitch without corners and process damping");
  if (cutter.kt_n_per_m2 < kLeastKt || cutter.kt_n_per_m2 > kLargestKt) {
    warn(source_.name + ": /kt_n_per_mm2: " + number_text(n_per_mm2_from_n_per_m2(cutter.kt_n_per_m2)) +
         ": of no material that is milled: expected N/mm2, which is MPa");
  }
  if (cutter.kr_n_per_m2 > 0 && cutter.kr_n_per_m2 < kLeastRatio * cutter.kt_n_per_m2) {
    warn(source_.name + ": /kr_n_per_mm2: " + number_text(n_per_mm2_from_n_per_m2(cutter.kr_n_per_m2)) +
         ": next to nothing beside Kt: a ratio Kr/Kt has to be multiplied by Kt");
  }
}

document::Json CutOptions::as_used(const Range& speed_rpm, const Range& depth_mm) const {
  cut_.cutter.check_edges_apart(metres_from_mm(depth_mm.to));
  document::Json used = document_;
  used.erase("format");
  used.erase("label");
  used.erase("provenance");
  const auto range = [](const Range& r) {
    return document::Json{{"from", r.from}, {"to", r.to}, {"count", r.count}};
  };
  used["chart"] = {{"speed_rpm", range(speed_rpm)}, {"depth_mm", range(depth_mm)}};
  return used;
}

void ModeOptions::declare(CLI::App& app) {
  app.add_option_function<std::string>(
         "--modes",
         [this](const std::string& text) {
           ModeList list = parse_modes(text);
           listed_ = std::move(list.indices);
           labels_ = std::move(list.labels);
         },
         "Use only these modes of the table, by numbers such as 1-7,14-15 or by labels such as m1,m3")
      ->type_name("LIST");
}

std::vector<std::string> ModeOptions::find_labels(const document::Input& table) {
  const std::vector<std::string> labels = document::mode_labels(table.document);
  if (labels_.empty()) return labels;
  listed_.emplace();
  for (const std::string& label : labels_) {
    const auto found = std::find(labels.begin(), labels.end(), label);
    cli::refuse_if(found == labels.end(),
                   "--modes: " + label + ": expected labels of modes of " + table.source.name);
    listed_->push_back(static_cast<int>(found - labels.begin()) + 1);
  }
  return labels;
}

std::vector<std::size_t> ModeOptions::chosen(const dynamics::ModalModel& table,
                                             const std::string& name) const {
  std::vector<std::size_t> indices;
  if (!listed_) {
    for (std::size_t k = 0; k < table.modes.size(); ++k) indices.push_back(k);
    return indices;
  }
  for (const int index : *listed_) {
    cli::refuse_if(static_cast<std::size_t>(index) > table.modes.size(),
                   "--modes: " + std::to_string(index) + ": expected at most " +
                       std::to_string(table.modes.size()) + ", the modes of " + name);
    indices.push_back(index - 1);
  }
  return indices;
}

dynamics::ModalModel ModeOptions::model(const dynamics::ModalModel& table, const std::string& name) const {
  return listed_ ? dynamics::chosen_modes(table, chosen(table, name)) : table;
}

void ModeOptions::name_as_in_table(milling::StabilityChart& chart) const {
  if (!listed_) return;
  for (auto& crossings : chart.crossings) {
    for (milling::StabilityCrossing& crossing : crossings)
      crossing.mode = static_cast<std::size_t>((*listed_)[crossing.mode] - 1);
  }
}

ChartAxes::ChartAxes(const document::LobesDocument& lobes) {
  for (const double rpm : lobes.speed_rpm) revolutions_per_s.push_back(revolutions_per_s_from_rpm(rpm));
  for (const double mm : lobes.depth_mm) depths_m.push_back(metres_from_mm(mm));
}

document::Input modal_table(document::Input input) {
  if (!input.document.is_null()) return input;
  if (input.source.text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw document::DataError(input.source.name, "", "", "empty input: expected a modal table");
  throw document::DataError(input.source.name, "line 1", "",
                            "not a modal table: expected what fit-modes makes of a tap");
}

milling::TipStructure structure_of(const dynamics::ModalModel& model, const document::Source& source,
                                   bool is_axial, const std::function<void(const std::string&)>& warn) {
  milling::TipStructure structure = document::tip_structure_of(model, source, is_axial);
  for (const std::string& dof : model.dofs) {
    if (dof != "x" && dof != "y" && !(is_axial && dof == "z"))
      warn(source.name + ": /dofs: \"" + dof + "\": left out: " +
           (dof == "z" ? "this cut does not act along the axis"
                       : "only x, y and z take part in chatter here"));
  }
  return structure;
}

milling::LimitCurve written_limits(const document::LobesDocument& lobes, const ChartAxes& axes) {
  milling::LimitCurve curve =
      milling::limit_curve(lobes.chart, axes.revolutions_per_s, lobes.scheme.method, axes.depths_m.back());
  for (milling::LimitPoint& point : curve.points) {
    if (point.depth_m) point.depth_m = document::as_written(*point.depth_m);
  }
  return curve;
}

void RunOptions::declare(CLI::App& app) {
  cli::add_integer_option(app, "--best", count_, 0, "Number of best points at most (default: 5)");
  cli::add_number_option(app, "--depth-margin", depth_margin_,
                         "Share of the limit depth that the best points stay below it (default: 0.1)",
                         "a ratio not below 0 and below 1", is_margin);
  cli::add_number_option(app, "--speed-margin", speed_margin_,
                         "Share of the speed, to either side, over which they stay stable (default: 0.02)",
                         "a ratio not below 0 and below 1", is_margin);
  cli::add_number_option(app, "--max-power", largest_power_,
                         "Cutting power that they may take, W; needs feed_per_tooth_mm in the cut",
                         "a number above 0", is_positive);
  cli::add_number_option(app, "--max-torque", largest_torque_,
                         "Spindle torque that they may take, N m; needs feed_per_tooth_mm in the cut",
                         "a number above 0", is_positive);
}

milling::RunRequest RunOptions::request(const document::CutDocument& cut) const {
  if ((largest_power_ || largest_torque_) && !cut.feed_per_tooth_m) {
    throw cli::WrongUsage((largest_power_ ? std::string("--max-power") : std::string("--max-torque")) +
                          ": expected feed_per_tooth_mm and diameter_mm in the cut");
  }
  milling::RunRequest request;
  if (count_) request.count = static_cast<std::size_t>(*count_);
  if (depth_margin_) request.depth_share = *depth_margin_;
  if (speed_margin_) request.speed_share = *speed_margin_;
  if (cut.feed_per_tooth_m) request.load = cut.load;
  request.largest_power_w = largest_power_;
  request.largest_torque_n_m = largest_torque_;
  return request;
}

std::vector<const CLI::Option*> PartOptions::declare(CLI::App& app) {
  const CLI::Option* part = app.add_option_function<std::string>(
                                   "--shard", [this](const std::string& text) { shard = parse_shard(text); },
                                   "Compute only part K of N: every Nth speed from the Kth on")
                                ->type_name("K/N");
  const CLI::Option* merged = cli::add_repeated_option(
      app, "--merge", "FILE",
      "Put the chart together: the command of its parts with --merge FILE for each instead of --shard",
      [this](const std::string& path) { paths.push_back(path); });
  return {part, merged};
}

void PartOptions::take_part(const document::Json& of, document::LobesDocument& lobes) const {
  if (!shard) return;
  cli::refuse_if(
      static_cast<std::size_t>(shard->count) > lobes.speed_rpm.size(),
      "--shard: expected at most as many parts as speeds, " + std::to_string(lobes.speed_rpm.size()));
  lobes.shard = shard;
  lobes.shard->of = of;
  lobes.speed_rpm = shard->part_of(lobes.speed_rpm);
}

void check_size(const document::LobesDocument& lobes, std::size_t tables, bool merged) {
  const auto speeds = static_cast<double>(lobes.speed_rpm.size());
  const std::string parts = " (parts of a chart: --shard)";
  cli::refuse_beyond(kMostRadii, "--speed, --depth", speeds * static_cast<double>(lobes.depth_mm.size()),
                     "points of the chart" + parts);
  if (merged) return;
  cli::refuse_beyond(kMostSpeeds, lobes.samples > 0 ? "--speed, --samples" : "--speed",
                     speeds * (static_cast<double>(tables) + lobes.samples),
                     "speeds, of all tables and samples" + parts);
  if (lobes.scheme.method == milling::StabilityMethod::kSemiDiscretization)
    cli::refuse_beyond(kMostIntervals, "--speed, --intervals", speeds * std::pow(lobes.scheme.intervals, 3),
                       "speeds times cubes of intervals" + parts);
}

}  // namespace stablecut
