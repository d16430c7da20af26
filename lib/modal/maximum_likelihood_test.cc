#include "modal/maximum_likelihood.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "modal/fitted_table.h"
#include "modal/likelihood.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

TEST_CASE("from a start nearby, exact data give the modes back") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  const FitData data = fixtures::data_of(truth, 1e-3);
  std::vector<dynamics::Mode> start = truth.modes;
  for (std::size_t k = 0; k < start.size(); ++k) {
    const double nudge = k % 2 == 0 ? 1 : -1;
    start[k].frequency_hz *= 1 + 2e-3 * nudge;
    start[k].damping_ratio *= 1 + 0.1 * nudge;
    start[k].psi_r[0] *= Complex(1, 0.1 * nudge);
    start[k].psi_l[1] *= Complex(1.1, -0.1);
  }
  const RefinedModes refined = refine_modes(data, start, ModeModel::kNonsymmetric, {100, 1e-14});
  CHECK(refined.converged);
  CHECK(refined.chi_square < 1e-12);
  for (std::size_t k = 0; k < start.size(); ++k) {
    CHECK(refined.modes[k].frequency_hz == Approx(truth.modes[k].frequency_hz).epsilon(1e-9));
    CHECK(refined.modes[k].damping_ratio == Approx(truth.modes[k].damping_ratio).epsilon(1e-8));
    CHECK((refined.modes[k].residue() - truth.modes[k].residue()).norm() <
          1e-7 * truth.modes[k].residue().norm());
  }
}

// The bound from a Jacobian by central differences, with the redundant complex scale of each mode taken out
// by fixing psi_r's first component.
TEST_CASE("standard deviations are the Cramer-Rao bound") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  const FitData data = fixtures::data_of(truth, 1e-2);
  const Eigen::Index count = truth.modes.size();
  const auto nudged = [&](Eigen::Index parameter, double step) {
    std::vector<dynamics::Mode> modes = truth.modes;
    dynamics::Mode& mode = modes[parameter / 8];
    const Eigen::Index which = parameter % 8;
    const Complex direction = which % 2 == 0 ? Complex(step, 0) : Complex(0, step);
    if (which == 0)
      mode.frequency_hz *= 1 + step;
    else if (which == 1)
      mode.damping_ratio *= 1 + step;
    else if (which < 4)
      mode.psi_r[1] += direction * mode.psi_r.norm();
    else
      mode.psi_l[which < 6 ? 0 : 1] += direction * mode.psi_l.norm();
    return modes;
  };
  const Eigen::Index values = 2 * data.lines() * static_cast<Eigen::Index>(data.curves.size());
  Eigen::MatrixXd jacobian(values, 8 * count);
  const double step = 1e-6;
  for (Eigen::Index p = 0; p < 8 * count; ++p) {
    Eigen::Index row = 0;
    for (const Curve& curve : data.curves) {
      const Eigen::VectorXcd slope =
          (curve_of(nudged(p, step), curve, data.s) - curve_of(nudged(p, -step), curve, data.s)) / (2 * step);
      // Each part of the complex value has half the variance.
      const Eigen::VectorXcd scaled = (2 * curve.weight).cwiseSqrt().cwiseProduct(slope);
      jacobian.col(p).segment(row, data.lines()) = scaled.real();
      jacobian.col(p).segment(row + data.lines(), data.lines()) = scaled.imag();
      row += 2 * data.lines();
    }
  }
  const Eigen::MatrixXd covariance = (jacobian.transpose() * jacobian).inverse();
  const Eigen::MatrixXd table = fitted_table(data, truth.modes, ModeModel::kNonsymmetric).covariance;
  for (Eigen::Index k = 0; k < count; ++k) {
    const dynamics::Mode& mode = truth.modes[k];
    CHECK(std::sqrt(table(10 * k, 10 * k)) ==
          Approx(mode.frequency_hz * std::sqrt(covariance(8 * k, 8 * k))).epsilon(1e-4));
    CHECK(std::sqrt(table(10 * k + 1, 10 * k + 1)) ==
          Approx(mode.damping_ratio * std::sqrt(covariance(8 * k + 1, 8 * k + 1))).epsilon(1e-4));
  }
}

// Against the quadratic form with the whole covariance matrix of each line, and its central differences.
TEST_CASE("errors that curves of one reference share enter chi-square, gradient and information") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  FitData data = fixtures::data_of(truth, 1e-2);
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    Curve& curve = data.curves[c];
    curve.shared = 0.9 * curve.weight.cwiseInverse().cwiseSqrt().cwiseProduct(
                             curve.h.cwiseQuotient(curve.h.cwiseAbs().cast<Complex>()));
    // Some error, different on each line and curve.
    for (Eigen::Index i = 0; i < data.lines(); ++i)
      curve.h[i] *= 1.0 + std::polar(0.02, static_cast<double>(i * i + 3) * static_cast<double>(c + 1));
  }
  const ModeParameters parameters(truth.modes, 2, ModeModel::kNonsymmetric);
  const Likelihood likelihood(data, parameters, out_of_band(data, truth.modes));
  const Eigen::VectorXd x = parameters.pack(truth.modes);
  const auto errors = [&](const Eigen::VectorXd& at) {
    std::vector<Eigen::VectorXcd> result;
    for (const Curve& curve : data.curves)
      result.push_back(curve_of(parameters.unpack(at), curve, data.s) - curve.h);
    return result;
  };
  // sum over lines of Re a^H V^-1 b.
  const auto product = [&](const std::vector<Eigen::VectorXcd>& a, const std::vector<Eigen::VectorXcd>& b) {
    double sum = 0;
    for (Eigen::Index i = 0; i < data.lines(); ++i) {
      Eigen::Matrix4cd covariance = Eigen::Matrix4cd::Zero();
      Eigen::Vector4cd left, right;
      for (Eigen::Index c = 0; c < 4; ++c) {
        left[c] = a[c][i];
        right[c] = b[c][i];
        covariance(c, c) = 1 / data.curves[c].weight[i];
        for (Eigen::Index d = 0; d < 4; ++d) {
          const Curve &p = data.curves[c], &q = data.curves[d];
          if (c != d && p.reference == q.reference) covariance(c, d) = p.shared[i] * std::conj(q.shared[i]);
        }
      }
      sum += left.dot(covariance.inverse() * right).real();
    }
    return sum;
  };
  const NormalEquations normal = likelihood.evaluate(x, true);
  CHECK(normal.sum_of_squares == Approx(product(errors(x), errors(x))).epsilon(1e-9));
  CHECK(likelihood.evaluate(x, false).sum_of_squares == normal.sum_of_squares);
  std::vector<std::vector<Eigen::VectorXcd>> slopes;
  const double step = 1e-6;
  for (Eigen::Index p = 0; p < x.size(); ++p) {
    Eigen::VectorXd up = x, down = x;
    up[p] += step;
    down[p] -= step;
    slopes.push_back(errors(up));
    const auto below = errors(down);
    for (std::size_t c = 0; c < below.size(); ++c) slopes[p][c] = (slopes[p][c] - below[c]) / (2 * step);
  }
  Eigen::VectorXd size(x.size());
  for (Eigen::Index p = 0; p < x.size(); ++p) size[p] = std::sqrt(product(slopes[p], slopes[p]));
  for (Eigen::Index p = 0; p < x.size(); ++p) {
    CHECK(std::abs(normal.gradient[p] - product(slopes[p], errors(x))) <
          1e-6 * size[p] * std::sqrt(normal.sum_of_squares));
    for (Eigen::Index q = 0; q < x.size(); ++q)
      CHECK(std::abs(normal.matrix(p, q) - product(slopes[p], slopes[q])) < 1e-6 * size[p] * size[q]);
  }
}

TEST_CASE("modes outside the band are held by priors whose gradient is that of chi-square") {
  const FitData data = fixtures::data_of(fixtures::close_pair(), 0.01);
  std::vector<dynamics::Mode> modes = fixtures::close_pair().modes;
  modes.push_back(fixtures::mode(0.5, 0.05, {Complex(0.1, 0.02), Complex(0.3, 0)},
                                 {Complex(0.01, 0), Complex(0.02, 0.01)}));
  modes.push_back(fixtures::mode(1700, 0.05, {Complex(1, 0), Complex(0.3, 0.1)},
                                 {Complex(0.01, 0), Complex(0.02, 0.01)}));
  const ModeParameters parameters(modes, 2, ModeModel::kNonsymmetric);
  const Eigen::VectorXd x = parameters.pack(modes);
  const Likelihood held(data, parameters, out_of_band(data, modes)),
      free(data, parameters, std::vector(6, false));
  const Eigen::VectorXd gradient = held.evaluate(x, true).gradient - free.evaluate(x, true).gradient;
  const auto prior = [&](const Eigen::VectorXd& at) {
    return held.evaluate(at, false).sum_of_squares - free.evaluate(at, false).sum_of_squares;
  };
  // At the lower end the first makes far more than is measured there.
  CHECK(prior(x) > 1e3);
  for (Eigen::Index p = parameters.pole_at(4); p < x.size(); ++p) {
    Eigen::VectorXd up = x, down = x;
    up[p] += 1e-5;
    down[p] -= 1e-5;
    CHECK((prior(up) - prior(down)) / 4e-5 ==
          Approx(gradient[p]).epsilon(1e-3).margin(1e-3 * gradient.norm()));
  }
}

TEST_CASE("where a part of J^T J is singular, or worse, what the rest knows stays") {
  NormalEquations normal;
  normal.matrix = Eigen::MatrixXd::Zero(5, 5);
  normal.matrix.topLeftCorner<2, 2>() << 4, 1, 1, 9;
  // Two numbers of a mode that cannot be told apart, as rounding leaves them, and one that nothing shows.
  normal.matrix.block<2, 2>(2, 2) << 1e24, 1e24, 1e24, 1e24 * (1 - 1e-9);
  const Eigen::MatrixXd inverse = inverse_normal_matrix(normal);
  CHECK((inverse.topLeftCorner<2, 2>() * 35 - (Eigen::Matrix2d() << 9, -1, -1, 4).finished()).norm() < 1e-3);
  CHECK(inverse(4, 4) > 1e6);
}
