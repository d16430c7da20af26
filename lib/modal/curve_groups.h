// What is fitted: the curves of each independent group of directions, with what is known of them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/frequency_response.h"
#include "modal/fit.h"
#include "modal/fit_data.h"
#include "modal/noise_weights.h"

namespace stablecut::modal {

/// An independent group of directions, before it is fitted.
struct CurveGroup {
  std::vector<std::string> directions;
  CurveVariances variance;  ///< given, those of few averages pooled over lines; empty when any is unknown
  FitData data;
  std::optional<int> wanted_modes;  ///< of those that were asked for, or as many as poles are given
  Eigen::VectorXcd poles;           ///< given, as they are seen through the window, rad/s
};

/// The groups of a receptance (m/N). Throws NoAnswer when all entries are zero, InvalidArgument for given
/// poles of which none moves some group, two are the same, or that are more than half of the lines.
std::vector<CurveGroup> curve_groups(const dynamics::FrequencyResponse& measured, const FitOptions& options);

/// The same curves between the same directions of a group, known as well.
bool alike(const CurveGroup& a, const CurveGroup& b);

}  // namespace stablecut::modal
