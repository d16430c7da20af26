#include "modal/vector_fitting.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "modal/pole_sums.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr double kGramRidge = 1e-12;       // added to each diagonal entry of a Gram matrix, as a share of it
constexpr double kLeastDiagonal = 1e-300;  // of a Gram matrix, in a quotient
constexpr double kStartDamping = 0.01;     // -Re / Im of starting poles
constexpr double kLowestStart = 1e-3;      // of the highest line, where the lowest is near 0
constexpr double kStartBelow = 2, kStartAbove = 1.5;  // factors to the pole below the band, and above it
constexpr double kStartGap = 1e-3;                    // between two starting poles at least, relative
constexpr double kFirstStart = 1e-4;                  // of the highest line, instead of 0 or less
constexpr double kNoiseTurn = 2;          // deviations of the noise by which curves may turn for nothing
constexpr double kRealPoleDamping = 0.7;  // damping ratio of the pair that two real poles become
constexpr double kLeastDecay = 1e-6;      // -Re of a relocated pole at least, of the highest line
constexpr double kVanishing = 1e-12;  // of sigma's largest coefficient, below which its constant counts as 0

// The real basis x of a conjugate pair: x_2k = phi + phi', x_2k+1 = i phi - i phi', so that the coefficients
// are the real and the imaginary part of the residue. From sums over the lines, sum c conj(phi_a) phi_b with
// c the (complex) weights, those of the real basis: sum c conj(x_a) x_b.
Eigen::MatrixXd real_gram(const Eigen::MatrixXcd& complex_gram) {
  const Eigen::Index n = complex_gram.rows() / 2;  // [phi; phi'] blocks
  Eigen::MatrixXd gram(2 * n, 2 * n);
  const Complex i(0, 1);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b) {
      const Complex pp = complex_gram(a, b), pc = complex_gram(a, n + b);
      const Complex cp = complex_gram(n + a, b), cc = complex_gram(n + a, n + b);
      gram(2 * a, 2 * b) = (pp + pc + cp + cc).real();
      gram(2 * a, 2 * b + 1) = (i * (pp - pc + cp - cc)).real();
      gram(2 * a + 1, 2 * b) = (-i * (pp + pc - cp - cc)).real();
      gram(2 * a + 1, 2 * b + 1) = (pp - pc - cp + cc).real();
    }
  }
  return gram;
}

// sum c conj(x_a), from the sums of phi with the conjugate of c.
Eigen::VectorXd real_projection(const Eigen::VectorXcd& sum_of_conjugate) {
  const Eigen::Index n = sum_of_conjugate.size() / 2;
  Eigen::VectorXd result(2 * n);
  for (Eigen::Index a = 0; a < n; ++a) {
    result[2 * a] = (sum_of_conjugate[a] + sum_of_conjugate[n + a]).real();
    result[2 * a + 1] = (sum_of_conjugate[n + a] - sum_of_conjugate[a]).imag();
  }
  return result;
}

// sum c conj(phi_a) phi_b over poles and conjugate poles, by partial fractions (pole_sums.h): -(S_c(b) + conj
// S_c'(a)) / (b + conj a), from the sums S_c of phi with c and S_c' with its conjugate.
Eigen::MatrixXcd weighted_gram(const Eigen::VectorXcd& poles, const Eigen::VectorXcd& sum,
                               const Eigen::VectorXcd& sum_of_conjugate) {
  const Eigen::Index n = poles.size();
  Eigen::VectorXcd pole(2 * n);
  pole << poles, poles.conjugate();
  Eigen::MatrixXcd gram(2 * n, 2 * n);
  for (Eigen::Index a = 0; a < 2 * n; ++a) {
    for (Eigen::Index b = 0; b < 2 * n; ++b) {
      gram(a, b) = -(sum[b] + std::conj(sum_of_conjugate[a])) / (pole[b] + std::conj(pole[a]));
    }
  }
  return gram;
}

// Symmetric positive system, scaled to a unit diagonal, with a small ridge.
struct ScaledSystem {
  explicit ScaledSystem(const Eigen::MatrixXd& matrix) {
    scale = matrix.diagonal().cwiseMax(kLeastDiagonal).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
    scaled.diagonal().array() += kGramRidge;
    factor.compute(scaled);
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const {
    return scale.asDiagonal() * factor.solve(scale.asDiagonal() * right);
  }
  Eigen::VectorXd scale;
  Eigen::LDLT<Eigen::MatrixXd> factor;
};

// How far the curves have turned from the first line to each, beyond what noise turns them: [lines].
Eigen::VectorXd turned_so_far(const FitData& data) {
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(data.lines());
  for (Eigen::Index i = 1; i < data.lines(); ++i) {
    double turn = 0;
    for (const Curve& curve : data.curves) {
      const double size = std::abs(curve.h[i]) + std::abs(curve.h[i - 1]);
      if (size == 0) continue;
      const double noise = std::sqrt(1 / curve.weight[i] + 1 / curve.weight[i - 1]);
      turn += std::max(0.0, std::abs(curve.h[i] - curve.h[i - 1]) - kNoiseTurn * noise) / size;
    }
    turned[i] = turned[i - 1] + turn;
  }
  return turned;
}

// The least squares sum w |sum r x - h sigma|^2 over the residues r of each curve and the common sigma = d +
// sum c x. The residues are eliminated, curve by curve (Schur complement) [Deschrijver2008]; what is left, a
// quadratic form in (c, d), adds up over the curves.
Eigen::MatrixXd reduced_form(const FitData& data, const Eigen::VectorXcd& poles) {
  const Eigen::Index n = poles.size();
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(2 * n + 1, 2 * n + 1);
  for (const Curve& curve : data.curves) {
    const auto sums = data_pole_sums(data.s, poles, curve.weight, curve.h);
    const Eigen::VectorXcd of_w = sums.col(0), of_wh = sums.col(1), of_conjugate = sums.col(2),
                           of_whh = sums.col(3);
    const Eigen::MatrixXd gram = real_gram(weighted_gram(poles, of_w, of_w));
    Eigen::MatrixXd cross(2 * n, 2 * n + 1);  // sum w conj(x_a) h x_b, and with 1 for x_b
    cross.leftCols(2 * n) = real_gram(weighted_gram(poles, of_wh, of_conjugate));
    cross.col(2 * n) = real_projection(of_conjugate);
    Eigen::MatrixXd own(2 * n + 1, 2 * n + 1);  // sum w |h|^2 conj(x_a) x_b
    own.topLeftCorner(2 * n, 2 * n) = real_gram(weighted_gram(poles, of_whh, of_whh));
    own.topRightCorner(2 * n, 1) = real_projection(of_whh);
    own.bottomLeftCorner(1, 2 * n) = own.topRightCorner(2 * n, 1).transpose();
    own(2 * n, 2 * n) = curve.weight.dot(curve.h.cwiseAbs2());
    const Eigen::MatrixXd complement = own - cross.transpose() * ScaledSystem(gram).solve(cross);
    reduced += (complement + complement.transpose()) / 2;
  }
  return reduced;
}

// The mean of Re sigma over the lines as a linear function of (c, d).
Eigen::VectorXd mean_of_sigma(const FitData& data, const Eigen::VectorXcd& poles) {
  const Eigen::Index n = poles.size();
  const Eigen::VectorXcd sums =
      data_pole_sums(data.s, poles,
                     Eigen::VectorXd::Constant(data.lines(), 1.0 / static_cast<double>(data.lines())),
                     Eigen::VectorXcd::Zero(data.lines()))
          .col(0);
  Eigen::VectorXd mean(2 * n + 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    mean[2 * k] = (sums[k] + sums[n + k]).real();
    mean[2 * k + 1] = (sums[n + k] - sums[k]).imag();
  }
  mean[2 * n] = 1;
  return mean;
}

// Zeros of 1 + sum c x: eigenvalues of A - b c^T in the real form of each pair.
Eigen::VectorXcd zeros_of_sigma(const Eigen::VectorXcd& poles, const Eigen::VectorXd& c) {
  const Eigen::Index n = poles.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    matrix(2 * k, 2 * k) = matrix(2 * k + 1, 2 * k + 1) = poles[k].real();
    matrix(2 * k, 2 * k + 1) = poles[k].imag();
    matrix(2 * k + 1, 2 * k) = -poles[k].imag();
    matrix.row(2 * k) -= 2 * c.transpose();
  }
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

// One pole with positive imaginary part for each pair of zeros: unstable ones mirrored, two real ones made
// one pair.
std::vector<Complex> pairs_of(const Eigen::VectorXcd& zeros, double least_decay) {
  std::vector<Complex> pairs;
  std::vector<double> real_zeros;
  for (const Complex& zero : zeros) {
    if (zero.imag() > 0) pairs.emplace_back(-std::abs(zero.real()), zero.imag());
    if (zero.imag() == 0) real_zeros.push_back(std::abs(zero.real()));
  }
  std::sort(real_zeros.begin(), real_zeros.end());
  for (std::size_t i = 0; i + 1 < real_zeros.size(); i += 2) {
    const double omega = std::max(std::sqrt(real_zeros[i] * real_zeros[i + 1]), least_decay);
    pairs.push_back(omega * Complex(-kRealPoleDamping, std::sqrt(1 - kRealPoleDamping * kRealPoleDamping)));
  }
  for (Complex& pole : pairs) pole = {std::min(pole.real(), -least_decay), pole.imag()};
  std::sort(pairs.begin(), pairs.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  return pairs;
}

}  // namespace

Eigen::VectorXcd starting_poles(const FitData& data, Eigen::Index pairs) {
  const double hi = data.highest();
  const double lo = std::max(data.lowest(), kLowestStart * hi);
  const Eigen::Index third = std::max<Eigen::Index>(pairs / 3, 1);
  std::vector<double> frequency;
  for (Eigen::Index k = 0; k < third; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(third);
    frequency.push_back(lo * std::pow(hi / lo, share));
    frequency.push_back(lo + (hi - lo) * share);
  }
  const Eigen::VectorXd turned = turned_so_far(data);
  for (Eigen::Index k = 0; static_cast<Eigen::Index>(frequency.size()) < pairs; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(pairs - 2 * third);
    const auto line = std::lower_bound(turned.begin(), turned.end(), share * turned[data.lines() - 1]);
    frequency.push_back(data.s[std::min<Eigen::Index>(line - turned.begin(), data.lines() - 1)].imag());
  }
  frequency.push_back(lo / kStartBelow);
  frequency.push_back(hi * kStartAbove);
  std::sort(frequency.begin(), frequency.end());
  Eigen::VectorXcd poles(frequency.size());
  double last = 0;
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    // No two alike: a repeated pole makes the basis singular.
    double omega = std::max(frequency[k], last * (1 + kStartGap));
    if (omega <= 0) omega = hi * kFirstStart;
    poles[k] = Complex(-kStartDamping * omega, omega);
    last = omega;
  }
  return poles;
}

Eigen::VectorXcd relocate_poles(const FitData& data, const Eigen::VectorXcd& poles) {
  const Eigen::Index n = poles.size();
  // Relaxed non-triviality [Gustavsen2006]: the mean of Re sigma over the lines is 1.
  Eigen::VectorXd sigma = ScaledSystem(reduced_form(data, poles)).solve(mean_of_sigma(data, poles));
  const double d = sigma[2 * n];
  if (std::abs(d) < kVanishing * sigma.cwiseAbs().maxCoeff() || !sigma.allFinite()) return poles;
  sigma /= d;
  std::vector<Complex> pairs =
      pairs_of(zeros_of_sigma(poles, sigma.head(2 * n)), kLeastDecay * data.highest());
  return Eigen::Map<Eigen::VectorXcd>(pairs.data(), pairs.size());
}

LinearResidues linear_residues(const FitData& data, const Eigen::VectorXcd& poles) {
  const Eigen::Index n = poles.size();
  const PoleValues values(data.s, poles);
  LinearResidues result;
  result.residue.resize(n, data.curves.size());
  result.loss.resize(n, data.curves.size());
  for (std::size_t e = 0; e < data.curves.size(); ++e) {
    const Curve& curve = data.curves[e];
    const auto sums = data_pole_sums(data.s, poles, curve.weight, curve.h);
    const ScaledSystem system(real_gram(weighted_gram(poles, sums.col(0), sums.col(0))));
    const Eigen::MatrixXd inverse = system.solve(Eigen::MatrixXd::Identity(2 * n, 2 * n));
    const Eigen::VectorXd coefficient = system.solve(real_projection(sums.col(2)));
    Eigen::VectorXcd residue(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      residue[k] = {coefficient[2 * k], coefficient[2 * k + 1]};
      const Eigen::Vector2d pair = coefficient.segment<2>(2 * k);
      result.loss(k, static_cast<Eigen::Index>(e)) =
          pair.dot(Eigen::Matrix2d(inverse.block<2, 2>(2 * k, 2 * k)).inverse() * pair);
    }
    result.residue.col(e) = residue;
    const Eigen::VectorXcd error = values.phi * residue + values.phi_conj * residue.conjugate() - curve.h;
    result.chi_square += error.cwiseAbs2().dot(curve.weight);
  }
  result.removal_loss = result.loss.rowwise().sum();
  return result;
}

}  // namespace stablecut::modal
