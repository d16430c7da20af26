// --surface: what stable cuts leave on the part.
#pragma once

#include "cli/tool.h"
#include "options.h"

namespace stablecut {

class SurfaceOption {
 public:
  void declare(CLI::App& app);
  /// Throws WrongUsage where the chart or the cut is not one that a surface can be said of.
  void check(const document::CutDocument& cut, const milling::StabilityScheme& scheme, bool has_whole_grid,
             std::size_t tables) const;
  /// Adds the surface to a chart, where it is asked for.
  void compute(const milling::TipStructure& structure, const document::CutDocument& cut,
               const ChartAxes& axes, int threads, bool quiet, document::LobesDocument& lobes) const;

 private:
  bool wanted_ = false;
};

}  // namespace stablecut
