#include "receptance/artefact.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace stablecut::receptance {

using Complex = std::complex<double>;

namespace {

constexpr double kLeastTapDeviation = 1e-12;  // of a tap's value, where its variance says less

}  // namespace

OpeningStiffness opening_stiffness(const std::vector<const Tap*>& taps, Artefact& artefact, bool symmetric,
                                   Eigen::Index line) {
  const Eigen::Index rows = taps.size();
  Eigen::MatrixXcd system(rows, symmetric ? 3 : 4);
  Eigen::VectorXcd right(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Tap& tap = *taps[i];
    const Eigen::RowVector2cd a = artefact.response_to_end_2(tap.response_m),
                              b = artefact.response_to_end_2(tap.reference_m);
    const double least = kLeastTapDeviation * std::abs(tap.h[line]);
    const double weight = 1 / std::max({std::sqrt(tap.variance[line]), least, kAboveZero});
    const Complex free = symmetric ? artefact.receptance(tap.response_m, tap.reference_m) : Complex(0);
    right[i] = weight * (free - tap.h[line]);
    if (symmetric) {
      system.row(i) << a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[1] * b[1];
    } else {
      system.row(i) << a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1];
    }
    system.row(i) *= weight;
  }
  // Columns of size 1: forces and moments differ by orders of magnitude.
  const Eigen::VectorXd scale = system.colwise().norm().cwiseMax(kAboveZero).cwiseInverse();
  const Eigen::MatrixXcd scaled = system * scale.asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXcd> solver(scaled);
  if (solver.rank() < scaled.cols()) {
    throw InvalidArgument(
        "the taps along the artefact are too alike to tell what holds it: expected pairs of at least two "
        "places, as 0 and 0, 0 and 45, 45 and 45 mm");
  }
  const Eigen::VectorXcd y = scale.asDiagonal() * solver.solve(right);
  OpeningStiffness stiffness;
  if (symmetric) {
    stiffness.value << y[0], y[1], y[1], y[2];
    stiffness.covariance = scale.asDiagonal() * (scaled.adjoint() * scaled).inverse() * scale.asDiagonal();
  } else {
    stiffness.value << y[0], y[1], y[2], y[3];
  }
  return stiffness;
}

}  // namespace stablecut::receptance
