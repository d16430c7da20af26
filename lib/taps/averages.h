// Frequency responses from the spectra of several hits, with their variance: README.md, "Averages".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "taps/hit_spectra.h"

namespace stablecut::taps {

/// H1 takes all noise to be the responses', apart from the power of the force's noise, which is taken off; H2
/// to be the force's; Hv lies between [Rocklin1985].
enum class Estimator { kH1, kH2, kHv };

/// The responses to one force, averaged over hits.
struct AveragedColumn {
  std::vector<Eigen::VectorXcd> h;         ///< [channels][lines]
  std::vector<Eigen::VectorXd> coherence;  ///< [channels][lines]; of two hits at least
  /// [lines] E[error of channel a times the conjugate of that of channel b], for b <= a, in the order (0, 0),
  /// (1, 0), (1, 1), (2, 0), ...; empty for a single hit. From the spread over the hits.
  std::vector<Eigen::VectorXcd> covariance;

  static std::size_t pair(std::size_t a, std::size_t b) { return a * (a + 1) / 2 + b; }
};

/// From at least one hit; all have the same channels and lines.
AveragedColumn average(const std::vector<HitSpectrum>& hits, Estimator estimator);

/// Number of lines, from the first on, on which the hits' mean force stands out: |F|^2 is at least ten times
/// that of the noise without a force window (which takes noise away, and no force comes for it) and 1e-6 of
/// its largest.
Eigen::Index lines_with_force(const std::vector<HitSpectrum>& hits);

}  // namespace stablecut::taps
