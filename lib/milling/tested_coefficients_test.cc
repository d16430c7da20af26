#include "milling/tested_coefficients.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "milling/limits.h"
#include "milling/lobes.h"
#include "milling/milling_fixtures_test.h"
#include "milling/period.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

constexpr double kWrong = 0.05;
const CoefficientDeviations kPrior{60e6, 40e6, 0.3};

using Judge = std::function<Verdicts(const std::vector<SampledCut>&)>;

CoefficientPosterior posterior(const std::vector<bool>& observed, const Judge& judge, int samples = 2000) {
  return coefficient_posterior(fixtures::oscillator({"x", "y"}), fixtures::benchmark_cutter(true, 0.4, 3),
                               kPrior, observed, judge, {kWrong, samples, 1});
}

// A stand-in for lobes that costs nothing: limits that depend on Kt and on Kr / Kt, at twelve cuts around the
// mean's.
Verdicts by_formula(const std::vector<SampledCut>& samples) {
  Verdicts verdicts(12, samples.size());
  for (Eigen::Index s = 0; s < verdicts.cols(); ++s) {
    const double kt = samples[s].cutter.kt_n_per_m2 / 600e6,
                 ratio = samples[s].cutter.kr_n_per_m2 / 600e6 / kt;
    for (int cut = 0; cut < 12; ++cut) {
      const double angle = cut / 2, depth = 0.85 + 0.06 * cut + (cut % 2 == 0 ? -0.05 : 0.05);
      const double limit = (1 + 0.8 * std::cos(angle) * (ratio - 1.0 / 3)) / kt;
      verdicts(cut, s) = depth < limit;
    }
  }
  return verdicts;
}

}  // namespace

TEST_CASE("the posterior of Kt and Kr is that of a grid over both", "[campaign]") {
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.4, 3);
  const SampledCut mean{tip_structure(fixtures::oscillator({"x", "y"})), cutter};
  // Around the limits at some speeds, as one would try; the deeper cut of a pair was stable at one.
  std::vector<TestedCut> cuts;
  std::vector<bool> observed;
  for (const double speed : {80.0, 110.0, 150.0}) {
    const auto limits = stability_chart(mean.structure, cutter, {speed}, {5e-3}, {}, false, 1);
    REQUIRE(!limits.crossings[0].empty());
    for (const double share : {0.9, 1.1}) {
      cuts.push_back({speed, share * limits.crossings[0][0].depth_m, {}});
      observed.push_back(share < 1 || speed == 110);
    }
  }
  const CoefficientPosterior found = posterior(
      observed, [&](const std::vector<SampledCut>& samples) { return verdicts_of(samples, mean, cuts, 1); });

  constexpr int kHalf = 16;  // steps of a quarter of a deviation
  double all = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (int a = -kHalf; a <= kHalf; ++a) {
    for (int b = -kHalf; b <= kHalf; ++b) {
      const double u = a / 4.0, v = b / 4.0, r = kPrior.correlation;
      Cutter at = cutter;
      at.kt_n_per_m2 += kPrior.kt_n_per_m2 * u;
      at.kr_n_per_m2 += kPrior.kr_n_per_m2 * v;
      double likely = std::exp(-(u * u - 2 * r * u * v + v * v) / (2 * (1 - r * r)));
      for (std::size_t i = 0; i < cuts.size(); ++i) {
        const auto map =
            prepare_period(mean.structure, at, cuts[i].revolutions_per_s, {}, cuts[i].depth_m).map;
        likely *= (spectral_radius(*map, cuts[i].depth_m) < 1) == observed[i] ? 1 - kWrong : kWrong;
      }
      all += likely;
      first += likely * Eigen::Vector2d(u, v);
      square += likely * Eigen::Vector2d(u, v) * Eigen::RowVector2d(u, v);
    }
  }
  first /= all;
  const Eigen::Matrix2d covariance = square / all - first * first.transpose();
  CHECK(found.effective_samples > 400);
  // The grid's steps, and four deviations of a mean of so many samples.
  const double tolerance = 4 / std::sqrt(found.effective_samples);
  CHECK(std::abs((found.kt_n_per_m2 - cutter.kt_n_per_m2) / kPrior.kt_n_per_m2 - first[0]) < tolerance);
  CHECK(std::abs((found.kr_n_per_m2 - cutter.kr_n_per_m2) / kPrior.kr_n_per_m2 - first[1]) < tolerance);
  CHECK(std::abs(found.deviations.kt_n_per_m2 / kPrior.kt_n_per_m2 - std::sqrt(covariance(0, 0))) <
        tolerance);
  CHECK(std::abs(found.deviations.kr_n_per_m2 / kPrior.kr_n_per_m2 - std::sqrt(covariance(1, 1))) <
        tolerance);
  CHECK(std::abs(found.deviations.correlation -
                 covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1))) < tolerance);
  // The cuts said something.
  CHECK(found.deviations.kt_n_per_m2 < 0.8 * kPrior.kt_n_per_m2);
}

TEST_CASE(
    "95 % intervals of Kt and Kr after tested cuts cover 93 to 97 % of true values drawn from the prior",
    "[campaign]") {
  std::mt19937_64 generator(5);
  constexpr int kTruths = 2000;
  int kt_covered = 0, kr_covered = 0, unlikely = 0;
  double deviation = 0;
  for (int t = 0; t < kTruths; ++t) {
    const Cutter cutter = fixtures::benchmark_cutter(true, 0.4, 3);
    const SampledCut true_cut = sampled_cuts(fixtures::oscillator({"x", "y"}), cutter, kPrior, 1, 100 + t)[0];
    const Verdicts verdicts = by_formula({true_cut});
    std::vector<bool> observed;
    for (Eigen::Index i = 0; i < verdicts.rows(); ++i)
      observed.push_back(verdicts(i, 0) != (numerics::uniform(generator, 0, 1) < kWrong));
    const CoefficientPosterior found = posterior(observed, by_formula, 600);
    const auto covers = [](const std::array<double, 2>& interval, double value) {
      return interval[0] <= value && value <= interval[1];
    };
    kt_covered += covers(found.kt_95_n_per_m2, true_cut.cutter.kt_n_per_m2);
    kr_covered += covers(found.kr_95_n_per_m2, true_cut.cutter.kr_n_per_m2);
    unlikely += found.as_unlikely_share < 0.01;
    deviation += found.deviations.kt_n_per_m2 / kPrior.kt_n_per_m2 / kTruths;
  }
  INFO(kt_covered << " " << kr_covered << " " << unlikely << " " << deviation);
  CHECK(std::abs(1.0 * kt_covered / kTruths - 0.95) < 0.02);
  CHECK(std::abs(1.0 * kr_covered / kTruths - 0.95) < 0.02);
  // A p value: of one in a hundred, and three deviations of that.
  CHECK(unlikely < 0.01 * kTruths + 3 * std::sqrt(0.01 * kTruths));
  CHECK(deviation < 0.8);
}

TEST_CASE("cuts that the prior does not allow are improbable, and cuts that say nothing leave it as it is") {
  // Deep cuts that are stable while shallow ones chatter: no Kt explains that.
  std::vector<bool> against;
  for (int cut = 0; cut < 12; ++cut) against.push_back(cut >= 6);
  const CoefficientPosterior found = posterior(against, by_formula);
  CHECK(found.as_unlikely_share < 1e-3);
  CHECK(found.least_contradicting > 4);

  const auto always = [](const std::vector<SampledCut>& samples) -> Verdicts {
    return Verdicts::Constant(3, static_cast<Eigen::Index>(samples.size()), true);
  };
  const CoefficientPosterior none = posterior({true, true, true}, always);
  CHECK(none.as_unlikely_share == 1);
  CHECK(none.contradicting == 0);
  // Quantiles of 2000 places, and their moments.
  CHECK(std::abs(none.kt_n_per_m2 - 600e6) < 0.01 * kPrior.kt_n_per_m2);
  CHECK(std::abs(none.deviations.kt_n_per_m2 / kPrior.kt_n_per_m2 - 1) < 0.02);
  CHECK(std::abs(none.deviations.correlation - kPrior.correlation) < 0.02);
  CHECK(std::abs(none.kr_95_n_per_m2[1] - 200e6 - 1.96 * kPrior.kr_n_per_m2) < 0.05 * kPrior.kr_n_per_m2);
}
