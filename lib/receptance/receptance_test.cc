#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "receptance/beam.h"
#include "receptance/held_tool.h"
#include "receptance/receptance_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::receptance;
using namespace stablecut::receptance::fixtures;

namespace {

// The frequency in from..to at which |h| peaks.
template <typename Tip>
double peak_hz(double from, double to, const Tip& tip) {
  double best = 0, at = 0;
  for (double f = from; f <= to; f += 0.05) {
    const double size = std::abs(tip(rad_per_s_from_hz(f))(0, 0));
    if (size > best) {
      best = size;
      at = f;
    }
  }
  return at;
}

}  // namespace

TEST_CASE("stub and bar joined rigidly are the cantilever, in all four receptances") {
  for (const BeamTheory theory : kBoth) {
    double worst_low = 0, worst = 0;
    for (double f = 1; f <= 20000; f *= 1.01) {
      const double omega = rad_per_s_from_hz(f);
      const Receptance<2> tip = coupled_tip<2>(SegmentMotion(bar(118.92), theory, omega).free(),
                                               fixed_free_receptance(bar(50.90), theory, omega));
      const double error = relative(tip, fixed_free_receptance(bar(169.82), theory, omega));
      (f < 10 ? worst_low : worst) = std::max(f < 10 ? worst_low : worst, error);
    }
    CHECK(worst_low < 1e-9);
    CHECK(worst < 1e-10);
  }
}

TEST_CASE("the textbook forms of the free-free and the fixed-free beam, where they do not cancel") {
  const BeamSegment segment = bar(118.92);
  for (const double f : {2000.0, 3825.0, 9000.0, 20000.0}) {
    const double omega = rad_per_s_from_hz(f), d = 0.012, pi = std::numbers::pi;
    const std::complex<double> ei = 200e9 * std::complex<double>(1, 0.02) * (pi / 64 * std::pow(d, 4));
    const std::complex<double> lambda = std::pow(7800 * (pi / 4) * d * d * omega * omega / ei, 0.25);
    const std::complex<double> x = lambda * segment.length_m;
    const auto c = std::cos(x), s = std::sin(x), ch = std::cosh(x), sh = std::sinh(x);
    const auto c1 = c * sh - s * ch, c2 = s * sh, c3 = s - sh, c4 = c - ch, c5 = c * sh + s * ch, c6 = s + sh;
    const auto c7 = ei * (c * ch - 1.0), c8 = ei * (c * ch + 1.0), l2 = lambda * lambda, l3 = l2 * lambda;
    const BeamReceptances r = SegmentMotion(segment, BeamTheory::kEulerBernoulli, omega).free();
    Eigen::Matrix2cd r11, r12, fixed;
    r11 << -c1 / (l3 * c7), c2 / (l2 * c7), c2 / (l2 * c7), c5 / (lambda * c7);
    r12 << c3 / (l3 * c7), -c4 / (l2 * c7), c4 / (l2 * c7), c6 / (lambda * c7);
    fixed << -c1 / (l3 * c8), c2 / (l2 * c8), c2 / (l2 * c8), c5 / (lambda * c8);
    CHECK(relative(r.r11, r11) < 1e-11);
    CHECK(relative(r.r12, r12) < 1e-11);
    CHECK(relative(fixed_free_receptance(segment, BeamTheory::kEulerBernoulli, omega), fixed) < 1e-11);
  }
}

TEST_CASE("low frequencies: rigid body and static deflection to rounding") {
  BeamSegment segment = bar(118.92);
  segment.loss_factor = 0;
  const double pi = std::numbers::pi, area = pi / 4 * 0.012 * 0.012, length = segment.length_m;
  const double mass = 7800 * area * length, omega = rad_per_s_from_hz(1e-3);
  const BeamReceptances r = SegmentMotion(segment, BeamTheory::kEulerBernoulli, omega).free();
  // A slender rod pushed at its end: -4 / (m w^2); the other end: 2 / (m w^2).
  CHECK(r.r11(0, 0).real() == Approx(-4 / (mass * omega * omega)).epsilon(1e-9));
  CHECK(r.r12(0, 0).real() == Approx(2 / (mass * omega * omega)).epsilon(1e-9));
  const double ei = 200e9 * pi / 64 * std::pow(0.012, 4);
  const Eigen::Matrix2cd fixed = fixed_free_receptance(segment, BeamTheory::kEulerBernoulli, omega);
  CHECK(fixed(0, 0).real() == Approx(std::pow(length, 3) / (3 * ei)).epsilon(1e-9));
  CHECK(fixed(0, 1).real() == Approx(length * length / (2 * ei)).epsilon(1e-9));
  CHECK(fixed(1, 1).real() == Approx(length / ei).epsilon(1e-9));
  // Timoshenko adds the shear deflection l / (kappa G A).
  const double shear = cowper_shear_coefficient(0, 0.3) * 200e9 / 2.6 * area;
  CHECK(fixed_free_receptance(segment, BeamTheory::kTimoshenko, omega)(0, 0).real() ==
        Approx(std::pow(length, 3) / (3 * ei) + length / shear).epsilon(1e-9));
}

TEST_CASE("series and functions meet; reciprocity; no overflow") {
  for (const BeamTheory theory : kBoth) {
    // Just below and above the switch the receptances are continuous: a second difference finds no step.
    for (double f = 200; f < 3000; f *= 1.001) {
      const double omega = rad_per_s_from_hz(f), step = 1e-6 * omega;
      const auto h = [&](double w) { return SegmentMotion(bar(118.92), theory, w).free().r12(0, 0); };
      CHECK(std::abs(h(omega - step) - 2.0 * h(omega) + h(omega + step)) < 1e-9 * std::abs(h(omega)));
    }
    const BeamReceptances r = SegmentMotion(bar(1000), theory, rad_per_s_from_hz(1e6)).free();
    CHECK(r.r11.allFinite());
    CHECK((r.r11 - r.r11.transpose()).norm() < 1e-9 * r.r11.norm());
    CHECK((r.r12 - r.r21.transpose()).norm() < 1e-9 * r.r12.norm());
  }
}

TEST_CASE(
    "published frequencies: 3281 Hz of the stub, 3825 Hz of the bar, 295 and 1848 Hz of both, 294 and 1830 "
    "Hz with the joint") {
  const BeamTheory theory = BeamTheory::kEulerBernoulli;
  CHECK(peak_hz(3200, 3350, [&](double w) { return fixed_free_receptance(bar(50.90), theory, w); }) ==
        Approx(3281).margin(1));
  CHECK(peak_hz(3750, 3900, [&](double w) { return SegmentMotion(bar(118.92), theory, w).free().r11; }) ==
        Approx(3825).margin(1));
  const auto tip = [&](double w, bool with_joint) -> Receptance<2> {
    Receptance<2> held = fixed_free_receptance(bar(50.90), theory, w);
    if (with_joint) held.diagonal() += published_joint().stiffness(w).cwiseInverse();
    return coupled_tip<2>(SegmentMotion(bar(118.92), theory, w).free(), held);
  };
  CHECK(peak_hz(280, 310, [&](double w) { return tip(w, false); }) == Approx(295).margin(0.6));
  CHECK(peak_hz(1800, 1900, [&](double w) { return tip(w, false); }) == Approx(1848).margin(0.6));
  CHECK(peak_hz(280, 310, [&](double w) { return tip(w, true); }) == Approx(294).margin(0.6));
  CHECK(peak_hz(1800, 1900, [&](double w) { return tip(w, true); }) == Approx(1830).margin(0.6));
  // The paper's objective on 1 to 5000 Hz in steps of 1 Hz: 6.82e-5 for its joint.
  double sum = 0;
  for (int f = 1; f <= 5000; ++f) {
    const double w = rad_per_s_from_hz(f);
    sum += std::pow(std::abs(tip(w, true)(0, 0)) - std::abs(tip(w, false)(0, 0)), 2);
  }
  CHECK(std::sqrt(sum) == Approx(6.82e-5).epsilon(1e-3));
}

namespace {

// Natural frequencies (Hz) of a cantilever by finite elements after Friedman and Kosmatka (1993), whose
// static shape functions leave an error that falls with the square of the element's length.
Eigen::VectorXd finite_element_frequencies(const BeamSegment& beam, int elements) {
  const double pi = std::numbers::pi, outer = beam.outer_diameter_m, inner = beam.inner_diameter_m;
  const double area = pi / 4 * (outer * outer - inner * inner);
  const double second = pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
  const double ei = beam.youngs_modulus_pa * second, length = beam.length_m / elements;
  const double shear = cowper_shear_coefficient(inner / outer, beam.poisson_ratio) * area *
                       beam.youngs_modulus_pa / (2 * (1 + beam.poisson_ratio));
  const double f = 12 * ei / (shear * length * length), f2 = f * f, l = length, l2 = l * l;
  Eigen::Matrix4d k, mt, mr;
  k << 12, 6 * l, -12, 6 * l, 6 * l, (4 + f) * l2, -6 * l, (2 - f) * l2, -12, -6 * l, 12, -6 * l, 6 * l,
      (2 - f) * l2, -6 * l, (4 + f) * l2;
  k *= ei / (l2 * l * (1 + f));
  const double t1 = 70 * f2 + 147 * f + 78, t2 = (35 * f2 + 77 * f + 44) * l / 4, t3 = 35 * f2 + 63 * f + 27,
               t4 = (35 * f2 + 63 * f + 26) * l / 4, t5 = (7 * f2 + 14 * f + 8) * l2 / 4,
               t6 = (7 * f2 + 14 * f + 6) * l2 / 4;
  mt << t1, t2, t3, -t4, t2, t5, t4, -t6, t3, t4, t1, -t2, -t4, -t6, -t2, t5;
  mt *= beam.density_kg_per_m3 * area * l / (210 * (1 + f) * (1 + f));
  const double r1 = (15 * f - 3) * l, r2 = (10 * f2 + 5 * f + 4) * l2, r3 = (5 * f2 - 5 * f - 1) * l2;
  mr << 36, -r1, -36, -r1, -r1, r2, r1, r3, -36, r1, 36, r1, -r1, r3, r1, r2;
  mr *= beam.density_kg_per_m3 * second / (30 * (1 + f) * (1 + f) * l);
  const int size = 2 * elements + 2;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size), mass = stiffness;
  for (int e = 0; e < elements; ++e) {
    stiffness.block<4, 4>(2 * e, 2 * e) += k;
    mass.block<4, 4>(2 * e, 2 * e) += mt + mr;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      stiffness.bottomRightCorner(size - 2, size - 2), mass.bottomRightCorner(size - 2, size - 2),
      Eigen::EigenvaluesOnly);
  return solver.eigenvalues().cwiseSqrt() / (2 * pi);
}

}  // namespace

TEST_CASE("Timoshenko's cantilever against converged finite elements: five frequencies to 1e-6") {
  for (BeamSegment beam : {BeamSegment{0.12, 0.03, 0, 200e9, 7800, 0.3, 0},
                           BeamSegment{0.2, 0.04, 0.03, 580e9, 14500, 0.22, 0}}) {
    const Eigen::VectorXd coarse = finite_element_frequencies(beam, 40),
                          middle = finite_element_frequencies(beam, 80),
                          fine = finite_element_frequencies(beam, 160);
    for (int mode = 0; mode < 5; ++mode) {
      // What is left of the error is a quarter of what halving took away, and a sixteenth after
      // extrapolation.
      const double first = middle[mode] + (middle[mode] - coarse[mode]) / 3;
      const double second = fine[mode] + (fine[mode] - middle[mode]) / 3;
      const double expected = second + (second - first) / 15;
      CHECK(std::abs(second - first) < 1e-6 * expected);
      // The dynamic stiffness of the tip, 1 / h, changes its sign at a natural frequency.
      const auto stiffness = [&](double hz) {
        return 1 / fixed_free_receptance(beam, BeamTheory::kTimoshenko, rad_per_s_from_hz(hz))(0, 0).real();
      };
      double low = expected * (1 - 1e-3), high = expected * (1 + 1e-3);
      REQUIRE(stiffness(low) * stiffness(high) < 0);
      for (int i = 0; i < 60; ++i) {
        const double centre = 0.5 * (low + high);
        (stiffness(centre) * stiffness(low) > 0 ? low : high) = centre;
      }
      CHECK(low == Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("slender bars: Timoshenko tends to Euler and Bernoulli") {
  for (const double length : {500.0, 2000.0}) {
    // The difference falls with (d / length)^2.
    const double omega = rad_per_s_from_hz(3e6 / (length * length));
    const double error = relative(fixed_free_receptance(bar(length), BeamTheory::kTimoshenko, omega),
                                  fixed_free_receptance(bar(length), BeamTheory::kEulerBernoulli, omega));
    CHECK(error < 20 * std::pow(12 / length, 2));
  }
}

TEST_CASE("sizes and frequencies are above 0, tubes are open") {
  BeamSegment segment = bar(0);
  CHECK_THROWS_AS(SegmentMotion(segment, BeamTheory::kTimoshenko, 1).free(), InvalidArgument);
  segment = bar(100);
  CHECK_THROWS_AS(SegmentMotion(segment, BeamTheory::kTimoshenko, 0).free(), InvalidArgument);
  segment.inner_diameter_m = 0.012;
  CHECK_THROWS_AS(fixed_free_receptance(segment, BeamTheory::kTimoshenko, 1), InvalidArgument);
  // Cowper: 0.886 of a solid circle, about half of a thin tube.
  CHECK(cowper_shear_coefficient(0, 0.3) == Approx(6 * 1.3 / (7 + 1.8)));
  CHECK(cowper_shear_coefficient(1, 0.3) == Approx(2 * 1.3 / (4 + 0.9)));
}
