#include "milling/semi_discretization.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <unsupported/Eigen/MatrixFunctions>

#include "milling/cut_schedule.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"

using namespace stablecut;
using namespace stablecut::milling;
using Complex = std::complex<double>;

namespace {

// The scheme of [RobotMillingThesis, eqs. 6-34 to 6-39] to the letter: (m + 1) full complex modal states, a
// matrix D_i for each interval, and their product.
double textbook_radius(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s, int m,
                       double depth_m) {
  const Eigen::Index n = structure.modes();
  Eigen::VectorXcd lambda(2 * n);
  lambda << structure.lambda, structure.lambda.conjugate();
  Eigen::MatrixXcd psi_r(structure.directions(), 2 * n), psi_l(structure.directions(), 2 * n);
  psi_r << structure.psi_r, structure.psi_r.conjugate();
  psi_l << structure.psi_l, structure.psi_l.conjugate();
  const double dt = cutter.tooth_period_s(revolutions_per_s) / m;
  const double step = cutter.mean_pitch_rad() / m;

  const Eigen::Index size = 2 * n * (m + 1);
  Eigen::MatrixXcd product = Eigen::MatrixXcd::Identity(size, size);
  for (int i = 0; i < m; ++i) {
    const Eigen::Matrix2d mean =
        mean_directional_coefficients(cutter, i * step, (i + 1) * step, 1e-3).topLeftCorner<2, 2>();
    const Eigen::MatrixXd kappa = depth_m * mean(structure.axes, structure.axes);
    const Eigen::MatrixXcd b = -psi_l.transpose() * kappa * psi_r;
    const Eigen::MatrixXcd a = Eigen::MatrixXcd(lambda.asDiagonal()) - b;
    const Eigen::MatrixXcd p = (a * dt).exp();
    const Eigen::MatrixXcd r = (p - Eigen::MatrixXcd::Identity(2 * n, 2 * n)) * a.inverse() * b;
    Eigen::MatrixXcd d = Eigen::MatrixXcd::Zero(size, size);
    d.topLeftCorner(2 * n, 2 * n) = p;
    d.block(0, 2 * n * (m - 1), 2 * n, 2 * n) += 0.5 * r;
    d.block(0, 2 * n * m, 2 * n, 2 * n) += 0.5 * r;
    d.bottomLeftCorner(2 * n * m, 2 * n * m).setIdentity();
    product = d * product;
  }
  return Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(product, false).eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("the reduced semi-discretization has the textbook matrix's spectral radius") {
  const dynamics::ModalModel models[] = {fixtures::oscillator({"x"}), fixtures::oscillator({"x", "y"}),
                                         fixtures::coupled_modes(3, 5)};
  for (const dynamics::ModalModel& model : models) {
    const TipStructure structure = tip_structure(model);
    for (const auto& [teeth, immersion] : {std::pair{2, 0.25}, std::pair{3, 1.0}, std::pair{1, 0.1}}) {
      for (const int m : {2, 5, 9}) {
        const Cutter cutter = fixtures::benchmark_cutter(teeth == 2, immersion, teeth);
        for (const double depth : {0.2e-3, 3e-3}) {
          const double expected = textbook_radius(structure, cutter, 150, m, depth);
          const SemiDiscretizationMap map(structure, cutter, 150, m);
          INFO(model.modes.size() << " modes, " << teeth << " teeth, m = " << m);
          CHECK(spectral_radius(map, depth) == Approx(expected).epsilon(1e-10));
        }
      }
    }
  }
}

TEST_CASE("only the intervals in cut carry a delayed displacement") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(15, 1));
  // 60 of 180 degrees are 13.3 of 40 intervals: 14 in cut.
  const SemiDiscretizationMap map(structure, fixtures::benchmark_cutter(true, 0.25), 150, 40);
  CHECK(map.monodromy(1e-3).rows() == 30 + 2 * 14);
}

TEST_CASE("with motion along the axis both methods agree") {
  // One tooth in cut at a time, whose chip is one number, and several.
  for (const int teeth : {1, 4}) {
    Cutter cutter = fixtures::benchmark_cutter(false, 0.6, teeth);
    cutter.ka_n_per_m2 = 250e6;
    cutter.lead_rad = 0.9;
    cutter.feed_angle_rad = 0.3;
    const dynamics::ModalModel model = fixtures::coupled_modes(4, 21, 3);
    const TipStructure axial = tip_structure(model, cutter.is_axial()), plane = tip_structure(model);
    REQUIRE(axial.directions() == 3);
    const double depth = 1.5e-3, speed = 360.0 / teeth;
    const double radius = spectral_radius(SpectralMap(axial, cutter, speed, 24), depth);
    const double discrete = spectral_radius(SemiDiscretizationMap(axial, cutter, speed, 400), depth);
    CHECK(radius == Approx(discrete).epsilon(1e-4));
    CHECK(std::abs(radius - spectral_radius(SpectralMap(plane, cutter, speed, 24), depth)) > 1e-3 * radius);
  }
}
