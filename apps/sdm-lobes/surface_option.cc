#include "surface_option.h"

#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "milling/surface.h"

namespace stablecut {

void SurfaceOption::declare(CLI::App& app) {
  app.add_flag("--surface", wanted_,
               "Also where stable cuts leave the surface, and how far the tip vibrates and bends");
}

void SurfaceOption::check(const document::CutDocument& cut, const milling::StabilityScheme& scheme,
                          bool has_whole_grid, std::size_t tables) const {
  if (!wanted_) return;
  cli::refuse_if(!has_whole_grid, "--surface: expected a chart with its grid, not in parts");
  cli::refuse_if(tables > 1, "--surface: expected with one modal table only");
  cli::refuse_if(scheme.method == milling::StabilityMethod::kSemiDiscretization,
                 "--surface: expected with --method spectral only");
  cli::refuse_if(!cut.feed_per_tooth_m, "--surface: expected feed_per_tooth_mm and diameter_mm in the cut");
  cli::refuse_if(!milling::leaves_equal_chips(cut.cutter, cut.load),
                 "--surface: expected equal pitches without runout and process damping");
}

void SurfaceOption::compute(const milling::TipStructure& structure, const document::CutDocument& cut,
                            const ChartAxes& axes, int threads, bool quiet,
                            document::LobesDocument& lobes) const {
  if (!wanted_) return;
  cli::ProgressBar bar("sdm-lobes: surface", !quiet);
  lobes.surface =
      milling::surface_chart(structure, cut.cutter, cut.load, axes.revolutions_per_s, axes.depths_m,
                             lobes.chart, threads, [&](double share) { bar.show(share); });
}

}  // namespace stablecut
