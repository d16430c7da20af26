// Kind `lobes`: the stability chart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/json_text.h"
#include "document/measured_cuts.h"
#include "milling/lobes.h"

namespace stablecut {

/// What the model says of a tested cut.
struct JudgedCut {
  MeasuredCut cut;
  double spectral_radius = 0;
};

/// A cut is stable below a spectral radius of 1.
inline bool is_stable(double radius) { return radius < 1; }

/// The limit curve of one mode alone.
struct ModeLimit {
  int mode = 0;  ///< 1-based, in the table
  std::vector<std::optional<StabilityLimit>> limit;
};

struct LobesDocument {
  Json cut;  ///< as used: the document's fields with the command line's in their place
  StabilityScheme scheme;
  std::vector<double> speed_rpm;
  std::vector<double> depth_mm;
  StabilityChart chart;
  std::vector<ModeLimit> per_mode;
  std::vector<JudgedCut> points;
  double points_error = 0;  ///< largest estimated error of the points' radii
};

/// The document without provenance.
Json lobes_to_json(const LobesDocument& lobes);

}  // namespace stablecut
