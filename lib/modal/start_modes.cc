#include "modal/start_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>

#include "modal/mode_candidates.h"
#include "modal/mode_selection.h"
#include "modal/vector_fitting.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

// Of the first refinement, which has many candidates.
constexpr Effort kStartEffort{24, 0.1};
constexpr Eigen::Index kStartPairs = 30, kMostStartPairs = 120;
// From twice as many pairs where a larger share of them matters.
constexpr double kCrowdedStart = 0.6;
constexpr int kRelocations = 8;
constexpr int kRelocationsAfterPruning = 2;
// Poles that may stand for a rigid body: up to so many times the first line, or so much damped.
constexpr double kRigidReach = 4, kRigidDamping = 0.3;
// Where a rigid body's own pole is looked for, in first lines; how much it is damped there; and how far apart
// those of several directions start.
constexpr std::array kRigidPlaces = {0.5, 0.1, 0.02};
constexpr double kRigidStartDamping = 0.05, kRigidSpread = 0.1;

// Relocated poles, of so many pairs to start from, without those that do not matter.
Eigen::VectorXcd relocated_poles(const GroupFit& fit, Eigen::Index pairs) {
  const FitData& data = fit.data;
  Eigen::VectorXcd poles = starting_poles(data, pairs);
  for (int i = 0; i < kRelocations; ++i) poles = relocate_poles(data, poles);
  while (poles.size() > 1) {
    const LinearResidues linear = linear_residues(data, poles);
    const double spread = std::max(1.0, linear.chi_square / fit.complex_values());
    const double least = spread * static_cast<double>(2 * data.curves.size()) * std::log(data.values());
    std::vector<Eigen::Index> order(poles.size());
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return linear.removal_loss[a] < linear.removal_loss[b];
    });
    const auto worthless = std::count_if(order.begin(), order.end(),
                                         [&](Eigen::Index k) { return linear.removal_loss[k] < least; });
    if (worthless == 0) break;
    // Half of them at a time: each may matter once others are gone.
    const auto dropped = std::clamp<std::ptrdiff_t>(worthless / 2, 1, worthless);
    std::vector<Eigen::Index> kept(order.begin() + dropped, order.end());
    std::sort(kept.begin(), kept.end());
    poles = poles(kept).eval();
    for (int i = 0; i < kRelocationsAfterPruning; ++i) poles = relocate_poles(data, poles);
  }
  return poles;
}

// A suspended structure moves as a rigid body, 1 / (m omega^2), whose poles lie far below the lines. Exact
// data of it draw several poles to the first lines, from where none finds its way down. One mode for each
// direction below the lines replaces these, and the heavily damped ones that help them, when it explains the
// curves as well.
RefinedModes with_rigid_body(const GroupFit& fit, RefinedModes start) {
  const double lowest = fit.data.s[0].imag();
  std::vector<Complex> kept;
  for (const dynamics::Mode& mode : start.modes) {
    const Complex pole = mode.pole();
    if (std::abs(pole) > kRigidReach * lowest && mode.damping_ratio < kRigidDamping) kept.push_back(pole);
  }
  const std::size_t dropped = start.modes.size() - kept.size();
  const std::size_t bodies = fit.data.dofs;
  if (dropped <= bodies) return start;
  for (const double place : kRigidPlaces) {
    Eigen::VectorXcd poles(kept.size() + bodies);
    std::copy(kept.begin(), kept.end(), poles.begin());
    for (std::size_t d = 0; d < bodies; ++d)
      poles[kept.size() + d] =
          place * (1 + kRigidSpread * static_cast<double>(d)) * lowest * Complex(-kRigidStartDamping, 1);
    RefinedModes trial = fit.refine(modes_at(fit.data, poles), kStartEffort);
    const double saved = static_cast<double>(dropped - bodies) * price_of_mode(fit, start, start);
    if (trial.chi_square < start.chi_square + saved) return trial;
  }
  return start;
}

}  // namespace

std::vector<dynamics::Mode> modes_at(const FitData& data, const Eigen::VectorXcd& poles) {
  const LinearResidues linear = linear_residues(data, poles);
  std::vector<dynamics::Mode> modes;
  for (Eigen::Index k = 0; k < poles.size(); ++k)
    modes.push_back(rank_one_mode(data, poles[k], linear.residue.row(k)));
  return modes;
}

Eigen::VectorXcd with_residual_terms(const FitData& data, const Eigen::VectorXcd& poles) {
  std::vector<Complex> all(poles.begin(), poles.end());
  std::erase_if(all, [&](Complex pole) { return !data.in_band(pole); });
  const Eigen::VectorXcd terms = residual_poles(data);
  all.insert(all.end(), terms.begin(), terms.end());
  return Eigen::Map<Eigen::VectorXcd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

// From more pairs where nearly all of them matter.
Eigen::VectorXcd find_poles(const GroupFit& fit) {
  const Eigen::Index lines = fit.data.lines();
  Eigen::VectorXcd poles;
  for (Eigen::Index pairs = kStartPairs; pairs <= kMostStartPairs; pairs *= 2) {
    poles = relocated_poles(fit, std::min(pairs, lines / kLinesPerPair));
    const bool crowded = static_cast<double>(poles.size()) >= kCrowdedStart * static_cast<double>(pairs);
    if (!crowded || kLinesPerPair * pairs >= lines) break;
  }
  return fit.data.residual_terms ? with_residual_terms(fit.data, poles) : poles;
}

RefinedModes start_modes(const GroupFit& fit, const Eigen::VectorXcd& poles) {
  if (fit.data.residual_terms) return fit.refine(modes_at(fit.data, poles), kStartEffort);
  return with_rigid_body(fit, fit.refine(modes_at(fit.data, poles), kStartEffort));
}

}  // namespace stablecut::modal
