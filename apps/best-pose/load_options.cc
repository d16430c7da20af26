#include "load_options.h"

#include "base/units.h"
#include "cli/exit_status.h"
#include "words.h"

namespace stablecut {
namespace {

constexpr double kLargestForce = 1e9;  // N
constexpr double kWidestCone = 90;     // deg

}  // namespace

void add_load_options(CLI::App& app, LoadOptions& options) {
  cli::add_choice_option(app, "--index", options.index, index_names(), index_help());
  cli::add_vector_option(app, "--force", options.force_n, "Force on the tool point, N");
  cli::add_choice_option(app, "--force-frame", options.frame, "base|tool|feed",
                         "Frame of --force (default: base)");
  cli::add_number_option(
      app, "--force-cone", options.cone_deg, "The force may point anywhere within this angle of --force, deg",
      "an angle above 0 and at most 90", [](double value) { return value > 0 && value <= kWidestCone; });
  cli::add_number_option(app, "--force-turning", options.turning_n,
                         "Beside --force a force of this size turns about the tool axis, N",
                         "a number above 0 and below 1e9",
                         [](double value) { return value > 0 && value < kLargestForce; });
}

robot::StiffnessTask stiffness_task(const LoadOptions& options, bool along_path, bool with_cut) {
  const bool varies = options.cone_deg || options.turning_n;
  cli::refuse_if(with_cut && (options.force_n || varies), "--cut: expected without --force, which it gives");
  robot::StiffnessTask task;
  if (with_cut) task.index = &robot::stiffness_index("surface");
  if (varies || (along_path && options.force_n)) task.index = &robot::stiffness_index("deflection");
  if (!options.index.empty()) task.index = &robot::stiffness_index(options.index);
  if (options.force_n) {
    task.force_n = Eigen::Vector3d(options.force_n->data());
    cli::refuse_if(task.force_n->isZero(0) && !options.turning_n,
                   "--force: 0,0,0: expected a force that is not zero");
    cli::refuse_if(!(task.force_n->lpNorm<Eigen::Infinity>() < kLargestForce),
                   "--force: expected components below 1e9 N");
  }
  cli::refuse_if(!options.force_n && options.cone_deg, "--force-cone: expected with --force only");
  cli::refuse_if(options.cone_deg && options.turning_n, "--force-turning: expected without --force-cone");
  cli::refuse_if(
      varies && !task.index->needs_force,
      std::string(options.cone_deg ? "--force-cone" : "--force-turning") + ": expected the index deflection");
  // What turns may be all that there is.
  if (options.turning_n && !task.force_n) task.force_n = Eigen::Vector3d::Zero();
  cli::refuse_if(task.index->needs_cut && !with_cut,
                 std::string("--cut: missing: expected a cut for the index ") + task.index->name);
  cli::refuse_if(task.index->needs_force && !task.force_n && !with_cut,
                 std::string("--force: missing: expected a force for the index ") + task.index->name);
  cli::refuse_if(!options.frame.empty() && !options.force_n, "--force-frame: expected with --force only");
  cli::refuse_if(!along_path && options.frame == "feed", "--force-frame: feed: expected with --path only");
  task.force_in_tool = options.frame == "tool";
  task.force_cone_rad = radians_from_degrees(options.cone_deg.value_or(0));
  task.force_turning_n = options.turning_n.value_or(0);
  return task;
}

}  // namespace stablecut
