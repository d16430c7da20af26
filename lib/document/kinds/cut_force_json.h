// Kind `cut-force`: the force of a cut, and cuts simulated.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/measured/measured_cuts.h"
#include "document/text/json_text.h"
#include "milling/cut_simulation.h"
#include "milling/edge_force.h"

namespace stablecut::document {

struct SimulatedPoint {
  MeasuredCut cut;
  std::optional<milling::SimulationResult> result;
  std::string failure;  ///< why there is none
};

struct CutForceDocument {
  Json cut;  ///< as used, without format and provenance
  double diameter_m = 0;
  double depth_mm = 0;
  std::optional<double> speed_rpm;
  int harmonics = 0;
  std::vector<SimulatedPoint> points;
};

/// The document without provenance; `force` is that of the document's depth.
Json cut_force_to_json(const CutForceDocument& document, const milling::EdgeForce& force);

}  // namespace stablecut::document
