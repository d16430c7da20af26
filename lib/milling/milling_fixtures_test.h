// Structures and cuts that several tests of this room share.
#pragma once

#include <complex>
#include <random>

#include "dynamics/modal_model.h"
#include "milling/cutter.h"

namespace stablecut::milling::fixtures {

/// The one-mode benchmark of [Insperger2004] and [Ding2010]: 0.03993 kg, 922 Hz, zeta 0.011; the same in
/// every direction of `dofs`.
inline dynamics::ModalModel oscillator(const std::vector<std::string>& dofs) {
  dynamics::ModalModel model;
  model.dofs = dofs;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    dynamics::Mode mode;
    mode.frequency_hz = 922;
    mode.damping_ratio = 0.011;
    const Eigen::Index n = dofs.size();
    mode.psi_r = Eigen::VectorXcd::Unit(n, i);
    mode.psi_l = mode.psi_r / std::complex<double>(0, 2 * 0.03993 * mode.pole().imag());
    model.modes.push_back(mode);
  }
  return model;
}

/// Its cutter: Kt = 600, Kr = 200 N/mm2, two teeth.
inline Cutter benchmark_cutter(bool up_milling, double radial_immersion, int teeth = 2) {
  Cutter cutter;
  cutter.teeth = teeth;
  cutter.kt_n_per_m2 = 600e6;
  cutter.kr_n_per_m2 = 200e6;
  set_immersion(cutter, up_milling, radial_immersion);
  return cutter;
}

/// Coupled non-symmetric modes in x and y, or in x, y and z, around the benchmark's stiffness, from a seed.
inline dynamics::ModalModel coupled_modes(int count, unsigned seed, int directions = 2) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(generator() >> 11) * 0x1p-53;
  };
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  if (directions == 3) model.dofs.emplace_back("z");
  for (int k = 0; k < count; ++k) {
    dynamics::Mode mode;
    mode.frequency_hz = uniform(80, 1200);
    mode.damping_ratio = uniform(0.005, 0.08);
    const auto complex = [&] {
      const double re = uniform(-1, 1);
      return std::complex<double>(re, uniform(-1, 1));
    };
    mode.psi_r = Eigen::VectorXcd::NullaryExpr(directions, [&](Eigen::Index) { return complex(); });
    mode.psi_l = mode.psi_r / std::complex<double>(0, 2 * 0.3 * mode.pole().imag());
    mode.psi_l += 0.2 * mode.psi_l.norm() *
                  Eigen::VectorXcd::NullaryExpr(directions, [&](Eigen::Index) { return complex(); });
    model.modes.push_back(mode);
  }
  return model;
}

}  // namespace stablecut::milling::fixtures
