// joint-stiffness: loads and deflections at robot poses in, joint stiffness out; or, with --plan, which poses
// and loads to measure.

#include <algorithm>
#include <array>
#include <optional>

#include "base/error.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/tool.h"
#include "document/kinds/hypothesis_json.h"
#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/load_samples_json.h"
#include "document/kinds/measurement_plan_json.h"
#include "document/kinds/pose_list_json.h"
#include "document/kinds/robot_json.h"
#include "document/measured/load_samples_csv.h"
#include "hypothesis_words.h"
#include "plan_candidates.h"
#include "pose_words.h"
#include "robot/given_poses.h"
#include "words.h"

namespace stablecut {
namespace {

constexpr int kMostPlanned = 10'000;

class JointStiffnessTool : public cli::Tool {
 public:
  JointStiffnessTool()
      : cli::Tool(
            "joint-stiffness",
            "Joint stiffness of a robot from loads and the deflections measured under them; joints that "
            "the measurements cannot identify are named.",
            "joint-stiffness --robot robot.json loads.csv > stiffness.json", "joint-stiffness") {}

 private:
  using Vector = std::optional<std::array<double, 3>>;

  void setup(CLI::App& app) override {
    cli::begin_group(app, "Input");
    add_file_option(app, "--robot", robot_path_, "Robot document: kinematics, flange, tool (required)");
    cli::add_choice_option(app, "--from", from_, "json|csv",
                           "Format of the load samples (default: told from their content)");
    cli::begin_group(app, "Identification");
    cli::add_choice_option(app, "--loss", loss_, "squared|huber",
                           "squared (default), or huber: samples far from the model get less weight");
    cli::add_choice_option(
        app, "--model", model_, "joints|base|three-axis|best",
        "What yields: the joints (default), also the base, also the bearings (three springs "
        "a joint), or whatever predicts blocks of poses best");
    app.add_option_function<std::string>(
           "--components", [this](const std::string& text) { choose_components(text); },
           "Use only these components of the deflection, also in a plan (default: xyz)")
        ->type_name("xyz");
    cli::add_repeated_option(
        app, "--apply", "NAME",
        "Change the robot or the samples before the identification, as a warning has "
        "proposed: sign:A3, turned:z90, deflection:inch, ...; may be given several times",
        [this](const std::string& text) { applied_.push_back(text); });
    cli::begin_group(app, "Plan of measurements");
    cli::add_integer_option(app, "--plan", plan_, 1,
                            "Instead read a pose list and choose N measurements: the poses and loads that "
                            "identify the joints best");
    app.add_flag("--repeats", repeats_, "A plan may choose the same pose and load several times");
    cli::add_repeated_option(app, "--load", "X,Y,Z",
                             "A force that a measurement may use, N, base frame; may be given several times "
                             "(default: 600 along x, y and -z)",
                             [this](const std::string& text) {
                               const auto load = parse_vector(text);
                               if (!load)
                                 throw cli::WrongUsage("--load: " + text + ": expected X,Y,Z, three numbers");
                               plan_request_.loads_n.push_back(*load);
                             });
    const auto positive = [](double value) { return value > 0; };
    cli::add_number_option(app, "--std-mm", plan_request_.std_mm,
                           "Standard deviation of a measured component, mm (default: 0.005)",
                           "a number above 0", positive);
    cli::add_vector_option(app, "--load-point", plan_request_.load_point_mm,
                           "Point where the loads act, mm, flange frame (default: the tool point)");
    cli::add_vector_option(
        app, "--measuring-point", plan_request_.measuring_point_mm,
        "Point whose displacement is measured, mm, flange frame (default: the tool point)");
    add_file_option(app, "--expected", expected_path_,
                    "Joint stiffness to expect (a joint-stiffness document): adds standard deviations in "
                    "N m/rad");
  }

  void choose_components(const std::string& text) {
    components_ = {};
    for (const char c : text) {
      const auto d = std::string("xyz").find(c);
      if (d == std::string::npos || components_[d]) {
        throw cli::WrongUsage("--components: " + text + ": expected some of x, y, z, each once");
      }
      components_[d] = true;
    }
  }

  void run() override {
    cli::refuse_if(robot_path_.empty(), "--robot: missing: expected a robot document");
    const bool for_plan = repeats_ || !plan_request_.loads_n.empty() || plan_request_.std_mm ||
                          !expected_path_.empty() || plan_request_.load_point_mm ||
                          plan_request_.measuring_point_mm;
    cli::refuse_if(!plan_ && for_plan,
                   "--repeats, --load, --std-mm, --expected, --load-point, --measuring-point: expected with "
                   "--plan only");
    cli::refuse_if(plan_ && (!from_.empty() || !loss_.empty() || !model_.empty()),
                   "--from, --loss, --model: expected without --plan");
    cli::refuse_if(plan_ && !applied_.empty(), "--apply: expected without --plan");
    const document::Input robot_input = read_input(robot_path_, cli::InputForm::kJson);
    const robot::Robot robot = document::robot_from_json(robot_input.document, robot_input.source);
    if (plan_)
      plan(robot);
    else
      identify(robot);
  }

  void identify(robot::Robot robot) {
    const document::Input input =
        read_main_input(from_ == "json" ? cli::InputForm::kJson : cli::InputForm::kByContent);
    const std::string& name = input.source.name;
    const bool csv = from_ == "csv" || (from_.empty() && input.document.is_null());
    document::LoadSamplesDocument samples =
        csv ? document::load_samples_from_csv(input.source, robot, components_)
            : document::load_samples_from_json(input.document, input.source, robot, components_);
    const std::vector<robot::Hypothesis> applied = apply_named(applied_, robot, samples, components_);
    if (const std::string text = unit_warning(samples, name); !text.empty()) warn(text);
    std::vector<robot::JointAngles> angles;
    for (const robot::LoadSample& sample : samples.samples) angles.push_back(sample.angles);
    const std::string radians = radians_text(angles);
    document::IdentificationDocument document;
    document.options = {loss_ == "huber", components_, elastic_model()};
    document.places = samples.places;
    document.names = samples.names;
    document.identification = robot::identify_stiffness(robot, samples.samples, document.options);
    const robot::Identification& found = document.identification;
    const SecondLook look = second_look(robot, samples, components_);
    const std::vector<std::string> suspected = hypothesis_warnings(look, robot, samples);
    if (!found.any_identified()) {
      throw NoAnswer(name + ": " + nothing_identified_text(found, robot) +
                     (radians.empty() ? "" : "; " + radians) +
                     (look.better.empty() ? "" : "; " + suspected.front()));
    }
    if (!radians.empty()) warn(name + ": " + radians);
    const std::string outside = outside_limits_text(robot, angles, samples.places, "samples");
    if (!outside.empty()) warn(name + ": " + outside);
    for (const std::string& text : suspected) warn(name + ": " + text);
    if (const std::string text = misfit_warning(found); !text.empty()) warn(name + ": " + text);
    // What is wrong with the input would look like a richer elasticity.
    if (const std::string text = richer_model_text(found);
        model_.empty() && look.better.empty() && !text.empty()) {
      warn(name + ": " + text);
    }
    for (const std::string& text :
         identification_warnings(found, robot, samples, name, document.options.huber)) {
      warn(text);
    }
    document::Json result = document::identification_to_json(document, robot);
    result["applied"] = document::applied_to_json(applied, robot, samples);
    result["hypotheses"] = document::better_fits_to_json(look.better, robot, samples);
    write_document(main_output(), result);
  }

  std::optional<robot::ElasticModel> elastic_model() const {
    if (model_ == "best") return std::nullopt;
    for (const robot::ElasticModel model : {robot::ElasticModel::kBase, robot::ElasticModel::kThreeAxis}) {
      if (model_ == document::model_name(model)) return model;
    }
    return robot::ElasticModel::kJointsOnly;
  }

  void plan(const robot::Robot& robot) {
    document::PlanDocument document;
    if (!expected_path_.empty()) {
      const document::Input expected = read_input(expected_path_, cli::InputForm::kJson);
      document.expected = document::joint_stiffness_from_json(expected.document, expected.source, robot);
    }
    const document::Input input = read_main_input(cli::InputForm::kJson);
    const document::PoseListDocument list = document::pose_list_from_json(input.document, input.source);
    document.names = list.names;
    const PlanCandidates candidates = plan_candidates(robot, list.poses, plan_request_);
    document.candidates = candidates.samples;
    document.pose = candidates.pose;
    if (document.candidates.empty()) throw NoAnswer(input.source.name + ": " + candidates.outside);
    if (!candidates.outside.empty()) warn(input.source.name + ": " + candidates.outside + ": left out");
    if (const std::string radians = radians_text(list.poses); !radians.empty())
      warn(input.source.name + ": " + radians);
    cli::refuse_if(*plan_ > kMostPlanned, "--plan: expected at most " + std::to_string(kMostPlanned));
    const robot::PlanOptions options{*plan_, repeats_, components_};
    document.plan = robot::plan_measurements(robot, document.candidates, options);
    if (document.expected) add_model_error(robot, options, document);
    for (const std::string& text : plan_warnings(document, robot)) warn(text);
    write_document(main_output(), document::plan_to_json(document, robot));
  }

  std::string robot_path_, from_, loss_, model_, expected_path_;
  std::vector<std::string> applied_;
  std::array<bool, 3> components_ = {true, true, true};
  std::optional<int> plan_;
  bool repeats_ = false;
  PlanRequest plan_request_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::JointStiffnessTool().main(argc, argv); }
