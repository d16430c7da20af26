// best-pose: joint stiffness and a plane in, the stiffest pose out, and a map of the plane; or, with
// --evaluate, scores of given poses; or, with --path, the motion along a tool path.

#include <cmath>
#include <optional>

#include "assumed_stiffness.h"
#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "cut_options.h"
#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/pose_json.h"
#include "document/kinds/pose_list_json.h"
#include "document/kinds/robot_json.h"
#include "keep_out_options.h"
#include "load_options.h"
#include "path_mode.h"
#include "pose_values.h"
#include "search_task.h"
#include "words.h"

namespace stablecut {
namespace {

constexpr int kDefaultAlternatives = 5;

class BestPose : public cli::Tool {
 public:
  BestPose()
      : cli::Tool(
            "best-pose",
            "The stiffest joint angles of a milling robot whose tool works in a plane: over the plane, the "
            "turn about the tool axis and all branches of the inverse kinematics.",
            "best-pose --robot robot.json --height 1600 stiffness.json > pose.json", "pose") {}

 private:
  void setup(CLI::App& app) override {
    const auto any = [](double) { return true; };
    cli::begin_group(app, "Input");
    add_file_option(app, "--robot", robot_path_, "Robot document: kinematics, flange, tool (required)");
    cli::add_vector_option(app, "--tool-point", tool_point_mm_,
                           "Tool point in the flange frame, mm (default: the robot's tool)");
    cli::begin_group(app, "Search");
    cli::add_number_option(app, "--height", where_.height_mm, "The plane z = HEIGHT, mm, base frame",
                           "a number", any);
    cli::add_vector_option(app, "--plane-origin", where_.plane_origin_mm,
                           "Or any other plane: its origin, mm, base frame");
    cli::add_vector_option(app, "--plane-x", where_.plane_x,
                           "Direction of that plane's x axis (default: 1,0,0)");
    cli::add_vector_option(app, "--plane-y", where_.plane_y,
                           "Direction of that plane's y axis (default: 0,1,0)");
    cli::add_range_option(app, "--x", where_.x_mm,
                          "Tool point along the plane's x axis, mm (default: what the robot reaches)");
    cli::add_range_option(app, "--y", where_.y_mm,
                          "Tool point along the plane's y axis, mm (default: what the robot reaches)");
    cli::add_range_option(
        app, "--redundancy", where_.redundancy_deg,
        "Turn about the tool axis, deg; 0 puts the tool's x axis nearest the base's x axis (default: "
        "-180:175:72)");
    cli::add_vector_option(app, "--tool-axis", where_.tool_axis,
                           "Direction of the tool axis, base frame (default: 0,0,-1)");
    cli::begin_group(app, "Stiffness");
    add_load_options(app, load_);
    add_file_option(app, "--cut", cut_.path, "A cut document, whose forces act instead of --force");
    add_cut_options(app, cut_);
    cli::begin_group(app, "Search");
    add_margin_options(app, where_);
    add_keep_out_options(app, keep_out_);
    cli::add_integer_option(app, "--alternatives", alternatives_, 0,
                            "How many other local optima to list (default: 5)");
    cli::begin_group(app, "Stiffness");
    cli::add_repeated_option(app, "--assume", "JOINT=K",
                             "Stiffness of a joint that was not identified, N m/rad, as in A1=6.9e6; may be "
                             "given several times",
                             [this](const std::string& text) { assumed_.push_back(parse_assumed(text)); });
    cli::begin_group(app, "Search");
    add_file_option(app, "--map", map_path_, "Also write the best sample at each point of the plane");
    cli::begin_group(app, "Evaluation");
    add_file_option(app, "--evaluate", evaluate_path_,
                    "Instead of a search, score and rank the poses of a pose list");
    cli::begin_group(app, "Path");
    add_file_option(app, "--path", along_.path, "Instead of a plane, the motion along a tool path");
    add_path_options(app, along_);
    add_file_option(app, "--joints", along_.joints_csv, "Also write the joint angles along the path as CSV");
    add_file_option(app, "--offsets", along_.offsets_csv,
                    "Also write the points that cancel the mean deflection under --cut as CSV");
  }

  void run() override {
    const bool evaluate = !evaluate_path_.empty();
    cli::refuse_if(robot_path_.empty(), "--robot: missing: expected a robot document");
    cli::refuse_if(evaluate && !map_path_.empty(), "--map: expected a search, not --evaluate");
    check_path_options();
    cli::refuse_if(!evaluate && !along_.given() && !where_.has_plane(),
                   "--height: missing: expected the height of the plane, mm");
    document::PoseDocument document;
    check_cut_options(cut_, along_.given());
    document.task = stiffness_task(load_, along_.given(), cut_.given());
    if (!along_.given()) document.plane = search_plane(where_);
    const document::Input robot_input = read_input(robot_path_, cli::InputForm::kJson);
    robot::Robot robot = document::robot_from_json(robot_input.document, robot_input.source);
    if (tool_point_mm_) robot.tool.translation() = tool_point_m(*tool_point_mm_);
    apply(keep_out_, robot);
    const document::Input input = read_main_input(cli::InputForm::kJson);
    const robot::JointStiffness joints =
        document::joint_stiffness_from_json(input.document, input.source, robot);
    const robot::Elasticity elasticity = complete_elasticity(joints, assumed_, robot, input.source);
    document.errors = joints.errors;
    if (const std::string text = rigid_springs_text(joints, robot); !text.empty())
      warn(input.source.name + ": " + text);
    if (cut_.given()) take_cut(read_input(cut_.path, cli::InputForm::kJson), cut_, document.task);
    if (evaluate) return score_poses(robot, elasticity, document);
    if (const auto bad = robot::unsupported_geometry(robot)) {
      throw unsupported_robot(*bad, robot, robot_input.source);
    }
    if (along_.given()) return drive_path(robot, elasticity, document);
    try {
      search(robot, elasticity, document);
    } catch (const robot::NoPose& none) {
      const std::string metres = metres_text(where_, robot);
      throw NoAnswer(no_pose_text(none.obstacle(), robot) + (metres.empty() ? "" : "; " + metres));
    }
  }

  void check_path_options() const {
    const std::string stray = along_.without_path();
    cli::refuse_if(!along_.given() && !stray.empty(), stray + ": expected with --path only");
    if (!along_.given()) return;
    cli::refuse_if(!along_.offsets_csv.empty() && !cut_.given(), "--offsets: expected with --cut only");
    cli::refuse_if(!evaluate_path_.empty(), "--path: expected a path or --evaluate");
    cli::refuse_if(!map_path_.empty(), "--map: expected a search in a plane, not --path");
    cli::refuse_if(where_.height_mm || where_.x_mm || where_.y_mm || where_.tool_axis,
                   "--path: expected without --height, --x, --y and --tool-axis");
  }

  // A path is read and scored like the planes; without an index its deflection counts, or its weakest
  // direction where no force is given.
  void drive_path(const robot::Robot& robot, const robot::Elasticity& elasticity,
                  const document::PoseDocument& document) {
    const document::Input input = read_input(along_.path, cli::InputForm::kByContent);
    document::ToolPathDocument path = read_path(input, along_, where_);
    robot::PathTask task =
        path_task(path.path, along_, where_, robot, elasticity, document.task, load_.frame == "feed");
    document::Json placement;
    if (!along_.place.empty()) {
      cli::ProgressBar bar("best-pose: places", !quiet());
      placement =
          place_path(robot, task, path.frame, along_.place, threads(), [&](double at) { bar.show(at); });
    }
    PathResult result;
    {
      cli::ProgressBar bar("best-pose: path", !quiet());
      result = solve_path(robot, task, path.frame, document.errors, threads(),
                          [&](double share) { bar.show(share); });
    }
    if (!result.undone.empty()) {
      if (!along_.partial || result.document.is_null()) throw NoAnswer(along_.path + ": " + result.undone);
      warn(along_.path + ": " + result.undone);
    }
    if (!result.untold.empty()) warn(along_.path + ": " + result.untold);
    if (!placement.is_null()) result.document["placement"] = std::move(placement);
    write_document(main_output(), std::move(result.document));
    if (!along_.joints_csv.empty()) write_text(along_.joints_csv, std::move(result.joints_csv));
    if (!along_.offsets_csv.empty()) write_text(along_.offsets_csv, std::move(result.offsets_csv));
  }

  void search(const robot::Robot& robot, const robot::Elasticity& elasticity,
              document::PoseDocument& document) {
    document.pose_task = search_task(where_, document.plane.plane, robot, elasticity, document.task);
    const robot::PoseTask& task = document.pose_task;
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
    const bool asked = !load_.index.empty() || where_.redundancy_deg;
    if (asked && !document.search.redundancy_matters && task.redundancy.count > 1) {
      warn(idle_redundancy_text(robot, *task.stiffness.index));
    }
    if (const std::string metres = metres_text(where_, robot); !metres.empty()) warn(metres);
    const robot::FoundPose& best = document.search.best;
    const auto report = [&](const robot::FoundPose& found) {
      document.reports.push_back(
          robot::report_pose(robot, found.angles, document.task, elasticity, document.errors));
    };
    report(best);
    if (const std::string text = untold_score_text(document.reports.front(), *document.task.index);
        !text.empty())
      warn("the best pose: " + text);
    for (const robot::FoundPose& found : document.search.alternatives) report(found);
    document.moves = robot::part_moves(robot, task, best);
    document.sweep = robot::redundancy_sweep(robot, task, best.at.x, best.at.y);
    write_document(main_output(), document::pose_to_json(document, robot));
    if (!scan) return;
    write_document(map_path_,
                   document::pose_map_to_json(robot::pose_map(robot, *scan), task, document.plane));
  }

  void score_poses(const robot::Robot& robot, const robot::Elasticity& elasticity,
                   document::PoseDocument& document) {
    const document::Input input = read_input(evaluate_path_, cli::InputForm::kJson);
    const document::PoseListDocument list = document::pose_list_from_json(input.document, input.source);
    document.names = list.names;
    for (const robot::JointAngles& angles : list.poses) {
      const std::string place = input.source.name + ": /poses/" + std::to_string(document.evaluated.size());
      check_feed(document.task, robot::robot_pose(robot, angles).tool.linear().col(2), " of " + place);
      document.evaluated.push_back(
          robot::report_pose(robot, angles, document.task, elasticity, document.errors));
      const robot::PoseReport& report = document.evaluated.back();
      if (std::isnan(report.score)) {
        warn(place + ": a singular pose: the arm cannot yield in a direction that the index " +
             document.task.index->name + " takes into account, so it has no score");
      }
      if (const std::string text = untold_score_text(report, *document.task.index); !text.empty())
        warn(place + ": " + text);
      if (report.limit_margin_rad < 0) {
        warn(place + "/joints_deg: " + number_text(degrees_from_radians(-report.limit_margin_rad), 3) +
             " degrees outside the joint limits");
      }
    }
    write_document(main_output(), document::evaluation_to_json(document));
  }

  std::string robot_path_, map_path_, evaluate_path_;
  SearchOptions where_;
  PathOptions along_;
  LoadOptions load_;
  CutOptions cut_;
  KeepOutOptions keep_out_;
  std::optional<std::array<double, 3>> tool_point_mm_;
  std::optional<int> alternatives_;
  std::vector<AssumedStiffness> assumed_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::BestPose().main(argc, argv); }
