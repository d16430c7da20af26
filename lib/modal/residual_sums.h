// What a refinement needs of all lines: the residual of each curve, and its sums with the poles' functions.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/fit_data.h"

namespace stablecut::modal {

/// Sums over the lines of one curve, for all poles and then for their conjugates: [2 poles]. phi is 1 / (i w
/// - pole), w the weight and e = model - h.
struct ErrorPoleSums {
  Eigen::VectorXcd weight;          ///< sum w phi
  Eigen::VectorXcd weight_squared;  ///< sum w phi^2
  Eigen::VectorXcd error;           ///< sum w e conj(phi)
  Eigen::VectorXcd error_squared;   ///< sum w e conj(phi^2)
};

/// The curves' lines in separate arrays, whole lanes long, walked through in blocks that stay in the cache.
class ResidualSums {
 public:
  explicit ResidualSums(const FitData& data);

  /// chi-square, the sum of w |e|^2 over lines and curves, for poles and their residues [poles x curves]; and
  /// the curves' sums where `sums` is not null.
  double evaluate(const Eigen::VectorXcd& poles, const Eigen::MatrixXcd& residue,
                  std::vector<ErrorPoleSums>* sums) const;

 private:
  Eigen::Index curves_;
  Eigen::ArrayXd omega_;         // [lines, filled up]
  Eigen::ArrayXXd weight_;       // [lines x curves], 0 where filled up
  Eigen::ArrayXXd h_re_, h_im_;  // [lines x curves]
};

}  // namespace stablecut::modal
