// What a refinement needs of all lines: chi-square, and the sums of each curve's residual with 1 / (s - pole)
// and its square. README.md, "Sums over the lines".
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "modal/fit_data.h"

namespace stablecut::modal {

/// Sums over the lines of one curve, for all poles and then for their conjugates: [2 poles]. phi is 1 / (s -
/// pole), w the diagonal of the errors' inverse covariance and w e that inverse times e = model - h.
struct ErrorPoleSums {
  Eigen::VectorXcd weight;          ///< sum w phi
  Eigen::VectorXcd weight_squared;  ///< sum w phi^2
  Eigen::VectorXcd error;           ///< sum w e conj(phi)
  Eigen::VectorXcd error_squared;   ///< sum w e conj(phi^2)
};

/// Sums over the lines for a pair of curves with correlated errors, with w the complex entry of the inverse
/// covariance, of the first curve's row and the second one's column: [2 poles].
struct PairPoleSums {
  std::size_t first = 0, second = 0;  ///< curves
  Eigen::VectorXcd weight;            ///< sum w phi
  Eigen::VectorXcd weight_squared;    ///< sum w phi^2
  Eigen::VectorXcd mirror;            ///< sum conj(w) phi
  Eigen::VectorXcd mirror_squared;    ///< sum conj(w) phi^2
};

struct PoleSums {
  std::vector<ErrorPoleSums> curves;
  std::vector<PairPoleSums> pairs;
};

/// The curves in separate arrays for real and imaginary parts, filled up to whole lanes, summed over in
/// blocks of lines that stay in the first cache.
class ResidualSums {
 public:
  explicit ResidualSums(const FitData& data);

  /// chi-square, the squared error over its variance summed over lines and curves, for poles and their
  /// residues [poles x curves]; and the sums where `sums` is not null.
  double evaluate(const Eigen::VectorXcd& poles, const Eigen::MatrixXcd& residue, PoleSums* sums) const;

 private:
  // Curves of one reference with errors that they share.
  struct Column {
    std::vector<Eigen::Index> curves;
  };
  double take_shared(Eigen::Index first, Eigen::Index lines, Eigen::ArrayXXd& error_re,
                     Eigen::ArrayXXd& error_im) const;

  Eigen::Index curves_;
  Eigen::ArrayXd omega_;                   // [lines, filled up]
  Eigen::ArrayXXd own_, diagonal_;         // [lines x curves] of the inverse covariance, 0 where filled up
  Eigen::ArrayXXd h_re_, h_im_;            // [lines x curves]
  Eigen::ArrayXXd common_re_, common_im_;  // [lines x curves], empty where nothing is shared
  std::vector<Column> columns_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  Eigen::ArrayXXd pair_re_, pair_im_;  // [lines x pairs]
};

}  // namespace stablecut::modal
