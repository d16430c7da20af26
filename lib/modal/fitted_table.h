// From the refined modes of one group of directions to rows of a table: what no curve shows, the contract's
// scale, and how sure all of it is.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/fit_data.h"
#include "modal/mode_parameters.h"

namespace stablecut::modal {

struct FittedTable {
  std::vector<dynamics::Mode> modes;  ///< as given, completed and normalised
  Eigen::MatrixXd covariance;         ///< of their parameters, in the order of ModalModel::covariance
  /// Some vector components are shown by no curve, because nothing was measured or nothing pushed in that
  /// direction: they follow by reciprocity from a direction in which both was done, else they are zero.
  bool by_reciprocity = false;
};

/// Covariance from the Fisher information of the weighted curves (the Cramer-Rao bound of the model), carried
/// on to first order. Modes outside the band carry their weak prior.
FittedTable fitted_table(const FitData& data, const std::vector<dynamics::Mode>& modes, ModeModel model);

}  // namespace stablecut::modal
