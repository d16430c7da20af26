// The entries of a tap as the checks look at them: noise, windows, and what kind of channel each is.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/frequency_response.h"
#include "modal/entry_name.h"
#include "modal/line_windows.h"

namespace stablecut::modal {

/// One entry that is not zero. The frequency response must outlive it.
struct Channel {
  const dynamics::FrequencyResponseEntry* entry = nullptr;
  Eigen::VectorXd variance;            ///< [lines] of the noise, estimated from the entry itself
  std::vector<WindowSummary> windows;  ///< by frequency
  bool driving_point = false;          ///< response and force in one direction at one place
  bool swapped = false;  ///< a driving point whose imaginary part has the wrong sign in most windows
  bool dead = false;     ///< nothing but noise in most windows

  EntryName name() const { return {entry->response, entry->reference}; }
};

std::vector<Channel> channels_of(const dynamics::FrequencyResponse& receptance);

/// Share of the windows above `usable_from_hz` in which a part of H / |H| is positive, weighted by that part;
/// 0 where none stands out of the noise.
double positive_share(const Channel& channel, double usable_from_hz, double WindowSummary::*part);

/// A part has one sign where the other's share is kOneSign at most; one of both where it is between the two.
inline constexpr double kOneSign = 0.05, kSomeSign = 0.2;

/// A window tells nothing where the noise's deviation is larger than that share of |H|: 10 dB.
inline constexpr double kNoiseShare = 0.3;
/// A window is no sound driving point's where its imaginary part is positive by more than that share of |H|.
inline constexpr double kPositiveShare = 0.1;

}  // namespace stablecut::modal
