// What cross entries show beside their mirror images: README.md, "Mirror images".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/tap_channels.h"
#include "modal/tap_checks.h"

namespace stablecut::modal {

/// kExchanged, kBothExchanged, kOppositeMirror or kNotReciprocal, the first that holds; nothing where
/// mirrored entries are as equal as those of a usual structure. Lines up to `usable_from_hz` do not count.
std::vector<TapFinding> check_mirrors(const Eigen::VectorXd& hz, const std::vector<Channel>& channels,
                                      double usable_from_hz);

}  // namespace stablecut::modal
