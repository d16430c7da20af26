// From records of a hammer and of what answers it to frequency responses: README.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/frequency_response.h"
#include "taps/averages.h"
#include "taps/hit_search.h"

namespace stablecut::taps {

/// The records of the hits in one direction.
struct TapColumn {
  std::string reference;               ///< direction of the force
  std::vector<std::string> responses;  ///< directions of the channels
  std::vector<Record> records;         ///< at one rate, which is that of all columns
};

struct TapChoice {
  HitChoice hits;
  std::optional<double> decay_per_s;  ///< of the exponential window, 0 for none; empty: what is needed
  std::optional<bool> force_window;   ///< empty: where the force shows more than noise away from its pulse
  Estimator estimator = Estimator::kH1;
};

struct TapCampaign {
  dynamics::FrequencyResponse frf;     ///< with variances and covariances where there were several hits
  std::vector<std::vector<Hit>> hits;  ///< [columns] all that were found
  double length_s = 0;                 ///< of each hit's part
  std::vector<double> used;            ///< [columns] number of hits that were averaged
  bool force_window = false;           ///< was laid over the force
  bool ends_with_force = false;        ///< above the last line the force is lost in noise
};

/// Finds the hits, rejects what is of no use and averages the rest. `quantity` is that of the responses.
/// Throws InvalidArgument for records of different rates, NoAnswer for a column without a hit that can be
/// used, or whose hits leave no line; `hits` then tells nothing, unless `found` takes them.
TapCampaign responses_of(const std::vector<TapColumn>& columns, dynamics::Quantity quantity,
                         const TapChoice& choice, std::vector<std::vector<Hit>>* found = nullptr);

}  // namespace stablecut::taps
