#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

#include "robot/path_brute_force_test.h"
#include "robot/path_fixtures_test.h"
#include "robot/pose_report.h"
#include "robot/pose_search.h"
#include "robot/singularity_lanes.h"

namespace stablecut::robot {
namespace {

using namespace fixtures;

PathCell cell_for(PathCell cell, int kind) {
  if (kind == 3) cell.robot = with_tool_offset(cell.robot, 0.15);
  return cell;
}

ToolPath path_of(const PathCell& cell, int kind, int count, double speed) {
  const std::array<ToolPath (*)(const PathCell&, int, double), 4> kinds{line_path, circle_path, spiral_path,
                                                                        zigzag_path};
  return kinds[kind](cell, count, speed);
}

// Whatever a part says holds by forward kinematics, the limits and the speeds.
void check_part(const Robot& robot, const PathTask& task, const PathModel& model, const PathPart& part) {
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    const PathPose& pose = part.poses[i];
    const ToolPathPoint& point = task.path[part.first + i];
    const RobotPose at = robot_pose(robot, pose.angles);
    REQUIRE((at.tool.translation() - point.position).norm() < 1e-9);
    REQUIRE((at.tool.linear().col(2) - point.axis).norm() < 1e-9);
    REQUIRE(limit_margin_rad(robot, pose.angles) >= task.limit_margin_rad - 1e-9);
    REQUIRE(is_away_from_singularities(at, task.singularity_margin * (1 - 1e-6)));
    const double score = stiffness_score(translational_compliance(at, task.elasticity), at.tool.linear(),
                                         point_task(task, model.frames(), part.first + i));
    REQUIRE(std::abs(path_cost(*task.stiffness.index, score) / pose.cost - 1) < 1e-7);
    largest = std::max(largest, pose.cost);
    sum += pose.cost;
    if (i == 0) continue;
    const JointAngles step = (pose.angles - part.poses[i - 1].angles).cwiseAbs();
    REQUIRE((step.array() <= (task.max_speed * model.frames().time[part.first + i]).array()).all());
    REQUIRE((step.array() <= kPi / 2).all());
    REQUIRE(std::abs(pose.turn - part.poses[i - 1].turn) <=
            task.most_turn_per_metre * model.frames().distance[part.first + i] + 1e-9);
  }
  const double objective = task.mean_objective ? sum / static_cast<double>(part.poses.size()) : largest;
  CHECK(std::abs(part.objective / objective - 1) < 1e-12);
}

TEST_CASE("paths are not worse than brute force in steps of a degree") {
  const PathCell plain = path_cells()[GENERATE(0, 1, 2)];
  const int kind = GENERATE(0, 1, 2, 3);
  const bool mean = GENERATE(false, true);
  const PathCell cell = cell_for(plain, kind);
  CAPTURE(cell.name, kind, mean);
  // Of the longer paths the last points, some 100 mm apart.
  ToolPath path = path_of(cell, kind, kind == 2 ? 120 : kind == 3 ? 60 : 20, kind == 2 ? 0.6 : 1);
  path.erase(path.begin(), path.end() - 20);
  PathTask task = path_task(cell, std::move(path), "deflection");
  task.mean_objective = mean;
  const PathModel model(cell.robot, task);
  const PathSearch search = search_path(model, 2);
  REQUIRE(search.parts.size() == 1);
  CHECK(search.obstacles.empty());
  check_part(cell.robot, task, model, search.parts[0]);
  // Joints turn by 8 to 30 degrees a step: a redundancy that turns by more than 60 needs all of them.
  const double brute = brute_force_objective(cell.robot, task, 60);
  REQUIRE(std::isfinite(brute));
  CHECK(search.parts[0].objective <= brute * (1 + 1e-3));
}

TEST_CASE("what is said of the progress never goes back, and ends with all") {
  const PathCell cell = path_cells()[0];
  const bool mean = GENERATE(false, true);
  PathTask task = path_task(cell, line_path(cell, 200, 1), "deflection");
  task.mean_objective = mean;
  std::vector<double> shares;
  search_path(PathModel(cell.robot, task), 1, [&](double share) { shares.push_back(share); });
  REQUIRE(shares.size() > 3);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.front() >= 0);
  CHECK(shares.back() == 1);
}

TEST_CASE("a point of a path costs what the report of its pose says, whatever yields") {
  const Robot robot = with_tool_offset(kr360(), 0.1);
  const PathCell cell{"", robot, {1.7, 0.2, 1.1}, k_theta_2d(), path_cells()[0].max_speed_deg};
  const std::string_view index = GENERATE("deflection", "weakest", "combined", "axial");
  const ElasticModel yields =
      GENERATE(ElasticModel::kJointsOnly, ElasticModel::kBase, ElasticModel::kThreeAxis);
  CAPTURE(index, yields);
  std::mt19937_64 generator(45);
  PathTask task = path_task(cell, spiral_path(cell, 6, 0.1), index);
  task.elasticity = random_elasticity(robot, yields, generator);
  if (index == "deflection" && yields == ElasticModel::kBase) {
    // In the tool's frame instead of the feed's.
    task.force_in_feed = false;
    task.stiffness.force_in_tool = true;
  }
  const PathModel model(robot, task);
  int compared = 0;
  for (std::size_t i = 0; i < task.path.size(); ++i) {
    for (int b = 0; b < kBranches; ++b) {
      const auto pose = model.pose(i, 0.3 * static_cast<double>(i), b);
      if (!pose) continue;
      const PoseReport report =
          report_pose(robot, pose->angles, point_task(task, model.frames(), i), task.elasticity, {});
      // The kernel's largest eigenvalue is promised to 1e-8 of the spread.
      CHECK(std::abs(path_cost(*task.stiffness.index, report.score) / pose->cost - 1) < 1e-8);
      ++compared;
    }
  }
  CHECK(compared > 20);
}

TEST_CASE("a path of one point costs what the search of poses finds there") {
  const Robot robot = with_tool_offset(kr360(), 0.1);
  const PathCell cell{"", robot, {1.7, 0.2, 1.1}, k_theta_2d(), path_cells()[0].max_speed_deg};
  std::mt19937_64 generator(46);
  PathTask task = path_task(cell, {path_point(cell, 0, 0, 0, 0, 0, 0.1)}, "deflection");
  task.force_in_feed = false;
  task.elasticity = random_elasticity(robot, ElasticModel::kThreeAxis, generator);
  const PathModel model(robot, task);
  const PathSearch path = search_path(model, 1);
  PoseTask pose = tool_down(robot, cell.workpiece.z(), "deflection", 2);
  pose.x = {cell.workpiece.x(), cell.workpiece.x(), 1};
  pose.y = {cell.workpiece.y(), cell.workpiece.y(), 1};
  pose.stiffness = task.stiffness;
  pose.elasticity = task.elasticity;
  // Neither search stops nearer than 1e-6 of the score.
  CHECK(std::abs(path.parts.at(0).objective / search_poses(robot, pose, 0, 1).best.score - 1) < 1e-6);
}

TEST_CASE("a path in one motion is the same on any number of threads") {
  const PathCell cell = cell_for(path_cells()[0], 3);
  const PathTask task = path_task(cell, zigzag_path(cell, 50, 0.5), "deflection");
  const PathModel model(cell.robot, task);
  const PathSearch one = search_path(model, 1), three = search_path(model, 3);
  REQUIRE(one.parts.size() == three.parts.size());
  for (std::size_t i = 0; i < one.parts[0].poses.size(); ++i)
    CHECK(one.parts[0].poses[i].angles == three.parts[0].poses[i].angles);
}

TEST_CASE("points so near that no joint turns by a degree between them", "[campaign]") {
  // 0.4 mm apart at 50 mm/s: 8 ms, in which the slowest joint turns by 0.7 degrees.
  const PathCell cell = cell_for(path_cells()[0], 3);
  PathTask dense = path_task(cell, line_path(cell, 2501, 0.05), "deflection");
  dense.stiffness.force_n = Eigen::Vector3d(400, 0, 0);
  dense.force_in_feed = false;
  PathTask coarse = dense;
  coarse.path = line_path(cell, 26, 0.05);
  const PathModel dense_model(cell.robot, dense), coarse_model(cell.robot, coarse);
  const PathSearch found = search_path(dense_model, 2), reference = search_path(coarse_model, 2);
  REQUIRE(found.parts.size() == 1);
  REQUIRE(reference.parts.size() == 1);
  check_part(cell.robot, dense, dense_model, found.parts[0]);
  // The coarse path's points are among the dense one's and are bound by less.
  CHECK(found.parts[0].objective >= reference.parts[0].objective * (1 - 1e-5));
  CHECK(found.parts[0].objective <= reference.parts[0].objective * 1.01);
}

TEST_CASE("dense paths are not worse than the plain ladder", "[campaign]") {
  // The slowest joint does not turn by a degree between two points, and others do: the plain ladder moves.
  const PathCell cell = cell_for(path_cells()[0], 3);
  PathTask task = path_task(cell, zigzag_path(cell, 1100, 0.5), "deflection");
  task.mean_objective = GENERATE(false, true);
  CAPTURE(task.mean_objective);
  const PathModel model(cell.robot, task);
  const std::size_t end = model.size() - 1;
  const Ladder ladder = model.whole_ladder(radians_from_degrees(1));
  const std::vector<StepLimit> limits = model.step_limits();
  REQUIRE(limits[1].joint.minCoeff() < radians_from_degrees(1));
  REQUIRE(limits[1].joint.maxCoeff() > radians_from_degrees(1));
  const ChainTask plain{model, ladder, limits, kAllBranches, 2, {}};
  double best = 0;
  if (task.mean_objective) {
    const auto chain = best_chain(plain, 0, end, {1, 0});
    REQUIRE(chain);
    best = chain->total / static_cast<double>(model.size());
  } else {
    const auto through = path_through(plain, 0, end);
    REQUIRE(through);
    best = through->best();
  }
  const PathSearch found = search_path(model, 2);
  REQUIRE(found.parts.size() == 1);
  check_part(cell.robot, task, model, found.parts[0]);
  // What turning weighs beside the mean.
  CHECK(found.parts[0].objective <= best * (1 + 1e-4));
}

TEST_CASE("limits on the turning of the redundancy and its interval are kept") {
  const PathCell cell = cell_for(path_cells()[0], 3);
  PathTask task = path_task(cell, zigzag_path(cell, 60, 0.1), "deflection");
  const PathModel free_model(cell.robot, task);
  const double free = search_path(free_model, 2).parts.at(0).objective;
  task.most_turn_per_metre = radians_from_degrees(20);
  const PathModel slow_model(cell.robot, task);
  const PathSearch slow = search_path(slow_model, 2);
  REQUIRE(slow.parts.size() == 1);
  check_part(cell.robot, task, slow_model, slow.parts[0]);
  CHECK(slow.parts[0].objective >= free * (1 - 1e-5));
  task.redundancy = Range{radians_from_degrees(20), radians_from_degrees(50), 7};
  const PathModel bound_model(cell.robot, task);
  const PathSearch bound = search_path(bound_model, 2);
  REQUIRE(bound.parts.size() == 1);
  for (const PathPose& pose : bound.parts[0].poses) {
    const double degrees = degrees_from_radians(redundancy_angle(robot_pose(cell.robot, pose.angles).tool));
    CHECK(degrees > 20 - 1e-6);
    CHECK(degrees < 50 + 1e-6);
  }
}

TEST_CASE("stretches that cannot be driven, and what they break") {
  const PathCell cell = path_cells()[0];
  PathTask task = path_task(cell, {}, "weakest");
  const auto search = [&] {
    const PathModel model(cell.robot, task);
    const PathSearch found = search_path(model, 2);
    std::size_t driven = 0;
    for (const PathPart& part : found.parts) {
      check_part(cell.robot, task, model, part);
      driven += part.poses.size();
    }
    return std::pair(found, driven);
  };
  SECTION("reach") {
    for (int i = 0; i < 31; ++i) task.path.push_back(path_point(cell, 0.05 * i, 0, 0, 0, 0, 0.1));
    const auto [found, driven] = search();
    REQUIRE(found.obstacles.size() >= 1);
    CHECK(found.obstacles.back().last == 30);
    CHECK(found.obstacles.back().fault.kind == PoseFault::Kind::kReach);
    CHECK(driven == found.obstacles.front().first);
  }
  SECTION("a joint's speed") {
    task.path = line_path(cell, 41, 0.05);
    for (int i = 15; i <= 20; ++i) task.path[i].speed = 5;
    const auto [found, driven] = search();
    CHECK(driven == 41);
    REQUIRE(found.obstacles.size() == 1);
    const PathObstacle& obstacle = found.obstacles[0];
    CHECK(obstacle.between);
    CHECK(obstacle.speed);
    CHECK(obstacle.first == 14);
    CHECK(obstacle.last == 20);
    CHECK(obstacle.fault.joint == 0);
    // About 1.8 m from axis 1: joint 1 turns at 5 m/s over that distance.
    CHECK(obstacle.fault.missing == Approx(5 / 1.8 / task.max_speed[0]).epsilon(0.05));
  }
  SECTION("keep-out") {
    Robot robot = cell.robot;
    robot.keep_out_radius_m = 1.7;
    task.path = circle_path(cell, 41, 0.05);
    const PathModel model(robot, task);
    const PathSearch found = search_path(model, 2);
    REQUIRE(found.obstacles.size() == 1);
    CHECK(found.obstacles[0].fault.kind == PoseFault::Kind::kKeepOut);
    for (std::size_t i = 0; i < task.path.size(); ++i) {
      const bool inside = task.path[i].position.head<2>().norm() < 1.7;
      CHECK(inside == (i >= found.obstacles[0].first && i <= found.obstacles[0].last));
    }
  }
  SECTION("keep-out of a box and of the floor alone") {
    task.path = line_path(cell, 41, 0.05);
    const bool floor = GENERATE(false, true);
    Robot robot = cell.robot;
    // The straight tool stands on the line.
    if (floor)
      robot.floor_m = cell.workpiece.z() + 0.001;
    else
      robot.keep_out_boxes = {{cell.workpiece - Eigen::Vector3d(0.1, 0.101, 0.1),
                               cell.workpiece + Eigen::Vector3d(0.1, 0.101, 0.1)}};
    const PathModel model(robot, task);
    const PathSearch found = search_path(model, 2);
    REQUIRE(found.obstacles.size() == 1);
    CHECK(found.obstacles[0].fault.kind == PoseFault::Kind::kKeepOut);
    CHECK(found.obstacles[0].first == (floor ? 0 : 16));
    CHECK(found.obstacles[0].last == (floor ? 40 : 24));
  }
  SECTION("a joint that is wound up") {
    // Round axis 1 by more than its range.
    const PathCell here{"", cell.robot, {0, 0, 1.0}, cell.stiffness, cell.max_speed_deg};
    for (int i = 0; i <= 80; ++i) {
      const double at = radians_from_degrees(-180 + 5 * i);
      task.path.push_back(path_point(here, 1.8 * std::cos(at), 1.8 * std::sin(at), 0, 0, 0, 0.1));
    }
    const auto [found, driven] = search();
    CHECK(driven == 81);
    REQUIRE(found.obstacles.size() == 1);
    CHECK(found.obstacles[0].between);
    CHECK(!found.obstacles[0].speed);
    CHECK(found.obstacles[0].fault.kind == PoseFault::Kind::kLimit);
    CHECK(found.obstacles[0].fault.joint == 0);
  }
}

TEST_CASE("why the worst point is not better: what all poses of whole degrees there say") {
  std::array<int, 4> seen{};
  for (int n = 0; n < 24; ++n) {
    const PathCell cell = cell_for(path_cells()[n % 3], 3);
    PathTask task = path_task(cell, path_of(cell, n % 4, 15, 0.3), n % 5 == 0 ? "weakest" : "deflection");
    // Joints from slow to as they are, and limits that leave little or much.
    task.max_speed *= std::array{0.3, 0.6, 1.0}[n / 8];
    task.limit_margin_rad = radians_from_degrees(n % 2 == 0 ? 2 : 25);
    const PathModel model(cell.robot, task);
    const PathSearch found = search_path(model, 1);
    if (found.parts.empty()) continue;
    const PathPart& part = found.parts[0];
    const WorstPoint worst = worst_point(model, part);
    INFO("case " << n << ", reason " << static_cast<int>(worst.reason));
    double largest = 0;
    for (const PathPose& pose : part.poses) largest = std::max(largest, pose.cost);
    CHECK(part.poses[worst.point - part.first].cost == largest);
    double same = kUnreached, any = kUnreached;
    for (const BruteNode& node : brute_nodes(cell.robot, task, model.frames(), worst.point)) {
      any = std::min(any, node.cost);
      if (node.branch == part.branch) same = std::min(same, node.cost);
    }
    // Half a per mille for other turns than whole degrees of the redundancy.
    const double better = largest * (1 - 5e-4), much_better = largest * (1 - 2e-3);
    switch (worst.reason) {
      case WorstPoint::Reason::kNeighbours:
        CHECK(same < better);
        CHECK(std::abs(worst.better_cost / same - 1) < 1e-2);
        break;
      case WorstPoint::Reason::kBranch:
        CHECK(same > much_better);
        CHECK(any < better);
        break;
      case WorstPoint::Reason::kFault:
        CHECK(any > much_better);
        CHECK(worst.fault.kind != PoseFault::Kind::kNone);
        CHECK(worst.better_cost < better);
        break;
      case WorstPoint::Reason::kPlace:
        CHECK(any > much_better);
        break;
    }
    ++seen[static_cast<std::size_t>(worst.reason)];
  }
  CAPTURE(seen[0], seen[1], seen[2], seen[3]);
  for (const auto reason :
       {WorstPoint::Reason::kFault, WorstPoint::Reason::kBranch, WorstPoint::Reason::kNeighbours})
    CHECK(seen[static_cast<std::size_t>(reason)] > 0);
}

TEST_CASE("the arms' singularity test agrees with that of poses") {
  std::mt19937_64 generator(3);
  for (const PathCell& cell : path_cells()) {
    const InverseKinematics inverse(cell.robot);
    int away_count = 0, near_count = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const Eigen::Isometry3d tool = robot_pose(cell.robot, random_angles(cell.robot, generator)).tool;
      ArmLanes lanes;
      solve_arms(inverse.constants(), inverse.target_of(tool), lanes);
      const Eigen::Vector3d point = inverse.home_from_base() * tool.translation();
      bool away[kArms];
      constexpr double kMargin = 0.1;
      arms_away_from_singularities(lanes, point.data(), kMargin, away);
      for (int arm = 0; arm < kArms; ++arm) {
        if (!std::isfinite(lanes.limit_margin[arm])) continue;
        JointAngles angles;
        for (int j = 0; j < kJoints; ++j) angles[j] = lanes.angle[j][arm];
        const double margin = singularity_margin(robot_pose(cell.robot, angles));
        if (std::abs(margin - kMargin) < 1e-6) continue;
        CHECK(away[arm] == (margin > kMargin));
        ++(away[arm] ? away_count : near_count);
      }
    }
    CHECK(away_count > 20);
    CHECK(near_count > 20);
  }
}

TEST_CASE("a turn that stays is no turning about the tool's axis") {
  const PathCell cell = path_cells()[0];
  const ToolPath path = spiral_path(cell, 2000, 0.1);
  const PathFrames frames = path_frames(path);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Matrix3d step = frames.tool[i] * frames.tool[i - 1].transpose();
    const Eigen::AngleAxisd turn(step);
    // The least rotation between the axes has its axis square to both.
    CHECK(std::abs(turn.angle() * turn.axis().dot(path[i].axis)) < 1e-9);
    CHECK((frames.tool[i].col(2) - path[i].axis).norm() < 1e-12);
    const Eigen::Isometry3d frame = tool_frame(path, frames, i, 0.3);
    CHECK(std::abs(std::remainder(redundancy_angle(frame) - frames.redundancy[i] - 0.3, kTwoPi)) < 1e-9);
    CHECK(std::abs(frames.time[i] - (path[i].position - path[i - 1].position).norm() / 0.1) < 1e-12);
  }
}

}  // namespace
}  // namespace stablecut::robot
