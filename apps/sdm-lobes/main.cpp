// sdm-lobes: modal table and cut in, stability chart out.

#include <algorithm>
#include <optional>

#include "base/number_text.h"
#include "base/parallel.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/kinds/cut_json.h"
#include "document/kinds/lobes_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/text/data_error.h"

namespace stablecut {
namespace {

// The chart where neither cut nor options say one.
constexpr Range kDefaultSpeed{2000, 20000, document::kDefaultChartCount};
constexpr Range kDefaultDepth{0, 5, document::kDefaultChartCount};

// Above this estimated error of the spectral radius the result is called not converged.
constexpr double kSuspectError = 1e-6;

class SdmLobes : public cli::Tool {
 public:
  SdmLobes()
      : cli::Tool(
            "sdm-lobes",
            "Stability lobes of milling from a modal table of the tool tip: spectral radii over speed and "
            "depth, "
            "and the limit depth at each speed.",
            "sdm-lobes modes.json --cut cut.json > lobes.json", "lobes") {}

 private:
  void setup(CLI::App& app) override {
    const auto positive = [](double value) { return value > 0; };
    const auto not_negative = [](double value) { return value >= 0; };
    add_file_option(app, "--cut", cut_path_, "Cut document: cutter, coefficients, engagement, chart");
    cut_options_ = {
        cli::add_integer_option(app, "--teeth", teeth_, 1, "Number of teeth"),
        cli::add_number_option(app, "--kt", kt_, "Tangential cutting coefficient, N/mm2", "a number above 0",
                               positive),
        cli::add_number_option(app, "--kr", kr_, "Radial cutting coefficient, N/mm2", "a number not below 0",
                               not_negative),
        cli::add_choice_option(app, "--milling", milling_, "up|down", "Milling direction, with --immersion"),
        cli::add_number_option(app, "--immersion", immersion_, "Radial immersion ae/D",
                               "a ratio above 0 and at most 1",
                               [](double value) { return value > 0 && value <= 1; })};
    cli::add_range_option(app, "--speed", speed_,
                          "Spindle speeds, rpm (default: the cut's chart, else 2000:20000:64)");
    cli::add_range_option(app, "--depth", depth_, "Axial depths, mm (default: the cut's chart, else 0:5:64)");
    cli::add_choice_option(app, "--method", method_, "spectral|sdm",
                           "spectral (default): converged; sdm: the zeroth-order semi-discretization");
    cli::add_integer_option(app, "--intervals", intervals_, 1,
                            "Intervals per tooth period, for sdm (default: 40)");
    app.add_option_function<std::string>(
           "--modes",
           [this](const std::string& text) {
             modes_ = parse_index_list(text);
             if (!modes_)
               throw cli::WrongUsage("--modes: " + text + ": expected 1-based indices such as 1-7,14-15");
           },
           "Use only these modes of the table, such as 1-7,14-15")
        ->type_name("LIST");
    app.add_flag("--per-mode", per_mode_, "Also the limit of each mode alone");
    add_file_option(app, "--points", points_path_,
                    "Tested cuts to judge: CSV or JSON with depth_mm, speed_rpm[, observed]");
    app.add_flag("--limit-only", limit_only_, "No grid of spectral radii, only the limit");
    cli::add_integer_option(app, "--best", best_, 0, "Best points to run at most (default: 5)");
    const auto share = [](double value) { return value >= 0 && value < 1; };
    cli::add_number_option(app, "--depth-margin", depth_margin_,
                           "Of the limit depth, kept by the best points (default: 0.1)",
                           "a ratio not below 0 and below 1", share);
    cli::add_number_option(app, "--speed-margin", speed_margin_,
                           "Of the speed, to either side, over which they stay stable (default: 0.02)",
                           "a ratio not below 0 and below 1", share);
    cli::add_number_option(app, "--max-power", most_power_,
                           "W at the cut that they may take; needs feed_per_tooth_mm in the cut",
                           "a number above 0", positive);
    cli::add_number_option(app, "--max-torque", most_torque_, "N m of the spindle, alike", "a number above 0",
                           positive);
    cli::add_integer_option(
        app, "--samples", samples_, 2,
        "Cuts drawn from the table's covariance and the cut's deviations, for the probability "
        "of stability and an interval of the limit");
    cli::add_integer_option(app, "--seed", seed_, 0, "Of the samples (default: 1)");
    not_in_provenance(
        app.add_option_function<std::string>(
               "--shard",
               [this](const std::string& text) {
                 const auto slash = text.find('/');
                 const auto index = parse_integer(text.substr(0, slash));
                 const auto count =
                     slash == std::string::npos ? std::nullopt : parse_integer(text.substr(slash + 1));
                 if (!index || !count || *index < 1 || *index > *count)
                   throw cli::WrongUsage("--shard: " + text + ": expected K/N with 1 <= K <= N");
                 shard_ = document::Shard{*index, *count, {}};
               },
               "Only part K of N of the chart: every Nth speed from the Kth on")
            ->type_name("K/N"));
    not_in_provenance(cli::add_repeated_option(
        app, "--merge", "FILE",
        "A part of this chart, computed by the same command with --shard; give all parts, one option each",
        [this](const std::string& path) { part_paths_.push_back(path); }));
  }

  void run() override {
    check_usage();
    const document::Json cut_json = cut_document();
    const document::CutDocument cut = read_cut(cut_json);
    check_cut(cut);
    const document::Input table = read_main_input(cli::InputForm::kJson);
    const dynamics::ModalModel whole_model = document::modal_table_from_json(table.document, table.source);
    const dynamics::ModalModel model = selected_modes(whole_model, table.source);
    const milling::TipStructure structure = structure_of(model, table.source);
    for (const std::string& dof : model.dofs) {
      if (dof != "x" && dof != "y")
        warn(table.source.name + ": /dofs: \"" + dof + "\": left out: only x and y chatter here");
    }

    document::LobesDocument lobes;
    lobes.scheme = {method_ == "sdm" ? milling::StabilityMethod::kSemiDiscretization
                                     : milling::StabilityMethod::kSpectral,
                    intervals_.value_or(milling::StabilityScheme{}.intervals)};
    const Range speed = speed_.value_or(cut.speed_rpm.value_or(kDefaultSpeed));
    const Range depth = depth_.value_or(cut.depth_mm.value_or(kDefaultDepth));
    if (!(speed.from > 0))
      throw cli::WrongUsage("--speed: " + number_text(speed.from) + ": expected speeds above 0 rpm");
    if (depth.from < 0)
      throw cli::WrongUsage("--depth: " + number_text(depth.from) + ": expected depths not below 0 mm");
    lobes.speed_rpm = speed.values();
    lobes.depth_mm = depth.values();
    lobes.cut = cut_as_used(cut_json, speed, depth);
    if (!points_path_.empty()) {
      const document::Input points = read_input(points_path_, cli::InputForm::kByContent);
      for (const document::MeasuredCut& measured : document::measured_cuts(points.source, points.document)) {
        lobes.points.push_back({measured, 0});
      }
    }

    if (shard_ && static_cast<std::size_t>(shard_->count) > lobes.speed_rpm.size())
      throw cli::WrongUsage("--shard: expected at most as many parts as speeds, " +
                            std::to_string(lobes.speed_rpm.size()));
    // The table's own hash, and the options that choose from it.
    const document::Json of = {{"sha256", cli::sha256(table.source.text)},
                               {"modes", modes_.value_or(std::vector<int>{})},
                               {"seed", seed_.value_or(1)}};
    if (shard_) {
      lobes.shard = shard_;
      lobes.shard->of = of;
      lobes.speed_rpm = shard_->part_of(lobes.speed_rpm);
    }
    lobes.samples = samples_.value_or(0);
    const ChartAxes axes(lobes);
    if (part_paths_.empty()) {
      compute_chart(structure, model, cut, axes, lobes);
    } else {
      std::vector<document::Input> parts;
      for (const std::string& path : part_paths_) parts.push_back(read_part(path));
      document::merge_parts(lobes, !limit_only_, of, parts);
    }
    if (per_mode_) lobes.per_mode = limit_of_each_mode(whole_model, cut.cutter, axes, lobes.scheme);
    judge(structure, cut.cutter, lobes);
    if (!shard_) lobes.what_to_run = what_to_run(structure, cut, axes, lobes);
    warn_if_not_converged(lobes);
    write_document(main_output(), document::lobes_to_json(lobes));
  }

  // The chart's speeds and depths in the units of the numeric rooms.
  struct ChartAxes {
    std::vector<double> revolutions_per_s, depths_m;
    explicit ChartAxes(const document::LobesDocument& lobes) {
      for (const double rpm : lobes.speed_rpm) revolutions_per_s.push_back(revolutions_per_s_from_rpm(rpm));
      for (const double mm : lobes.depth_mm) depths_m.push_back(metres_from_mm(mm));
    }
  };

  void check_usage() const {
    cli::refuse_if(intervals_ && method_ != "sdm", "--intervals: expected with --method sdm only");
    cli::refuse_if(samples_ && method_ == "sdm", "--samples: expected with --method spectral only");
    cli::refuse_if(seed_ && !samples_, "--seed: expected with --samples only");
    cli::refuse_if(cut_path_ == "-" && main_input() == "-", "-: expected standard input for one input only");
    cli::refuse_if(shard_ && !part_paths_.empty(), "--shard: expected either --shard or --merge");
    cli::refuse_if(shard_ && (per_mode_ || !points_path_.empty()),
                   "--shard: expected --per-mode and --points with --merge, not with a part");
  }

  // What the options ask of the cut.
  void check_cut(const document::CutDocument& cut) const {
    const milling::Cutter& cutter = cut.cutter;
    if (method_ == "sdm" &&
        (!cutter.equal_pitch() || cutter.lag_rad_per_m != 0 || cutter.damping_n_per_m > 0)) {
      throw cli::WrongUsage("--method: sdm: expected straight teeth of equal pitch without process damping");
    }
    if ((most_power_ || most_torque_) && !cut.feed_per_tooth_m) {
      throw cli::WrongUsage((most_power_ ? std::string("--max-power") : std::string("--max-torque")) +
                            ": expected feed_per_tooth_mm and diameter_mm in the cut");
    }
  }

  void compute_chart(const milling::TipStructure& structure, const dynamics::ModalModel& model,
                     const document::CutDocument& cut, const ChartAxes& axes,
                     document::LobesDocument& lobes) {
    {
      cli::ProgressBar bar("sdm-lobes: chart", !quiet());
      lobes.chart =
          milling::stability_chart(structure, cut.cutter, axes.revolutions_per_s, axes.depths_m, lobes.scheme,
                                   !limit_only_, threads(), [&](double share) { bar.show(share); });
    }
    // Modes are named as in the table.
    if (modes_) {
      for (auto& crossings : lobes.chart.crossings) {
        for (milling::StabilityCrossing& crossing : crossings)
          crossing.mode = static_cast<std::size_t>((*modes_)[crossing.mode] - 1);
      }
    }
    if (!samples_) return;
    if (model.covariance.size() == 0 && cut.deviations.kt_n_per_m2 == 0 && cut.deviations.kr_n_per_m2 == 0)
      warn(
          "--samples: neither a covariance in the modal table nor kt_std_n_per_mm2 or kr_std_n_per_mm2 in "
          "the cut: every sample is the same");
    cli::ProgressBar bar("sdm-lobes: samples", !quiet());
    lobes.sampled =
        milling::sampled_stability(milling::sampled_cuts(model, cut.cutter, cut.deviations, *samples_,
                                                         static_cast<unsigned>(seed_.value_or(1))),
                                   axes.revolutions_per_s, axes.depths_m, lobes.chart.resolution,
                                   !limit_only_, threads(), [&](double share) { bar.show(share); });
  }

  document::WhatToRun what_to_run(const milling::TipStructure& structure, const document::CutDocument& cut,
                                  const ChartAxes& axes, const document::LobesDocument& lobes) const {
    document::WhatToRun what;
    std::vector<milling::LimitPoint> curve;
    for (std::size_t s = 0; s < axes.revolutions_per_s.size(); ++s) {
      const milling::StabilityCrossing* limit = milling::limit_of(lobes.chart.crossings[s]);
      curve.push_back({axes.revolutions_per_s[s], {}});
      if (limit != nullptr) curve.back().depth_m = document::as_written(limit->depth_m);
    }
    const double top = axes.depths_m.back();
    const auto limit_at = [&](double speed, double largest_depth_m) {
      // As many points as the chart's speed below needed: lower speeds need more.
      const auto above =
          std::upper_bound(axes.revolutions_per_s.begin(), axes.revolutions_per_s.end(), speed);
      const auto below = std::max<std::ptrdiff_t>(above - axes.revolutions_per_s.begin() - 1, 0);
      return milling::limit_depth(structure, cut.cutter, speed, lobes.scheme.method,
                                  lobes.chart.resolution[below], largest_depth_m);
    };
    what.unconditional = milling::unconditional_limit(
        curve, top,
        milling::possible_flips(structure, cut.cutter, axes.revolutions_per_s.front(),
                                axes.revolutions_per_s.back()),
        limit_at, threads());
    what.limits.largest_depth_m = top;
    if (depth_margin_) what.limits.depth_share = *depth_margin_;
    if (speed_margin_) what.limits.speed_share = *speed_margin_;
    if (most_power_ || most_torque_) {
      const milling::CutRate unit = milling::cut_rate(cut.cutter, *cut.feed_per_tooth_m, 1, 1);
      if (most_power_) what.limits.largest_depth_times_speed = *most_power_ / unit.power_w;
      if (most_torque_) what.limits.largest_depth_by_torque = *most_torque_ / unit.torque_n_m;
    }
    what.best = milling::best_points(curve, what.limits, best_.value_or(5), limit_at, threads());
    if (cut.feed_per_tooth_m) {
      for (const milling::OperatingPoint& point : what.best)
        what.rates.push_back(
            milling::cut_rate(cut.cutter, *cut.feed_per_tooth_m, point.revolutions_per_s, point.depth_m));
    }
    return what;
  }

  void warn_if_not_converged(const document::LobesDocument& lobes) const {
    if (lobes.scheme.method != milling::StabilityMethod::kSpectral) return;
    const double error =
        std::max(lobes.points_error, *std::max_element(lobes.chart.error.begin(), lobes.chart.error.end()));
    if (error > kSuspectError)
      warn("the spectral radius has converged only to " + number_text(error) + " (see /convergence)");
  }

  // From --cut, or from the options.
  document::Json cut_document() {
    const bool from_options = std::any_of(cut_options_.begin(), cut_options_.end(),
                                          [](const CLI::Option* option) { return option->count() > 0; });
    if (!cut_path_.empty()) {
      if (from_options) {
        throw cli::WrongUsage(
            "--cut: expected either a cut document or --teeth --kt --kr --milling --immersion");
      }
      const document::Input input = read_input(cut_path_, cli::InputForm::kJson);
      cut_source_ = input.source;
      return input.document;
    }
    for (const CLI::Option* option : cut_options_) {
      if (option->count() == 0) {
        throw cli::WrongUsage(option->get_name() +
                              ": missing: expected --cut, or --teeth --kt --kr --milling --immersion");
      }
    }
    cut_source_.name = "options";
    return {{"format", "stablecut/cut/1"}, {"teeth", *teeth_},    {"kt_n_per_mm2", *kt_},
            {"kr_n_per_mm2", *kr_},        {"milling", milling_}, {"radial_immersion", *immersion_}};
  }

  // What is wrong with a cut by options is wrong usage.
  document::CutDocument read_cut(const document::Json& document) const {
    if (!cut_path_.empty()) return document::cut_from_json(document, cut_source_);
    try {
      return document::cut_from_json(document, cut_source_);
    } catch (const document::DataError& error) {
      throw cli::WrongUsage(error.what());
    }
  }

  static document::Json cut_as_used(document::Json cut, const Range& speed, const Range& depth) {
    cut.erase("format");
    cut.erase("provenance");
    const auto range = [](const Range& r) {
      return document::Json{{"from", r.from}, {"to", r.to}, {"count", r.count}};
    };
    cut["chart"] = {{"speed_rpm", range(speed)}, {"depth_mm", range(depth)}};
    return cut;
  }

  dynamics::ModalModel selected_modes(const dynamics::ModalModel& model,
                                      const document::Source& source) const {
    if (!modes_) return model;
    std::vector<std::size_t> selected;
    for (const int index : *modes_) {
      if (static_cast<std::size_t>(index) > model.modes.size()) {
        throw cli::WrongUsage("--modes: " + std::to_string(index) + ": expected at most " +
                              std::to_string(model.modes.size()) + ", the modes of " + source.name);
      }
      selected.push_back(index - 1);
    }
    return dynamics::chosen_modes(model, selected);
  }

  static milling::TipStructure structure_of(const dynamics::ModalModel& model,
                                            const document::Source& source) {
    if (model.dof("x") < 0 && model.dof("y") < 0) {
      throw document::DataError(source.name, "/dofs", document::Json(model.dofs).dump(),
                                "expected x, y or both");
    }
    milling::TipStructure structure = milling::tip_structure(model);
    if (structure.modes() == 0) {
      throw document::DataError(
          source.name, "/modes", "",
          "expected at least one mode that a force in x or y drives and that moves x or y");
    }
    return structure;
  }

  std::vector<document::ModeLimit> limit_of_each_mode(const dynamics::ModalModel& model,
                                                      const milling::Cutter& cutter, const ChartAxes& axes,
                                                      const milling::StabilityScheme& scheme) const {
    std::vector<int> indices;
    for (int k = 1; k <= static_cast<int>(model.modes.size()); ++k) {
      if (!modes_ || std::binary_search(modes_->begin(), modes_->end(), k)) indices.push_back(k);
    }
    std::vector<document::ModeLimit> result;
    cli::ProgressBar bar("sdm-lobes: modes", !quiet());
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const dynamics::ModalModel alone =
          dynamics::chosen_modes(model, {static_cast<std::size_t>(indices[i] - 1)});
      document::ModeLimit limit{
          indices[i], std::vector<std::vector<milling::StabilityCrossing>>(axes.revolutions_per_s.size())};
      // A mode that a force at the tip does not drive, or that does not move it, cannot chatter.
      if (const milling::TipStructure structure = milling::tip_structure(alone); structure.modes() > 0) {
        limit.crossings = milling::stability_chart(structure, cutter, axes.revolutions_per_s, axes.depths_m,
                                                   scheme, false, threads())
                              .crossings;
      }
      for (auto& crossings : limit.crossings) {
        for (milling::StabilityCrossing& crossing : crossings)
          crossing.mode = static_cast<std::size_t>(limit.mode - 1);
      }
      result.push_back(std::move(limit));
      bar.show(static_cast<double>(i + 1) / static_cast<double>(indices.size()));
    }
    return result;
  }

  void judge(const milling::TipStructure& structure, const milling::Cutter& cutter,
             document::LobesDocument& lobes) const {
    std::vector<double> error(lobes.points.size(), 0.0);
    parallel_for(lobes.points.size(), threads(), [&](std::size_t i) {
      document::JudgedCut& point = lobes.points[i];
      const double depth_m = metres_from_mm(point.cut.depth_mm);
      const milling::PreparedPeriod period = milling::prepare_period(
          structure, cutter, revolutions_per_s_from_rpm(point.cut.speed_rpm), lobes.scheme, depth_m);
      point.spectral_radius = milling::spectral_radius(*period.map, depth_m);
      error[i] = period.error;
    });
    if (!error.empty()) lobes.points_error = *std::max_element(error.begin(), error.end());
  }

  std::string cut_path_, points_path_, milling_, method_ = "spectral";
  std::optional<int> teeth_, intervals_, best_, samples_, seed_;
  std::optional<double> kt_, kr_, immersion_, depth_margin_, speed_margin_, most_power_, most_torque_;
  std::optional<document::Shard> shard_;
  std::vector<std::string> part_paths_;
  std::vector<CLI::Option*> cut_options_;
  std::optional<Range> speed_, depth_;
  std::optional<std::vector<int>> modes_;
  bool per_mode_ = false, limit_only_ = false;
  document::Source cut_source_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::SdmLobes().main(argc, argv); }
