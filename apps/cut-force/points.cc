#include "points.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "base/units.h"

namespace stablecut {

std::vector<document::SimulatedPoint> simulated_points(const milling::TipStructure& structure,
                                                       const document::CutDocument& cut,
                                                       const std::vector<document::MeasuredCut>& points,
                                                       const PointRequest& request, int threads,
                                                       const Progress& progress) {
  std::vector<document::SimulatedPoint> result(points.size());
  parallel_for(
      points.size(), threads,
      [&](std::size_t i) {
        result[i].cut = points[i];
        try {
          milling::SimulationRequest simulated{revolutions_per_s_from_rpm(points[i].speed_rpm),
                                               metres_from_mm(points[i].depth_mm), request.passes,
                                               request.steps, request.from_rest};
          simulated.path = request.path;
          result[i].result = milling::simulate_cut(structure, cut.cutter, cut.load, simulated);
        } catch (const NoAnswer& failure) {
          result[i].failure = failure.what();
        }
      },
      progress);
  if (std::none_of(result.begin(), result.end(), [](const auto& point) { return point.result.has_value(); }))
    throw NoAnswer(result.front().failure);
  return result;
}

}  // namespace stablecut
