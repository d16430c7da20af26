// Robots and paths that the tests of path searches share.
#pragma once

#include "robot/path_search.h"
#include "robot/robot_fixtures_test.h"

namespace stablecut::robot::fixtures {

/// A row of the table, mm and deg.
struct TableRow {
  double a_mm, alpha_deg, d_mm, sign, offset_deg, min_deg, max_deg;
};

inline Robot robot_of_table(const std::array<TableRow, kJoints>& rows) {
  Robot robot;
  for (int j = 0; j < kJoints; ++j) {
    Joint& joint = robot.joints[j];
    joint.name = std::string("J") + static_cast<char>('1' + j);
    joint.a_m = metres_from_mm(rows[j].a_mm);
    joint.set_alpha(radians_from_degrees(rows[j].alpha_deg));
    joint.d_m = metres_from_mm(rows[j].d_mm);
    joint.theta_sign = rows[j].sign;
    joint.theta_offset_rad = radians_from_degrees(rows[j].offset_deg);
    joint.min_rad = radians_from_degrees(rows[j].min_deg);
    joint.max_rad = radians_from_degrees(rows[j].max_deg);
  }
  robot.tool.translation() << 0, 0, 0.21;
  return robot;
}

/// Sizes as of a robot for 165 kg; angle 3 is counted from the horizontal.
inline Robot fanuc_like() {
  Robot robot = robot_of_table({{{0, 0, 670, 1, 0, -185, 185},
                                 {312, -90, 0, 1, -90, -60, 76},
                                 {1075, 0, 0, -1, 0, -80, 230},
                                 {225, -90, 1280, -1, 0, -360, 360},
                                 {0, 90, 0, 1, 0, -125, 125},
                                 {0, -90, 215, -1, 0, -360, 360}}});
  robot.joints[2].coupling = {1, 1};
  robot.joints[2].coupled_min_rad = radians_from_degrees(-100);
  robot.joints[2].coupled_max_rad = radians_from_degrees(200);
  return robot;
}

/// Sizes as of a robot for 100 kg, with a shoulder off the middle.
inline Robot staubli_like() {
  return robot_of_table({{{0, 0, 642, 1, 0, -180, 180},
                          {250, -90, 50, 1, -90, -115, 120},
                          {950, 0, 0, 1, 90, -140, 145},
                          {0, 90, 800, 1, 0, -270, 270},
                          {0, -90, 0, 1, 0, -115, 120},
                          {0, 90, 194, 1, 0, -270, 270}}});
}

/// A robot, where its workpiece lies, and what its joints can.
struct PathCell {
  const char* name;
  Robot robot;
  Eigen::Vector3d workpiece;
  JointAngles stiffness, max_speed_deg;
};

inline std::array<PathCell, 3> path_cells() {
  return {{{"KR360",
            kr360(),
            {1.8, 0, 1.0},
            k_theta_2d(),
            (JointAngles() << 100, 90, 90, 120, 110, 160).finished()},
           {"FANUC-like",
            fanuc_like(),
            {1.6, 0, 0.8},
            0.5 * k_theta_2d(),
            (JointAngles() << 130, 115, 125, 180, 180, 260).finished()},
           {"Staubli-like",
            staubli_like(),
            {1.0, 0, 0.6},
            0.3 * k_theta_2d(),
            (JointAngles() << 160, 150, 150, 260, 260, 400).finished()}}};
}

inline ToolPathPoint path_point(const PathCell& cell, double x, double y, double z, double tilt, double about,
                                double speed) {
  const Eigen::Vector3d axis(std::sin(tilt) * std::cos(about), std::sin(tilt) * std::sin(about),
                             -std::cos(tilt));
  return {cell.workpiece + Eigen::Vector3d(x, y, z), axis, std::nullopt, speed};
}

inline ToolPath line_path(const PathCell& cell, int count, double speed) {
  ToolPath path;
  for (int i = 0; i < count; ++i)
    path.push_back(path_point(cell, 0, -0.5 + i / (count - 1.0), 0, 0, 0, speed));
  return path;
}

inline ToolPath circle_path(const PathCell& cell, int count, double speed) {
  ToolPath path;
  for (int i = 0; i < count; ++i) {
    const double at = kTwoPi * i / (count - 1.0);
    path.push_back(path_point(cell, 0.3 * std::cos(at), 0.3 * std::sin(at), 0, 0, 0, speed));
  }
  return path;
}

/// Ten turns out to 250 mm, the axis tilting by up to 20 degrees.
inline ToolPath spiral_path(const PathCell& cell, int count, double speed) {
  ToolPath path;
  for (int i = 0; i < count; ++i) {
    const double share = i / (count - 1.0), at = 10 * kTwoPi * share, radius = 0.02 + 0.23 * share;
    path.push_back(path_point(cell, radius * std::cos(at), radius * std::sin(at), 0.05 * share,
                              radians_from_degrees(20) * share, at, speed));
  }
  return path;
}

/// Over 600 x 400 mm in nine lines.
inline ToolPath zigzag_path(const PathCell& cell, int count, double speed) {
  ToolPath path;
  constexpr int kLines = 9;
  const double length = kLines * 0.6 + 0.4;
  for (int i = 0; i < count; ++i) {
    double left = length * i / (count - 1.0), x = 0, y = -0.2;
    for (int line = 0; left > 0; ++line) {
      const double along = std::min(left, 0.6);
      x = line % 2 == 0 ? along : 0.6 - along;
      left -= along;
      if (left <= 0) break;
      const double across = std::min(left, 0.4 / (kLines - 1));
      y += across;
      left -= across;
    }
    path.push_back(path_point(cell, x - 0.3, y, 0, 0, 0, speed));
  }
  return path;
}

inline PathTask path_task(const PathCell& cell, ToolPath path, std::string_view index) {
  PathTask task;
  task.path = std::move(path);
  task.stiffness.index = &stiffness_index(index);
  if (index == "deflection") {
    task.stiffness.force_n = Eigen::Vector3d(200, 400, -150);
    task.force_in_feed = true;
  }
  task.elasticity = joints_only(cell.stiffness.cwiseInverse());
  task.max_speed = cell.max_speed_deg * radians_from_degrees(1);
  task.limit_margin_rad = radians_from_degrees(2);
  task.singularity_margin = 0.01;
  return task;
}

}  // namespace stablecut::robot::fixtures
