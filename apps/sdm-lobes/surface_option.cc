#include "surface_option.h"

#include <cmath>

#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "document/kinds/pose_json.h"
#include "milling/surface.h"

namespace stablecut {
namespace {

bool is_positive(double value) { return value > 0; }
bool is_any(double) { return true; }

// A compliance in the tool's frame, whose z points to the tip, in the taps' x and y, whose z points to the
// spindle: x is the tool's x turned by an angle about that.
Eigen::Matrix2d in_taps_frame(const Eigen::Matrix3d& compliance, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  Eigen::Matrix<double, 3, 2> axes;
  axes << c, -s, -s, -c, 0, 0;
  return axes.transpose() * compliance * axes;
}

}  // namespace

void SurfaceOption::declare(CLI::App& app) {
  cli::begin_group(app, "The surface");
  app.add_flag("--surface", wanted_,
               "Also where stable cuts leave the surface, and how far the tip vibrates and bends");
  cli::add_number_option(app, "--max-surface-error", largest_error_um_,
                         "What to run: by how much the wall may lie off, um, either way; needs "
                         "feed_per_tooth_mm in the cut",
                         "a number above 0", is_positive);
}

void SurfaceOption::declare_static(CLI::App& app) {
  cli::add_number_option(
      app, "--static-angle", static_angle_deg_,
      "From the tool frame's x to the taps' +x, deg, counterclockwise seen from the spindle "
      "(default: 0)",
      "a number", is_any);
}

milling::RunRequest SurfaceOption::completed(milling::RunRequest request, const dynamics::ModalModel& model,
                                             const CutOptions::Reader& read_input) const {
  if (!used()) return request;
  request.surface.emplace();
  if (largest_error_um_) request.surface->largest_error_m = *largest_error_um_ * 1e-6;
  if (!pose_path.empty()) {
    const document::Input pose = read_input(pose_path, cli::InputForm::kJson);
    request.surface->added_compliance = in_taps_frame(document::tool_compliance(pose.document, pose.source),
                                                      radians_from_degrees(static_angle_deg_.value_or(0))) -
                                        milling::compliance_below_band(model);
  }
  return request;
}

void SurfaceOption::check(const document::CutDocument& cut, const std::string& method, bool has_whole_grid,
                          std::size_t tables) const {
  cli::refuse_if(static_angle_deg_ && pose_path.empty(), "--static-angle: expected with --static only");
  cli::refuse_if(!pose_path.empty() && !wanted_ && !largest_error_um_,
                 "--static: expected with --surface or --max-surface-error");
  if (!used()) return;
  const std::string name = wanted_ ? "--surface" : "--max-surface-error";
  cli::refuse_if(wanted_ && !has_whole_grid, "--surface: expected a chart with its grid, not in parts");
  cli::refuse_if(tables > 1, name + ": expected with one modal table only");
  cli::refuse_if(method == "sdm", name + ": expected with --method spectral only");
  cli::refuse_if(cut.cutter.helices_differ(), name + ": expected a cut with one helix angle");
  cli::refuse_if(!cut.feed_per_tooth_m, name + ": expected feed_per_tooth_mm and diameter_mm in the cut");
}

void SurfaceOption::compute(const milling::TipStructure& structure, const document::CutDocument& cut,
                            const ChartAxes& axes, const milling::RunRequest& request, int threads,
                            bool quiet, document::LobesDocument& lobes) const {
  if (!wanted_) return;
  cli::ProgressBar bar("sdm-lobes: surface", !quiet);
  lobes.surface = milling::surface_chart(structure, cut.cutter, cut.load, axes.revolutions_per_s,
                                         axes.depths_m, lobes.chart, request.surface->added_compliance,
                                         threads, [&](double share) { bar.show(share); });
}

}  // namespace stablecut
