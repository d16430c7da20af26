// Kind `cut`: cutter, cutting coefficients, engagement, and the chart to draw.
#pragma once

#include <optional>

#include "base/range.h"
#include "document/text/json_text.h"
#include "milling/cutter.h"
#include "milling/cutting_force.h"
#include "milling/sampled_stability.h"

namespace stablecut::document {

struct CutDocument {
  milling::Cutter cutter;
  std::optional<double> feed_per_tooth_m;  ///< with a diameter
  milling::CuttingLoad load;               ///< with the feed where there is one
  milling::CoefficientDeviations deviations;
  std::optional<Range> speed_rpm;  ///< of the chart
  std::optional<Range> depth_mm;   ///< of the chart
};

/// The deepest cut that a chart may have: no tool is longer.
inline constexpr double kMostDepthMm = 10'000;

/// Points along an axis of the chart when nothing says how many.
inline constexpr int kDefaultChartCount = 64;

/// Whether a cut has to name Kt and Kr: not where they are what is sought. They are 0 where they are missing.
enum class CoefficientsNeeded { kAll, kNone };

/// Throws DataError.
CutDocument cut_from_json(const Json& document, const Source& source,
                          CoefficientsNeeded needed = CoefficientsNeeded::kAll);

}  // namespace stablecut::document
