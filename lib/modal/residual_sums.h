// What a refinement needs of all lines: chi-square, and the sums of each curve's residual with 1 / (s - pole)
// and its square. README.md, "Sums over the lines".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/fit_data.h"

namespace stablecut::modal {

/// Sums over the lines of one curve, for all poles and then for their conjugates: [2 poles]. phi is 1 / (s -
/// pole), w the weight and e = model - h.
struct ErrorPoleSums {
  Eigen::VectorXcd weight;          ///< sum w phi
  Eigen::VectorXcd weight_squared;  ///< sum w phi^2
  Eigen::VectorXcd error;           ///< sum w e conj(phi)
  Eigen::VectorXcd error_squared;   ///< sum w e conj(phi^2)
};

/// The curves in separate arrays for real and imaginary parts, filled up to whole lanes, summed over in
/// blocks of lines that stay in the first cache.
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
