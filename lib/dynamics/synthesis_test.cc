#include "dynamics/synthesis.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"

using namespace stablecut;
using namespace stablecut::dynamics;
using Complex = std::complex<double>;

namespace {

// A mass on a spring in x: psi_r psi_l = 1 / (2 i m omega_d).
ModalModel oscillator(double mass, double frequency_hz, double damping_ratio) {
  ModalModel model;
  model.dofs = {"x"};
  Mode mode;
  mode.frequency_hz = frequency_hz;
  mode.damping_ratio = damping_ratio;
  mode.psi_r = Eigen::VectorXcd::Constant(1, 1.0);
  mode.psi_l = Eigen::VectorXcd::Constant(1, 1.0 / Complex(0, 2 * mass * mode.pole().imag()));
  model.modes.push_back(mode);
  return model;
}

}  // namespace

TEST_CASE("one mode is the oscillator's receptance 1 / (k - m w^2 + i c w)") {
  const double mass = 0.04, zeta = 0.011;
  const auto frf = synthesize(oscillator(mass, 922, zeta), Eigen::Vector3d(0, 900, 3000));
  const double omega_n = rad_per_s_from_hz(922);
  for (Eigen::Index line = 0; line < 3; ++line) {
    const double omega = rad_per_s_from_hz(frf.frequency_hz[line]);
    const Complex expected =
        1.0 / (mass * Complex(omega_n * omega_n - omega * omega, 2 * zeta * omega_n * omega));
    CHECK(std::abs(frf.entries[0].h[line] - expected) < 1e-13 * std::abs(expected));
  }
}

TEST_CASE("noise has the variance that it says, and its seed decides it") {
  const auto model = oscillator(0.04, 922, 0.3);
  const Eigen::VectorXd lines = Eigen::VectorXd::LinSpaced(20000, 100, 2000);
  const auto clean = synthesize(model, lines);
  for (const NoiseLevel& level :
       {NoiseLevel{40.0, {}, 7}, NoiseLevel{{}, 30.0, 7}, NoiseLevel{20.0, 30.0, 7}}) {
    auto noisy = clean;
    add_noise(noisy, level);
    const Eigen::VectorXd ratio =
        (noisy.entries[0].h - clean.entries[0].h).cwiseAbs2().cwiseQuotient(noisy.entries[0].variance);
    // The mean of 20 000 unit exponentials: standard deviation 0.007.
    CHECK(ratio.mean() == Approx(1).margin(0.03));
    auto again = clean;
    add_noise(again, level);
    CHECK(again.entries[0].h == noisy.entries[0].h);
  }
}
