// rcsa-couple: a tool, its holder and the joint between them in, the frequency responses at the tip out; or a
// measured tip in, and the joint out.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/kinds/assembly_json.h"
#include "document/kinds/frf_json.h"
#include "document/kinds/tool_joint_json.h"
#include "document/measured/frf_import.h"
#include "document/text/data_error.h"

namespace stablecut {
namespace {

constexpr std::array<const char*, 2> kDirections = {"x", "y"};
constexpr std::array<const char*, 4> kJointNames = {"k1", "c1", "k2", "c2"};
constexpr double kNoFit = 0.5;    // relative residual from which on no joint explains the tip
constexpr double kPoorFit = 0.1;  // from which on a line says so
constexpr std::size_t kMostPositions = 10;

class RcsaCouple : public cli::Tool {
 public:
  RcsaCouple()
      : cli::Tool(
            "rcsa-couple",
            "The frequency responses at the tip of a tool that nobody tapped, by receptance coupling of "
            "tool, "
            "joint and holder; or, with --identify, the joint from a measured tip.",
            "rcsa-couple assembly.json > tip.json", "frf") {}

 private:
  void setup(CLI::App& app) override {
    app.add_flag("--slopes", slopes_, "Also the responses of slopes and to moments");
    cli::add_repeated_option(app, "--positions", "MM,MM,...",
                             "Responses between these places on the tool, distances from the tip in mm",
                             [this](const std::string& text) { take_positions(text); });
    add_file_option(app, "--joint", joint_path_, "Take the joint from a tool-joint document");
    add_file_option(app, "--identify", identify_path_,
                    "Identify the joint from a measured tip (frf), and write a tool-joint document");
    cli::add_unit_option(app, unit_,
                         "Unit of the measured tip's numbers, as um/N; wins over what its file says");
    cli::add_repeated_option(app, "--bounds", "NAME=LO:HI,...",
                             "Bounds of k1 (N/m), c1 (N s/m), k2 (N m/rad), c2 (N m s/rad) for --identify",
                             [this](const std::string& text) { take_bounds(text); });
    cli::add_choice_option(
        app, "--objective", objective_, "complex|amplitude",
        "What --identify makes least: the weighted complex error (default), or the paper's "
        "amplitude difference");
    add_file_option(app, "--fitted", fitted_path_, "Also write the tip with the identified joint (frf)");
    add_file_option(app, "--rigid", rigid_path_, "Also write the tip with a rigid joint (frf)");
  }

  void run() override {
    if (identify_path_.empty()) {
      if (!fitted_path_.empty()) throw cli::WrongUsage("--fitted: expected --identify");
      if (!objective_.empty()) throw cli::WrongUsage("--objective: expected --identify");
      if (bounds_given_) throw cli::WrongUsage("--bounds: expected --identify");
      if (unit_) throw cli::WrongUsage("--unit: expected --identify");
      couple();
    } else {
      if (!joint_path_.empty()) throw cli::WrongUsage("--joint: expected no --identify");
      if (slopes_ || !positions_m_.empty())
        throw cli::WrongUsage("--slopes, --positions: expected no --identify");
      identify();
    }
  }

  // ---- options ----

  void take_positions(const std::string& text) {
    for (const std::string_view part : split(text, ',')) {
      const auto position = parse_number(part);
      if (!position || *position < 0 || positions_m_.size() == kMostPositions)
        throw cli::WrongUsage("--positions: " + text +
                              ": expected up to 10 distances from the tip in mm, as 0,40");
      const double metres = metres_from_mm(*position);
      if (std::find(positions_m_.begin(), positions_m_.end(), metres) != positions_m_.end())
        throw cli::WrongUsage("--positions: " + text + ": expected each place once");
      positions_m_.push_back(metres);
    }
  }

  void take_bounds(const std::string& text) {
    for (const std::string_view part : split(text, ',')) {
      const auto equals = part.find('=');
      const auto name = std::find(kJointNames.begin(), kJointNames.end(), part.substr(0, equals));
      const auto band = equals == std::string::npos ? std::nullopt : parse_band(part.substr(equals + 1));
      const std::size_t at = name - kJointNames.begin();
      if (name == kJointNames.end() || !band ||
          !(band->from >= receptance::kLeastBound[at] && band->to <= receptance::kLargestBound)) {
        throw cli::WrongUsage("--bounds: " + std::string(part) +
                              ": expected k1=LO:HI, c1=, k2= or c2=, increasing, from 1e-20 for k1 and k2, "
                              "from 0 for c1 and c2, to 1e20");
      }
      bounds_.least[at] = band->from;
      bounds_.most[at] = band->to;
    }
    bounds_given_ = true;
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

  document::AssemblyDocument read_assembly(const document::Input& input,
                                           const Eigen::VectorXd& frequency_hz) {
    assembly_name_ = input.source.name;
    reading_assembly_ = true;
    const auto folder = std::filesystem::path(main_input() == "-" ? "" : main_input()).parent_path();
    document::AssemblyDocument document = document::assembly_from_json(
        input.document, input.source, frequency_hz, [&](const std::string& path) {
          return read_input((folder / path).string(), cli::InputForm::kByContent);
        });
    warn_of(document.remarks);
    for (const std::string& text : document.warnings) warn(text);
    return document;
  }

  void set_joints(receptance::Assembly& assembly,
                  const std::array<std::optional<receptance::ToolJoint>, 2>& joints) const {
    for (std::size_t d = 0; d < 2; ++d) assembly.held[d].joint = joints[d];
    const auto values = [&](std::size_t d) {
      return joints[d] ? receptance::values_of(*joints[d]) : receptance::JointValues{};
    };
    assembly.axisymmetric = assembly.axisymmetric && values(0) == values(1);
  }

  // The tip, or pairs of places on the tool.
  dynamics::FrequencyResponse responses(const receptance::Assembly& assembly) {
    std::vector<std::pair<double, double>> places;
    for (const double a : positions_m_) {
      for (const double b : positions_m_) places.emplace_back(a, b);
    }
    const std::size_t lines = assembly.frequency_hz.size();
    const std::size_t pairs = std::max<std::size_t>(places.size(), 1);
    std::vector<receptance::Receptance<4>> value(lines * pairs);
    {
      cli::ProgressBar bar("rcsa-couple: lines", !quiet());
      parallel_for(
          lines, threads(),
          [&](std::size_t i) {
            const Eigen::Index line = i;
            if (places.empty()) value[i] = assembly.tip(line);
            for (std::size_t p = 0; p < places.size(); ++p)
              value[i * pairs + p] = assembly.along_tool(line, places[p].first, places[p].second);
          },
          [&](double share) { bar.show(share); });
    }
    dynamics::FrequencyResponse frf;
    frf.frequency_hz = assembly.frequency_hz;
    const int step = slopes_ ? 1 : 2;  // through w_x, slope_x, w_y, slope_y
    const auto name = [](int i) { return std::string(i % 2 == 1 ? "slope_" : "") + kDirections[i / 2]; };
    for (std::size_t p = 0; p < pairs; ++p) {
      for (int a = 0; a < 4; a += step) {
        for (int b = 0; b < 4; b += step) {
          dynamics::FrequencyResponseEntry entry;
          entry.response = name(a);
          entry.reference = name(b);
          if (!places.empty()) {
            entry.response_position_m = places[p].first;
            entry.reference_position_m = places[p].second;
          }
          entry.h.resize(assembly.frequency_hz.size());
          for (std::size_t i = 0; i < lines; ++i) {
            const Eigen::Index line = i;
            entry.h[line] = value[i * pairs + p](a, b);
            if (!std::isfinite(std::abs(entry.h[line]))) {
              throw document::DataError(
                  assembly_name_, "/frequency_hz", number_text(assembly.frequency_hz[line]),
                  "the receptance is not finite: expected sizes and materials of usual magnitude");
            }
          }
          frf.entries.push_back(std::move(entry));
        }
      }
    }
    return frf;
  }

  void write_responses(const std::string& path, const document::AssemblyDocument& document) {
    document::Json result = document::frf_to_json(responses(document.assembly));
    if (const document::Json quality = document::holder_quality_to_json(document); !quality.is_null())
      result["holder"] = quality;
    write_document(path, std::move(result));
  }

  void couple() {
    const document::Input input = read_main_input(cli::InputForm::kJson);
    document::AssemblyDocument document =
        read_assembly(input, document::assembly_frequencies(input.document, input.source));
    if (!positions_m_.empty() && document.assembly.tip_mass_kg > 0) {
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
      set_joints(document.assembly, {joints.joint[0], joints.joint[1]});
    }
    write_responses(main_output(), document);
    write_rigid(document);
  }

  void write_rigid(document::AssemblyDocument document) {
    if (rigid_path_.empty()) return;
    set_joints(document.assembly, {});
    write_responses(rigid_path_, document);
  }

  // ---- identification ----

  // The entry at the tip itself, or null.
  static const dynamics::FrequencyResponseEntry* tip_entry(const dynamics::FrequencyResponse& frf,
                                                           const std::string& direction) {
    dynamics::FrequencyResponseEntry tip;
    tip.response = tip.reference = direction;
    for (const auto& entry : frf.entries) {
      if (entry.same_places(tip)) return &entry;
    }
    return nullptr;
  }

  void identify() {
    const document::Input measured_input = read_input(identify_path_, cli::InputForm::kByContent);
    std::vector<document::Remark> remarks;
    document::FrfChoice choice;
    choice.unit = unit_;
    if (unit_ && document::frf_form_of(measured_input, choice) == document::FrfForm::kJson)
      throw cli::WrongUsage("--unit: a frf document says its units itself");
    const dynamics::FrequencyResponse tap = document::import_frf(measured_input, choice, remarks);
    warn_of(remarks);
    const document::Input input = read_main_input(cli::InputForm::kJson);
    const Eigen::VectorXd wanted = document::assembly_frequencies(input.document, input.source);
    const dynamics::FrequencyResponse measured =
        dynamics::to_receptance(dynamics::within_band(tap, wanted[0], wanted[wanted.size() - 1]));
    if (measured.frequency_hz.size() < receptance::kLeastJointLines) {
      throw document::DataError(measured_input.source.name, "/frequency_hz",
                                std::to_string(measured.frequency_hz.size()) + " lines",
                                "expected at least " + std::to_string(receptance::kLeastJointLines) +
                                    " within the assembly's band");
    }
    document::AssemblyDocument document = read_assembly(input, measured.frequency_hz);
    receptance::Assembly& assembly = document.assembly;
    if (assembly.couples_directions) {
      throw document::DataError(
          input.source.name, "/holder", "",
          "couples x and y: expected a holder whose directions can be identified one by one");
    }
    std::array<const dynamics::FrequencyResponseEntry*, 2> entry{};
    for (std::size_t d = 0; d < 2; ++d) entry[d] = tip_entry(measured, kDirections[d]);
    if (entry[0] == nullptr && entry[1] == nullptr)
      throw document::DataError(measured_input.source.name, "/h", "",
                                "expected an entry xx or yy at the tip");
    const bool same =
        assembly.axisymmetric && entry[0] != nullptr && entry[1] != nullptr && entry[0]->h == entry[1]->h &&
        dynamics::same_values(dynamics::known_variance(*entry[0]), dynamics::known_variance(*entry[1]));

    document::ToolJointDocument result;
    result.objective = objective_ == "amplitude" ? receptance::JointObjective::kAmplitude
                                                 : receptance::JointObjective::kComplex;
    result.lines = measured.frequency_hz.size();
    result.lo_hz = measured.frequency_hz[0];
    result.hi_hz = measured.frequency_hz[result.lines - 1];
    parallel_for(2, threads(), [&](std::size_t d) {
      if (entry[d] != nullptr && !(d == 1 && same)) {
        result.estimate[d] = estimate(assembly, static_cast<int>(d), *entry[d], result.objective);
      }
    });
    if (same) result.estimate[1] = result.estimate[0];
    for (std::size_t d = 0; d < 2; ++d) {
      if (result.estimate[d] && !(d == 1 && same))
        judge(*result.estimate[d], same ? "x and y" : kDirections[d]);
    }
    write_document(main_output(), document::tool_joint_to_json(result));
    if (!fitted_path_.empty()) {
      document::AssemblyDocument fitted = document;
      // A direction that was not measured is taken as the other.
      const auto joint = [&](std::size_t d) {
        return result.estimate[result.estimate[d] ? d : 1 - d]->joint;
      };
      set_joints(fitted.assembly, {joint(0), joint(1)});
      write_responses(fitted_path_, fitted);
    }
    write_rigid(document);
  }

  receptance::JointEstimate estimate(const receptance::Assembly& assembly, int direction,
                                     const dynamics::FrequencyResponseEntry& entry,
                                     receptance::JointObjective objective) const {
    receptance::JointData data;
    data.omega_rad_per_s = kTwoPi * assembly.frequency_hz;
    for (Eigen::Index i = 0; i < data.omega_rad_per_s.size(); ++i)
      data.plane.push_back(assembly.plane(direction, i));
    data.tip = entry.h;
    data.variance = dynamics::known_variance(entry);
    return receptance::identify_joint(data, bounds_, objective);
  }

  void judge(const receptance::JointEstimate& estimate, const std::string& direction) const {
    const receptance::JointValues values = receptance::values_of(estimate.joint);
    const bool unbounded =
        std::none_of(estimate.at_bound.begin(), estimate.at_bound.end(), [](bool b) { return b; });
    const bool nothing =
        std::none_of(estimate.identifiable.begin(), estimate.identifiable.end(), [](bool b) { return b; });
    if (objective_ != "amplitude" && estimate.residual > kNoFit) {
      throw NoAnswer(direction + ": the best joint leaves " + percent_text(estimate.residual) +
                     " of the measured tip, " + identify_path_ +
                     ", unexplained: are tool, holder and units right?");
    }
    if (unbounded && nothing)
      throw NoAnswer(direction + ": the measured tip, " + identify_path_ + ", tells nothing of the joint");
    if (estimate.residual > kPoorFit)
      warn(direction + ": the best joint leaves " + percent_text(estimate.residual) +
           " of the measured tip unexplained");
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string name = direction + ": " + kJointNames[i];
      if (estimate.at_bound[i]) {
        warn(name + " lies at its bound, " + number_text(values[i]));
      } else if (!estimate.identifiable[i]) {
        warn(name + " is not identifiable: its standard deviation is " +
             percent_text(estimate.deviation[i] / values[i]) + " of it");
      }
    }
  }

  bool slopes_ = false, bounds_given_ = false, reading_assembly_ = false;
  std::vector<double> positions_m_;
  std::optional<document::FrfUnit> unit_;
  std::string assembly_name_, joint_path_, identify_path_, fitted_path_, rigid_path_, objective_;
  receptance::JointBounds bounds_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::RcsaCouple().main(argc, argv); }
