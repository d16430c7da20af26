#include "taps/overload.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace stablecut::taps {
namespace {

constexpr int kSamplesAtEnd = 3;      // a smooth peak touches its highest value once, or twice by chance
constexpr double kFarFromRest = 0.5;  // of the excursion to the other side
constexpr double kSteepSteps = 4;     // flanks of a rounded smooth peak are at most two converter steps high

// Least difference between values: the converter's step, or the rounding of a file.
double least_step(const std::vector<double>& sorted) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double step = sorted[i] - sorted[i - 1];
    if (step > 0) least = std::min(least, step);
  }
  return least;
}

bool cut_off_at(const Eigen::VectorXd& channel, double end, double step, Eigen::Index from, Eigen::Index to) {
  int touching = 0, flanks = 0;
  double heights = 0;
  for (Eigen::Index i = from; i < to; ++i) {
    if (channel[i] != end) continue;
    ++touching;
    for (const Eigen::Index beside : {i - 1, i + 1}) {
      if (beside < 0 || beside >= channel.size() || channel[beside] == end) continue;
      ++flanks;
      heights += std::abs(channel[beside] - end);
    }
  }
  return touching >= kSamplesAtEnd && flanks > 0 && heights > kSteepSteps * step * flanks;
}

}  // namespace

ChannelRange range_of(const Eigen::VectorXd& channel) {
  std::vector<double> sorted(channel.begin(), channel.end());
  std::sort(sorted.begin(), sorted.end());
  return {sorted.front(), sorted[sorted.size() / 2], sorted.back(), least_step(sorted)};
}

bool overloaded(const Eigen::VectorXd& channel, const ChannelRange& range, Eigen::Index from,
                Eigen::Index to) {
  const double above = range.largest - range.rest, below = range.rest - range.least;
  // Where a channel merely rests is no end of its range.
  return (above >= kFarFromRest * below && cut_off_at(channel, range.largest, range.step, from, to)) ||
         (below >= kFarFromRest * above && cut_off_at(channel, range.least, range.step, from, to));
}

}  // namespace stablecut::taps
