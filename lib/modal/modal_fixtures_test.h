// Structures that several tests of this room share.
#pragma once

#include <cmath>
#include <complex>
#include <random>
#include <utility>
#include <vector>

#include "base/units.h"
#include "dynamics/synthesis.h"
#include "modal/fit_data.h"
#include "numerics/random.h"

namespace stablecut::modal::fixtures {

inline dynamics::Mode mode(double frequency_hz, double damping_ratio, Eigen::Vector2cd psi_r,
                           Eigen::Vector2cd psi_l) {
  dynamics::Mode result;
  result.frequency_hz = frequency_hz;
  result.damping_ratio = damping_ratio;
  result.psi_r = psi_r;
  result.psi_l = psi_l;
  return result;
}

/// Four non-symmetric modes in x and y: a close pair, a heavily damped one, a light one.
inline dynamics::ModalModel close_pair() {
  using Complex = std::complex<double>;
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  model.modes = {
      mode(120, 0.01, {Complex(1, 0.1), Complex(-0.4, 0.2)}, {Complex(0.9e-4, 1e-5), Complex(-2e-5, 3e-5)}),
      mode(121.8, 0.012, {Complex(0.3, -0.2), Complex(1, 0)}, {Complex(2e-5, 1e-5), Complex(1e-4, -2e-5)}),
      mode(260, 0.12, {Complex(1, 0), Complex(0.7, 0.6)}, {Complex(3e-4, -1e-4), Complex(2e-4, 1e-4)}),
      mode(640, 0.008, {Complex(0.2, 0.9), Complex(1, -0.3)}, {Complex(1e-4, 1e-4), Complex(-2e-4, 0)})};
  return model;
}

/// A structure with real modes in skew directions.
inline dynamics::ModalModel skew_modes() {
  using Complex = std::complex<double>;
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  const auto add = [&](double hz, double damping, double angle, double stiffness) {
    const double omega = kTwoPi * hz;
    const Eigen::Vector2cd shape = std::sqrt(omega * omega / stiffness) *
                                   Eigen::Vector2cd(std::cos(angle), std::sin(angle)) /
                                   std::sqrt(Complex(0, 2 * omega));
    model.modes.push_back(mode(hz, damping, shape, shape));
  };
  add(31, 0.04, 0.5, 2e6);
  add(55, 0.03, 2.1, 1e6);
  add(240, 0.03, 0.9, 8e6);
  add(610, 0.025, 2.6, 1e7);
  return model;
}

/// A mode of hysteretic damping: N/m, and the angle of its direction from x, rad.
struct Hysteretic {
  double hz, damping, stiffness, angle;
};

/// Receptances in x and y of such modes, 1 / (k (1 + 2 i zeta) - m omega^2) each.
inline dynamics::FrequencyResponse hysteretic(const std::vector<Hysteretic>& modes,
                                              const Eigen::VectorXd& lines) {
  dynamics::FrequencyResponse frf;
  frf.frequency_hz = lines;
  const Eigen::ArrayXd omega = kTwoPi * lines.array();
  for (const bool in_x : {true, false}) {
    for (const bool along_x : {true, false}) {
      dynamics::FrequencyResponseEntry entry;
      entry.response = in_x ? "x" : "y";
      entry.reference = along_x ? "x" : "y";
      entry.h = Eigen::VectorXcd::Zero(lines.size());
      for (const Hysteretic& m : modes) {
        const auto along = [&](bool x) { return x ? std::cos(m.angle) : std::sin(m.angle); };
        const double square = std::pow(kTwoPi * m.hz, 2);
        const std::complex<double> loss(0, 2 * m.damping * square);
        entry.h.array() += along(in_x) * along(along_x) * square / m.stiffness /
                           ((square - omega.square()).cast<std::complex<double>>() + loss);
      }
      frf.entries.push_back(std::move(entry));
    }
  }
  return frf;
}

/// Noise that many dB below each curve's root mean square.
inline dynamics::FrequencyResponse with_noise(dynamics::FrequencyResponse frf, double db,
                                              std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  for (auto& entry : frf.entries) {
    const double noise =
        std::pow(10, -db / 20) * entry.h.norm() / std::sqrt(static_cast<double>(entry.h.size()));
    for (Eigen::Index i = 0; i < entry.h.size(); ++i)
      entry.h[i] += noise * numerics::unit_complex_normal(generator);
  }
  return frf;
}

/// The model's exact receptances on 1 to 1000 Hz, weighted for noise of that share of each value.
inline FitData data_of(const dynamics::ModalModel& model, double relative_noise) {
  const dynamics::FrequencyResponse frf =
      dynamics::synthesize(model, Eigen::VectorXd::LinSpaced(1000, 1, 1000));
  FitData data;
  data.s = std::complex<double>(0, kTwoPi) * frf.frequency_hz.cast<std::complex<double>>();
  data.dofs = 2;
  for (const auto& entry : frf.entries) {
    data.curves.push_back({model.dof(entry.response), model.dof(entry.reference), entry.h,
                           (relative_noise * relative_noise * entry.h.array().abs2()).inverse()});
  }
  return data;
}

}  // namespace stablecut::modal::fixtures
