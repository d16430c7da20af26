#include "keep_out_options.h"

#include "base/units.h"
#include "pose_values.h"
#include "robot/keep_out.h"

namespace stablecut {

void add_keep_out_options(CLI::App& app, KeepOutOptions& options) {
  cli::add_number_option(
      app, "--keep-out-radius", options.radius_mm,
      "Radius of a cylinder round axis 1 that tool and forearm keep out of, mm; 0: none (default: "
      "the robot document's, else what its dimensions say)",
      "a number not below 0", [](double value) { return value >= 0; });
  cli::add_number_option(app, "--floor", options.floor_mm,
                         "Height below which neither tool nor links may be, mm, base frame", "a number",
                         [](double) { return true; });
  cli::add_repeated_option(app, "--keep-out", "BOX",
                           "XFROM:XTO,YFROM:YTO,ZFROM:ZTO in mm, base frame: a box that tool and links keep "
                           "out of; may be given several times",
                           [&options](const std::string& text) { options.boxes.push_back(parse_box(text)); });
}

void apply(const KeepOutOptions& options, robot::Robot& robot) {
  if (options.radius_mm)
    robot.keep_out_radius_m = metres_from_mm(*options.radius_mm);
  else if (!(robot.keep_out_radius_m > 0))
    robot.keep_out_radius_m = robot::column_radius_m(robot);
  if (options.floor_mm) robot.floor_m = metres_from_mm(*options.floor_mm);
  robot.keep_out_boxes = options.boxes;
}

}  // namespace stablecut
