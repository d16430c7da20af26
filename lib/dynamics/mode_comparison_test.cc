#include "dynamics/mode_comparison.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "base/error.h"
#include "base/units.h"

using namespace stablecut;
using namespace stablecut::dynamics;
using Complex = std::complex<double>;

namespace {

Mode mode_of(double frequency_hz, double damping_ratio, Complex x, Complex y) {
  Mode mode;
  mode.frequency_hz = frequency_hz;
  mode.damping_ratio = damping_ratio;
  mode.psi_r = mode.psi_l = Eigen::Vector2cd(x, y);
  return mode;
}

ModalModel model_of(std::vector<Mode> modes) { return {{"x", "y"}, std::move(modes), {}}; }

// A pair at nearly one frequency, along x and y; one above; a stand-in.
ModalModel tool() {
  ModalModel model = model_of({mode_of(100, 0.03, 1, 0.1), mode_of(101, 0.03, -0.1, 1),
                               mode_of(250, 0.02, 1, 1), mode_of(900, 0.1, 1, 0)});
  model.modes[3].out_of_band = true;
  return model;
}

// All time integral of conj(a) b of the two ringings exp(lambda t), by the trapezoidal rule.
Complex product(Complex a, Complex b) {
  constexpr double kStep = 1e-6, kEnd = 0.3;
  Complex sum = 0.5;
  for (double t = kStep; t < kEnd; t += kStep) sum += std::exp((std::conj(a) + b) * t);
  return sum * kStep;
}

}  // namespace

TEST_CASE("modal assurance: 1 for one shape, 0 for orthogonal ones, whatever the complex scale") {
  const Eigen::Vector2cd a(Complex(1, 2), Complex(-0.5, 1)), across(-std::conj(a[1]), std::conj(a[0]));
  CHECK(modal_assurance(a, Complex(0.3, -4) * a) == Approx(1).epsilon(1e-14));
  CHECK(modal_assurance(a, across) < 1e-30);
  CHECK(modal_assurance(a, Eigen::Vector2cd(a + across)) == Approx(0.5).epsilon(1e-14));
  CHECK(modal_assurance(a, Eigen::Vector2cd::Zero()) == 0);
}

TEST_CASE("phase collinearity and complexity are those of the ellipse that the components draw") {
  const Complex turn = std::polar(3.0, 0.7);
  CHECK(phase_collinearity(turn * Eigen::Vector2cd(1, -2)) == Approx(1).epsilon(1e-14));
  CHECK(complexity(turn * Eigen::Vector2cd(1, -2)) < 1e-7);
  CHECK(phase_collinearity(turn * Eigen::Vector2cd(1, Complex(0, 1))) < 1e-30);
  CHECK(complexity(turn * Eigen::Vector2cd(1, Complex(0, 1))) == Approx(1).epsilon(1e-14));
  // Axes 1 and 0.25, at right angles.
  for (const Complex factor : {Complex(1), turn}) {
    const Eigen::Vector2cd psi = factor * Eigen::Vector2cd(1, Complex(0, 0.25));
    CHECK(complexity(psi) == Approx(0.25).epsilon(1e-13));
    CHECK(phase_collinearity(psi) == Approx(std::pow((1 - 0.0625) / (1 + 0.0625), 2)).epsilon(1e-13));
  }
}

TEST_CASE(
    "modes of one structure are paired by their shapes where frequencies do not tell, and alone where they "
    "do not fit") {
  ModalModel moved = tool();
  std::swap(moved.modes[0], moved.modes[1]);
  moved.modes[0].frequency_hz = 96;  // y, now the lower one
  moved.modes[1].frequency_hz = 99;
  moved.modes[2] = mode_of(410, 0.02, 1, 1);  // too far from 250 Hz
  for (Mode& mode : moved.modes) mode.psi_r *= Complex(0, -2);
  const ModeComparison comparison = compare_modes(tool(), moved);
  REQUIRE(comparison.pairs.size() == 2);
  CHECK(comparison.pairs[0].first == 0);
  CHECK(comparison.pairs[0].second == 1);
  CHECK(comparison.pairs[0].frequency_hz == Approx(-1));
  CHECK(comparison.pairs[1].second == 0);
  CHECK(comparison.pairs[1].assurance == Approx(1).epsilon(1e-14));
  CHECK(comparison.first_alone == std::vector<std::size_t>{2});
  CHECK(comparison.second_alone == std::vector<std::size_t>{2});
  CHECK(comparison.assurance.rows() == 3);
  CHECK(comparison.assurance(0, 0) < 0.05);
  CHECK_FALSE(comparison.pairs[0].frequency_std_hz);
}

TEST_CASE("of two candidates the one is taken whose ringing has more in common") {
  // Nearer in frequency, but ten times as damped; and as much damped, but three half widths away.
  const ModalModel one = model_of({mode_of(100, 0.02, 1, 0)});
  const ModalModel two = model_of({mode_of(101, 0.2, 1, 0), mode_of(103, 0.02, 1, 0)});
  const auto common = [&](const Mode& other) {
    const Complex a = one.modes[0].pole(), b = other.pole();
    return std::norm(product(a, b)) / std::abs(product(a, a) * product(b, b));
  };
  const std::size_t likelier = common(two.modes[0]) > common(two.modes[1]) ? 0 : 1;
  const ModeComparison comparison = compare_modes(one, two);
  REQUIRE(comparison.pairs.size() == 1);
  CHECK(comparison.pairs[0].second == likelier);
}

TEST_CASE("differences have the deviations of both tables") {
  ModalModel first = model_of({mode_of(100, 0.03, 1, 0)}), second = model_of({mode_of(103, 0.02, 1, 0)});
  first.covariance = Eigen::MatrixXd::Identity(10, 10) * 9;
  second.covariance = Eigen::MatrixXd::Identity(10, 10) * 16;
  const ModeComparison comparison = compare_modes(first, second);
  REQUIRE(comparison.pairs.size() == 1);
  CHECK(comparison.pairs[0].frequency_hz == Approx(3));
  CHECK(comparison.pairs[0].damping_ratio == Approx(-0.01));
  CHECK(comparison.pairs[0].frequency_std_hz == Approx(5));
  CHECK(comparison.pairs[0].damping_std == Approx(5));
}

TEST_CASE("tables in other directions are compared in those that both have") {
  ModalModel second = tool();
  second.dofs = {"y", "z"};
  for (Mode& mode : second.modes) {
    mode.psi_r = mode.psi_l = Eigen::Vector2cd(mode.psi_r[1], 7);
  }
  const ModeComparison comparison = compare_modes(tool(), second);
  CHECK(comparison.dofs == std::vector<std::string>{"y"});
  CHECK(comparison.pairs.size() == 3);
  second.dofs = {"z", "u"};
  CHECK_THROWS_AS(compare_modes(tool(), second), InvalidArgument);
}
