// Single lines that stand out of a measured curve, as mains hum does.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::modal {

/// Lines on which the value stands out of its neighbours by more than ten deviations of the noise (`variance`
/// [lines], of the complex value): out of a cubic through four of them, and out of a resonance that eight of
/// them could show, to within what that leaves of the eight. Found one after the other, that which stands out
/// most first; more than two side by side are none. Indices, increasing.
std::vector<Eigen::Index> disturbed_lines(const Eigen::VectorXd& hz, const Eigen::VectorXcd& h,
                                          const Eigen::VectorXd& variance);

}  // namespace stablecut::modal
