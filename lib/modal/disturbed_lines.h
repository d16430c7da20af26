// Single lines that stand out of a measured curve, as mains hum does.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::modal {

/// Lines (indices, increasing) whose value stands out of its neighbours by more than ten standard deviations:
/// of the cubic through four of them, and of a resonance that eight of them could show. `hz`, the values `h`
/// and the variance of their noise (of the complex value), each [lines]. Lines are taken out one after the
/// other, the one that stands out most first; more than two side by side are no hum and not returned.
/// README.md, "Disturbed lines".
std::vector<Eigen::Index> disturbed_lines(const Eigen::VectorXd& hz, const Eigen::VectorXcd& h,
                                          const Eigen::VectorXd& variance);

}  // namespace stablecut::modal
