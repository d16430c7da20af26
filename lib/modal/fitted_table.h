// From the refined modes of one group of directions to rows of a table: components that no curve shows, the
// scale that modal tables have, and how sure all of it is. README.md, "Uncertainty".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/fit_data.h"
#include "modal/mode_parameters.h"

namespace stablecut::modal {

struct FittedTable {
  std::vector<dynamics::Mode> modes;  ///< as given, completed and normalised
  Eigen::MatrixXd covariance;         ///< of their parameters, in the order of ModalModel::covariance
  /// Some vector components are shown by no curve, because no response or no force was in that direction.
  /// They follow by reciprocity from a direction that had both; where there is none they are zero.
  bool by_reciprocity = false;
};

/// The covariance is the inverse of the Fisher information of the weighted curves, the Cramer-Rao bound
/// [Cramer1946] [Rao1945], carried to the table's parameters to first order. For modes outside the band it
/// includes their prior. Where the data's poles are fixed their variances are zero, and the others those
/// given the poles. `of_noise`: the weights are those of a noise, and the covariance gets the deviations of
/// shapes that are no mode's; where the model is the limit, its inflation stands for these.
FittedTable fitted_table(const FitData& data, const std::vector<dynamics::Mode>& modes, ModeModel model,
                         bool of_noise = true);

}  // namespace stablecut::modal
