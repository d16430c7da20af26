#include "milling/tested_coefficients.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "base/error.h"
#include "base/parallel.h"
#include "base/units.h"
#include "milling/limits.h"
#include "milling/lobes.h"
#include "numerics/distributions.h"
#include "numerics/order_statistics.h"
#include "numerics/random.h"

namespace stablecut::milling {
namespace {

constexpr double kLow = 0.025, kHigh = 0.975;  // quantiles
constexpr int kImagined = 4000;                // sets of observations for the p value
constexpr double kSameSize = 1e-9;             // of two likelihoods, relative
constexpr double kWider = 2;                   // the second draw's covariance over the posterior's

// Verdicts on all cuts, bit by bit.
using Bits = std::vector<std::uint64_t>;
constexpr std::size_t kBits = 64;

int different(const Bits& a, const Bits& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += std::popcount(a[i] ^ b[i]);
  return count;
}

template <typename Column>
Bits bits_of(const Column& verdicts, std::size_t count) {
  Bits bits((count + kBits - 1) / kBits, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (verdicts[static_cast<Eigen::Index>(i)]) bits[i / kBits] |= std::uint64_t{1} << i % kBits;
  }
  return bits;
}

// Samples with weights, whatever was observed, and what each says of the cuts.
struct Samples {
  std::vector<Eigen::Vector2d> place;    // standard normal in the prior
  std::vector<Eigen::Vector2d> kt_kr;    // N/m2
  std::vector<double> prior_over_drawn;  // densities
  std::vector<Bits> said;
  std::size_t of_prior = 0;  // the first so many were drawn from the prior
};

// So many of the cuts that contradict make the observations so much less likely than none.
std::vector<double> likelihoods(double wrong_share, std::size_t cuts) {
  std::vector<double> result;
  for (std::size_t i = 0; i <= cuts; ++i)
    result.push_back(std::pow(wrong_share / (1 - wrong_share), static_cast<double>(i)));
  return result;
}

std::vector<double> weights_of(const Samples& samples, const Bits& observed,
                               const std::vector<double>& likelihood) {
  std::vector<double> weights;
  for (std::size_t s = 0; s < samples.said.size(); ++s)
    weights.push_back(samples.prior_over_drawn[s] * likelihood[different(samples.said[s], observed)]);
  return weights;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

struct Moments {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

Moments moments_of(const std::vector<Eigen::Vector2d>& values, const std::vector<double>& weights) {
  Moments result;
  const double sum = sum_of(weights);
  for (std::size_t s = 0; s < values.size(); ++s) result.mean += weights[s] / sum * values[s];
  for (std::size_t s = 0; s < values.size(); ++s) {
    const Eigen::Vector2d off = values[s] - result.mean;
    result.covariance += weights[s] / sum * off * off.transpose();
  }
  return result;
}

// The point set of [Hammersley1960], as standard normal numbers.
std::vector<Eigen::Vector2d> normal_places(int count) {
  const double infinite = std::numeric_limits<double>::infinity();
  const auto bits = static_cast<int>(std::bit_width(static_cast<unsigned>(count)));
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < count; ++i) {
    double reversed = std::ldexp(0.5, -bits);
    for (int bit = 0; bit < bits; ++bit) {
      if ((i >> bit & 1) != 0) reversed += std::ldexp(0.5, -bit);
    }
    places.emplace_back(numerics::student_t_quantile((i + 0.5) / count, infinite),
                        numerics::student_t_quantile(reversed, infinite));
  }
  return places;
}

double normal_density(const Eigen::Vector2d& place, const Moments& of) {
  return std::exp(-0.5 * (place - of.mean).dot(of.covariance.llt().solve(place - of.mean))) /
         (kTwoPi * std::sqrt(of.covariance.determinant()));
}

// What samples say, each once, with the prior's mass of those that say it.
struct Patterns {
  std::vector<Bits> said;
  std::vector<double> mass;
  std::vector<std::size_t> of_sample;

  explicit Patterns(const Samples& samples) {
    std::map<Bits, std::size_t> known;
    for (std::size_t s = 0; s < samples.said.size(); ++s) {
      const auto [at, is_new] = known.try_emplace(samples.said[s], said.size());
      if (is_new) {
        said.push_back(samples.said[s]);
        mass.push_back(0);
      }
      mass[at->second] += samples.prior_over_drawn[s];
      of_sample.push_back(at->second);
    }
  }
};

// How well they explain observations.
struct Explained {
  double evidence = 0;       // mean likelihood
  double contradicting = 0;  // posterior mean
};

// `less` of the mass of one pattern does not count.
Explained explained(const Patterns& patterns, const std::vector<double>& likelihood, const Bits& bits,
                    std::size_t one = 0, double less = 0) {
  Explained result;
  double sum = 0, all = 0;
  for (std::size_t p = 0; p < patterns.said.size(); ++p) {
    const double mass = patterns.mass[p] - (p == one ? less : 0);
    const int contradicting = different(patterns.said[p], bits);
    sum += mass * likelihood[contradicting];
    all += mass;
    result.contradicting += mass * likelihood[contradicting] * contradicting;
  }
  result.evidence = sum / all;
  result.contradicting /= sum;
  return result;
}

// Observations as the samples would give them: how often they are no likelier than these, or contradict as
// much. Half of the samples are the prior's own, from which they are drawn; one does not vouch for what it
// gave itself. The smaller share counts, twice since there are two [Dunn1961].
double as_unlikely_share(const Samples& samples, const std::vector<double>& likelihood, const Bits& observed,
                         std::size_t cuts, const PosteriorRequest& request) {
  const Patterns patterns(samples);
  const Explained here = explained(patterns, likelihood, observed);
  std::mt19937_64 generator(request.seed);
  int no_likelier = 0, no_nearer = 0;
  for (int i = 0; i < kImagined; ++i) {
    const auto from =
        static_cast<std::size_t>(numerics::uniform(generator, 0, static_cast<double>(samples.of_prior)));
    Bits imagined = samples.said[from];
    for (std::size_t c = 0; c < cuts; ++c) {
      if (numerics::uniform(generator, 0, 1) < request.wrong_share)
        imagined[c / kBits] ^= std::uint64_t{1} << c % kBits;
    }
    const Explained there =
        explained(patterns, likelihood, imagined, patterns.of_sample[from], samples.prior_over_drawn[from]);
    no_likelier += there.evidence <= here.evidence * (1 + kSameSize);
    no_nearer += there.contradicting >= here.contradicting * (1 - kSameSize);
  }
  return std::min(1.0, 2.0 * (1 + std::min(no_likelier, no_nearer)) / (1 + kImagined));
}

}  // namespace

Verdicts verdicts_of(const std::vector<SampledCut>& samples, const SampledCut& mean,
                     const std::vector<TestedCut>& cuts, int threads, const Progress& progress) {
  std::map<double, std::vector<std::size_t>> at_speed;
  for (std::size_t i = 0; i < cuts.size(); ++i) at_speed[cuts[i].revolutions_per_s].push_back(i);
  Verdicts verdicts(cuts.size(), samples.size());
  std::size_t done = 0;
  for (const auto& [speed, at] : at_speed) {
    double deepest = 0;
    for (const std::size_t i : at) deepest = std::max(deepest, cuts[i].depth_m);
    if (deepest == 0) {  // nothing is cut
      for (const std::size_t i : at) verdicts.row(static_cast<Eigen::Index>(i)).setConstant(true);
      ++done;
      continue;
    }
    const StabilityChart chart =
        stability_chart(mean.structure, mean.cutter, {speed}, {deepest}, {}, false, threads);
    parallel_for(
        samples.size(), threads,
        [&, speed = speed, &at = at](std::size_t s) {
          const auto crossings =
              crossings_at(samples[s].structure, samples[s].cutter, speed, deepest, chart.resolution[0]);
          for (const std::size_t i : at) verdicts(i, s) = stable_between(crossings, cuts[i].depth_m);
        },
        [&, done](double share) {
          if (progress) progress((static_cast<double>(done) + share) / static_cast<double>(at_speed.size()));
        });
    ++done;
  }
  return verdicts;
}

CoefficientPosterior coefficient_posterior(
    const dynamics::ModalModel& model, const Cutter& cutter, const CoefficientDeviations& prior,
    const std::vector<bool>& observed_stable,
    const std::function<Verdicts(const std::vector<SampledCut>&)>& verdicts,
    const PosteriorRequest& request) {
  const std::size_t cuts = observed_stable.size();
  const Bits observed = bits_of(observed_stable, cuts);
  const std::vector<double> likelihood = likelihoods(request.wrong_share, cuts);
  const double together = prior.correlation;
  Eigen::Matrix2d root;
  root << prior.kt_n_per_m2, 0, prior.kr_n_per_m2 * together,
      prior.kr_n_per_m2 * std::sqrt(1 - together * together);
  Samples samples;
  const auto draw = [&](const Moments& from, int count, unsigned seed) {
    std::vector<SampledCut> drawn = sampled_cuts(model, cutter, {}, count, seed);
    const std::vector<Eigen::Vector2d> normal = normal_places(count);
    const Eigen::Matrix2d spread = from.covariance.llt().matrixL();
    for (int i = 0; i < count; ++i) {
      samples.place.push_back(from.mean + spread * normal[i]);
      const Eigen::Vector2d by = root * samples.place.back();
      set_coefficients(drawn[i].cutter, by[0], by[1]);
      samples.kt_kr.emplace_back(drawn[i].cutter.kt_n_per_m2, drawn[i].cutter.kr_n_per_m2);
    }
    const Verdicts said = verdicts(drawn);
    for (int i = 0; i < count; ++i) samples.said.push_back(bits_of(said.col(i), cuts));
  };

  // Half from the prior, half from around what these say; together they are a mixture of both [Owen2000].
  const Moments whole{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity()};
  const int first = (request.samples + 1) / 2, second = request.samples - first;
  draw(whole, first, request.seed);
  samples.of_prior = samples.said.size();
  samples.prior_over_drawn.assign(first, 1);
  Moments near = moments_of(samples.place, weights_of(samples, observed, likelihood));
  near.covariance = kWider * near.covariance + kTwoPi / first * Eigen::Matrix2d::Identity();
  draw(near, second, request.seed + 1);
  samples.prior_over_drawn.clear();
  for (const Eigen::Vector2d& place : samples.place) {
    const double of_prior = normal_density(place, whole);
    samples.prior_over_drawn.push_back(of_prior * request.samples /
                                       (first * of_prior + second * normal_density(place, near)));
  }

  const std::vector<double> weights = weights_of(samples, observed, likelihood);
  const double sum = sum_of(weights);
  CoefficientPosterior result;
  result.least_contradicting = static_cast<int>(cuts);
  result.stable_share = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(cuts));
  double squares = 0;
  std::array<std::vector<double>, 2> value;
  for (std::size_t s = 0; s < weights.size(); ++s) {
    const double share = weights[s] / sum;
    squares += share * share;
    const int contradicting = different(samples.said[s], observed);
    result.contradicting += share * contradicting;
    result.least_contradicting = std::min(result.least_contradicting, contradicting);
    for (std::size_t i = 0; i < cuts; ++i) {
      if (samples.said[s][i / kBits] >> i % kBits & 1) result.stable_share[i] += share;
    }
    for (const int k : {0, 1}) value[k].push_back(samples.kt_kr[s][k]);
  }
  result.effective_samples = 1 / squares;
  const Moments found = moments_of(samples.kt_kr, weights);
  result.kt_n_per_m2 = found.mean[0];
  result.kr_n_per_m2 = found.mean[1];
  result.deviations = {std::sqrt(found.covariance(0, 0)), std::sqrt(found.covariance(1, 1)), 0};
  const double size = result.deviations.kt_n_per_m2 * result.deviations.kr_n_per_m2;
  if (size > 0) result.deviations.correlation = std::clamp(found.covariance(0, 1) / size, -1.0, 1.0);
  result.kt_95_n_per_m2 = {numerics::weighted_quantile(value[0], weights, kLow),
                           numerics::weighted_quantile(value[0], weights, kHigh)};
  result.kr_95_n_per_m2 = {numerics::weighted_quantile(value[1], weights, kLow),
                           numerics::weighted_quantile(value[1], weights, kHigh)};
  result.as_unlikely_share = as_unlikely_share(samples, likelihood, observed, cuts, request);
  return result;
}

}  // namespace stablecut::milling
