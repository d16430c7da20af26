#include "dynamics/modal_model.h"

#include <catch2/catch.hpp>

using namespace stablecut;
using namespace stablecut::dynamics;
using Complex = std::complex<double>;

namespace {

Mode mode_with(Eigen::Vector2cd psi_r, Eigen::Vector2cd psi_l) {
  Mode mode;
  mode.frequency_hz = 100;
  mode.damping_ratio = 0.02;
  mode.psi_r = psi_r;
  mode.psi_l = psi_l;
  return mode;
}

}  // namespace

TEST_CASE("normalising keeps the residue and fixes scale and phase") {
  const Mode mode =
      mode_with({Complex(0.3, -2), Complex(-5, 1)}, {Complex(1e-4, 2e-5), Complex(-3e-5, 4e-5)});
  const Mode result = normalised(mode);
  CHECK((result.residue() - mode.residue()).norm() < 1e-15 * mode.residue().norm());
  CHECK(result.psi_r.norm() == Approx(result.psi_l.norm()).epsilon(1e-14));
  CHECK(std::abs(std::arg(result.psi_r[1] / result.psi_l[1])) < 1e-14);
  CHECK(result.psi_r[1].real() > 0);
}

TEST_CASE("modes of which their deviations leave nothing are told from others") {
  ModalModel model;
  model.dofs = {"x", "y"};
  for (int k = 0; k < 5; ++k) model.modes.push_back(mode_with({3e-3, 4e-3}, {4e-3, 3e-3}));
  model.modes[4].out_of_band = true;
  const Eigen::Index own = model.parameters_per_mode();
  Eigen::VectorXd deviation = Eigen::VectorXd::Zero(5 * own);
  deviation[1] = 0.0199;  // of a damping of 0.02
  deviation[own + 1] = 0.0201;
  deviation.segment(2 * own + 2, 4).setConstant(2.4e-3);  // together less than psi_r, 5e-3
  deviation.segment(3 * own + 6, 4).setConstant(2.6e-3);  // more than psi_l
  deviation.segment(4 * own, own).setConstant(1);
  model.covariance = deviation.cwiseAbs2().asDiagonal();
  CHECK(untold_modes(model) == std::vector<std::size_t>{1, 3});
}

TEST_CASE("a symmetric mode has equal vectors") {
  const Eigen::Vector2cd psi(Complex(0.1, 0.02), Complex(-0.4, 0.3));
  const Mode result = normalised(mode_with(psi * Complex(0, 7), psi / Complex(2, 1)));
  CHECK((result.psi_r - result.psi_l).norm() < 1e-15);
}

TEST_CASE("an uncoupled left vector leaves the phase to psi_r") {
  const Mode result = normalised(mode_with({Complex(0, 2), 0}, {0, Complex(3, 1)}));
  CHECK(std::abs(result.psi_r[0].imag()) < 1e-15);
  CHECK(result.psi_r[0].real() > 0);
}

TEST_CASE("pole and frequency are inverse") {
  Mode mode = mode_with({1, 1}, {1, 1});
  const Complex lambda = mode.pole();
  CHECK(lambda.imag() > 0);
  set_pole(mode, lambda);
  CHECK(mode.frequency_hz == Approx(100).epsilon(1e-14));
  CHECK(mode.damping_ratio == Approx(0.02).epsilon(1e-14));
}

TEST_CASE("the slope of normalising is that of central differences") {
  const Mode mode =
      mode_with({Complex(0.3, -2), Complex(-5, 1)}, {Complex(1e-1, 2e-2), Complex(-3e-2, 4e-2)});
  const auto parameters = [](const Mode& from) {
    const Mode n = normalised(from);
    Eigen::VectorXd p(10);
    p << n.frequency_hz, n.damping_ratio, n.psi_r[0].real(), n.psi_r[0].imag(), n.psi_r[1].real(),
        n.psi_r[1].imag(), n.psi_l[0].real(), n.psi_l[0].imag(), n.psi_l[1].real(), n.psi_l[1].imag();
    return p;
  };
  const Eigen::MatrixXd slope = normalisation_slope(mode);
  for (Eigen::Index c = 0; c < 10; ++c) {
    const double step = 1e-6;
    const auto moved = [&](double by) {
      Mode other = mode;
      const Complex change = c % 2 == 0 ? Complex(by, 0) : Complex(0, by);
      if (c < 2) set_pole(other, mode.pole() + change);
      if (c >= 2 && c < 6) other.psi_r[(c - 2) / 2] += change;
      if (c >= 6) other.psi_l[(c - 6) / 2] += change;
      return parameters(other);
    };
    const Eigen::VectorXd expected = (moved(step) - moved(-step)) / (2 * step);
    INFO("coordinate " << c);
    CHECK((slope.col(c) - expected).norm() < 1e-6 * (1 + expected.norm()));
  }
}

TEST_CASE("chosen modes take their part of the covariance") {
  ModalModel model;
  model.dofs = {"x"};
  model.modes = std::vector<Mode>(3, mode_with({1, 0}, {1, 0}));
  model.covariance = Eigen::VectorXd::LinSpaced(18, 1, 18).asDiagonal();
  const ModalModel chosen = chosen_modes(model, {2, 0});
  CHECK(chosen.covariance.diagonal()[0] == 13);
  CHECK(chosen.covariance.diagonal()[11] == 6);
  CHECK(chosen.deviation(1)[0] == 1);
}

TEST_CASE("without an exponential window, poles are what they were, and so is their covariance") {
  ModalModel model;
  model.dofs = {"x"};
  for (const auto& [hz, zeta] : {std::pair(80.0, 0.03), std::pair(200.0, 0.02)}) {
    Mode mode;
    mode.frequency_hz = hz;
    mode.damping_ratio = zeta;
    mode.psi_r = mode.psi_l = Eigen::VectorXcd::Constant(1, std::complex<double>(0.1, 0.2));
    model.modes.push_back(mode);
  }
  Eigen::MatrixXd root = Eigen::MatrixXd::Identity(12, 12);
  for (Eigen::Index i = 0; i < 12; ++i)
    for (Eigen::Index j = 0; j < i; ++j) root(i, j) = 0.3 / static_cast<double>(i + j);
  model.covariance = root * root.transpose();
  const double decay = 7;
  ModalModel windowed = model;
  for (Mode& mode : windowed.modes) set_pole(mode, mode.pole() - decay);
  const ModalModel back = without_window(windowed, decay);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(back.modes[k].frequency_hz == Approx(model.modes[k].frequency_hz).epsilon(1e-14));
    CHECK(back.modes[k].damping_ratio == Approx(model.modes[k].damping_ratio).epsilon(1e-13));
    CHECK(back.modes[k].psi_r == model.modes[k].psi_r);
  }
  // The covariance goes along the derivatives, by central differences here.
  Eigen::MatrixXd slope = Eigen::MatrixXd::Identity(12, 12);
  for (Eigen::Index k = 0; k < 2; ++k) {
    for (Eigen::Index p = 0; p < 2; ++p) {
      const auto moved = [&](double step) {
        ModalModel other = windowed;
        other.covariance.resize(0, 0);
        Mode& mode = other.modes[k];
        (p == 0 ? mode.frequency_hz : mode.damping_ratio) += step;
        const Mode result = without_window(other, decay).modes[k];
        return Eigen::Vector2d(result.frequency_hz, result.damping_ratio);
      };
      const double step = p == 0 ? 1e-3 : 1e-6;
      slope.block<2, 1>(6 * k, 6 * k + p) = (moved(step) - moved(-step)) / (2 * step);
    }
  }
  windowed.covariance = model.covariance;
  const Eigen::MatrixXd expected = slope * model.covariance * slope.transpose();
  CHECK((without_window(windowed, decay).covariance - expected).norm() < 1e-7 * expected.norm());

  // A window that explains more than all damping.
  CHECK_THROWS_WITH(without_window(model, 20), Catch::Contains("less than the window alone"));
  model.modes[0].out_of_band = true;
  CHECK(without_window(model, 20).modes[0].damping_ratio == 0.03);
}
