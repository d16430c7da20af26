// Channels whose amplifier or converter came to its end: README.md, "Overloads".
#pragma once

#include <Eigen/Core>

namespace stablecut::taps {

/// The ends of what a channel shows in a whole record.
struct ChannelRange {
  double least = 0, rest = 0, largest = 0;  ///< of its values; in the middle the median
  double step = 0;                          ///< least difference between values
};

/// Of at least one sample.
ChannelRange range_of(const Eigen::VectorXd& channel);

/// Whether samples [from, to) of a channel touch an end of its range where the channel is cut off: several
/// samples at the channel's largest (or least) value, with steep flanks beside them.
bool overloaded(const Eigen::VectorXd& channel, const ChannelRange& range, Eigen::Index from,
                Eigen::Index to);

}  // namespace stablecut::taps
