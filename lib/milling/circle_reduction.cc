#include "milling/circle_reduction.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace stablecut::milling {
namespace {

// Directions in which all residuals together have less are left out.
constexpr double kLeastResidual = 1e-7;

}  // namespace

Eigen::MatrixXd leading_basis(const CircleOperator& of, double least) {
  const Eigen::Index modes = of.growth.size();
  // The largest that the resolvent becomes, for both coordinates of each mode.
  const Eigen::VectorXd one = (1 - of.growth.array().abs()).inverse();
  Eigen::VectorXd resonance(2 * modes);
  resonance << one, one;
  const auto of_pairs = [&](const Eigen::VectorXd& squares) {
    Eigen::VectorXd both(2 * modes);
    both << squares.head(modes) + squares.tail(modes), squares.head(modes) + squares.tail(modes);
    return both;
  };
  const Eigen::VectorXd driven = of_pairs(of.state_of.rowwise().squaredNorm());
  Eigen::VectorXd felt = Eigen::VectorXd::Zero(2 * modes);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(of.size(), of.size());
  for (const CircleOperator::Part& part : of.parts) {
    gram.noalias() += part.direct * part.direct.transpose();
    gram.noalias() += part.direct.transpose() * part.direct;
    if (part.of_state.cols() == 0) continue;
    felt += of_pairs(part.of_state.colwise().squaredNorm());
    const Eigen::MatrixXd scaled = part.of_state * driven.cwiseSqrt().cwiseProduct(resonance).asDiagonal();
    gram.noalias() += scaled * scaled.transpose();
  }
  const Eigen::MatrixXd scaled = felt.cwiseSqrt().cwiseProduct(resonance).asDiagonal() * of.state_of;
  gram.noalias() += scaled.transpose() * scaled;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  Eigen::Index kept = 0;
  while (kept < of.size() && solver.eigenvalues()[of.size() - 1 - kept] > least * least) ++kept;
  return solver.eigenvectors().rightCols(kept);
}

Residuals residuals(const CircleOperator& of, const std::vector<EigenTriple>& triples) {
  Residuals result{Eigen::MatrixXcd(of.size(), triples.size()), Eigen::MatrixXcd(of.size(), triples.size())};
  for (std::size_t i = 0; i < triples.size(); ++i) {
    const EigenTriple& t = triples[i];
    const auto column = static_cast<Eigen::Index>(i);
    result.right.col(column) = of.times(t.angle, t.right) / t.value - t.right;
    result.left.col(column) = of.adjoint_times(t.angle, t.left) / std::conj(t.value) - t.left;
  }
  return result;
}

Eigen::MatrixXd enriched(const Eigen::MatrixXd& basis, const Residuals& by) {
  const Eigen::Index count = by.right.cols();
  Eigen::MatrixXd beside(basis.rows(), 4 * count);
  beside << by.right.real(), by.right.imag(), by.left.real(), by.left.imag();
  // Twice, since the first time leaves rounding of the size of what is taken away.
  for (int pass = 0; pass < 2; ++pass) beside -= basis * (basis.transpose() * beside);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(beside);
  const Eigen::Index most = std::min(4 * count, basis.rows() - basis.cols());
  Eigen::Index kept = 0;
  while (kept < most && std::abs(factors.matrixQR()(kept, kept)) > kLeastResidual) ++kept;
  Eigen::MatrixXd added = factors.householderQ() * Eigen::MatrixXd::Identity(basis.rows(), kept);
  // Small columns are orthogonal to the basis only nearly.
  added -= basis * (basis.transpose() * added);
  Eigen::MatrixXd result(basis.rows(), basis.cols() + kept);
  result << basis, added.colwise().normalized();
  return result;
}

std::complex<double> corrected_value(const CircleOperator& of, const EigenTriple& t) {
  const Eigen::VectorXcd right = of.times(t.angle, t.right), left = of.adjoint_times(t.angle, t.left);
  const Eigen::VectorXcd again = of.times(t.angle, right);
  return left.dot(again) / left.dot(right);
}

}  // namespace stablecut::milling
