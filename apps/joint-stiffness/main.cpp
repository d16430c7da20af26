// joint-stiffness: loads and deflections at robot poses in, joint stiffness out; or, with --plan, which poses
// and loads to measure.

#include <algorithm>
#include <array>
#include <optional>

#include "base/error.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/tool.h"
#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/load_samples_json.h"
#include "document/kinds/measurement_plan_json.h"
#include "document/kinds/pose_list_json.h"
#include "document/kinds/robot_json.h"
#include "document/measured/load_samples_csv.h"
#include "pose_words.h"
#include "robot/given_poses.h"
#include "words.h"

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
    app.add_option_function<std::string>(
           "--components", [this](const std::string& text) { choose_components(text); },
           "Use only these components of the deflection, also in a plan (default: xyz)")
        ->type_name("xyz");
    cli::begin_group(app, "Plan of measurements");
    cli::add_integer_option(app, "--plan", plan_, 1,
                            "Instead read a pose list and choose N measurements: the poses and loads that "
                            "identify the joints best");
    cli::add_repeated_option(app, "--load", "X,Y,Z",
                             "A force that a measurement may use, N, base frame; may be given several times "
                             "(default: 600 along x, y and -z)",
                             [this](const std::string& text) {
                               const auto load = parse_vector(text);
                               if (!load)
                                 throw cli::WrongUsage("--load: " + text + ": expected X,Y,Z, three numbers");
                               loads_.push_back(*load);
                             });
    const auto positive = [](double value) { return value > 0; };
    cli::add_number_option(app, "--std-mm", std_mm_,
                           "Standard deviation of a measured component, mm (default: 0.005)",
                           "a number above 0", positive);
    cli::add_vector_option(app, "--load-point", load_point_mm_,
                           "Point where the loads act, mm, flange frame (default: the tool point)");
    cli::add_vector_option(
        app, "--measuring-point", measuring_point_mm_,
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
    const bool for_plan =
        !loads_.empty() || std_mm_ || !expected_path_.empty() || load_point_mm_ || measuring_point_mm_;
    cli::refuse_if(
        !plan_ && for_plan,
        "--load, --std-mm, --expected, --load-point, --measuring-point: expected with --plan only");
    cli::refuse_if(plan_ && (!from_.empty() || !loss_.empty()), "--from, --loss: expected without --plan");
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
    const std::string& name = input.source.name;
    const bool csv = from_ == "csv" || (from_.empty() && input.document.is_null());
    const document::LoadSamplesDocument samples =
        csv ? document::load_samples_from_csv(input.source, robot, components_)
            : document::load_samples_from_json(input.document, input.source, robot, components_);
    if (const std::string text = unit_warning(samples, name); !text.empty()) warn(text);
    std::vector<robot::JointAngles> angles;
    for (const robot::LoadSample& sample : samples.samples) angles.push_back(sample.angles);
    const std::string radians = radians_text(angles);
    document::IdentificationDocument document;
    document.options = {loss_ == "huber", components_};
    document.places = samples.places;
    document.names = samples.names;
    document.identification = robot::identify_stiffness(robot, samples.samples, document.options);
    const robot::Identification& found = document.identification;
    if (!found.any_identified()) {
      throw NoAnswer(name + ": " + nothing_identified_text(found, robot) +
                     (radians.empty() ? "" : "; " + radians));
    }
    if (!radians.empty()) warn(name + ": " + radians);
    const std::string outside = outside_limits_text(robot, angles, samples.places, "samples");
    if (!outside.empty()) warn(name + ": " + outside);
    for (const std::string& text :
         identification_warnings(found, robot, samples, name, document.options.huber)) {
      warn(text);
    }
    write_document(main_output(), document::identification_to_json(document, robot));
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
    add_candidates(list.poses, robot, input.source.name, document);
    cli::refuse_if(*plan_ > kMostPlanned, "--plan: expected at most " + std::to_string(kMostPlanned));
    document.plan = robot::plan_measurements(robot, document.candidates, components_, *plan_);
    for (int j = 0; j < robot::kJoints; ++j) {
      if (document.plan.identifiability.visibility[j] != robot::Visibility::kVisible) {
        warn("joint " + robot.joints[j].name + " cannot be identified from these poses and loads");
      }
    }
    write_document(main_output(), document::plan_to_json(document, robot));
  }

  // Every pose inside the joint limits with every load.
  void add_candidates(const std::vector<robot::JointAngles>& poses, const robot::Robot& robot,
                      const std::string& name, document::PlanDocument& document) const {
    std::vector<std::string> places;
    for (std::size_t p = 0; p < poses.size(); ++p) places.push_back("/poses/" + std::to_string(p));
    const std::string outside = outside_limits_text(robot, poses, places, "poses");
    std::vector<bool> allowed(poses.size(), true);
    for (const robot::OutsideLimits& pose : robot::poses_outside_limits(robot, poses))
      allowed[pose.pose] = false;
    if (std::find(allowed.begin(), allowed.end(), true) == allowed.end())
      throw NoAnswer(name + ": " + outside);
    if (!outside.empty()) warn(name + ": " + outside + ": left out");
    if (const std::string radians = radians_text(poses); !radians.empty()) warn(name + ": " + radians);
    const auto point = [&](const Vector& mm) {
      return mm ? Eigen::Vector3d(Eigen::Vector3d(mm->data()) * 1e-3) : robot.tool.translation();
    };
    const auto loads = loads_.empty() ? std::vector(kPlanLoads.begin(), kPlanLoads.end()) : loads_;
    for (std::size_t p = 0; p < poses.size(); ++p) {
      if (!allowed[p]) continue;
      for (const auto& load : loads) {
        robot::LoadSample sample;
        sample.angles = poses[p];
        sample.force_n = Eigen::Vector3d(load.data());
        sample.force_point = point(load_point_mm_);
        sample.measuring_point = point(measuring_point_mm_);
        sample.deflection_std_m = Eigen::Vector3d::Constant(std_mm_.value_or(kPlanStdMm) * 1e-3);
        document.candidates.push_back(sample);
        document.pose.push_back(static_cast<int>(p));
      }
    }
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
