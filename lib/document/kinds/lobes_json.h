// Kind `lobes`: the stability chart.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "document/measured/measured_cuts.h"
#include "document/text/json_text.h"
#include "milling/lobes.h"
#include "milling/operating_points.h"
#include "milling/sampled_stability.h"

namespace stablecut::document {

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
  std::vector<std::vector<milling::StabilityCrossing>> crossings;
};

/// Part K of N of a chart: every Nth speed from the Kth on.
struct Shard {
  int index = 1;  ///< K, from 1
  int count = 1;  ///< N
  Json of;        ///< what the chart was computed from, to tell parts of another one

  /// The whole chart's speeds that are this part's.
  template <typename T>
  std::vector<T> part_of(const std::vector<T>& whole) const {
    std::vector<T> part;
    for (std::size_t i = index - 1; i < whole.size(); i += static_cast<std::size_t>(count))
      part.push_back(whole[i]);
    return part;
  }
};

struct WhatToRun {
  std::optional<milling::LimitPoint> unconditional;
  milling::OperatingLimits limits;
  std::vector<milling::OperatingPoint> best;
  std::vector<milling::CutRate> rates;  ///< of the best, where feed and diameter are known
};

struct LobesDocument {
  Json cut;  ///< as used: the document's fields with the command line's in their place
  milling::StabilityScheme scheme;
  std::optional<Shard> shard;
  std::vector<double> speed_rpm;
  std::vector<double> depth_mm;
  milling::StabilityChart chart;
  int samples = 0;
  std::optional<milling::SampledStability> sampled;
  std::vector<ModeLimit> per_mode;
  std::vector<JudgedCut> points;
  double points_error = 0;  ///< largest estimated error of the points' radii
  std::optional<WhatToRun> what_to_run;
};

/// The document without provenance.
Json lobes_to_json(const LobesDocument& lobes);

/// The chart of all the speeds of `whole` from its parts, documents written with `shard`: fills in `chart`
/// and `sampled`; the rest must be there, and `whole_of` is what a part's `of` must be. Throws DataError
/// where a part is not one, is of another chart, or is missing.
void merge_parts(LobesDocument& whole, bool with_grid, const Json& whole_of, const std::vector<Input>& parts);

/// A length in metres as it is when read back from the document that it is written to, so that a chart put
/// together from parts is the same to the last digit.
double as_written(double metres);

}  // namespace stablecut::document
