// Speed and error of stability charts, as ratios within one run.
//
//   lobes_benchmark TABLE CUT     the 15-mode table and its cut
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <thread>
#include <vector>

#include "base/range.h"
#include "base/seconds_benchmark.h"
#include "base/units.h"
#include "cli/streams.h"
#include "document/kinds/cut_json.h"
#include "document/kinds/modal_table_json.h"
#include "milling/lobes.h"
#include "milling/semi_discretization.h"
#include "milling/spectral.h"
#include "numerics/eigenvalue_lanes.h"
#include "numerics/eigenvalues.h"

using namespace stablecut;

namespace {

double sink = 0;

std::vector<double> speeds_of(const Range& rpm) {
  std::vector<double> speeds;
  for (const double value : rpm.values()) speeds.push_back(revolutions_per_s_from_rpm(value));
  return speeds;
}

// The semi-discretization's matrix with all m delayed displacements, as the reduced matrix of the literature
// has them: what is sensed while nothing cuts feeds nothing.
Eigen::MatrixXd with_free_intervals(const Eigen::MatrixXd& in_cut, Eigen::Index size) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  matrix.topLeftCorner(in_cut.rows(), in_cut.cols()) = in_cut;
  for (Eigen::Index i = in_cut.rows(); i < size; ++i)
    matrix.row(i).head(in_cut.cols()) = in_cut.row(i % in_cut.rows()) / 2;
  return matrix;
}

struct Case {
  milling::TipStructure structure;
  milling::Cutter cutter;
  std::vector<double> speeds, depths;

  milling::StabilityChart chart(bool with_grid, int threads) const {
    return milling::stability_chart(structure, cutter, speeds, depths, {}, with_grid, threads);
  }
  double time(bool with_grid, int threads = 1) const {
    return least_seconds([&] { sink += chart(with_grid, threads).error[0]; });
  }
};

void the_thesis_case(const Case& thesis) {
  const milling::StabilityChart chart = thesis.chart(true, 1);
  const double points = static_cast<double>(thesis.speeds.size() * thesis.depths.size());
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const double grid = thesis.time(true), grid_threaded = thesis.time(true, threads);
  std::printf("200 x 100 grid with all crossings, 15 modes, 5000-20000 rpm, 0-4 mm\n");
  std::printf("  one thread %.3f s, %.1f us a point; %d threads %.3f s\n", grid, 1e6 * grid / points, threads,
              grid_threaded);

  // Each depth by itself, with half as many points again; boundaries on a grid twenty times finer.
  double error = 0;
  int crossings = 0, missed = 0;
  const std::vector<double> fine = Range{0, thesis.depths.back(), 2000}.values();
  for (std::size_t s = 0; s < thesis.speeds.size(); s += 9) {
    const int finer = chart.resolution[s] * 3 / 2 + 3;
    const milling::SpectralMap map(thesis.structure, thesis.cutter, thesis.speeds[s], finer);
    const std::vector<double> radii = milling::spectral_radii(map, thesis.depths);
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const double own = chart.spectral_radius(i, s);
      error = std::max(error, std::abs(own - radii[i]) / std::max(1.0, radii[i]));
    }
    const std::vector<double> between = milling::spectral_radii(map, fine);
    for (std::size_t i = 1; i < fine.size(); ++i) {
      if ((between[i] > 1) == (between[i - 1] > 1)) continue;
      ++crossings;
      missed += std::none_of(chart.crossings[s].begin(), chart.crossings[s].end(), [&](const auto& crossing) {
        return crossing.depth_m > fine[i - 1] - 1e-9 && crossing.depth_m < fine[i] + 1e-9;
      });
    }
  }
  std::printf(
      "  error of the radius against a finer map, depth by depth: %.1e; %d of %d crossings of a grid "
      "twenty times finer missed\n",
      error, missed, crossings);

  int sampled = 0;
  const double baseline = seconds([&] {
    for (std::size_t s = 0; s < thesis.speeds.size(); s += 40) {
      const milling::SemiDiscretizationMap map(thesis.structure, thesis.cutter, thesis.speeds[s], 40);
      for (std::size_t i = 5; i < thesis.depths.size(); i += 20, ++sampled) {
        const Eigen::MatrixXd matrix = with_free_intervals(map.monodromy(thesis.depths[i]), 110);
        sink += Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().cwiseAbs().maxCoeff();
      }
    }
  });
  std::printf(
      "  semi-discretization, m = 40, 110 rows, Eigen's dense solver per point: %.0f us, ratio %.0f\n",
      1e6 * baseline / sampled, baseline / sampled / (grid / points));
  const double alone = thesis.time(false);
  // Limits by a scan over the depths, as a grid would find them.
  const double scanned = least_seconds([&] {
    for (const double speed : thesis.speeds) {
      const auto period =
          milling::prepare_period(thesis.structure, thesis.cutter, speed, {}, thesis.depths.back());
      const milling::DepthScan scan(*period.map, thesis.depths.back(), milling::DepthScan::kForLimits);
      sink += static_cast<double>(milling::scanned_crossings(scan, *period.map, 1e-3).size());
    }
  });
  std::printf(
      "  limits alone: one thread %.3f s, %d threads %.3f s; by a scan over the depths %.1f times as much\n",
      alone, threads, thesis.time(false, threads), scanned / alone);
  Case deep = thesis, shallow = thesis;
  deep.depths = {0, 20e-3};
  shallow.depths = {0, 0.5e-3};
  std::printf("  limits up to 20 mm, of up to 0.5 mm: %.2f\n", deep.time(false) / shallow.time(false));
}

void one_mode(const Case& thesis, const dynamics::ModalModel& table) {
  dynamics::ModalModel alone = dynamics::chosen_modes(table, {14});
  alone.dofs = {"x"};
  alone.modes[0].psi_r.conservativeResize(1);
  alone.modes[0].psi_l.conservativeResize(1);
  const Case one{milling::tip_structure(alone), thesis.cutter, thesis.speeds, thesis.depths};
  std::printf("one mode, one direction, same grid: one thread %.3f s\n", one.time(true));
}

void scaling(const Case& thesis, const dynamics::ModalModel& table) {
  const double base = thesis.time(true);
  Case more = thesis;
  more.speeds = speeds_of({5000, 20000, 400});
  const double speeds = more.time(true) / base;
  more = thesis;
  more.depths = Range{0, thesis.depths.back(), 400}.values();
  std::printf("cost of twice the speeds %.2f, of four times the depths %.2f\n", speeds,
              more.time(true) / base);
  // The same modes four times over, each time a little higher.
  dynamics::ModalModel many = table;
  many.covariance.resize(0, 0);
  for (const double factor : {1.013, 1.027, 1.041}) {
    for (dynamics::Mode mode : table.modes) {
      mode.frequency_hz *= factor;
      many.modes.push_back(mode);
    }
  }
  const Case sixty{milling::tip_structure(many), thesis.cutter, speeds_of({5000, 20000, 10}), thesis.depths};
  const Case fifteen{thesis.structure, thesis.cutter, sixty.speeds, thesis.depths};
  std::printf("cost of 60 modes, of 15: grid %.1f, limits %.1f\n", sixty.time(true) / fifteen.time(true),
              sixty.time(false) / fifteen.time(false));
}

void real_cutters(const Case& thesis) {
  const Case straight{thesis.structure, thesis.cutter, speeds_of({5000, 20000, 10}), thesis.depths};
  const auto ratios = [&](const char* what, const Case& other, const Case& plain) {
    std::printf("cost of %s, of the plain cutter: grid %.1f, limits %.1f\n", what,
                other.time(true) / plain.time(true), other.time(false) / plain.time(false));
  };
  Case other = straight;
  other.cutter.pitch_rad = {kTwoPi * 170 / 360, kTwoPi * 190 / 360};
  ratios("unequal pitch, two teeth", other, straight);
  other.cutter.pitch_rad.clear();
  other.cutter.lag_rad_per_m = 2 * std::tan(radians_from_degrees(30)) / 0.012;
  ratios("a helix", other, straight);
  Case slot = straight;
  slot.speeds.resize(3);
  slot.depths = {0, 1e-3};
  slot.cutter.teeth = 4;
  milling::set_immersion(slot.cutter, true, 1);
  other = slot;
  other.cutter.pitch_rad = {kTwoPi * 70 / 360, kTwoPi * 110 / 360, kTwoPi * 85 / 360, kTwoPi * 95 / 360};
  ratios("unequal pitch, four teeth in a slot", other, slot);
  other.cutter.pitch_rad = {kTwoPi * 70 / 360, kTwoPi * 110 / 360, kTwoPi * 70 / 360, kTwoPi * 110 / 360};
  ratios("70-110-70-110 in a slot", other, slot);
}

void eigenvalue_solvers(const Case& thesis) {
  const milling::SpectralMap map(thesis.structure, thesis.cutter, thesis.speeds[100], 9);
  std::vector<Eigen::MatrixXd> matrices;
  for (int i = 1; i <= 8; ++i) matrices.push_back(map.monodromy(i * 0.4e-3));
  constexpr int kRepeats = 200;
  const auto time = [&](const std::function<void()>& work) {
    return 1e6 * least_seconds([&] {
             for (int i = 0; i < kRepeats; ++i) work();
           }) /
           (kRepeats * 8);
  };
  const double lanes = time([&] { sink += numerics::eigenvalues_of_each(matrices).front()[0].real(); });
  const double own = time([&] {
    for (const auto& matrix : matrices) sink += numerics::eigenvalues(matrix)[0].real();
  });
  const double dense = time([&] {
    for (const auto& matrix : matrices)
      sink += Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues()[0].real();
  });
  std::printf(
      "all eigenvalues of %ld rows: eight side by side %.1f us each, alone %.1f us, Eigen's Schur form %.1f "
      "us\n",
      static_cast<long>(matrices[0].rows()), lanes, own, dense);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "lobes_benchmark: expected TABLE and CUT\n");
    return 64;
  }
  const document::Source table_source = cli::read_source(argv[1]), cut_source = cli::read_source(argv[2]);
  const dynamics::ModalModel table =
      document::modal_table_from_json(document::parse_json(table_source), table_source);
  const document::CutDocument cut = document::cut_from_json(document::parse_json(cut_source), cut_source);
  const Case thesis{milling::tip_structure(table), cut.cutter, speeds_of({5000, 20000, 200}),
                    Range{0, 4e-3, 100}.values()};
  the_thesis_case(thesis);
  one_mode(thesis, table);
  scaling(thesis, table);
  real_cutters(thesis);
  eigenvalue_solvers(thesis);
  return sink == 0;
}
