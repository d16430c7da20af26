// One factor between the cross entries of all modes: README.md, "One factor between mirror images".
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "dynamics/modal_model.h"

namespace stablecut::modal {

struct ReciprocityFactor {
  double factor = 1;      ///< residues of H_ij over those of H_ji
  double deviation = 0;   ///< its standard deviation
  std::size_t modes = 0;  ///< that show it
};

/// Whether all modes of a table (with its covariance) that both directions move by as much as can be told are
/// reciprocal but for one factor, which chance does not explain: neither noise nor a scatter over the modes, as
/// taps beside the sensor make.
std::optional<ReciprocityFactor> reciprocity_factor(const dynamics::ModalModel& table, Eigen::Index i,
                                                    Eigen::Index j);

}  // namespace stablecut::modal
