#include "cut_options.h"

#include "base/number_text.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "document/kinds/cut_json.h"
#include "document/text/data_error.h"
#include "milling/turning_force.h"

namespace stablecut {
namespace {

constexpr double kLargestForce = 1e9;  // N
constexpr double kDeepestMm = 200;

// The room of milling and that of robots do not know each other.
robot::CutLoad load_of(const milling::TurningForce& force, double depth_m) {
  robot::CutLoad load{depth_m, force.mean_n, force.turning_n, {}};
  for (const milling::TurningForce::Wall& wall : force.walls)
    load.walls.push_back({wall.angle_rad == 0, wall.leaving_n});
  return load;
}

}  // namespace

void add_cut_options(CLI::App& app, CutOptions& options) {
  cli::add_number_option(app, "--cut-depth", options.depth_mm, "Depth of --cut along the tool axis, mm",
                         "a depth above 0 and at most 200 mm",
                         [](double value) { return value > 0 && value <= kDeepestMm; });
  cli::add_vector_option(app, "--feed", options.feed,
                         "Direction of its feed, base frame; a path has its own");
}

void check_cut_options(const CutOptions& options, bool along_path) {
  cli::refuse_if(!options.given() && options.depth_mm, "--cut-depth: expected with --cut only");
  cli::refuse_if(!options.given() && options.feed, "--feed: expected with --cut only");
  if (!options.given()) return;
  cli::refuse_if(!options.depth_mm, "--cut-depth: missing: expected the depth of the cut, mm");
  cli::refuse_if(along_path && options.feed, "--feed: expected without --path, which has its own");
  cli::refuse_if(!along_path && !options.feed, "--feed: missing: expected the direction of the cut's feed");
  cli::refuse_if(options.feed && Eigen::Vector3d(options.feed->data()).isZero(0),
                 "--feed: 0,0,0: expected a direction");
}

void take_cut(const document::Input& input, const CutOptions& options, robot::StiffnessTask& task) {
  const document::CutDocument cut = document::cut_from_json(input.document, input.source);
  cli::refuse_if(!cut.feed_per_tooth_m, "--cut: expected feed_per_tooth_mm and diameter_mm in the cut");
  const double depth_m = metres_from_mm(*options.depth_mm);
  const robot::CutLoad load = load_of(milling::turning_force(cut.cutter, cut.load, depth_m), depth_m);
  if (!(load.peak_n() > 0 && load.peak_n() < kLargestForce))
    throw document::DataError(input.source.name, "/", number_text(load.peak_n()) + " N",
                              "expected a cut whose force is above 0 and below 1e9 N");
  task.cut = std::make_shared<robot::CutLoad>(load);
  if (options.feed) task.feed = Eigen::Vector3d(options.feed->data()).stableNormalized();
}

void check_feed(const robot::StiffnessTask& task, const Eigen::Vector3d& tool_axis,
                const std::string& whose) {
  cli::refuse_if(task.cut && !robot::across_tool(task.feed, tool_axis),
                 "--feed: along the tool axis" + whose + ": expected a direction across it");
}

}  // namespace stablecut
