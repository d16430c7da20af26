// Speed of a stability chart, as ratios within one run: the converged method against the semi-discretization,
// each point by Eigen's dense solver, on a structure of 15 coupled modes.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

#include "base/range.h"
#include "base/units.h"
#include "milling/lobes.h"
#include "milling/milling_fixtures_test.h"
#include "milling/multipliers.h"
#include "milling/semi_discretization.h"
#include "milling/spectral.h"

using namespace stablecut;

namespace {

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double sink = 0;

}  // namespace

int main() {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(15, 1));
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.25);
  std::vector<double> speeds;
  for (const double rpm : Range{5000, 20000, 200}.values()) speeds.push_back(revolutions_per_s_from_rpm(rpm));
  const std::vector<double> depths = Range{0, 4e-4, 100}.values();

  const double grid = seconds([&] {
    const auto chart = stability_chart(structure, cutter, speeds, depths, {}, true, 1);
    sink += chart.spectral_radius.sum();
    std::printf(
        "200 x 100 grid and limit, 15 modes, spectral, one thread; estimated error %.1e, %d to %d points per "
        "arc\n",
        *std::max_element(chart.error.begin(), chart.error.end()),
        *std::min_element(chart.resolution.begin(), chart.resolution.end()),
        *std::max_element(chart.resolution.begin(), chart.resolution.end()));
  });
  const double limit =
      seconds([&] { sink += stability_chart(structure, cutter, speeds, depths, {}, false, 1).error[0]; });
  // The baseline on a sample of the grid's points.
  int points = 0;
  const double baseline = seconds([&] {
    for (std::size_t s = 0; s < speeds.size(); s += 25) {
      const SemiDiscretizationMap map(structure, cutter, speeds[s], 40);
      for (std::size_t i = 0; i < depths.size(); i += 10, ++points) {
        sink += Eigen::EigenSolver<Eigen::MatrixXd>(map.monodromy(depths[i]), false)
                    .eigenvalues()
                    .cwiseAbs()
                    .maxCoeff();
      }
    }
  });
  const double per_point = grid / static_cast<double>(speeds.size() * depths.size());
  std::printf("  grid %.3f s, %.1f us per point\n", grid, 1e6 * per_point);
  std::printf("  limit curve alone %.3f s, %.2f of the grid\n", limit, limit / grid);
  std::printf("  semi-discretization, m = 40, reduced matrix, Eigen per point: %.1f us, ratio %.1f\n",
              1e6 * baseline / points, baseline / points / per_point);

  const Eigen::MatrixXd matrix = SpectralMap(structure, cutter, speeds[100], 9).monodromy(1e-3);
  constexpr int kRepeats = 2000;
  const double own = seconds([&] {
    for (int i = 0; i < kRepeats; ++i) sink += eigenvalues(matrix).cwiseAbs().maxCoeff();
  });
  const double eigen = seconds([&] {
    for (int i = 0; i < kRepeats; ++i) {
      sink += Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().cwiseAbs().maxCoeff();
    }
  });
  const double largest = seconds([&] {
    for (int i = 0; i < kRepeats; ++i)
      sink += leading_eigenvalues(matrix, 2 * structure.modes()).cwiseAbs().maxCoeff();
  });
  std::printf("eigenvalues of %ld rows: %.1f us, Eigen's Schur form %.1f us, ratio %.2f\n",
              static_cast<long>(matrix.rows()), 1e6 * own / kRepeats, 1e6 * eigen / kRepeats, eigen / own);
  std::printf("  the largest modulus alone %.1f us, ratio %.2f to all\n", 1e6 * largest / kRepeats,
              own / largest);
  // Few modes and a long cut: the reduction stops early.
  const TipStructure few = tip_structure(fixtures::coupled_modes(3, 1));
  const Eigen::MatrixXd wide = SpectralMap(few, cutter, speeds[0], 40).monodromy(1e-3);
  const double all_of_few = seconds([&] {
    for (int i = 0; i < kRepeats; ++i) sink += eigenvalues(wide).cwiseAbs().maxCoeff();
  });
  const double largest_of_few = seconds([&] {
    for (int i = 0; i < kRepeats; ++i)
      sink += leading_eigenvalues(wide, 2 * few.modes()).cwiseAbs().maxCoeff();
  });
  std::printf("  of 3 modes and %ld rows: %.1f us, ratio %.2f to all\n", static_cast<long>(wide.rows()),
              1e6 * largest_of_few / kRepeats, all_of_few / largest_of_few);
  return sink == 0;
}
