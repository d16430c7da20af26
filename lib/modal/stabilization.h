// The stabilization diagram [VanDerAuweraer2004]: poles of fits of rising order, and which of them stay where
// they are.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/progress.h"
#include "dynamics/frequency_response.h"
#include "modal/fit_data.h"

namespace stablecut::modal {

/// What a pole has in common with the nearest one of the order before.
enum class Stability {
  kNew,        ///< nothing
  kFrequency,  ///< the frequency, to 1 %
  kPole        ///< the damping too, to 10 % of it
};

struct StabilizationPole {
  double frequency_hz = 0;
  double damping_ratio = 0;
  Stability stability = Stability::kNew;
};

struct StabilizationOrder {
  int order = 0;                         ///< pole pairs of each independent group of directions
  std::vector<StabilizationPole> poles;  ///< in the band, of all groups, by frequency
};

/// Vector fitting of weighted curves with 3, 4, ... `highest` pole pairs (fewer where there are few lines),
/// each group of directions for itself; on `threads` threads, with the same result on any number.
std::vector<StabilizationOrder> stabilization(const std::vector<FitData>& groups, int highest, int threads,
                                              const Progress& progress);

/// Complex mode indicator function [Shih1988]: singular values of H on each line, largest first, m/N, [lines
/// x directions]. A missing entry counts as zero. Peaks of the second show a second mode at the same
/// frequency.
Eigen::MatrixXd mode_indicator(const dynamics::FrequencyResponse& frf);

}  // namespace stablecut::modal
