// What best-pose says about poses and robots: the facts of lib/robot in words.
#pragma once

#include <string>

#include "document/text/data_error.h"
#include "document/text/json_text.h"
#include "robot/inverse.h"
#include "robot/joint_stiffness.h"
#include "robot/pose_report.h"
#include "robot/pose_task.h"
#include "search_task.h"

namespace stablecut {

/// The names of the stiffness indices, separated by |.
std::string index_names();
/// What each of them is, for --help.
std::string index_help();

/// Why a search found no pose.
std::string no_pose_text(const robot::Obstacle& obstacle, const robot::Robot& robot);

/// That the height was perhaps meant in metres; empty where it could not be.
std::string metres_text(const SearchOptions& where, const robot::Robot& robot);

/// The error for a robot without analytic inverse kinematics: place in the robot document, value and what was
/// expected.
document::DataError unsupported_robot(const robot::UnsupportedGeometry& bad, const robot::Robot& robot,
                                      const document::Source& source);

/// Which springs have no compliance and count as rigid; empty where all have one.
std::string rigid_springs_text(const robot::JointStiffness& joints, const robot::Robot& robot);

/// That a pose's score is smaller than its own standard deviation; empty where it is larger, or the deviation
/// is not known.
std::string untold_score_text(const robot::PoseReport& report, const robot::StiffnessIndex& index);

/// A warning that the redundancy angle cannot change the index.
std::string idle_redundancy_text(const robot::Robot& robot, const robot::StiffnessIndex& index);

}  // namespace stablecut
