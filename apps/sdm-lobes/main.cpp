// sdm-lobes: modal table and cut in, stability chart out.

#include <algorithm>
#include <optional>

#include "base/number_text.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "critical_modes.h"
#include "document/kinds/cut_json.h"
#include "document/kinds/lobes_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/text/data_error.h"
#include "milling/envelope.h"
#include "options.h"
#include "surface_option.h"
#include "words.h"

namespace stablecut {
namespace {

// The chart where neither the cut nor an option gives one.
constexpr Range kDefaultSpeed{2000, 20000, document::kDefaultChartCount};
constexpr Range kDefaultDepth{0, 5, document::kDefaultChartCount};

class SdmLobes : public cli::Tool {
 public:
  SdmLobes()
      : cli::Tool(
            "sdm-lobes",
            "Stability lobes of milling from a modal table of the tool tip: spectral radii over speed and "
            "depth, the limit depth at each speed, and what to run.",
            "sdm-lobes modes.json --cut cut.json > lobes.json", "lobes") {}

 private:
  void setup(CLI::App& app) override {
    not_in_provenance(app.add_option("MORE", more_tables_,
                                     "Further modal tables (poses, tools): what is stable for all of them"));
    cli::begin_group(app, "The cut (--cut, or the five others)");
    add_file_option(app, "--cut", cut_.path, "Cut document: cutter, cutting coefficients, engagement, chart");
    cut_.declare(app);

    cli::begin_group(app, "The chart");
    cli::add_range_option(app, "--speed", speed_,
                          "Spindle speeds, rpm (default: the cut's chart, else 2000:20000:64)");
    cli::add_range_option(app, "--depth", depth_,
                          "Axial depths of cut, mm (default: the cut's chart, else 0:5:64)");
    cli::add_choice_option(app, "--method", method_, "spectral|sdm",
                           "spectral (default): converged; sdm: zeroth-order semi-discretization");
    cli::add_integer_option(app, "--intervals", intervals_, 1,
                            "With --method sdm: intervals per tooth period (default: 40)");

    cli::begin_group(app, "Modes");
    modes_.declare(app);
    app.add_flag("--per-mode", per_mode_, "Also write the limit of each mode alone");

    cli::begin_group(app, "Tested cuts");
    add_file_option(app, "--points", points_path_,
                    "Compare with these cuts: CSV or JSON with depth_mm, speed_rpm[, observed]");

    cli::begin_group(app, "The chart");
    app.add_flag("--limit-only", limit_only_, "Write the limits only, no grid of spectral radii");
    surface_.declare(app);
    add_file_option(app, "--static", surface_.pose_path,
                    "Pose document (best-pose): how the robot yields below the band of the taps");
    surface_.declare_static(app);

    cli::begin_group(app, "What to run");
    run_.declare(app);

    cli::begin_group(app, "Uncertainty");
    cli::add_integer_option(app, "--samples", samples_, 2,
                            "Also compute N cuts drawn from the table's covariance and the cut's standard "
                            "deviations: the probability of stability, and an interval of each limit");
    cli::add_integer_option(app, "--seed", seed_, 0, "Seed of the samples (default: 1)");

    cli::begin_group(app, "Large charts in parts");
    for (const CLI::Option* option : parts_.declare(app)) not_in_provenance(option);
  }

  // What an error suggests to change.
  std::string option_for(Remedy remedy) const override { return remedy == Remedy::kModes ? "--modes" : ""; }

  void run() override {
    check_usage();
    const CutOptions::Reader reader = [this](const std::string& path, cli::InputForm form) {
      return read_input(path, form);
    };
    cut_.read(reader);
    cut_.check(method_, [this](const auto& text) { warn(text); });
    surface_.check(cut_.cut(), method_, !limit_only_ && !parts_.used(), 1 + more_tables_.size());
    const milling::RunRequest asked = run_.request(cut_.cut());
    const document::Input table = modal_table(read_main_input(cli::InputForm::kByContent));
    const dynamics::ModalModel all_modes = document::modal_table_from_json(table.document, table.source);
    document::LobesDocument lobes;
    lobes.mode_labels = {modes_.find_labels(table)};
    const dynamics::ModalModel model = modes_.model(all_modes, table.source.name);
    std::vector<milling::TipStructure> structures = {structure_in(model, table.source)};
    const milling::Cutter& cutter = cut_.cut().cutter;
    const milling::RunRequest request = surface_.completed(asked, model, reader);
    lobes.scheme = {method_ == "sdm" ? milling::StabilityMethod::kSemiDiscretization
                                     : milling::StabilityMethod::kSpectral,
                    intervals_.value_or(milling::StabilityScheme{}.intervals)};
    lobes.samples = samples_.value_or(0);
    std::vector<dynamics::ModalModel> models = {all_modes};
    read_more_tables(table.source.name, models, structures, lobes);
    set_axes(lobes);
    read_points(lobes);
    // A part belongs to this table, and to the options that choose from it.
    const document::Json of = {
        {"sha256", cli::sha256(table.source.text)}, {"modes", modes_.listed()}, {"seed", seed_.value_or(1)}};
    parts_.take_part(of, lobes);
    check_size(lobes, structures.size(), !parts_.paths.empty());

    const ChartAxes axes(lobes);
    if (parts_.paths.empty()) {
      compute_chart(structures, axes, lobes);
      surface_.compute(structures.front(), cut_.cut(), axes, request, threads(), quiet(), lobes);
      if (samples_) compute_samples(model, axes, lobes);
    } else {
      std::vector<document::Input> parts;
      for (const std::string& path : parts_.paths) parts.push_back(read_part(path));
      document::merge_parts(lobes, !limit_only_, of, parts);
    }
    if (per_mode_) {
      cli::ProgressBar bar("sdm-lobes: modes", !quiet());
      lobes.per_mode = milling::limits_of_each_mode(
          all_modes, modes_.chosen(all_modes, table.source.name), cutter, axes.revolutions_per_s,
          axes.depths_m, lobes.scheme, threads(), [&](double share) { bar.show(share); });
    }
    lobes.judged_cuts = milling::judged_cuts(document::tested_cuts(lobes.measured_cuts), structures, cutter,
                                             lobes.scheme, threads());
    if (!parts_.shard)
      lobes.what_to_run =
          milling::what_to_run(structures, cutter, written_limits(lobes, axes), request, threads());
    for (const std::string& line : convergence_warnings(lobes, advice(Remedy::kModes))) warn(line);
    const std::vector<std::string> doubtful = doubtful_critical_modes(lobes.chart, models);
    for (const std::string& line : doubtful) warn(line);
    if (!doubtful.empty() && models.size() == 1 && !parts_.used()) {
      const auto line = limit_without_doubtful(all_modes, modes_.chosen(all_modes, table.source.name),
                                               table.source, cutter, axes, lobes.scheme, threads());
      if (line) warn(*line);
    }
    write_document(main_output(), document::lobes_to_json(lobes));
  }

  void check_usage() const {
    cli::refuse_if(!more_tables_.empty() && (samples_ || per_mode_ || modes_.given() || parts_.used()),
                   "--samples, --per-mode, --modes, --shard, --merge: expected with one modal table only");
    cli::refuse_if(intervals_ && method_ != "sdm", "--intervals: expected with --method sdm only");
    cli::refuse_if(samples_ && method_ == "sdm", "--samples: expected with --method spectral only");
    cli::refuse_if(seed_ && !samples_, "--seed: expected with --samples only");
    cli::refuse_if(cut_.path == "-" && main_input() == "-", "-: expected standard input for one input only");
    cli::refuse_if(parts_.shard && !parts_.paths.empty(), "--shard: expected either --shard or --merge");
    cli::refuse_if(parts_.shard && (per_mode_ || !points_path_.empty()),
                   "--shard: expected --per-mode and --points with --merge, not with a part");
  }

  milling::TipStructure structure_in(const dynamics::ModalModel& model,
                                     const document::Source& source) const {
    return structure_of(model, source, cut_.cut().cutter.is_axial(),
                        [this](const auto& text) { warn(text); });
  }

  void read_more_tables(const std::string& first, std::vector<dynamics::ModalModel>& models,
                        std::vector<milling::TipStructure>& structures, document::LobesDocument& lobes) {
    if (more_tables_.empty()) return;
    lobes.tables = {first};
    for (const std::string& path : more_tables_) {
      const document::Input table = modal_table(read_input(path, cli::InputForm::kByContent));
      models.push_back(document::modal_table_from_json(table.document, table.source));
      structures.push_back(structure_in(models.back(), table.source));
      lobes.tables.push_back(table.source.name);
      lobes.mode_labels.push_back(modes_.find_labels(table));
    }
  }

  void set_axes(document::LobesDocument& lobes) const {
    const Range speed = speed_.value_or(cut_.cut().speed_rpm.value_or(kDefaultSpeed));
    const Range depth = depth_.value_or(cut_.cut().depth_mm.value_or(kDefaultDepth));
    cli::refuse_if(!(speed.from > 0),
                   "--speed: " + number_text(speed.from) + ": expected speeds above 0 rpm");
    const double wrong = depth.from < 0 ? depth.from : depth.to;
    cli::refuse_if(wrong < 0 || wrong > document::kMostDepthMm,
                   "--depth: " + number_text(wrong) + ": expected depths from 0 to 10000 mm");
    lobes.speed_rpm = speed.values();
    lobes.depth_mm = depth.values();
    lobes.cut = cut_.as_used(speed, depth);
  }

  void read_points(document::LobesDocument& lobes) {
    if (points_path_.empty()) return;
    const document::Input points = read_input(points_path_, cli::InputForm::kByContent);
    lobes.measured_cuts = document::measured_cuts(points.source, points.document);
  }

  void compute_chart(const std::vector<milling::TipStructure>& structures, const ChartAxes& axes,
                     document::LobesDocument& lobes) {
    std::vector<milling::StabilityChart> charts;
    for (const milling::TipStructure& structure : structures) {
      cli::ProgressBar bar("sdm-lobes: chart", !quiet());
      charts.push_back(milling::stability_chart(structure, cut_.cut().cutter, axes.revolutions_per_s,
                                                axes.depths_m, lobes.scheme, !limit_only_, threads(),
                                                [&](double share) { bar.show(share); }));
    }
    lobes.chart = milling::envelope_of(charts);
    modes_.name_as_in_table(lobes.chart);
  }

  void compute_samples(const dynamics::ModalModel& model, const ChartAxes& axes,
                       document::LobesDocument& lobes) {
    const document::CutDocument& cut = cut_.cut();
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

  CutOptions cut_;
  ModeOptions modes_;
  RunOptions run_;
  SurfaceOption surface_;
  std::optional<Range> speed_, depth_;
  std::string method_ = "spectral", points_path_;
  std::optional<int> intervals_, samples_, seed_;
  bool per_mode_ = false, limit_only_ = false;
  std::vector<std::string> more_tables_;
  PartOptions parts_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::SdmLobes().main(argc, argv); }
