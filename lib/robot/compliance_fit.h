// The compliances that explain measured deflections best: weights, estimate and residuals. README.md,
// "Identification".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot/identifiability.h"
#include "robot/load_sample.h"

namespace stablecut::robot {

/// Residuals below this share of the largest measured value are rounding: the samples are exact.
inline constexpr double kRounding = 1e-12;

/// The rows of one sample, which come one after another in the equations.
struct SampleRows {
  int sample = 0;
  Eigen::Index first = 0, count = 0;
};

/// A fit to m equations in the compliances of n springs, those whose columns are independent.
struct ComplianceFit {
  const ComplianceEquations& equations;
  std::vector<SampleRows> samples;
  bool deviations_stated = false;  ///< by the samples
  Eigen::VectorXd std;             ///< [m] of each row: as stated, else up to one common factor
  Eigen::VectorXd weight;          ///< [m] of the robust loss, 0..1, the same for all rows of a sample
  Identifiability seen;
  Eigen::MatrixXd a;         ///< [m x n] columns of the independent springs, in the order of seen.independent
  Eigen::VectorXd solution;  ///< [n] rad/(N m), m/N for the base
  Eigen::VectorXd residual;  ///< [m] measured less explained, m or rad

  /// What a row is multiplied with in the weighted problem: sqrt(weight) / std.
  Eigen::VectorXd whitening() const { return weight.cwiseSqrt().cwiseQuotient(std); }
  /// The deviation that `std` stands for: 1 where it is stated, else from the median of the residuals.
  double robust_deviation() const;
  /// Share of the rows' influence that grows with the residual, 1 without down-weighted samples: a sample
  /// beyond the Huber threshold keeps it only across its residual.
  double mean_influence_slope() const;
};

/// Weighted least squares with no compliance below 0 where a spring can be told from the others. Where the
/// samples state no deviations, those of rotations against deflections settle with the residuals; with
/// `huber` samples that lie far off count less. Both by repeated fits.
ComplianceFit fit_compliances(const ComplianceEquations& equations, bool huber);

}  // namespace stablecut::robot
