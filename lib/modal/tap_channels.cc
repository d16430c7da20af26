#include "modal/tap_channels.h"

#include <algorithm>

#include "dynamics/noise.h"

namespace stablecut::modal {
namespace {

constexpr double kDeadShare = 0.6;           // noise over |H| from which on a window holds nothing else
constexpr double kDeadWindows = 0.8;         // share of such windows from which on a channel is dead
constexpr std::ptrdiff_t kSwappedRatio = 4;  // windows with the wrong sign for one with the right one
constexpr double kSignificant = 2;           // deviations of the noise from which on a part of H counts

// A driving point takes energy: Im H_ii <= 0.
bool has_swapped_sign(const std::vector<WindowSummary>& windows) {
  const auto count = [&](double sign) {
    return std::count_if(windows.begin(), windows.end(), [&](const WindowSummary& window) {
      return sign * window.imaginary > kPositiveShare;
    });
  };
  return count(1) > kSwappedRatio * count(-1);
}

bool is_dead(const std::vector<WindowSummary>& windows) {
  const auto noisy = std::count_if(windows.begin(), windows.end(),
                                   [](const WindowSummary& window) { return window.noise > kDeadShare; });
  return static_cast<double>(noisy) > kDeadWindows * static_cast<double>(windows.size());
}

}  // namespace

double positive_share(const Channel& channel, double usable_from_hz, double WindowSummary::*part) {
  double positive = 0, all = 0;
  for (const WindowSummary& window : channel.windows) {
    if (window.lo_hz <= usable_from_hz || window.noise > kNoiseShare) continue;
    if (std::abs(window.*part) < kSignificant * window.noise) continue;
    all += std::abs(window.*part);
    positive += std::max(window.*part, 0.0);
  }
  return all > 0 ? positive / all : 0.0;
}

std::vector<Channel> channels_of(const dynamics::FrequencyResponse& receptance) {
  const Eigen::VectorXd& hz = receptance.frequency_hz;
  const dynamics::NoiseShapes floors = dynamics::floor_shapes(hz);
  const std::vector<LineSpan> windows = octave_windows(hz);
  std::vector<Channel> channels;
  for (const auto& entry : receptance.entries) {
    if (entry.h.isZero(0)) continue;
    Channel channel;
    channel.entry = &entry;
    channel.variance = dynamics::estimated_variance(hz, entry.h, entry.h.cwiseAbs(), floors, true);
    for (const LineSpan& window : windows)
      channel.windows.push_back(summary_of(window, hz, entry.h, channel.variance));
    channel.driving_point = entry.is_driving_point();
    channel.swapped = channel.driving_point && has_swapped_sign(channel.windows);
    channel.dead = is_dead(channel.windows);
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace stablecut::modal
