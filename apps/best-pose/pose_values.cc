#include "pose_values.h"

#include <cmath>
#include <string_view>
#include <vector>

#include "base/range.h"
#include "base/units.h"
#include "cli/exit_status.h"

namespace stablecut {
namespace {

constexpr int kMostPlaces = 100'000;
constexpr double kFarthestToolMm = 1e6;       // as in a robot document
constexpr double kDefaultJointSpeedDeg = 60;  // deg/s, of a joint whose speed nobody says

}  // namespace

Eigen::Vector3d tool_point_m(const std::array<double, 3>& point_mm) {
  Eigen::Vector3d point;
  for (Eigen::Index d = 0; d < 3; ++d) {
    cli::refuse_if(std::abs(point_mm[d]) > kFarthestToolMm, "--tool-point: expected lengths in mm up to 1e6");
    point[d] = metres_from_mm(point_mm[d]);
  }
  return point;
}

robot::Box parse_box(const std::string& text) {
  const auto fields = split(text, ',');
  robot::Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto band = fields.size() == 3 ? parse_band(fields[d]) : std::nullopt;
    cli::refuse_if(!band, "--keep-out: " + text + ": expected XFROM:XTO,YFROM:YTO,ZFROM:ZTO, mm");
    box.least_m[static_cast<Eigen::Index>(d)] = metres_from_mm(band->from);
    box.most_m[static_cast<Eigen::Index>(d)] = metres_from_mm(band->to);
  }
  return box;
}

robot::PlaceGrid place_grid(const std::string& text) {
  std::vector<Range> ranges;
  for (const std::string_view field : split(text, ',')) {
    const auto range = parse_range(field);
    cli::refuse_if(!range, "--place: " + text + ": expected FROM:TO:COUNT for x, y, perhaps z, and the turn");
    ranges.push_back(*range);
  }
  cli::refuse_if(ranges.size() != 3 && ranges.size() != 4,
                 "--place: " + text + ": expected FROM:TO:COUNT for x, y, perhaps z, and the turn");
  const auto scaled = [](Range range, double unit) {
    return Range{range.from * unit, range.to * unit, range.count};
  };
  robot::PlaceGrid grid;
  grid.x = scaled(ranges[0], metres_from_mm(1));
  grid.y = scaled(ranges[1], metres_from_mm(1));
  if (ranges.size() == 4) grid.z = scaled(ranges[2], metres_from_mm(1));
  grid.turn = scaled(ranges.back(), radians_from_degrees(1));
  double size = 1;
  for (const Range& range : ranges) size *= range.count;
  cli::refuse_if(size > kMostPlaces,
                 "--place: " + text + ": expected at most " + std::to_string(kMostPlaces) + " places");
  return grid;
}

robot::JointAngles joint_speeds(const std::string& text, const robot::Robot& robot) {
  robot::JointAngles speeds;
  for (int j = 0; j < robot::kJoints; ++j)
    speeds[j] = robot.joints[j].max_speed.value_or(radians_from_degrees(kDefaultJointSpeedDeg));
  if (text.empty()) return speeds;
  const auto fields = split(text, ',');
  const bool right = fields.size() == 1 || fields.size() == robot::kJoints;
  for (int j = 0; j < robot::kJoints && right; ++j) {
    const auto speed = parse_number(fields[fields.size() == 1 ? 0 : j]);
    // The least numbers there are vanish in radians.
    speeds[j] = radians_from_degrees(speed.value_or(0));
    cli::refuse_if(!(speeds[j] > 0), "--joint-speed: " + text + ": expected speeds above 0 deg/s");
  }
  cli::refuse_if(!right, "--joint-speed: " + text + ": expected one number or six, separated by commas");
  return speeds;
}

}  // namespace stablecut
