// cut-force: the force of a cut; cuts simulated; cutting coefficients from measured forces.

#include <filesystem>
#include <optional>

#include "base/number_text.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/kinds/cut_force_json.h"
#include "document/kinds/cut_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/text/data_error.h"
#include "identify.h"
#include "points.h"
#include "tested.h"
#include "words.h"

namespace stablecut {
namespace {

constexpr double kDefaultDepthMm = 1;
constexpr int kDefaultHarmonics = 10;
// What one run computes at most: some hours.
constexpr int kMostHarmonics = 100'000, kMostSteps = 100'000;
constexpr double kMostPassages = 1e9, kMostMaps = 1e8;

bool is_positive(double value) { return value > 0; }
bool is_minority(double value) { return value > 0 && value < 0.5; }

class CutForce : public cli::Tool {
 public:
  CutForce()
      : cli::Tool("cut-force",
                  "Force, torque and power of a cut; with the modes of the tool tip, cuts simulated in time: "
                  "growth, surface, chatter; and cutting coefficients from measured forces.",
                  "cut-force cut.json --depth 2 --table modes.json --points tested.csv > force.json",
                  "cut-force") {}

 private:
  void setup(CLI::App& app) override {
    cli::begin_group(app, "The force");
    cli::add_number_option(app, "--depth", depth_, "Axial depth of cut, mm (default: 1)", "a number above 0",
                           is_positive);
    cli::add_number_option(app, "--speed", speed_, "Spindle speed, rpm: for the power", "a number above 0",
                           is_positive);
    cli::add_integer_option(app, "--harmonics", harmonics_, 0, "Harmonics of the force (default: 10)",
                            kMostHarmonics);

    cli::begin_group(app, "Simulation");
    add_file_option(app, "--table", table_path_, "Modal table of the tool tip");
    add_file_option(
        app, "--points", points_path_,
        "Cuts to simulate: CSV or JSON with depth_mm, speed_rpm[, observed] (default: --depth and "
        "--speed)");
    cli::add_integer_option(app, "--passes", request_.passes, 1,
                            "Teeth to follow (default: until what was there at the start is gone)");
    cli::add_integer_option(app, "--steps", request_.steps, 8,
                            "Steps of a tooth period (default: as many as the growth needs)", kMostSteps);
    app.add_flag("--from-rest", request_.from_rest,
                 "Begin at rest in the full cut, a blow, instead of beside the periodic motion");
    cli::add_choice_option(app, "--tooth-paths", paths_, "circles|cycloids",
                           "Paths of the teeth as the tool is fed (default: circles)");

    cli::begin_group(app, "Coefficients from forces");
    identify_option_ =
        add_file_option(app, "--identify", forces_path_,
                        "Write the cut with the coefficients that explain these mean forces (CSV)");
    cli::add_choice_option(app, "--edges", edges_, "fit|cut",
                           "fit (default): find edge forces too; cut: take those of the cut, or none");
    cli::add_choice_option(app, "--force-on", force_on_, "tool|workpiece",
                           "What the measured forces act on (default: tool)");

    cli::begin_group(app, "Coefficients from tested cuts");
    add_file_option(app, "--tested", tested_path_,
                    "Write the cut with Kt and Kr as these cuts leave them: CSV or JSON with depth_mm, "
                    "speed_rpm, observed; needs --table and standard deviations of Kt and Kr in the cut");
    cli::add_integer_option(app, "--samples", samples_, 2, "Cuts to draw (default: 2000)");
    cli::add_integer_option(app, "--seed", seed_, 0, "Seed of the samples (default: 1)");
    cli::add_number_option(app, "--wrong-share", wrong_share_,
                           "Share of the observations that are taken to be wrong (default: 0.05)",
                           "a ratio above 0 and below 0.5", is_minority);
  }

  void run() override {
    check_usage();
    const document::Input input = read_main_input(cli::InputForm::kJson);
    if (identify_option_->count() > 0)
      identify(input);
    else if (!tested_path_.empty())
      learn(input);
    else
      compute(input);
  }

  void check_usage() const {
    const bool identifies = identify_option_->count() > 0;
    const bool learns = !tested_path_.empty();
    const bool simulates = request_.passes || request_.steps || request_.from_rest || !paths_.empty();
    cli::refuse_if(identifies && learns, "--tested: expected without --identify");
    cli::refuse_if(identifies && (depth_ || speed_ || harmonics_ || !table_path_.empty()),
                   "--identify: expected without --depth, --speed, --harmonics and --table");
    cli::refuse_if(learns && (depth_ || speed_ || harmonics_ || !points_path_.empty() || simulates),
                   "--tested: expected without --depth, --speed, --harmonics, --points, --passes, --steps, "
                   "--from-rest and --tooth-paths");
    cli::refuse_if(learns && table_path_.empty(), "--tested: expected with --table");
    cli::refuse_if(!learns && (samples_ || seed_ || wrong_share_),
                   "--samples, --seed, --wrong-share: expected with --tested only");
    cli::refuse_if(!identifies && !edges_.empty(), "--edges: expected with --identify only");
    cli::refuse_if(!identifies && !force_on_.empty(), "--force-on: expected with --identify only");
    cli::refuse_if(!points_path_.empty() && table_path_.empty(), "--points: expected with --table only");
    cli::refuse_if(!table_path_.empty() && !learns && points_path_.empty() && !(depth_ && speed_),
                   "--table: expected --points, or --depth and --speed");
    cli::refuse_if(simulates && table_path_.empty(),
                   "--passes, --steps, --from-rest, --tooth-paths: expected with --table only");
  }

  // Neither the simulation nor the separation of plane and axis knows such edges.
  static void refuse_inclined(const document::CutDocument& cut, const std::string& option) {
    cli::refuse_if(!cut.cutter.is_upright(),
                   option + ": expected a cut without lead_angle_deg and corner_radius_mm");
  }

  void compute(const document::Input& input) {
    const document::CutDocument cut = document::cut_from_json(input.document, input.source);
    if (!cut.feed_per_tooth_m)
      throw document::DataError(input.source.name, "/feed_per_tooth_mm", "",
                                "missing: expected a feed above 0, and diameter_mm beside it");
    document::CutForceDocument document;
    document.cut = input.document;
    document.cut.erase("format");
    document.cut.erase("label");
    document.cut.erase("provenance");
    document.diameter_m = cut.cutter.diameter_m;
    document.depth_mm = depth_.value_or(kDefaultDepthMm);
    document.speed_rpm = speed_;
    document.harmonics = harmonics_.value_or(kDefaultHarmonics);
    if (!table_path_.empty()) {
      refuse_inclined(cut, "--table");
      const document::Input modes = read_input(table_path_, cli::InputForm::kJson);
      const dynamics::ModalModel model = document::modal_table_from_json(modes.document, modes.source);
      const milling::TipStructure structure = document::tip_structure_of(model, modes.source, false);
      if (cut.cutter.is_axial() && model.dof("z") >= 0)
        warn(modes.source.name + ": /dofs: \"z\": left out: the simulation moves the tip in x and y only");
      std::vector<document::MeasuredCut> points;
      std::string name = "--depth and --speed";
      if (points_path_.empty()) {
        points = {{*depth_, *speed_, {}}};
      } else {
        const document::Input table = read_input(points_path_, cli::InputForm::kByContent);
        points = document::measured_cuts(table.source, table.document);
        name = table.source.name;
        if (points.empty()) throw document::DataError(name, "", "", "expected one cut at least");
      }
      cli::refuse_beyond(
          kMostPassages, "--passes, --steps",
          static_cast<double>(points.size()) * request_.passes.value_or(1) * request_.steps.value_or(1),
          "steps of all cuts");
      if (paths_ == "cycloids") request_.path = milling::ToothPath::kCycloid;
      cli::ProgressBar bar("cut-force: points", !quiet());
      document.points = simulated_points(structure, cut, points, request_, threads(),
                                         [&](double share) { bar.show(share); });
      for (const std::string& warning : point_warnings(document.points, name)) warn(warning);
    }
    const milling::EdgeForce force(cut.cutter, cut.load, metres_from_mm(document.depth_mm));
    write_document(main_output(), document::cut_force_to_json(document, force));
  }

  void identify(const document::Input& input) {
    const document::CutDocument cut =
        document::cut_from_json(input.document, input.source, document::CoefficientsNeeded::kNone);
    refuse_inclined(cut, "--identify");
    const document::Input table = read_input(forces_path_, cli::InputForm::kText);
    std::vector<document::MeasuredForceRow> rows = document::measured_forces(table.source, cut);
    const std::filesystem::path folder = std::filesystem::path(forces_path_).parent_path();
    for (document::MeasuredForceRow& row : rows) {
      if (row.record.empty()) continue;
      const document::Input record = read_input((folder / row.record).string(), cli::InputForm::kText);
      row.force.force_n = document::mean_of_record(record.source, row.speed_rpm);
    }
    const document::IdentifiedCut identified =
        identified_cut(input.document, cut, std::move(rows), {edges_ == "cut", force_on_ == "workpiece"});
    for (const std::string& warning :
         identification_warnings(identified.found, identified.held_at_zero, table.source.name))
      warn(warning);
    write_document(main_output(), document::identified_cut_to_json(identified));
  }

  void learn(const document::Input& input) {
    document::TestedCutDocument document;
    document.cut = input.document;
    document.prior = document::cut_from_json(input.document, input.source);
    if (document.prior.deviations.kt_n_per_m2 == 0 && document.prior.deviations.kr_n_per_m2 == 0)
      throw document::DataError(input.source.name, "/kt_std_n_per_mm2", "",
                                "expected a standard deviation of Kt or Kr above 0: how far they may be off");
    const document::Input modes = read_input(table_path_, cli::InputForm::kJson);
    const dynamics::ModalModel model = document::modal_table_from_json(modes.document, modes.source);
    const document::Input table = read_input(tested_path_, cli::InputForm::kByContent);
    document.cuts = document::measured_cuts(table.source, table.document);
    std::erase_if(document.cuts, [](const auto& cut) { return !cut.observed_stable; });
    if (document.cuts.empty())
      throw document::DataError(table.source.name, "", "", "expected cuts that were observed, one at least");
    cli::refuse_beyond(kMostMaps, "--samples",
                       static_cast<double>(document.cuts.size()) * samples_.value_or(0),
                       "samples times cuts");
    if (samples_) document.request.samples = *samples_;
    if (seed_) document.request.seed = static_cast<unsigned>(*seed_);
    if (wrong_share_) document.request.wrong_share = *wrong_share_;
    cli::ProgressBar bar("cut-force: samples", !quiet());
    learn_from_tested_cuts(
        model, modes.source, threads(), [&](double share) { bar.show(share); }, document);
    for (const std::string& warning : posterior_warnings(document.posterior)) warn(warning);
    write_document(main_output(), document::tested_cut_to_json(document));
  }

  std::optional<double> depth_, speed_, wrong_share_;
  std::optional<int> harmonics_, samples_, seed_;
  PointRequest request_;
  std::string table_path_, points_path_, tested_path_, forces_path_, edges_, force_on_, paths_;
  CLI::Option* identify_option_ = nullptr;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::CutForce().main(argc, argv); }
