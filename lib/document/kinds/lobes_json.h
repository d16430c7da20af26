// Kind `lobes`: the stability chart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/measured/measured_cuts.h"
#include "document/text/json_text.h"
#include "milling/lobes.h"
#include "milling/mode_limits.h"
#include "milling/sampled_stability.h"
#include "milling/surface.h"
#include "milling/tested_cuts.h"
#include "milling/what_to_run.h"

namespace stablecut::document {

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

struct LobesDocument {
  Json cut;                         ///< as used: the document's fields with the command line's in their place
  std::vector<std::string> tables;  ///< names, where the chart is for several
  /// Names of the modes of each table, empty where they have none.
  std::vector<std::vector<std::string>> mode_labels;
  milling::StabilityScheme scheme;
  std::optional<Shard> shard;
  std::vector<double> speed_rpm;
  std::vector<double> depth_mm;
  milling::StabilityChart chart;
  int samples = 0;
  std::optional<milling::SampledStability> sampled;
  std::vector<milling::ModeLimit> per_mode;  ///< modes as in the table
  std::vector<MeasuredCut> measured_cuts;
  std::vector<milling::JudgedCut> judged_cuts;  ///< as many
  std::optional<milling::WhatToRun> what_to_run;
  milling::SurfaceChart surface;  ///< empty: not asked for

  /// The largest estimated error of the spectral radii.
  double convergence() const;
};

/// The document without provenance.
Json lobes_to_json(const LobesDocument& lobes);

/// Puts the parts of a chart, documents that were written with a shard, together: fills in `chart` and
/// `sampled` of `whole`, whose other members say which chart it is, and `whole_of` what its parts' `of` must
/// be. Throws DataError where a document is no part, is a part of another chart, or where a part is missing.
void merge_parts(LobesDocument& whole, bool with_grid, const Json& whole_of, const std::vector<Input>& parts);

/// A length in metres as it is read back from the document that it is written to. What is computed from a
/// chart is computed from these, so that it is the same to the last digit from a chart put together from
/// parts.
double as_written(double metres);

}  // namespace stablecut::document
