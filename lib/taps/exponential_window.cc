#include "taps/exponential_window.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stablecut::taps {
namespace {

constexpr int kBlocks = 16;  // over which the decay is followed
constexpr double kSeen = 4;  // deviations of a block's mean square that the ringing must be above noise
constexpr double kNoiseVariance =
    2.6265;  // of a block's noise by fourth differences over that by its mean square
constexpr double kFinestStep = 0x1p-24;    // of the peak: the step of the best converters
constexpr double kShareOfNoise = 1.0 / 3;  // of the average's noise: what may leak
constexpr double kSteadyFall = 0.7;        // of the logarithm of the mean square over half a part: a half
constexpr int kHalvings = 60;

using Index = Eigen::Index;

// Of one channel, over the hits, each as if its force had been 1 N.
struct Ringing {
  std::array<double, kBlocks> mean_square{};
  double noise_square = 0;  // of the last block, by its fourth differences
  double values = 0;        // as many of equal weight make a block's mean square as sure as it is
};

Ringing ringing_of(const std::vector<Record>& records, const std::vector<Hit>& hits, Index length,
                   std::size_t channel) {
  Ringing ringing;
  const Index block = length / kBlocks;
  double peak_square = 0, weights = 0, squared_weights = 0;
  for (const Hit& hit : hits) {
    const double scale = 1 / (hit.pulse.force_n * hit.pulse.force_n * static_cast<double>(hits.size()));
    weights += scale;
    squared_weights += scale * scale;
    const auto part = records[hit.record].responses[channel].segment(hit.from, block * kBlocks);
    for (int b = 0; b < kBlocks; ++b) {
      // Without the mean: drift that is slower than a block rings for ever.
      const auto of_block = part.segment(b * block, block).array();
      const Eigen::ArrayXd square = (of_block - of_block.mean()).square();
      ringing.mean_square[b] += scale * square.mean();
      peak_square = std::max(peak_square, scale * square.maxCoeff());
    }
    double sum = 0;
    for (Index i = (kBlocks - 1) * block; i + 4 < kBlocks * block; ++i) {
      const double difference = part[i] - 4 * part[i + 1] + 6 * part[i + 2] - 4 * part[i + 3] + part[i + 4];
      sum += difference * difference;
    }
    ringing.noise_square += scale * sum / (70 * static_cast<double>(block - 4));
  }
  const double finest = kFinestStep * kFinestStep * peak_square * static_cast<double>(hits.size());
  ringing.noise_square = std::max(ringing.noise_square, finest);
  ringing.values = static_cast<double>(block) * weights * weights / squared_weights;
  return ringing;
}

// What does not decay, as noise, hum and drift: its mean square, and the least of a block that rings above
// it.
struct Floor {
  double square, least;
};

Floor floor_of(const Ringing& ringing) {
  const double of_block = std::sqrt(2 / ringing.values);  // relative deviation of a mean square of noise
  const double white = ringing.noise_square * (1 + kSeen * of_block * std::sqrt(1 + kNoiseVariance));
  constexpr int kHalf = kBlocks / 2;
  Eigen::Array<double, kHalf, 1> level;
  for (int b = 0; b < kHalf; ++b) level[b] = std::log(std::max(ringing.mean_square[kHalf + b], white));
  const Eigen::Array<double, kHalf, 1> place =
      Eigen::Array<double, kHalf, 1>::LinSpaced(-(kHalf - 1) / 2.0, (kHalf - 1) / 2.0);
  const double places = place.square().sum(), slope = (place * level).sum() / places;
  const Eigen::Array<double, kHalf, 1> left = level - level.mean() - slope * place;
  const double deviation =
      std::max(std::sqrt(left.square().sum() / (kHalf - 2)), of_block) / std::sqrt(places);
  if (-slope > kSeen * deviation || -slope * kHalf > kSteadyFall) return {ringing.noise_square, white};
  const double scatter = std::sqrt((level - level.mean()).square().sum() / (kHalf - 1));
  double steady = 0;
  for (int b = kHalf; b < kBlocks; ++b) steady += ringing.mean_square[b] / kHalf;
  return {steady, std::max(white, std::exp(level.mean() + kSeen * std::max(scatter, of_block)))};
}

}  // namespace

double needed_decay(const std::vector<Record>& records, const std::vector<Hit>& hits, Index length) {
  const Index block = length / kBlocks;
  if (hits.empty() || block < 8) return 0;
  const double rate = records.front().sample_rate_hz;
  const double block_s = static_cast<double>(block) / rate;
  const double duration_s = static_cast<double>(length) / rate;
  double needed = 0;
  for (std::size_t c = 0; c < records.front().responses.size(); ++c) {
    const Ringing ringing = ringing_of(records, hits, length, c);
    const Floor floor = floor_of(ringing);
    int last = kBlocks - 1;
    while (last > 0 && ringing.mean_square[last] <= floor.least) --last;
    if (last == 0) continue;
    const double of_last = ringing.mean_square[last] - floor.square;
    // The slowest decay that shows: between the last block that rings and one half as late, if that rings.
    const int half = last / 2;
    const double of_half = std::max(ringing.mean_square[half] - floor.square, of_last);
    const double own = std::log(of_half / of_last) / (2 * block_s * (last - half));
    const double left_s = duration_s - (last + 0.5) * block_s;
    const double at_end = std::sqrt(2 * of_last) * std::exp(-own * left_s);
    // Leakage a e^(-decay T) rate / (own + decay) against the noise of an average of windowed records.
    const double noise = kShareOfNoise * std::sqrt(ringing.noise_square / static_cast<double>(hits.size()));
    const auto leaks = [&](double decay) {
      const double kept_s = decay > 0 ? -std::expm1(-2 * decay * duration_s) / (2 * decay) : duration_s;
      const double damping = std::max(own + decay, 1 / duration_s);
      return at_end * std::exp(-decay * duration_s) * rate / damping > noise * std::sqrt(rate * kept_s);
    };
    if (!leaks(needed)) continue;
    double low = needed, high = std::max(needed, 1 / duration_s);
    while (leaks(high)) high *= 2;
    for (int i = 0; i < kHalvings; ++i) (leaks((low + high) / 2) ? low : high) = (low + high) / 2;
    needed = high;
  }
  return needed;
}

}  // namespace stablecut::taps
