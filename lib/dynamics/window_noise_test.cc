#include "dynamics/window_noise.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "base/units.h"

using namespace stablecut;
using namespace stablecut::dynamics;
using Complex = std::complex<double>;

namespace {

struct Factors {
  double pole, residue;
};

// Claimed and true deviations of a least-squares fit of residue and pole to one ringing, sample by sample
// through the window: the discrete Fourier transform is unitary, so that a fit of all lines is one of all
// samples.
Factors by_samples(double decay_per_s, double own_decay_per_s, double duration_s) {
  constexpr int kSamples = 4000;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero(), of_noise = information;
  double mean = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = duration_s * (i + 0.5) / kSamples, window = std::exp(-decay_per_s * t);
    const Eigen::Vector2d slope = window * std::exp(-own_decay_per_s * t) * Eigen::Vector2d(1, t);
    information += slope * slope.transpose();
    of_noise += window * window * slope * slope.transpose();
    mean += window * window / kSamples;
  }
  const Eigen::Matrix2d claimed = mean * information.inverse();
  const Eigen::Matrix2d true_one = information.inverse() * of_noise * information.inverse();
  return {std::sqrt(true_one(1, 1) / claimed(1, 1)), std::sqrt(true_one(0, 0) / claimed(0, 0))};
}

ModalModel one_mode(double decay_per_s) {
  ModalModel model;
  model.dofs = {"x"};
  Mode mode;
  set_pole(mode, Complex(-decay_per_s, kTwoPi * 100));
  mode.psi_r = mode.psi_l = Eigen::VectorXcd::Constant(1, Complex(1e-3, -1e-3));
  model.modes = {mode};
  model.covariance = Eigen::MatrixXd::Constant(6, 6, 0.5) + 0.5 * Eigen::MatrixXd::Identity(6, 6);
  return model;
}

FrequencyResponse through(double decay_per_s) {
  FrequencyResponse frf;
  frf.window_decay_per_s = decay_per_s;
  frf.frequency_hz = Eigen::Vector4d(10, 11, 13, 14);  // 1 s, a line left out
  return frf;
}

}  // namespace

TEST_CASE("deviations through an exponential window are those of the sandwich") {
  for (const double decay : {3.0, 8.0}) {
    for (const double own : {1.5, 5.0, 40.0}) {
      const Factors wanted = by_samples(decay, own, 1);
      const ModalModel model = with_window_noise(one_mode(own + decay), through(decay));
      // The formula takes the ringing to have ended, which leaves exp(-2 * 4.5) of it times some powers of 9.
      const double tolerance = own + decay < 5 ? 6e-3 : 1e-4;
      for (const Eigen::Index pole : {0, 1})
        CHECK(std::sqrt(model.covariance(pole, pole)) == Approx(wanted.pole).epsilon(tolerance));
      for (Eigen::Index psi = 2; psi < 6; ++psi)
        CHECK(std::sqrt(model.covariance(psi, psi)) == Approx(wanted.residue).epsilon(tolerance));
      // Correlations stay.
      CHECK(model.covariance(0, 3) ==
            Approx(0.5 * std::sqrt(model.covariance(0, 0) * model.covariance(3, 3))).epsilon(1e-12));
    }
  }
}

TEST_CASE("without a window nothing changes, and with hardly any hardly anything") {
  CHECK(with_window_noise(one_mode(10), through(0)).covariance == one_mode(10).covariance);
  CHECK(with_window_noise(one_mode(10), through(1e-4)).covariance.isApprox(one_mode(10).covariance, 1e-3));
}
