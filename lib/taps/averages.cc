#include "taps/averages.h"

#include <algorithm>
#include <complex>
#include <limits>

namespace stablecut::taps {
namespace {

constexpr double kLeastForceOverNoise = 10;  // of |F|^2: below, its noise is no small error
constexpr double kMostForceNoise = 0.5;      // of |F|^2: what may be taken off as noise
constexpr double kLeastForce = 1e-6;         // of the largest |F|^2: 60 dB, the linear range of sensors

using Index = Eigen::Index;
using Complex = std::complex<double>;

// Sums over the hits on one line.
struct Sums {
  double force = 0;              // of |F|^2
  double quiet_force = 0;        // of |F|^2 without what its noise adds
  std::vector<double> response;  // of |A|^2
  std::vector<Complex> cross;    // of A conj(F)
};

Sums sums_of(const std::vector<HitSpectrum>& hits, Index line) {
  const std::size_t channels = hits.front().responses.size();
  Sums sums{0, 0, std::vector<double>(channels, 0), std::vector<Complex>(channels, 0)};
  double noise = 0;
  for (const HitSpectrum& hit : hits) {
    sums.force += std::norm(hit.force[line]);
    noise += hit.force_noise_square;
    for (std::size_t c = 0; c < channels; ++c) {
      sums.response[c] += std::norm(hit.responses[c][line]);
      sums.cross[c] += hit.responses[c][line] * std::conj(hit.force[line]);
    }
  }
  sums.quiet_force = sums.force - std::min(noise, kMostForceNoise * sums.force);
  return sums;
}

// What a channel's estimate is, and the factors a, b with which a hit's error e enters it to first order:
// e (a conj(F) + b conj(A)).
struct Estimate {
  Complex h, of_force, of_response;
};

Estimate estimate(const Sums& sums, std::size_t channel, Estimator estimator) {
  const Complex cross = sums.cross[channel];
  if (estimator == Estimator::kH1) return {cross / sums.quiet_force, 1 / sums.quiet_force, 0};
  const Complex h1 = cross / sums.force;
  // Nothing in common: H2 has no answer, and the response is nothing but noise.
  if (cross == 0.0) return {h1, 1 / sums.force, 0};
  const Complex h2 = sums.response[channel] / std::conj(cross), per_response = 1.0 / std::conj(cross);
  if (estimator == Estimator::kH2) return {h2, 0, per_response};
  // Half the relative error of each: Hv^2 = H1 H2, on the branch of H1 (both have one phase).
  const Complex hv = h1 * std::sqrt(std::abs(h2) / std::abs(h1));
  return {hv, hv / (2.0 * h1 * sums.force), hv * per_response / (2.0 * h2)};
}

}  // namespace

AveragedColumn average(const std::vector<HitSpectrum>& hits, Estimator estimator) {
  const std::size_t channels = hits.front().responses.size();
  const Index lines = hits.front().force.size();
  const bool spread = hits.size() > 1;
  AveragedColumn column;
  column.h.assign(channels, Eigen::VectorXcd(lines));
  if (spread) {
    column.coherence.assign(channels, Eigen::VectorXd(lines));
    column.covariance.assign(channels * (channels + 1) / 2, Eigen::VectorXcd::Zero(lines));
  }
  std::vector<Estimate> estimates(channels);
  std::vector<Complex> influence(channels);
  for (Index line = 0; line < lines; ++line) {
    const Sums sums = sums_of(hits, line);
    for (std::size_t c = 0; c < channels; ++c) {
      estimates[c] = estimate(sums, c, estimator);
      column.h[c][line] = estimates[c].h;
      const double powers = sums.force * sums.response[c];
      if (spread)
        column.coherence[c][line] = powers > 0 ? std::min(1.0, std::norm(sums.cross[c]) / powers) : 0;
    }
    if (!spread) continue;
    for (const HitSpectrum& hit : hits) {
      const Complex force = hit.force[line];
      // What the hit leaves of its own error, as it draws the average towards itself [MacKinnon1985, HC2].
      const double left = std::max(1 - std::norm(force) / sums.force, std::numeric_limits<double>::epsilon());
      for (std::size_t c = 0; c < channels; ++c) {
        const Estimate& of = estimates[c];
        const Complex response = hit.responses[c][line];
        influence[c] = (response - of.h * force) *
                       (of.of_force * std::conj(force) + of.of_response * std::conj(response));
      }
      for (std::size_t a = 0; a < channels; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          column.covariance[AveragedColumn::pair(a, b)][line] +=
              influence[a] * std::conj(influence[b]) / left;
        }
      }
    }
  }
  return column;
}

Index lines_with_force(const std::vector<HitSpectrum>& hits) {
  const Index lines = hits.front().force.size();
  Eigen::ArrayXd square = Eigen::ArrayXd::Zero(lines);
  double noise = 0;
  for (const HitSpectrum& hit : hits) {
    square += hit.force.array().abs2();
    noise += hit.open_noise_square;
  }
  const double least = std::max(kLeastForceOverNoise * noise, kLeastForce * square.maxCoeff());
  Index count = 0;
  while (count < lines && square[count] >= least) ++count;
  return count;
}

}  // namespace stablecut::taps
