#include "taps/hit_spectra.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "base/units.h"

namespace stablecut::taps {
namespace {

constexpr Eigen::Index kQuietSamples = 16;  // whose mean is surer than a quarter of the noise
constexpr Eigen::Index kQuietShare = 16;    // of a part's length, before the pulse: what tells the offset

using Index = Eigen::Index;

// 1 from a pulse's reach before the pulse to a reach behind it, then half a cosine wave down to 0 over
// another reach on either side.
Eigen::ArrayXd force_window(const Hit& hit, Index length) {
  const Index reach = hit.pulse.reach();
  const Index from = hit.pulse.from - hit.from - reach, to = hit.pulse.to - hit.from + reach;
  Eigen::ArrayXd window(length);
  for (Index i = 0; i < length; ++i) {
    const Index beyond = i < from ? from - i : i >= to ? i - to + 1 : 0;
    window[i] = beyond > reach
                    ? 0
                    : (1 + std::cos(kPi * static_cast<double>(beyond) / static_cast<double>(reach + 1))) / 2;
  }
  return window;
}

Eigen::ArrayXd decay_window(Index length, double decay_per_sample) {
  return (-decay_per_sample * Eigen::ArrayXd::LinSpaced(length, 0, static_cast<double>(length - 1))).exp();
}

// Mean of what a channel shows before the pulse and its window, 0 where that is too short to tell.
double offset_before(const Eigen::VectorXd& channel, const Hit& hit, Index samples) {
  const Index end = hit.pulse.from - hit.pulse.reach();
  const Index from = std::max<Index>(0, end - samples);
  return end - from < kQuietSamples ? 0 : channel.segment(from, end - from).mean();
}

Eigen::VectorXcd lines_of(const Eigen::VectorXd& signal, Index lines) {
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  Eigen::VectorXcd all;
  transform.fwd(all, signal);
  return all.segment(1, lines);
}

}  // namespace

Index transform_length(Index length) {
  for (Index n = length - length % 2; n > 0; n -= 2) {
    Index rest = n;
    for (const Index factor : {2, 3, 5}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return n;
  }
  return 0;
}

HitSpectrum force_spectrum(const Record& record, const Hit& hit, Index length, Index lines,
                           double force_offset_n, double force_noise_n, const Windows& windows) {
  const Eigen::ArrayXd decaying = decay_window(length, windows.decay_per_s / record.sample_rate_hz);
  Eigen::ArrayXd of_force = decaying;
  if (windows.force == ForceWindow::kPulse) of_force *= force_window(hit, length);
  if (windows.force == ForceWindow::kAway) of_force *= 1 - force_window(hit, length);
  const double noise_square = force_noise_n * force_noise_n;
  const auto force = record.force.segment(hit.from, length).array() - force_offset_n;
  return {lines_of((force * of_force).matrix(), lines),
          {},
          noise_square * of_force.square().sum(),
          noise_square * decaying.square().sum()};
}

HitSpectrum hit_spectrum(const Record& record, const Hit& hit, Index length, Index lines,
                         double force_offset_n, double force_noise_n, const Windows& windows) {
  HitSpectrum spectrum = force_spectrum(record, hit, length, lines, force_offset_n, force_noise_n, windows);
  const Eigen::ArrayXd decaying = decay_window(length, windows.decay_per_s / record.sample_rate_hz);
  for (const Eigen::VectorXd& channel : record.responses) {
    const double offset = offset_before(channel, hit, length / kQuietShare);
    spectrum.responses.push_back(
        lines_of(((channel.segment(hit.from, length).array() - offset) * decaying).matrix(), lines));
  }
  return spectrum;
}

}  // namespace stablecut::taps
