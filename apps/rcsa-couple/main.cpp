// rcsa-couple: a tool, its holder and the joint between them in, the frequency responses at the tip out; or a
// measured tip in, and the joint out.

#include <glog/logging.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/number_text.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/kinds/assembly_json.h"
#include "document/kinds/frf_json.h"
#include "document/kinds/tool_joint_json.h"
#include "document/measured/frf_import.h"
#include "document/text/data_error.h"
#include "option_values.h"
#include "receptance/assembly_identification.h"
#include "receptance/assembly_response.h"
#include "words.h"

namespace stablecut {
namespace {

class RcsaCouple : public cli::Tool {
 public:
  RcsaCouple()
      : cli::Tool(
            "rcsa-couple",
            "Frequency responses at the tip of a tool, computed by receptance coupling of tool, joint and "
            "holder; or, with --identify, the joint from a measured tip.",
            "rcsa-couple assembly.json > tip.json", "frf") {}

 private:
  void setup(CLI::App& app) override {
    cli::begin_group(app, "Coupling");
    app.add_flag("--slopes", choice_.slopes, "Also slopes as responses, and responses to moments");
    cli::add_repeated_option(app, "--positions", "MM,MM,...",
                             "Responses between all pairs of these places on the tool, in place of the tip; "
                             "distances from the tip in mm",
                             [this](const std::string& text) { add_positions(text, choice_.positions_m); });
    cli::add_number_option(
        app, "--overhang", overhang_mm_,
        "Length of the tool from its tip to the joint, mm: its segment at the joint is made "
        "longer or shorter (default: the assembly's)",
        "a number above 0", [](double value) { return value > 0; });
    add_file_option(app, "--joint", joint_path_,
                    "Take the joint from a tool-joint document in place of the assembly");
    cli::begin_group(app, "Identification");
    add_file_option(
        app, "--identify", identify_path_,
        "Identify the joint from a measured tip (frf, or a measured file), and write a tool-joint "
        "document");
    cli::add_unit_option(app, unit_,
                         "Unit of the measured tip's numbers, as um/N; overrides what its file says");
    cli::add_repeated_option(app, "--bounds", "NAME=LO:HI,...",
                             "Bounds of k1 (N/m), c1 (N s/m), k2 (N m/rad), c2 (N m s/rad)",
                             [this](const std::string& text) {
                               set_bounds(text, bounds_);
                               bounds_given_ = true;
                             });
    cli::add_choice_option(app, "--objective", objective_name_, "complex|amplitude",
                           "What is minimised: the complex error, weighted by the noise (default), or the "
                           "unweighted difference of amplitudes, as Liu et al. 2014 do");
    cli::begin_group(app, "Further outputs");
    add_file_option(app, "--fitted", fitted_path_,
                    "With --identify, also write the tip with the identified joint (frf)");
    add_file_option(app, "--rigid", rigid_path_, "Also write the tip with a rigid joint (frf)");
  }

  void run() override {
    if (identify_path_.empty()) {
      cli::refuse_if(!fitted_path_.empty(), "--fitted: expected only with --identify");
      cli::refuse_if(!objective_name_.empty(), "--objective: expected only with --identify");
      cli::refuse_if(bounds_given_, "--bounds: expected only with --identify");
      cli::refuse_if(unit_.has_value(), "--unit: expected only with --identify");
      couple();
    } else {
      cli::refuse_if(!joint_path_.empty(), "--joint: expected only without --identify");
      cli::refuse_if(choice_.slopes || !choice_.positions_m.empty(),
                     "--slopes, --positions: expected only without --identify");
      identify();
    }
  }

  // What the user could change for the file that is being read: the measured tip, or one that the assembly
  // names with a quantity and a unit of its own.
  std::string option_for(Remedy remedy) const override {
    const bool unit = remedy == Remedy::kUnit || remedy == Remedy::kQuantityOrUnit;
    if (!reading_assembly_) return unit ? "--unit" : "";
    if (unit) return "\"unit\" beside its \"file\"";
    return remedy == Remedy::kQuantity ? "\"quantity\" beside its \"file\"" : "";
  }

  void warn_of(const std::vector<document::Remark>& remarks) const {
    for (const document::Remark& remark : remarks)
      warn(document::remark_text(remark) + advice(document::remedy(remark.kind)));
  }

  // ---- coupling ----

  void couple() {
    const document::Input input = read_main_input(cli::InputForm::kJson);
    document::AssemblyDocument document =
        read_assembly(input, document::assembly_frequencies(input.document, input.source));
    if (!choice_.positions_m.empty() && document.assembly.tip_mass_kg > 0) {
      throw document::DataError(input.source.name, "/sensor_mass_g", "",
                                "with --positions: expected no sensor on the tip");
    }
    if (!joint_path_.empty()) {
      const document::Input joint = read_input(joint_path_, cli::InputForm::kJson);
      const document::ToolJoints joints = document::tool_joints_from_json(joint.document, joint.source);
      if (!joints.only.empty()) {
        warn(joint.source.name + ": identified in " + joints.only + " only: taken for " +
             (joints.only == "x" ? "y" : "x") + " as well");
      }
      for (const auto& value : joints.doubts) warn(words_of(value));
      document.assembly.set_joints({joints.joint[0], joints.joint[1]});
    }
    write_responses(main_output(), document);
    write_rigid(document);
  }

  document::AssemblyDocument read_assembly(const document::Input& input,
                                           const Eigen::VectorXd& frequency_hz) {
    assembly_name_ = input.source.name;
    reading_assembly_ = true;
    const auto folder = std::filesystem::path(main_input() == "-" ? "" : main_input()).parent_path();
    document::AssemblyDocument document = document::assembly_from_json(
        input.document, input.source, frequency_hz, [&](const std::string& path) {
          return read_input((folder / path).string(), cli::InputForm::kByContent);
        });
    if (overhang_mm_) set_overhang(*overhang_mm_, document.assembly.tool);
    warn_of(document.remarks);
    for (const auto& material : document.material_doubts) warn(words_of(material));
    for (const auto& size : document.size_doubts) warn(words_of(size));
    for (const document::HolderFinding& finding : document.findings) warn(words_of(finding));
    return document;
  }

  void write_responses(const std::string& path, const document::AssemblyDocument& document) {
    cli::ProgressBar bar("rcsa-couple: lines", !quiet());
    const dynamics::FrequencyResponse frf = receptance::assembly_response(
        document.assembly, choice_, threads(), [&](double share) { bar.show(share); });
    for (const auto& entry : frf.entries) {
      for (Eigen::Index i = 0; i < entry.h.size(); ++i) {
        if (std::isfinite(std::abs(entry.h[i]))) continue;
        throw document::DataError(
            assembly_name_, "/frequency_hz", number_text(frf.frequency_hz[i]),
            "the receptance is not finite: expected sizes and materials of usual magnitude");
      }
    }
    document::Json result = document::frf_to_json(frf);
    if (const document::Json quality = document::holder_quality_to_json(document); !quality.is_null())
      result["holder"] = quality;
    write_document(path, std::move(result));
  }

  void write_rigid(document::AssemblyDocument document) {
    if (rigid_path_.empty()) return;
    document.assembly.set_joints({});
    write_responses(rigid_path_, document);
  }

  // ---- identification ----

  void identify() {
    const document::Input measured_input = read_input(identify_path_, cli::InputForm::kByContent);
    const dynamics::FrequencyResponse tap = read_tap(measured_input);
    const document::Input input = read_main_input(cli::InputForm::kJson);
    const Eigen::VectorXd wanted = document::assembly_frequencies(input.document, input.source);
    const dynamics::FrequencyResponse measured =
        dynamics::to_receptance(dynamics::within_band(tap, wanted[0], wanted[wanted.size() - 1]));
    const Eigen::Index lines = measured.frequency_hz.size();
    if (lines < receptance::kLeastJointLines) {
      throw document::DataError(measured_input.source.name, "/frequency_hz", std::to_string(lines) + " lines",
                                "expected at least " + std::to_string(receptance::kLeastJointLines) +
                                    " within the assembly's band");
    }
    const document::AssemblyDocument document = read_assembly(input, measured.frequency_hz);
    if (document.assembly.couples_directions) {
      throw document::DataError(
          input.source.name, "/holder", "",
          "couples x and y: expected a holder whose directions can be identified one by one");
    }
    const receptance::MeasuredTip tip = receptance::tip_entries(measured);
    if (tip[0] == nullptr && tip[1] == nullptr)
      throw document::DataError(measured_input.source.name, "/h", "",
                                "expected an entry xx or yy at the tip");
    const auto objective = objective_name_ == "amplitude" ? receptance::JointObjective::kAmplitude
                                                          : receptance::JointObjective::kComplex;
    const receptance::IdentifiedJoints joints =
        receptance::identify_joints(document.assembly, tip, bounds_, objective, threads());
    for (const std::string& text : warnings_of(joints, bounds_, objective, identify_path_)) warn(text);
    write_document(main_output(),
                   document::tool_joint_to_json({joints.estimate, objective, lines, measured.frequency_hz[0],
                                                 measured.frequency_hz[lines - 1]}));
    write_fitted(document, joints);
    write_rigid(document);
  }

  dynamics::FrequencyResponse read_tap(const document::Input& input) {
    std::vector<document::Remark> remarks;
    document::FrfChoice choice;
    choice.unit = unit_;
    if (unit_ && document::frf_form_of(input, choice) == document::FrfForm::kJson)
      throw cli::WrongUsage("--unit: a frf document says its units itself");
    dynamics::FrequencyResponse tap = document::import_frf(input, choice, remarks);
    warn_of(remarks);
    document::refuse_window(tap, input.source);
    return tap;
  }

  void write_fitted(document::AssemblyDocument document, const receptance::IdentifiedJoints& joints) {
    if (fitted_path_.empty()) return;
    // A direction that was not measured is taken as the other.
    const auto joint = [&](std::size_t d) { return joints.estimate[joints.estimate[d] ? d : 1 - d]->joint; };
    document.assembly.set_joints({joint(0), joint(1)});
    write_responses(fitted_path_, document);
  }

  receptance::ResponseChoice choice_;
  std::optional<double> overhang_mm_;
  bool bounds_given_ = false, reading_assembly_ = false;
  std::optional<document::FrfUnit> unit_;
  std::string assembly_name_, joint_path_, identify_path_, fitted_path_, rigid_path_, objective_name_;
  receptance::JointBounds bounds_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) {
  // Ceres reports difficulties of its own through glog; what the user should know is in this tool's messages.
  FLAGS_minloglevel = google::GLOG_FATAL;
  return stablecut::RcsaCouple().main(argc, argv);
}
