#include "taps/averages.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::taps;
using Complex = std::complex<double>;

namespace {

constexpr Eigen::Index kLines = 4000;

// Hits on H = (2 - 1i, 0.5i) with forces of different size, noise on the force's channel (the same for both
// responses) and on each response.
std::vector<HitSpectrum> hits_with(double force_noise, double response_noise, std::mt19937_64& generator) {
  std::vector<HitSpectrum> hits;
  for (const double force : {1.0, 1.4, 0.7, 1.2, 0.9, 1.1}) {
    HitSpectrum hit{Eigen::VectorXcd(kLines), {Eigen::VectorXcd(kLines), Eigen::VectorXcd(kLines)}, 0};
    for (Eigen::Index i = 0; i < kLines; ++i) {
      hit.force[i] = force + force_noise * numerics::unit_complex_normal(generator);
      hit.responses[0][i] =
          Complex(2, -1) * force + response_noise * numerics::unit_complex_normal(generator);
      hit.responses[1][i] =
          Complex(0, 0.5) * force + response_noise * numerics::unit_complex_normal(generator);
    }
    hits.push_back(std::move(hit));
  }
  return hits;
}

}  // namespace

TEST_CASE("without noise all averages are the response, with coherence 1 and variance 0") {
  std::mt19937_64 generator(1);
  const auto hits = hits_with(0, 0, generator);
  for (const Estimator estimator : {Estimator::kH1, Estimator::kH2, Estimator::kHv}) {
    const AveragedColumn column = average(hits, estimator);
    CHECK((column.h[0].array() - Complex(2, -1)).abs().maxCoeff() < 1e-15 * 10);
    CHECK((column.h[1].array() - Complex(0, 0.5)).abs().maxCoeff() < 1e-15 * 10);
    CHECK((column.coherence[0].array() - 1).abs().maxCoeff() < 1e-15 * 10);
    for (const auto& covariance : column.covariance) CHECK(covariance.cwiseAbs().maxCoeff() < 1e-28);
  }
}

TEST_CASE("variance and covariance are those of the averages' errors") {
  const Complex truth[] = {Complex(2, -1), Complex(0, 0.5)};
  for (const Estimator estimator : {Estimator::kH1, Estimator::kH2, Estimator::kHv}) {
    std::mt19937_64 generator(7);
    const AveragedColumn column = average(hits_with(0.02, 0.02, generator), estimator);
    for (std::size_t a = 0; a < 2; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        const Eigen::ArrayXcd error_a = column.h[a].array() - column.h[a].mean();
        const Eigen::ArrayXcd error_b = column.h[b].array() - column.h[b].mean();
        const Complex true_value = (error_a * error_b.conjugate()).mean();
        const Complex estimate = column.covariance[AveragedColumn::pair(a, b)].mean();
        // Means over 4000 lines, those of the estimate with 5 degrees of freedom each: 2 % and 1 %.
        const double scale = std::sqrt(std::abs(error_a.abs2().mean() * error_b.abs2().mean()));
        CHECK(std::abs(estimate - true_value) < 0.08 * scale);
        if (a == b) CHECK(std::abs(estimate.imag()) < 1e-12 * scale);
        if (a != b) CHECK(std::abs(true_value) > 0.3 * scale);  // there is something to find
      }
      CHECK(std::abs(column.h[a].mean() - truth[a]) < 2e-3 * std::abs(truth[a]));
    }
  }
}

TEST_CASE("hits whose errors differ give the right variance too") {
  // Every second hit has ten times the noise: the textbook's formula would be wrong by the mean of the rest.
  std::mt19937_64 generator(3);
  const auto quiet = hits_with(0, 0.01, generator), loud = hits_with(0, 0.1, generator);
  std::vector<HitSpectrum> hits;
  for (std::size_t i = 0; i < quiet.size(); ++i) hits.push_back(i % 2 == 0 ? quiet[i] : loud[i]);
  const AveragedColumn column = average(hits, Estimator::kH1);
  const double truth = (column.h[0].array() - Complex(2, -1)).abs2().mean();
  // To first order: unequal noise leaves a share of the leverage, about 1 / 6.
  CHECK(std::abs(column.covariance[0].real().mean() / truth - 1) < 0.2);
}

TEST_CASE("H1 is too small by noise on the force, H2 too large by noise on the response, Hv between") {
  std::mt19937_64 generator(5);
  auto hits = hits_with(0.3, 0, generator);
  const double power = (1 + 1.96 + 0.49 + 1.44 + 0.81 + 1.21) / 6;
  const auto size = [&](Estimator estimator) {
    return std::abs(average(hits, estimator).h[0].mean()) / std::abs(Complex(2, -1));
  };
  // Six hits: the mean of a quotient is that of the means to a few per cent of the bias.
  CHECK(size(Estimator::kH1) == Approx(power / (power + 0.09)).epsilon(0.02));
  CHECK(size(Estimator::kH2) == Approx(1).epsilon(0.02));
  // Where the noise of the force is known, H1 is right.
  for (HitSpectrum& hit : hits) hit.force_noise_square = 0.09;
  CHECK(size(Estimator::kH1) == Approx(1).epsilon(0.02));
  CHECK(size(Estimator::kHv) == Approx(std::sqrt(power / (power + 0.09))).epsilon(0.02));
}

TEST_CASE("one hit has no spread") {
  std::mt19937_64 generator(1);
  auto hits = hits_with(0.1, 0.1, generator);
  hits.resize(1);
  const AveragedColumn column = average(hits, Estimator::kH1);
  CHECK(column.covariance.empty());
  CHECK(column.coherence.empty());
  CHECK(column.h[0].isApprox(hits[0].responses[0].cwiseQuotient(hits[0].force), 1e-14));
}
