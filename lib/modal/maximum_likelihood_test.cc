#include "modal/maximum_likelihood.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "modal/fitted_table.h"
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
