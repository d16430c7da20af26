// Spectra of hits through a force window and an exponential window: README.md, "Spectra".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "taps/hit_search.h"
#include "taps/record.h"

namespace stablecut::taps {

/// What of a hit's force is taken: all of it, nothing away from its pulse, or what that leaves out.
enum class ForceWindow { kNone, kPulse, kAway };

struct Windows {
  double decay_per_s = 0;  ///< of the exponential window, from the beginning of a hit's part; 0: none
  ForceWindow force = ForceWindow::kNone;
};

/// Of one hit, on the lines k / (length / rate), k from 1.
struct HitSpectrum {
  Eigen::VectorXcd force;                   ///< [lines] sums over the samples
  std::vector<Eigen::VectorXcd> responses;  ///< [channels][lines]
  double force_noise_square = 0;  ///< expected |force|^2 of a line without a hit, where the noise is white
  double open_noise_square = 0;   ///< the same without a force window
};

/// The longest length up to `length` that is even and a product of 2, 3 and 5.
Eigen::Index transform_length(Eigen::Index length);

/// The force of `hit` over `length` samples, without responses, on the first `lines` lines above 0.
HitSpectrum force_spectrum(const Record& record, const Hit& hit, Eigen::Index length, Eigen::Index lines,
                           double force_offset_n, double force_noise_n, const Windows& windows);

/// Spectra of `hit` over `length` samples, of which the first `lines` lines above 0.
HitSpectrum hit_spectrum(const Record& record, const Hit& hit, Eigen::Index length, Eigen::Index lines,
                         double force_offset_n, double force_noise_n, const Windows& windows);

}  // namespace stablecut::taps
