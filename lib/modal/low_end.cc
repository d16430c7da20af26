#include "modal/low_end.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace stablecut::modal {
namespace {

constexpr double kDriftShare = 0.1;  // of |H| that drift may be where it ends
// A curve rises on the way to a resonance by kRising over the least before, and by so many deviations of the
// noise; both are means over kMeanLines lines.
constexpr double kRising = 1.3, kStandingOut = 4;
constexpr double kMedianOverMean = 1.2533;  // sqrt(pi / 2), of that of a mean
constexpr Eigen::Index kMeanLines = 3;

// Im H / |H| of a driving point, above 0 where it gives energy; 0 of other channels, which tell nothing of
// it.
double energy_given(const Channel& channel, const WindowSummary& window) {
  return !channel.driving_point ? 0 : channel.swapped ? -window.imaginary : window.imaginary;
}

// By more than noise gives by chance: the deviation of a median of lines with that share of noise in each
// part, or of any phase. Noise alone only weighs little.
bool gives_energy(const Channel& channel, const WindowSummary& window) {
  const double deviation = kMedianOverMean * std::min(window.noise, 1.0) / std::sqrt(2 * window.lines);
  return energy_given(channel, window) > kPositiveShare + kStandingOut * deviation;
}

// Noise, or no driving point's.
bool tells_nothing(const Channel& channel, const WindowSummary& window) {
  return window.noise > kNoiseShare || energy_given(channel, window) > kPositiveShare;
}

// How far (Hz) a drift reaches that the first `ruined` windows show; 0 where |H| does not fall over them.
double reach_of(const std::vector<WindowSummary>& windows, std::size_t ruined) {
  if (ruined == 0 || ruined == windows.size()) return 0;
  if (windows[0].size < kDriftRise * windows[ruined].size) return 0;
  // As an acceleration the drift is even: the most of the last octave, as drift and stiffness may cancel at
  // its end. What is noise there weighs little by itself.
  double square = 0;
  for (std::size_t i = 0; i < ruined; ++i) {
    if (2 * windows[i].lo_hz > windows[ruined - 1].hi_hz && windows[i].noise < kNoiseShare)
      square = std::max(square, windows[i].size * windows[i].lo_hz * windows[i].hi_hz);
  }
  while (ruined + 1 < windows.size() &&
         square > kDriftShare * windows[ruined].size * std::pow(windows[ruined].lo_hz, 2))
    ++ruined;
  return windows[ruined - 1].hi_hz;
}

}  // namespace

double first_rise_hz(const Eigen::VectorXd& hz, const Channel& channel) {
  const Eigen::VectorXcd& h = channel.entry->h;
  const double sign = channel.swapped ? -1 : 1;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = kMeanLines; i + kMeanLines <= h.size(); ++i) {
    least = std::min(least, h.segment(i - kMeanLines, kMeanLines).cwiseAbs().mean());
    const double size = h.segment(i, kMeanLines).cwiseAbs().mean();
    const double imaginary = sign * h.segment(i, kMeanLines).imag().mean();
    const double deviation = std::sqrt(channel.variance.segment(i, kMeanLines).mean());
    if (size < kRising * least || size < least + kStandingOut * deviation) continue;
    if (!channel.driving_point || imaginary < kPositiveShare * size) return hz[i + kMeanLines - 1];
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<LowEnd> low_end_of(const Eigen::VectorXd& hz, const Channel& channel, double risen_hz) {
  std::size_t doubtful = 0, ruined = 0;
  for (std::size_t i = 0; i < channel.windows.size() && channel.windows[i].hi_hz < risen_hz; ++i) {
    if (tells_nothing(channel, channel.windows[i])) doubtful = i + 1;
    if (gives_energy(channel, channel.windows[i])) ruined = i + 1;
  }
  const LowEnd end{reach_of(channel.windows, doubtful), reach_of(channel.windows, ruined)};
  if (end.doubtful_hz == 0 || kLowEndShare * end.doubtful_hz > hz[hz.size() - 1]) return std::nullopt;
  return end;
}

}  // namespace stablecut::modal
