// --table and --points: cuts simulated.
#pragma once

#include <optional>
#include <vector>

#include "base/progress.h"
#include "document/kinds/cut_force_json.h"
#include "document/kinds/cut_json.h"
#include "milling/simulation_grid.h"
#include "milling/structure.h"

namespace stablecut {

struct PointRequest {
  std::optional<int> passes, steps;
  bool from_rest = false;
  milling::ToothPath path = milling::ToothPath::kCircle;
};

/// One result for each cut, the same whatever the number of threads. Throws NoAnswer where there is none.
std::vector<document::SimulatedPoint> simulated_points(const milling::TipStructure& structure,
                                                       const document::CutDocument& cut,
                                                       const std::vector<document::MeasuredCut>& points,
                                                       const PointRequest& request, int threads,
                                                       const Progress& progress);

}  // namespace stablecut
