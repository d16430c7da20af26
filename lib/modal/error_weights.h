// Inverse covariance of the errors of all curves on a line: README.md, "Errors that entries share".
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "modal/fit_data.h"

namespace stablecut::modal {

/// On each line the inverse covariance of the curves of one reference is diag(own) - a a^H with a = own v.
struct ErrorWeights {
  Eigen::VectorXd own;      ///< [lines] 1 / variance of what the curve does not share
  Eigen::VectorXcd common;  ///< [lines] v, (m/N); empty where the curve shares nothing
  /// Diagonal of the inverse covariance [lines].
  Eigen::VectorXd diagonal() const;
};

/// One for each curve.
std::vector<ErrorWeights> error_weights(const FitData& data);

/// Pairs of different curves (the lesser index first) whose errors are correlated.
std::vector<std::pair<std::size_t, std::size_t>> correlated_pairs(const FitData& data);

/// Inverse covariance times the errors, [curves][lines].
std::vector<Eigen::VectorXcd> weighted_errors(const FitData& data, const std::vector<ErrorWeights>& weights,
                                              std::vector<Eigen::VectorXcd> errors);

}  // namespace stablecut::modal
