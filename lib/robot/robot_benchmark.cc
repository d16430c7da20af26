// Speed of the robot room on one core, as rates and ratios within one run: inverse kinematics, compliance, a
// map of the plane; beside them, when it is installed, Orocos KDL on the same robot.

#include <cmath>
#include <cstdio>
#include <vector>

#include "base/seconds_benchmark.h"
#include "robot/compliance.h"
#include "robot/pose_search.h"
#include "robot/robot_fixtures_test.h"

#ifdef STABLECUT_HAVE_KDL
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#endif

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

double sink = 0;

void print_rate(const char* what, double count, double time) {
  std::printf("  %-66s %8.3f million/s\n", what, 1e-6 * count / time);
}

// Searches over windows of 0.6 x 0.6 m with a tool off the axis, the worst of 25, against one over the whole
// plane.
void print_windows() {
  const Robot offset = with_tool_offset(kr360(), 0.2);
  for (const StiffnessIndex& index : stiffness_indices()) {
    const PoseTask plane = tool_down(offset, 1.6, index.name, 2);
    const double whole = least_seconds([&] { sink += search_poses(offset, plane, 5, 1).best.score; });
    double worst = 0;
    for (int i = 0; i < 25; ++i) {
      PoseTask window = plane;
      const double x = -1.8 + 0.6 * (i % 5), y = -1.8 + 0.6 * (i / 5);
      window.x = {x, x + 0.6, 13};
      window.y = {y, y + 0.6, 13};
      worst = std::max(worst, seconds([&] {
                         try {
                           sink += search_poses(offset, window, 5, 1).best.score;
                         } catch (const NoPose&) {
                         }
                       }));
    }
    std::printf("  search over a window, %-30s worst of 25: %.2f of the whole plane\n", index.name,
                worst / whole);
  }
}

#ifdef STABLECUT_HAVE_KDL
KDL::Chain kdl_chain(const Robot& robot) {
  KDL::Chain chain;
  const auto frame = [](const Eigen::Isometry3d& f) {
    const auto r = f.linear();
    return KDL::Frame(
        KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
        KDL::Vector(f.translation().x(), f.translation().y(), f.translation().z()));
  };
  KDL::Frame before = KDL::Frame::Identity();
  for (const Joint& joint : robot.joints) {
    // Rx(alpha) Tx(a) before the axis, the offset's turn and d after it.
    before = before * KDL::Frame(KDL::Rotation::RotX(joint.alpha_rad())) *
             KDL::Frame(KDL::Vector(joint.a_m, 0, 0));
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), before));
    chain.addSegment(KDL::Segment(
        KDL::Joint(KDL::Vector(0, 0, 0), KDL::Vector(0, 0, joint.theta_sign), KDL::Joint::RotAxis),
        KDL::Frame(KDL::Rotation::RotZ(joint.theta_offset_rad), KDL::Vector(0, 0, joint.d_m))));
    before = KDL::Frame::Identity();
  }
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), frame(robot.tool_in_frame6())));
  return chain;
}

KDL::JntArray kdl_angles(const JointAngles& angles) {
  KDL::JntArray array(kJoints);
  for (int j = 0; j < kJoints; ++j) array(j) = angles[j];
  return array;
}
#endif

}  // namespace

int main() {
  const Robot robot = kr360();
  const InverseKinematics inverse(robot);
  const JointAngles compliance = k_theta_2d().cwiseInverse();
  constexpr int kPoses = 10000, kRepeats = 40;
  std::mt19937_64 generator(1);
  std::vector<JointAngles> poses;
  std::vector<ArmTarget> targets;
  for (int i = 0; i < kPoses; ++i) {
    poses.push_back(random_angles(robot, generator));
    targets.push_back(inverse.target_of(robot_pose(robot, poses.back()).tool));
  }
  std::printf("KR360, one core\n");
  const double inverse_time = least_seconds([&] {
    ArmLanes lanes;
    for (int r = 0; r < kRepeats; ++r) {
      for (const ArmTarget& target : targets) {
        solve_arms(inverse.constants(), target, lanes);
        sink += lanes.limit_margin[r % kBranches] > 0 ? 1 : 0;
      }
    }
  });
  const double solves = static_cast<double>(kPoses) * kRepeats;
  print_rate("inverse kinematics, 8 branches with copies and limits", solves, inverse_time);

  const double pose_time = least_seconds([&] {
    for (int r = 0; r < kRepeats / 4; ++r) {
      for (const JointAngles& angles : poses) {
        sink += principal_compliances(translational_compliance(robot_pose(robot, angles), compliance))[0];
      }
    }
  });
  print_rate("compliance with principal stiffnesses, from joint angles", solves / 4, pose_time);
  const double arm_time = least_seconds([&] {
    ArmLanes lanes;
    double entries[6][kArms];
    solve_arms(inverse.constants(), targets[0], lanes);
    for (int r = 0; r < kRepeats; ++r) {
      for (const ArmTarget& target : targets) {
        arm_compliances(lanes, target.origin, compliance.data(), entries);
        Eigen::Matrix3d matrix;
        for (int i = 0; i < kArms; ++i) {
          matrix << entries[0][i], entries[1][i], entries[2][i], entries[1][i], entries[3][i], entries[4][i],
              entries[2][i], entries[4][i], entries[5][i];
          sink += principal_compliances(matrix)[2];
        }
      }
    }
  });
  print_rate("compliance with principal stiffnesses, in the search", solves * kArms, arm_time);

  // Every spring that there may be, the left-out ones too.
  Elasticity elasticity = joints_only(compliance);
  for (int axis = 0; axis < 3; ++axis) elasticity.springs.push_back({Spring::Kind::kBase, 0, axis});
  for (int j = 0; j < kJoints; ++j) {
    for (int axis = 0; axis < 2; ++axis) elasticity.springs.push_back({Spring::Kind::kBearing, j, axis});
  }
  elasticity.compliance.conservativeResize(static_cast<Eigen::Index>(elasticity.springs.size()));
  elasticity.compliance.tail(15).setConstant(1e-7);
  const ArmSprings springs = arm_springs(robot, elasticity, inverse);
  for (const bool all : {false, true}) {
    const double time = least_seconds([&] {
      ArmLanes lanes;
      double entries[6][kArms];
      solve_arms(inverse.constants(), targets[0], lanes);
      for (int r = 0; r < kRepeats; ++r) {
        for (const ArmTarget& target : targets) {
          arm_compliances(lanes, target.origin, springs.joint, entries);
          if (all) add_spring_compliances(lanes, springs, target.origin, entries);
          sink += entries[5][3];
        }
      }
    });
    print_rate(all ? "compliance of joints, base and all bearings, in the search"
                   : "compliance of the joints, in the search",
               solves * kArms, time);
  }

  print_windows();

#ifdef STABLECUT_HAVE_KDL
  const KDL::Chain chain = kdl_chain(robot);
  KDL::ChainFkSolverPos_recursive forward(chain);
  KDL::ChainIkSolverPos_LMA numeric(chain);
  KDL::ChainJntToJacSolver jacobian_solver(chain);
  int found = 0;
  constexpr int kKdlPoses = 300;
  const double kdl_inverse = least_seconds([&] {
    found = 0;
    for (int i = 0; i < kKdlPoses; ++i) {
      KDL::Frame frame;
      forward.JntToCart(kdl_angles(poses[i]), frame);
      KDL::JntArray start = kdl_angles(poses[i]), result(kJoints);
      for (int j = 0; j < kJoints; ++j) start(j) += 0.2;
      found += numeric.CartToJnt(start, frame, result) == 0;
    }
  });
  print_rate("Orocos KDL, ChainIkSolverPos_LMA: one solution, start 0.2 rad off", kKdlPoses, kdl_inverse);
  std::printf("    (%d of %d converged); ratio per target %.0f\n", found, kKdlPoses,
              kdl_inverse / kKdlPoses / (inverse_time / solves));
  const double kdl_jacobian = least_seconds([&] {
    KDL::Jacobian jacobian(kJoints);
    for (const JointAngles& angles : poses) {
      jacobian_solver.JntToJac(kdl_angles(angles), jacobian);
      const auto columns = jacobian.data.topRows<3>();
      const Eigen::Matrix3d matrix = columns * compliance.asDiagonal() * columns.transpose();
      sink += principal_compliances(matrix)[0];
    }
  });
  print_rate("compliance by Orocos KDL's Jacobian", kPoses, kdl_jacobian);
  std::printf("    ratio %.1f\n", kdl_jacobian / kPoses / (pose_time / (solves / 4)));
#else
  std::printf("  (install liborocos-kdl-dev for a comparison)\n");
#endif

  std::printf("map of the plane z = 1.6 m, 20 mm, 5 degrees, all branches, two threads\n");
  for (const double offset : {0.0, 0.2}) {
    const Robot with_tool = with_tool_offset(robot, offset);
    PoseTask task = tool_down(with_tool, 1.6, "combined", 2);
    task.x = task.y = {-2.8, 2.8, 281};
    long reached = 0;
    const double map_time = least_seconds([&] {
      const PlaneScan scan = scan_plane(with_tool, task, 2);
      reached = (pose_map(with_tool, scan).branch.array() >= 0).count();
    });
    std::printf("  %s tool: %.2f s for %.2f million tool frames, %ld of %d points reached\n",
                offset > 0 ? "offset  " : "coaxial ", map_time, 281 * 281 * 72e-6, reached, 281 * 281);
  }
  const double search_time =
      seconds([&] { sink += search_poses(robot, tool_down(robot, 1.6, "combined", 2), 5, 2).best.score; });
  std::printf("search of the whole plane with refinement: %.3f s\n", search_time);
  return sink == 0;
}
