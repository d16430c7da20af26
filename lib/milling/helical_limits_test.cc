#include "milling/helical_limits.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

#include "base/units.h"
#include "milling/circle_reduction.h"
#include "milling/cut_schedule.h"
#include "milling/depth_scan.h"
#include "milling/helical_force.h"
#include "milling/limits.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"

using namespace stablecut;
using namespace stablecut::milling;

// The scan knows period maps with nodes on the pieces of each depth, and neither arcs nor the circle.
TEST_CASE("limits of helical teeth from the unit circle are those of the period map") {
  int limits = 0, from_circle = 0;
  for (unsigned seed = 0; seed < 16; ++seed) {
    INFO("seed " << seed);
    std::mt19937_64 generator(seed);
    const auto uniform = [&](double from, double to) {
      return from + (to - from) * static_cast<double>(generator() >> 11) * 0x1p-53;
    };
    const int modes = 1 + static_cast<int>(uniform(0, 8)), teeth = 1 + static_cast<int>(uniform(0, 6));
    const TipStructure structure = tip_structure(fixtures::coupled_modes(modes, 300 + seed));
    Cutter cutter = fixtures::benchmark_cutter(uniform(0, 1) < 0.5, uniform(0.05, 1), teeth);
    cutter.diameter_m = uniform(8e-3, 20e-3);
    const double helix = radians_from_degrees(uniform(5, 50));
    cutter.lag_rad_per_m = (seed % 5 == 4 ? -2 : 2) * std::tan(helix) / cutter.diameter_m;
    const double speed = uniform(100, 400), top = uniform(1e-3, 5e-3);
    const auto found = circle_limits(structure, cutter, speed, top);
    if (!found) continue;
    ++from_circle;
    const SpectralMap map(structure, cutter, speed, found->resolution + 6);
    const auto scanned = scanned_crossings(DepthScan(map, top), map, cutter.tooth_period_s(speed));
    REQUIRE(found->crossings.size() == scanned.size());
    for (std::size_t i = 0; i < scanned.size(); ++i, ++limits) {
      const StabilityCrossing& limit = found->crossings[i];
      CHECK(std::abs(limit.depth_m - scanned[i].depth_m) < 2e-7 * top);
      // Multipliers are right to 1e-8.
      CHECK(std::abs(spectral_radius(map, limit.depth_m) - 1) < 5e-8);
      CHECK(limit.unstable_above == scanned[i].unstable_above);
      CHECK(limit.kind == scanned[i].kind);
      CHECK(limit.chatter_frequency_hz == Approx(scanned[i].chatter_frequency_hz).epsilon(1e-5));
      CHECK(limit.mode == scanned[i].mode);
    }
  }
  CHECK(limits >= 10);
  CHECK(from_circle >= 15);
}

// [Zatarain2006]: where the edge's ends are whole pitches apart, as much of the edges is in every angle of
// the cut at any time. Then a multiplier is exp(s T) with the s of one harmonic, and at -1 the harmonics come
// in pairs, s and its conjugate, whose eigenvalues are not real.
TEST_CASE("at multiples of the axial pitch the directional matrix is constant, and no flip is left") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 7));
  Cutter cutter = fixtures::benchmark_cutter(true, 0.3, 4);
  cutter.diameter_m = 12e-3;
  cutter.lag_rad_per_m = 2 * std::tan(radians_from_degrees(45)) / cutter.diameter_m;
  const double axial_pitch = cutter.mean_pitch_rad() / cutter.lag_rad_per_m, speed = 200;
  constexpr int kPolynomials = 14;
  const HelicalForce force(structure, cutter, speed, 2.5 * axial_pitch, kPolynomials);
  const Eigen::Matrix2d mean =
      mean_directional_coefficients(cutter, 0, cutter.mean_pitch_rad(), 1e-3).topLeftCorner<2, 2>();
  const auto real_values_at = [&](double depth) {
    const CircleOperator at = force.operator_of(force.forces(depth));
    const Eigen::VectorXcd values =
        Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(at.matrix(kPi), false).eigenvalues();
    const double largest = values.cwiseAbs().maxCoeff();
    int count = 0;
    for (const auto& value : values)
      count += std::abs(value) > 0.01 * largest && std::abs(value.imag()) < 1e-6 * std::abs(value);
    return count;
  };
  for (const int whole : {1, 2}) {
    const Eigen::MatrixXd forces = force.forces(whole * axial_pitch);
    const Eigen::Index all = forces.rows() / 2;
    Eigen::MatrixXd constant = Eigen::MatrixXd::Zero(2 * all, 2 * kPolynomials);
    for (Eigen::Index b = 0; b < 2; ++b)
      for (Eigen::Index a = 0; a < 2; ++a)
        constant.block(b * all, a * kPolynomials, kPolynomials, kPolynomials)
            .diagonal()
            .setConstant(mean(b, a));
    CHECK((forces - constant).norm() < 1e-12 * constant.norm());
    CHECK(real_values_at(whole * axial_pitch) == 0);
  }
  CHECK(real_values_at(0.1 * axial_pitch) > 0);
}

// Which takes no polynomials of the force for more than the integrals ask for: twice as many change nothing
// but the error of the arc's polynomials.
TEST_CASE("the operator of helical teeth tends to that of the pieces of its depth") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(5, 11));
  Cutter cutter = fixtures::benchmark_cutter(false, 0.25, 3);
  cutter.diameter_m = 10e-3;
  cutter.lag_rad_per_m = 2 * std::tan(radians_from_degrees(30)) / cutter.diameter_m;
  const double speed = 180, top = 4e-3, depth = 2.3e-3;
  const CircleOperator pieces =
      period_force(structure, collocate(structure, cut_schedule(cutter, speed, depth), speed, 16),
                   cutter.tooth_period_s(speed))
          .whole;
  const auto largest = [](const CircleOperator& of) {
    const Eigen::VectorXcd values =
        Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(of.matrix(1.1), false).eigenvalues();
    Eigen::Index at = 0;
    values.cwiseAbs().maxCoeff(&at);
    return values[at];
  };
  const std::complex<double> exact = largest(pieces);
  const auto error_of = [&](int polynomials) {
    const HelicalForce force(structure, cutter, speed, top, polynomials);
    return std::abs(largest(force.operator_of(force.forces(depth))) / exact - 1.0);
  };
  CHECK(error_of(10) < 1e-3);
  CHECK(error_of(20) < 1e-5);
  CHECK(error_of(40) < 1e-6);
}
