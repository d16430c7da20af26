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

constexpr double kSurelyMore = 4;  // deviations of a mean square above that of noise

// 1 from a pulse's width before the pulse to a width behind it, then half a cosine wave down to 0 over
// another width on either side.
Eigen::ArrayXd force_window(const Hit& hit, Index length) {
  const Index width = hit.pulse.width();
  const Index from = hit.pulse.from - hit.from - width, to = hit.pulse.to - hit.from + width;
  Eigen::ArrayXd window(length);
  for (Index i = 0; i < length; ++i) {
    const Index beyond = i < from ? from - i : i >= to ? i - to + 1 : 0;
    window[i] = beyond > width
                    ? 0
                    : (1 + std::cos(kPi * static_cast<double>(beyond) / static_cast<double>(width + 1))) / 2;
  }
  return window;
}

// Mean of what a channel shows before the pulse and its window, 0 where that is too short to tell.
double offset_before(const Eigen::VectorXd& channel, const Hit& hit, Index samples) {
  const Index end = hit.pulse.from - hit.pulse.width();
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

bool force_disturbed(const std::vector<Record>& records, const HitSearch& search, Index length) {
  double squares = 0, noise = 0, samples = 0;
  for (const Hit& hit : search.hits) {
    if (hit.fault != HitFault::kNone) continue;
    const Eigen::ArrayXd away = 1 - force_window(hit, length);
    const double deviation = search.noise_n[hit.record];
    const auto force = records[hit.record].force.segment(hit.from, length).array();
    squares += (away * (force - search.offset_n[hit.record]).square()).sum();
    noise += deviation * deviation * away.sum();
    samples += away.sum();
  }
  return squares > noise * (1 + kSurelyMore * std::sqrt(2 / samples));
}

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

HitSpectrum hit_spectrum(const Record& record, const Hit& hit, Index length, Index lines,
                         double force_offset_n, double force_noise_n, const Windows& windows) {
  const Eigen::ArrayXd seconds =
      Eigen::ArrayXd::LinSpaced(length, 0, static_cast<double>(length - 1)) / record.sample_rate_hz;
  const Eigen::ArrayXd decaying = (-windows.decay_per_s * seconds).exp();
  Eigen::ArrayXd of_force = decaying;
  if (windows.force_window) of_force *= force_window(hit, length);
  HitSpectrum spectrum;
  const auto force = record.force.segment(hit.from, length).array() - force_offset_n;
  spectrum.force = lines_of((force * of_force).matrix(), lines);
  spectrum.force_noise_square = force_noise_n * force_noise_n * of_force.square().sum();
  for (const Eigen::VectorXd& channel : record.responses) {
    const double offset = offset_before(channel, hit, length / kQuietShare);
    spectrum.responses.push_back(
        lines_of(((channel.segment(hit.from, length).array() - offset) * decaying).matrix(), lines));
  }
  return spectrum;
}

}  // namespace stablecut::taps
