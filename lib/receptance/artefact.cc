#include "receptance/artefact.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace stablecut::receptance {

using Complex = std::complex<double>;

Inverse inverse_of(const std::vector<const Tap*>& taps, Artefact& artefact, bool symmetric,
                   Eigen::Index line) {
  const Eigen::Index rows = taps.size();
  Eigen::MatrixXcd system(rows, symmetric ? 3 : 4);
  Eigen::VectorXcd right(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Tap& tap = *taps[i];
    const Eigen::RowVector2cd a = artefact.to_joint(tap.response_m), b = artefact.to_joint(tap.reference_m);
    const double least = 1e-12 * std::abs(tap.h[line]);
    const double weight = 1 / std::max({std::sqrt(tap.variance[line]), least, 1e-300});
    right[i] =
        weight * ((symmetric ? artefact.between(tap.response_m, tap.reference_m) : Complex(0)) - tap.h[line]);
    if (symmetric) {
      system.row(i) << a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[1] * b[1];
    } else {
      system.row(i) << a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1];
    }
    system.row(i) *= weight;
  }
  const Eigen::VectorXd scale = system.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXcd scaled = system * scale.asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXcd> solver(scaled);
  if (solver.rank() < scaled.cols()) {
    throw InvalidArgument(
        "the taps along the artefact are too alike to tell what holds it: expected pairs of at least two "
        "places, as "
        "0 and 0, 0 and 45, 45 and 45 mm");
  }
  const Eigen::VectorXcd y = scale.asDiagonal() * solver.solve(right);
  Inverse inverse;
  if (symmetric) {
    inverse.value << y[0], y[1], y[1], y[2];
    inverse.covariance = scale.asDiagonal() * (scaled.adjoint() * scaled).inverse() * scale.asDiagonal();
  } else {
    inverse.value << y[0], y[1], y[2], y[3];
  }
  return inverse;
}

}  // namespace stablecut::receptance
