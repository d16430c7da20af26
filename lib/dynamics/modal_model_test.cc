#include "dynamics/modal_model.h"

#include <catch2/catch.hpp>

using namespace stablecut;
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
