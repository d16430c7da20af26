// best-pose: joint stiffness and a plane in, the stiffest pose out; a map of the plane; or a verdict on given
// poses.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/pose_json.h"
#include "document/kinds/pose_list_json.h"
#include "document/kinds/robot_json.h"
#include "document/text/data_error.h"

namespace stablecut {
namespace {

constexpr double kDefaultStepMm = 50;
constexpr double kDefaultLimitMarginDeg = 2;
constexpr double kDefaultSingularityMargin = 0.01;
constexpr Range kDefaultRedundancyDeg{-180, 175, 72};
constexpr int kDefaultAlternatives = 5;
constexpr double kLargestForce = 1e9;
constexpr int kMostPoints = 4'000'000;
constexpr int kMostTurns = 3600;

class BestPose : public cli::Tool {
 public:
  BestPose()
      : cli::Tool(
            "best-pose",
            "The stiffest joint angles of a milling robot over a plane, the redundancy about the tool axis "
            "and all "
            "branches, from its joint stiffness.",
            "best-pose --robot robot.json --height 1600 stiffness.json > pose.json", "pose") {}

 private:
  using Vector = std::optional<std::array<double, 3>>;

  void setup(CLI::App& app) override {
    const auto not_negative = [](double value) { return value >= 0; };
    const auto any = [](double) { return true; };
    add_file_option(app, "--robot", robot_path_, "Robot document: kinematics, flange, tool (required)");
    cli::add_number_option(app, "--height", height_mm_, "The plane: z = HEIGHT, mm, base frame", "a number",
                           any);
    cli::add_vector_option(app, "--plane-origin", plane_origin_, "Or any plane: its origin, mm, base frame");
    cli::add_vector_option(app, "--plane-x", plane_x_, "Direction of its x axis (default: 1,0,0)");
    cli::add_vector_option(app, "--plane-y", plane_y_, "Direction of its y axis (default: 0,1,0)");
    cli::add_range_option(app, "--x", x_,
                          "Tool point along the plane's x axis, mm (default: what the robot reaches)");
    cli::add_range_option(app, "--y", y_,
                          "Tool point along the plane's y axis, mm (default: what the robot reaches)");
    cli::add_range_option(
        app, "--redundancy", redundancy_,
        "Turn about the tool axis, deg; 0 puts the tool's x axis nearest the base's x axis (default: "
        "-180:175:72)");
    cli::add_vector_option(app, "--tool-axis", tool_axis_,
                           "Direction of the tool axis, base frame (default: 0,0,-1)");
    cli::add_choice_option(app, "--index", index_, "combined|weakest|axial|deflection",
                           "What counts as stiff (default: combined)");
    cli::add_vector_option(app, "--force", force_, "Force on the tool point, N");
    cli::add_choice_option(app, "--force-frame", force_frame_, "base|tool",
                           "Frame of --force (default: base)");
    cli::add_number_option(app, "--limit-margin", limit_margin_deg_,
                           "To keep from joint limits, deg (default: 2)", "a number not below 0",
                           not_negative);
    cli::add_number_option(app, "--singularity-margin", singularity_margin_,
                           "Least singular value of the Jacobian to keep, lengths in m (default: 0.01)",
                           "a number not below 0", not_negative);
    cli::add_integer_option(app, "--alternatives", alternatives_, 0,
                            "How many runners-up to list (default: 5)");
    cli::add_repeated_option(
        app, "--assume", "JOINT=K",
        "Stiffness of a joint that was not identified, N m/rad, as in A1=6.9e6; may be given again",
        [this](const std::string& text) { assume(text); });
    add_file_option(app, "--map", map_path_, "Also write the best of the samples at each point of the plane");
    add_file_option(app, "--evaluate", evaluate_path_, "Score the poses of a pose list instead of a search");
  }

  void run() override {
    if (robot_path_.empty()) throw cli::WrongUsage("--robot: missing: expected a robot document");
    const bool evaluate = !evaluate_path_.empty();
    if (evaluate && !map_path_.empty()) throw cli::WrongUsage("--map: expected a search, not --evaluate");
    if (!evaluate && !height_mm_ && !plane_origin_)
      throw cli::WrongUsage("--height: missing: expected the height of the plane, mm");
    const robot::StiffnessTask stiffness = stiffness_task();
    const document::PlaneDocument plane = plane_document();
    const document::Input robot_input = read_input(robot_path_, cli::InputForm::kJson);
    const robot::Robot robot = document::robot_from_json(robot_input.document, robot_input.source);
    const document::Input input = read_main_input(cli::InputForm::kJson);
    const robot::JointStiffness joints =
        complete(document::joint_stiffness_from_json(input.document, input.source), input.source, robot);
    document::PoseDocument document;
    document.task = stiffness;
    document.covariance = joints.compliance_covariance;
    robot::JointAngles compliance;
    for (int j = 0; j < robot::kJoints; ++j) compliance[j] = 1 / *joints.stiffness[j];
    if (evaluate)
      score_poses(robot, compliance, document);
    else
      search(robot, robot_input.source, compliance, plane, document);
  }

  void assume(const std::string& text) {
    const auto equals = text.find('=');
    const auto value = equals == std::string::npos ? std::nullopt : parse_number(text.substr(equals + 1));
    if (!value || !(*value > 0) || equals == 0) {
      throw cli::WrongUsage("--assume: " + text + ": expected JOINT=K with a stiffness above 0 N m/rad");
    }
    assumed_.emplace_back(text.substr(0, equals), *value);
  }

  robot::StiffnessTask stiffness_task() const {
    robot::StiffnessTask task;
    if (!index_.empty()) task.index = &robot::stiffness_index(index_);
    if (force_) {
      task.force_n = Eigen::Vector3d(force_->data());
      if (task.force_n->isZero(0)) throw cli::WrongUsage("--force: 0,0,0: expected a force that is not zero");
      if (!(task.force_n->lpNorm<Eigen::Infinity>() < kLargestForce)) {
        throw cli::WrongUsage("--force: expected components below 1e9 N");
      }
    }
    if (task.index->needs_force && !force_) {
      throw cli::WrongUsage(std::string("--force: missing: expected a force for the index ") +
                            task.index->name);
    }
    if (!force_frame_.empty() && !force_) throw cli::WrongUsage("--force-frame: expected with --force only");
    task.force_in_tool = force_frame_ == "tool";
    return task;
  }

  static Eigen::Vector3d direction(const Vector& value, const Eigen::Vector3d& otherwise,
                                   const std::string& name) {
    if (!value) return otherwise;
    const Eigen::Vector3d v(value->data());
    if (v.isZero(0)) throw cli::WrongUsage(name + ": 0,0,0: expected a direction");
    return v.stableNormalized();
  }

  document::PlaneDocument plane_document() const {
    document::PlaneDocument document;
    document.height_mm = height_mm_;
    if (height_mm_) {
      if (plane_origin_ || plane_x_ || plane_y_)
        throw cli::WrongUsage("--height: expected either a height or --plane-origin");
      document.plane.origin = {0, 0, metres_from_mm(*height_mm_)};
      return document;
    }
    if (plane_origin_) document.plane.origin = Eigen::Vector3d(plane_origin_->data()) * 1e-3;
    document.plane.x_axis = direction(plane_x_, Eigen::Vector3d::UnitX(), "--plane-x");
    document.plane.y_axis = direction(plane_y_, Eigen::Vector3d::UnitY(), "--plane-y");
    if (std::abs(document.plane.x_axis.dot(document.plane.y_axis)) > 1e-6) {
      throw cli::WrongUsage("--plane-y: expected a direction square to --plane-x");
    }
    document.plane.y_axis -= document.plane.x_axis.dot(document.plane.y_axis) * document.plane.x_axis;
    document.plane.y_axis.normalize();
    return document;
  }

  // Every joint needs a stiffness: the document's, or an assumed one where it has none.
  robot::JointStiffness complete(robot::JointStiffness joints, const document::Source& source,
                                 const robot::Robot& robot) const {
    for (const auto& [name, value] : assumed_) {
      const auto joint =
          std::find_if(robot.joints.begin(), robot.joints.end(),
                       [&name = name](const robot::Joint& candidate) { return candidate.name == name; });
      if (joint == robot.joints.end()) {
        std::string names;
        for (const robot::Joint& known : robot.joints) names += (names.empty() ? "" : ", ") + known.name;
        throw cli::WrongUsage("--assume: " + name + ": expected one of " + names);
      }
      auto& stiffness = joints.stiffness[joint - robot.joints.begin()];
      if (stiffness)
        throw cli::WrongUsage("--assume: " + name + ": " + source.name +
                              " has a stiffness for it: expected a joint without");
      stiffness = value;
    }
    std::string missing, option;
    std::size_t first = robot::kJoints;
    for (std::size_t j = 0; j < robot::kJoints; ++j) {
      if (joints.stiffness[j]) continue;
      if (first == robot::kJoints) first = j;
      missing += (missing.empty() ? "" : ", ") + robot.joints[j].name;
      option += " --assume " + robot.joints[j].name + "=K";
    }
    if (first < robot::kJoints) {
      std::string text =
          source.name + ": /stiffness_n_m_per_rad/" + std::to_string(first) + ": null: " + missing +
          " not identified: expected a stiffness for every joint; give what you know of it with" + option;
      if (missing == robot.joints[robot::kJoints - 1].name && robot::tool_alignment(robot).point_on_axis) {
        text += " (any K: the tool point lies on this joint's axis, so it does not change the answer)";
      }
      throw NoAnswer(text);
    }
    return joints;
  }

  Range span(const std::optional<Range>& given, const Range& reach) const {
    if (given) return {metres_from_mm(given->from), metres_from_mm(given->to), given->count};
    const double from = std::floor(mm_from_metres(reach.from) / kDefaultStepMm) * kDefaultStepMm;
    const double to = std::ceil(mm_from_metres(reach.to) / kDefaultStepMm) * kDefaultStepMm;
    return {metres_from_mm(from), metres_from_mm(to),
            1 + static_cast<int>(std::lround((to - from) / kDefaultStepMm))};
  }

  robot::PoseTask pose_task(const robot::Robot& robot, const robot::JointAngles& compliance,
                            const document::PlaneDocument& plane,
                            const robot::StiffnessTask& stiffness) const {
    robot::PoseTask task;
    task.plane = plane.plane;
    task.tool_axis = direction(tool_axis_, task.tool_axis, "--tool-axis");
    task.stiffness = stiffness;
    task.joint_compliance = compliance;
    task.limit_margin_rad = radians_from_degrees(limit_margin_deg_.value_or(kDefaultLimitMarginDeg));
    task.singularity_margin = singularity_margin_.value_or(kDefaultSingularityMargin);
    const auto reach = robot::plane_reach(robot, task.plane, task.tool_axis);
    task.x = span(x_, reach.x);
    task.y = span(y_, reach.y);
    if (static_cast<double>(task.x.count) * task.y.count > kMostPoints) {
      throw cli::WrongUsage("--x, --y: expected at most " + std::to_string(kMostPoints) + " points");
    }
    const Range degrees = redundancy_.value_or(kDefaultRedundancyDeg);
    if (degrees.to - degrees.from > 360) throw cli::WrongUsage("--redundancy: expected at most a full turn");
    if (degrees.count > kMostTurns) {
      throw cli::WrongUsage("--redundancy: expected at most " + std::to_string(kMostTurns) + " angles");
    }
    task.redundancy = {radians_from_degrees(degrees.from), radians_from_degrees(degrees.to), degrees.count};
    return task;
  }

  void search(const robot::Robot& robot, const document::Source& robot_source,
              const robot::JointAngles& compliance, const document::PlaneDocument& plane,
              document::PoseDocument& document) {
    if (const auto bad = robot::unsupported_geometry(robot)) {
      throw document::DataError(robot_source.name, "/joints/" + std::to_string(bad->joint) + "/" + bad->field,
                                number_text(bad->value),
                                std::string("expected ") + bad->expected +
                                    ": a search needs its inverse kinematics (--evaluate does not)");
    }
    const robot::PoseTask task = pose_task(robot, compliance, plane, document.task);
    document.plane = plane;
    std::optional<robot::PlaneScan> scan;
    if (!map_path_.empty()) {
      cli::ProgressBar bar("best-pose: map", !quiet());
      scan = robot::scan_plane(robot, task, threads(), [&](double share) { bar.show(share); });
    }
    {
      cli::ProgressBar bar("best-pose: plane", !quiet());
      document.search = robot::search_poses(
          robot, task, alternatives_.value_or(kDefaultAlternatives), threads(),
          [&](double share) { bar.show(share); }, scan ? &*scan : nullptr);
    }
    if (!document.search.redundancy_matters && task.redundancy.count > 1) {
      warn("--redundancy: the tool is coaxial with joint " + robot.joints.back().name +
           ", which alone turns it: no redundancy angle can change the index " + index_name());
    }
    const auto report = [&](const robot::FoundPose& found) {
      document.reports.push_back(
          robot::report_pose(robot, found.angles, document.task, compliance, document.covariance));
    };
    report(document.search.best);
    for (const robot::FoundPose& found : document.search.alternatives) report(found);
    document.sweep =
        robot::redundancy_sweep(robot, task, document.search.best.at.x, document.search.best.at.y);
    write_document(main_output(), document::pose_to_json(document, robot));
    if (scan)
      write_document(map_path_, document::pose_map_to_json(robot::pose_map(robot, *scan), task, plane));
  }

  void score_poses(const robot::Robot& robot, const robot::JointAngles& compliance,
                   document::PoseDocument& document) {
    const document::Input input = read_input(evaluate_path_, cli::InputForm::kJson);
    for (const robot::JointAngles& angles : document::pose_list_from_json(input.document, input.source)) {
      document.evaluated.push_back(
          robot::report_pose(robot, angles, document.task, compliance, document.covariance));
      const robot::PoseReport& report = document.evaluated.back();
      if (std::isnan(report.score)) {
        warn(input.source.name + ": /poses/" + std::to_string(document.evaluated.size() - 1) +
             ": a singular pose: the arm cannot yield in a direction that the index looks at, so there is no "
             "score");
      }
      if (report.limit_margin_rad < 0) {
        warn(input.source.name + ": /poses/" + std::to_string(document.evaluated.size() - 1) +
             "/joints_deg: " + number_text(degrees_from_radians(-report.limit_margin_rad), 3) +
             " degrees outside the joint limits");
      }
    }
    write_document(main_output(), document::evaluation_to_json(document));
  }

  std::string index_name() const { return index_.empty() ? "combined" : index_; }

  std::string robot_path_, index_, force_frame_, map_path_, evaluate_path_;
  std::optional<double> height_mm_, limit_margin_deg_, singularity_margin_;
  Vector plane_origin_, plane_x_, plane_y_, tool_axis_, force_;
  std::optional<Range> x_, y_, redundancy_;
  std::optional<int> alternatives_;
  std::vector<std::pair<std::string, double>> assumed_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::BestPose().main(argc, argv); }
