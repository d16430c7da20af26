// joint-stiffness: loads and deflections at robot poses in, joint stiffness out; or the poses and loads to
// measure.

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "base/error.h"
#include "base/number_text.h"
#include "cli/exit_status.h"
#include "cli/tool.h"
#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/load_samples_json.h"
#include "document/kinds/measurement_plan_json.h"
#include "document/kinds/pose_list_json.h"
#include "document/kinds/robot_json.h"
#include "document/measured/load_samples_csv.h"

namespace stablecut {
namespace {

// What a plan loads the tool point with when nothing else is said, N: a weight that a workshop has, along
// each axis.
constexpr std::array<std::array<double, 3>, 3> kPlanLoads = {{{600, 0, 0}, {0, 600, 0}, {0, 0, -600}}};
constexpr double kPlanStdMm = 0.005;
constexpr int kMostPlanned = 10'000;

class JointStiffnessTool : public cli::Tool {
 public:
  JointStiffnessTool()
      : cli::Tool(
            "joint-stiffness",
            "Joint stiffness of a robot from loads and deflections at measured poses, with what the loads "
            "cannot see "
            "said so.",
            "joint-stiffness --robot robot.json loads.csv > stiffness.json", "joint-stiffness") {}

 private:
  using Vector = std::optional<std::array<double, 3>>;

  void setup(CLI::App& app) override {
    add_file_option(app, "--robot", robot_path_, "Robot document: kinematics, flange, tool (required)");
    cli::add_choice_option(app, "--from", from_, "json|csv", "Form of the input (default: by content)");
    cli::add_choice_option(app, "--loss", loss_, "squared|huber",
                           "squared (default), or huber: samples far off count less and are named");
    app.add_option_function<std::string>(
           "--components",
           [this](const std::string& text) {
             components_ = {};
             for (const char c : text) {
               const auto d = std::string("xyz").find(c);
               if (d == std::string::npos || components_[d]) {
                 throw cli::WrongUsage("--components: " + text + ": expected some of x, y, z, each once");
               }
               components_[d] = true;
             }
           },
           "Use only these components of the deflection (default: xyz)")
        ->type_name("xyz");
    cli::add_integer_option(app, "--plan", plan_, 1,
                            "Read a pose list and choose the N poses and loads that identify best");
    cli::add_repeated_option(
        app, "--load", "X,Y,Z",
        "A force that a plan may use, N, base frame; may be given again (default: 600 along x, y, -z)",
        [this](const std::string& text) {
          const auto load = parse_vector(text);
          if (!load) throw cli::WrongUsage("--load: " + text + ": expected X,Y,Z, three numbers");
          loads_.push_back(*load);
        });
    const auto positive = [](double value) { return value > 0; };
    cli::add_number_option(app, "--std-mm", std_mm_,
                           "Deviation of a measured component, for a plan (default: 0.005)",
                           "a number above 0", positive);
    cli::add_vector_option(app, "--load-point", load_point_mm_,
                           "Where a plan's loads act, mm, flange frame (default: the tool point)");
    cli::add_vector_option(app, "--measuring-point", measuring_point_mm_,
                           "Whose displacement a plan measures, mm, flange frame (default: the tool point)");
    add_file_option(app, "--expected", expected_path_,
                    "Expected joint stiffness, for a plan's deviations in N m/rad");
  }

  void run() override {
    if (robot_path_.empty()) throw cli::WrongUsage("--robot: missing: expected a robot document");
    const bool for_plan =
        !loads_.empty() || std_mm_ || !expected_path_.empty() || load_point_mm_ || measuring_point_mm_;
    if (!plan_ && for_plan) {
      throw cli::WrongUsage(
          "--load, --std-mm, --expected, --load-point, --measuring-point: expected with --plan only");
    }
    if (plan_ && (!from_.empty() || !loss_.empty())) {
      throw cli::WrongUsage("--from, --loss: expected without --plan");
    }
    const document::Input robot_input = read_input(robot_path_, cli::InputForm::kJson);
    const robot::Robot robot = document::robot_from_json(robot_input.document, robot_input.source);
    if (plan_)
      plan(robot);
    else
      identify(robot);
  }

  void identify(const robot::Robot& robot) {
    const document::Input input =
        read_main_input(from_ == "json" ? cli::InputForm::kJson : cli::InputForm::kByContent);
    const bool csv = from_ == "csv" || (from_.empty() && input.document.is_null());
    const document::LoadSamplesDocument samples =
        csv ? document::load_samples_from_csv(input.source, robot, components_)
            : document::load_samples_from_json(input.document, input.source, robot, components_);
    warn_of_units(samples.samples, input.source.name);
    document::IdentificationDocument document;
    document.options = {loss_ == "huber", components_};
    document.places = samples.places;
    try {
      document.identification = robot::identify_stiffness(robot, samples.samples, document.options);
    } catch (const NoAnswer& answer) {
      throw NoAnswer(input.source.name + ": " + answer.what());
    }
    const robot::Identification& found = document.identification;
    for (int j = 0; j < robot::kJoints; ++j) {
      if (found.identified(j)) continue;
      warn("joint " + robot.joints[j].name +
           " is not identified: " + document::verdict_text(found.verdict[j]));
    }
    if (!found.deviations_known) {
      warn(input.source.name + ": as many unknowns as measured values: no deviations and no intervals");
    }
    if (found.chi_square_tail < 1e-3) {
      warn(input.source.name +
           ": the residuals are too large for the stated deviations (chi-square per degree of freedom " +
           number_text(*found.chi_square_per_dof) + "): the deviations of the result were scaled up");
    }
    for (const robot::Outlier& outlier : found.outliers) {
      warn(input.source.name + ": " + samples.places[outlier.sample] + ": " +
           number_text(outlier.residual_m * 1e6, 3) + " um from the model, " +
           number_text(outlier.deviations, 3) + " deviations" +
           (document.options.huber ? "" : ": an outlier? (--loss huber makes such samples count less)"));
    }
    write_document(main_output(), document::identification_to_json(document, robot));
  }

  // A robot under test gives by micrometres to millimetres.
  void warn_of_units(const std::vector<robot::LoadSample>& samples, const std::string& name) const {
    double largest = 0;
    for (const robot::LoadSample& sample : samples) largest = std::max(largest, sample.deflection_m.norm());
    if (largest > 0.02 || (largest > 0 && largest < 1e-6)) {
      warn(name + ": the largest deflection is " + number_text(largest * 1e3, 3) +
           " mm: are the units right?");
    }
  }

  void plan(const robot::Robot& robot) {
    document::PlanDocument document;
    if (!expected_path_.empty()) {
      const document::Input expected = read_input(expected_path_, cli::InputForm::kJson);
      document.expected = document::joint_stiffness_from_json(expected.document, expected.source);
    }
    const document::Input input = read_main_input(cli::InputForm::kJson);
    const std::vector<robot::JointAngles> poses = document::pose_list_from_json(input.document, input.source);
    if (loads_.empty()) loads_.assign(kPlanLoads.begin(), kPlanLoads.end());
    for (std::size_t p = 0; p < poses.size(); ++p) {
      for (const auto& load : loads_) {
        robot::LoadSample sample;
        sample.angles = poses[p];
        sample.force_n = Eigen::Vector3d(load.data());
        const auto point = [&](const Vector& mm) {
          return mm ? Eigen::Vector3d(Eigen::Vector3d(mm->data()) * 1e-3) : robot.tool.translation();
        };
        sample.force_point = point(load_point_mm_);
        sample.measuring_point = point(measuring_point_mm_);
        sample.deflection_std_m = Eigen::Vector3d::Constant(std_mm_.value_or(kPlanStdMm) * 1e-3);
        document.candidates.push_back(sample);
        document.pose.push_back(static_cast<int>(p));
      }
    }
    if (*plan_ > kMostPlanned) {
      throw cli::WrongUsage("--plan: expected at most " + std::to_string(kMostPlanned));
    }
    document.plan = robot::plan_measurements(robot, document.candidates, components_, *plan_);
    for (int j = 0; j < robot::kJoints; ++j) {
      if (document.plan.identifiability.visibility[j] != robot::Visibility::kVisible) {
        warn("joint " + robot.joints[j].name + " cannot be identified from these poses and loads");
      }
    }
    write_document(main_output(), document::plan_to_json(document, robot));
  }

  std::string robot_path_, from_, loss_, expected_path_;
  std::array<bool, 3> components_ = {true, true, true};
  std::optional<int> plan_;
  std::vector<std::array<double, 3>> loads_;
  std::optional<double> std_mm_;
  Vector load_point_mm_, measuring_point_mm_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::JointStiffnessTool().main(argc, argv); }
