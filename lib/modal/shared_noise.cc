#include "modal/shared_noise.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "dynamics/noise.h"
#include "modal/maximum_likelihood.h"

namespace stablecut::modal {
namespace {

constexpr int kSplits = 24;                // steps of expectation and maximisation
constexpr double kLeastOwnNoise = 1e-6;    // of the whole variance: what a curve always has of its own
constexpr Eigen::Index kLeastSpan = 24;    // lines on either side over which the shared part is averaged, ...
constexpr Eigen::Index kSpanOfLines = 16;  // ... and at least that fraction of all lines

// The curves of one reference that are not zero, with what modes leave of them.
struct Column {
  std::vector<std::size_t> curves;
  std::vector<Eigen::VectorXcd> model, error;
  std::vector<Eigen::ArrayXd> own;  // variance of the own part
  Eigen::ArrayXd shared;            // relative variance of the shared part
};

Column column_of(const FitData& data, const std::vector<dynamics::Mode>& modes, Eigen::Index reference) {
  Column column;
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    const Curve& curve = data.curves[c];
    if (curve.reference != reference || curve.h.isZero(0)) continue;
    column.curves.push_back(c);
    column.model.push_back(curve_of(modes, curve, data.s));
    column.error.push_back(curve.h - column.model.back());
  }
  return column;
}

// The relative variance that the curves share, the same on all lines, from products of their errors; 0 where
// Schwarz' criterion [Schwarz1978] does not take it for more than chance.
double constant_share(const Column& column, const CurveVariances& variance, double values) {
  // With a = error / deviation and f = model / deviation, Re(conj(a_c) a_d f_c conj(f_d)) has the mean shared
  // |f_c f_d|^2 and, where nothing is shared, the variance |f_c f_d|^2 / 2.
  double product = 0, weight = 0;
  for (std::size_t d = 0; d < column.curves.size(); ++d) {
    for (std::size_t c = 0; c < d; ++c) {
      const Eigen::ArrayXd scale = (variance[column.curves[c]].array() * variance[column.curves[d]].array());
      const Eigen::ArrayXcd of_c = column.error[c].array() * column.model[c].array().conjugate(),
                            of_d = column.error[d].array() * column.model[d].array().conjugate();
      product += ((of_c.conjugate() * of_d).real() / scale).sum();
      weight += (column.model[c].array().abs2() * column.model[d].array().abs2() / scale).sum();
    }
  }
  if (!(weight > 0) || !(product > std::sqrt(weight / 2 * std::log(values)))) return 0;
  return product / weight;
}

Eigen::ArrayXd running_mean(const Eigen::ArrayXd& values) {
  const Eigen::Index lines = values.size();
  const Eigen::Index half = std::min(std::max(kLeastSpan, lines / kSpanOfLines), (lines - 1) / 2);
  Eigen::ArrayXd sums(lines + 1), mean(lines);
  sums[0] = 0;
  for (Eigen::Index i = 0; i < lines; ++i) sums[i + 1] = sums[i] + values[i];
  for (Eigen::Index i = 0; i < lines; ++i) {
    const Eigen::Index first = std::clamp<Eigen::Index>(i - half, 0, lines - 1 - 2 * half);
    mean[i] = (sums[first + 2 * half + 1] - sums[first]) / static_cast<double>(2 * half + 1);
  }
  return mean;
}

// Expectation and maximisation [Dempster1977]: the shared error of each line, with its uncertainty, given
// both variances; then both variances from it.
void split(const FitData& data, double correction, bool local_allowed, Column& column) {
  const dynamics::NoiseShapes floors = dynamics::floor_shapes(data.s.imag());
  for (int step = 0; step < kSplits; ++step) {
    Eigen::ArrayXd precision = column.shared.inverse();
    Eigen::ArrayXcd mean = Eigen::ArrayXcd::Zero(data.lines());
    for (std::size_t c = 0; c < column.curves.size(); ++c) {
      const auto model = column.model[c].array();
      precision += model.abs2() / column.own[c];
      mean += model.conjugate() * column.error[c].array() / column.own[c];
    }
    mean /= precision;
    for (std::size_t c = 0; c < column.curves.size(); ++c) {
      const Eigen::ArrayXd size = column.model[c].array().abs2();
      const Eigen::ArrayXd square =
          (column.error[c].array() - column.model[c].array() * mean).abs2() + size / precision;
      const dynamics::ResidualNoise noise = dynamics::residual_noise(
          square.sqrt().cast<std::complex<double>>().matrix(), column.model[c].cwiseAbs(), floors);
      column.own[c] = correction * (local_allowed && noise.is_local ? noise.local : noise.smooth).array();
    }
    column.shared = correction * running_mean(mean.abs2() + precision.inverse());
  }
}

// Twice the logarithm of the errors' likelihood, but for a constant: independent errors of these variances.
double likelihood_of(const Column& column, const CurveVariances& variance) {
  double sum = 0;
  for (std::size_t c = 0; c < column.curves.size(); ++c) {
    const auto v = variance[column.curves[c]].array();
    sum -= (v.log() + column.error[c].array().abs2() / v).sum();
  }
  return sum;
}

// The same with the shared part: the covariance is diagonal but for one product, whose inverse and
// determinant are those of [Sherman1950].
double likelihood_of(const Column& column) {
  Eigen::ArrayXd precision = column.shared.inverse();
  Eigen::ArrayXcd mean = Eigen::ArrayXcd::Zero(precision.size());
  double sum = -column.shared.log().sum();
  for (std::size_t c = 0; c < column.curves.size(); ++c) {
    const auto model = column.model[c].array();
    precision += model.abs2() / column.own[c];
    mean += model.conjugate() * column.error[c].array() / column.own[c];
    sum -= (column.own[c].log() + column.error[c].array().abs2() / column.own[c]).sum();
  }
  return sum - precision.log().sum() + (mean.abs2() / precision).sum();
}

}  // namespace

CurveVariances shared_noise(const FitData& data, const std::vector<dynamics::Mode>& modes, double correction,
                            bool local_allowed, CurveVariances& variance) {
  CurveVariances shared(data.curves.size());
  for (Eigen::Index reference = 0; reference < data.dofs; ++reference) {
    Column column = column_of(data, modes, reference);
    const double share = constant_share(column, variance, data.values());
    if (share == 0) continue;
    column.shared = Eigen::ArrayXd::Constant(data.lines(), share);
    for (std::size_t c = 0; c < column.curves.size(); ++c) {
      const Eigen::ArrayXd whole = variance[column.curves[c]].array();
      column.own.emplace_back((whole - share * column.model[c].array().abs2()).max(kLeastOwnNoise * whole));
    }
    split(data, correction, local_allowed, column);
    // Smooth parts are no better than variances line by line where these know more: how a hammer's force
    // fades.
    if (!(likelihood_of(column) > likelihood_of(column, variance) + std::log(data.values()))) continue;
    for (std::size_t c = 0; c < column.curves.size(); ++c) {
      shared[column.curves[c]] = column.shared * column.model[c].array().abs2();
      variance[column.curves[c]] = column.own[c] + shared[column.curves[c]].array();
    }
  }
  return shared;
}

}  // namespace stablecut::modal
