#include "milling/floquet.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "numerics/eigenvalue_lanes.h"
#include "numerics/eigenvalues.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// A multiplier whose imaginary part is below this share of its modulus is real.
constexpr double kRealMultiplier = 1e-7;

// Harmonics of the force that chatter is looked for in: to kHarmonicReach times the highest mode, but no more
// than kMostHarmonics to either side.
constexpr double kHarmonicReach = 1.2;
constexpr double kMostHarmonics = 20000;
// Amplitudes closer than this share are equal: a real multiplier has k and its mirror image, and the first
// one stands for both.
constexpr double kSameAmplitude = 1e-9;

// Maps of at least kLongCut times the rows of the structure's state, and of more than kSmallMap rows, are
// solved one by one by a reduction that stops early; the others side by side in vector lanes. README.md,
// "Multipliers".
constexpr double kLongCut = 4;
constexpr Eigen::Index kSmallMap = 28;

// Inverse iteration: factorizations, and solutions with each. The shift lies beside the eigenvalue by this
// share of it, so that the factorization is not singular.
constexpr int kFactorizations = 2, kSolutions = 3;
constexpr double kShiftOffset = 1e-10;

// An eigenvalue with its vector from a value nearby: inverse iteration [Ipsen1997] from a vector of ones,
// then again from the Rayleigh quotient.
std::pair<Complex, Eigen::VectorXcd> eigenpair(const Eigen::MatrixXd& matrix, Complex near) {
  Eigen::VectorXcd vector = Eigen::VectorXcd::Ones(matrix.rows()).normalized();
  Complex value = near;
  for (int round = 0; round < kFactorizations; ++round) {
    Eigen::MatrixXcd shifted = matrix.cast<Complex>();
    shifted.diagonal().array() -= value * (1 + kShiftOffset);
    const Eigen::PartialPivLU<Eigen::MatrixXcd> inverse(shifted);
    for (int iteration = 0; iteration < kSolutions; ++iteration) vector = inverse.solve(vector).normalized();
    value = vector.dot(matrix * vector);
  }
  return {value, vector};
}

}  // namespace

std::vector<Eigen::VectorXcd> leading_multipliers(std::vector<Eigen::MatrixXd> monodromy,
                                                  Eigen::Index states) {
  Eigen::Index size = 0;
  for (const Eigen::MatrixXd& matrix : monodromy) size = std::max(size, matrix.rows());
  if (monodromy.size() > 1 &&
      (size <= kSmallMap || static_cast<double>(size) < kLongCut * static_cast<double>(states))) {
    // Rows of zeros add multipliers of zero.
    for (Eigen::MatrixXd& matrix : monodromy) {
      if (matrix.rows() == size) continue;
      Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(size, size);
      padded.topLeftCorner(matrix.rows(), matrix.rows()) = matrix;
      matrix = std::move(padded);
    }
    return numerics::eigenvalues_of_each(monodromy);
  }
  std::vector<Eigen::VectorXcd> values;
  for (Eigen::MatrixXd& matrix : monodromy)
    values.push_back(numerics::leading_eigenvalues(std::move(matrix), states));
  return values;
}

std::vector<Eigen::VectorXcd> leading_multipliers(const PeriodMap& map, const std::vector<double>& depths_m) {
  std::vector<Eigen::MatrixXd> monodromy;
  for (const double depth : depths_m) monodromy.push_back(map.monodromy(depth));
  return leading_multipliers(std::move(monodromy), 2 * map.structure().modes());
}

double spectral_radius(const PeriodMap& map, double depth_m) {
  return spectral_radii(map, {depth_m}).front();
}

std::vector<double> spectral_radii(const PeriodMap& map, const std::vector<double>& depths_m) {
  std::vector<double> radii;
  for (const Eigen::VectorXcd& values : leading_multipliers(map, depths_m)) {
    const double radius = values.cwiseAbs().maxCoeff();
    radii.push_back(map.passes() == 1 ? radius : std::pow(radius, 1.0 / map.passes()));
  }
  return radii;
}

Chatter chatter_of(const TipStructure& structure, double period_s, Complex mu,
                   const std::vector<ForceImpulse>& forces) {
  Chatter chatter;
  if (std::abs(mu.imag()) <= kRealMultiplier * std::abs(mu))
    chatter.kind = mu.real() < 0 ? Instability::kFlip : Instability::kFold;
  const Complex exponent = std::log(mu) / period_s;
  const double highest = structure.lambda.cwiseAbs().maxCoeff();
  const auto harmonics =
      static_cast<int>(std::min(std::ceil(kHarmonicReach * highest * period_s / kTwoPi), kMostHarmonics)) + 1;
  double best = -1;
  for (int k = -harmonics; k <= harmonics; ++k) {
    const Complex s = exponent + Complex(0, kTwoPi * k / period_s);
    Eigen::VectorXcd amplitude = Eigen::VectorXcd::Zero(structure.directions());
    for (const ForceImpulse& force : forces) amplitude += force.impulse * std::exp(-s * force.time_s);
    const Eigen::MatrixXcd moved = structure.mode_receptances(s, amplitude);
    amplitude = moved.rowwise().sum();
    if (amplitude.norm() > best * (1 + kSameAmplitude)) {
      best = amplitude.norm();
      chatter.frequency_hz = hz_from_rad_per_s(std::abs(s.imag()));
      chatter.participation = (amplitude.adjoint() * moved).real().transpose() / amplitude.squaredNorm();
    }
  }
  return chatter;
}

Chatter chatter_at(const PeriodMap& map, double depth_m, Complex near) {
  const auto [mu, vector] = eigenpair(map.monodromy(depth_m), near);
  return chatter_of(map.structure(), map.period_s(), mu, map.forces(depth_m, mu, vector));
}

}  // namespace stablecut::milling
