// One factor between the cross entries of all modes: README.md, "One factor between mirror images".
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "dynamics/modal_model.h"

namespace stablecut::modal {

struct ReciprocityFactor {
  Eigen::Index i = 0, j = 0;  ///< directions, i < j
  double factor = 1;          ///< residues of H_ij over those of H_ji
  double deviation = 0;       ///< its standard deviation
  std::size_t modes = 0;      ///< that show it
};

/// Pairs of directions in which all modes of a table (with its covariance) that both show are reciprocal but
/// for one factor, which chance does not explain: neither noise nor a scatter over the modes, as taps beside
/// the sensor make.
std::vector<ReciprocityFactor> reciprocity_factors(const dynamics::ModalModel& table);

}  // namespace stablecut::modal
