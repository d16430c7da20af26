#include "taps/tap_campaign.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "base/error.h"
#include "taps/hit_spectra.h"
#include "taps/tap_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::taps;
using fixtures::accelerance, fixtures::column_of, fixtures::exact_record, fixtures::kRate;
using Complex = std::complex<double>;

TEST_CASE("the damping of the exponential window is taken off to rounding") {
  // 1 s of a structure that rings for several seconds.
  TapChoice choice;
  choice.decay_per_s = 30;
  const TapCampaign campaign = responses_of({column_of(exact_record({{0.05, 80}}, 1.1, 30))},
                                            dynamics::Quantity::kAccelerance, choice);
  REQUIRE(campaign.frf.entries.size() == 2);
  CHECK(campaign.frf.window_decay_per_s == 30);
  double largest = 0;
  for (Eigen::Index row = 0; row < 2; ++row)
    largest = std::max(largest, campaign.frf.entries[row].h.cwiseAbs().maxCoeff());
  // Up to where the pulse has a thousandth of its force left.
  for (Eigen::Index line = 0; campaign.frf.frequency_hz[line] < 1000; ++line) {
    for (Eigen::Index row = 0; row < 2; ++row)
      CHECK(std::abs(campaign.frf.entries[row].h[line] - accelerance(campaign.frf, line, row)) <
            1e-10 * largest);
  }
  const dynamics::FrequencyResponse receptance = dynamics::to_receptance(campaign.frf);
  const Complex s(30, kTwoPi * receptance.frequency_hz[80]);
  CHECK(std::abs(receptance.entries[0].h[80] / dynamics::receptance_at(fixtures::structure(), s)(0, 0) -
                 1.0) < 1e-9);
}

TEST_CASE("ten hits with noise on the force and a double hit among them: the spread is that of the errors",
          "[campaign]") {
  constexpr int kCampaigns = 40;
  constexpr Eigen::Index kLines = 500;
  std::mt19937_64 generator(100);
  std::vector<fixtures::Blow> blows;
  for (int hit = 0; hit < 10; ++hit)
    blows.push_back({0.05 + 1.2 * hit, numerics::uniform(generator, 60, 120)});
  blows.push_back({0.05 + 1.2 * 4 + 0.021, 25});
  const Record exact = exact_record(blows, 12.1, 0);
  // Of x, of y, and of y times the conjugate of x in the phase of the truth's product.
  Eigen::Array3Xd errors = Eigen::Array3Xd::Zero(3, kLines), told = errors;
  TapChoice choice;
  choice.decay_per_s = 2;
  Eigen::Array2Xcd truth(2, kLines);
  for (int run = 0; run < kCampaigns; ++run) {
    Record record = exact;
    fixtures::add_noise(record.force, 0.5, generator);
    for (auto& response : record.responses) fixtures::add_noise(response, 0.02, generator);
    const TapCampaign campaign = responses_of({column_of(record)}, dynamics::Quantity::kAccelerance, choice);
    REQUIRE(campaign.hits[0].size() == 10);
    for (std::size_t i = 0; i < 10; ++i)
      CHECK(campaign.hits[0][i].fault == (i == 4 ? HitFault::kDouble : HitFault::kNone));
    REQUIRE(campaign.used[0] == 9);
    REQUIRE(campaign.frf.covariances.size() == 1);
    const auto& entries = campaign.frf.entries;
    for (Eigen::Index line = 0; line < kLines; ++line) {
      if (run == 0) {
        for (Eigen::Index row = 0; row < 2; ++row) truth(row, line) = accelerance(campaign.frf, line, row);
      }
      const Complex x = truth(0, line), y = truth(1, line);
      const Complex of_x = entries[0].h[line] - x, of_y = entries[1].h[line] - y;
      const Complex turn = std::conj(y * std::conj(x)) / std::abs(x * y);
      errors.col(line) +=
          Eigen::Array3d(std::norm(of_x), std::norm(of_y), (of_y * std::conj(of_x) * turn).real());
      told.col(line) += Eigen::Array3d(entries[0].variance[line], entries[1].variance[line],
                                       (campaign.frf.covariances[0].value[line] * turn).real());
    }
  }
  // Hundreds of lines in 40 campaigns are known to 3 %; the variance is right to first order, the force's
  // noise being 0.7 % of its peak.
  const Eigen::ArrayXd scale = (told.row(0) * told.row(1)).sqrt();
  CHECK((errors.row(0) / told.row(0)).mean() == Approx(1).margin(0.06));
  CHECK((errors.row(1) / told.row(1)).mean() == Approx(1).margin(0.06));
  const double shared = (errors.row(2).transpose() / scale).mean();
  CHECK(shared == Approx((told.row(2).transpose() / scale).mean()).epsilon(0.2));
  CHECK(shared > 0.2);  // of the deviations: there is something to find
}

TEST_CASE("columns share their lines") {
  Record x = exact_record({{0.05, 80}, {1.25, 90}}, 2.6, 0),
         y = exact_record({{0.05, 80}, {1.05, 90}}, 2.0, 0);
  const TapCampaign campaign =
      responses_of({column_of(x), {"y", {"x", "y"}, {y}}}, dynamics::Quantity::kAccelerance, {});
  REQUIRE(campaign.frf.entries.size() == 4);
  CHECK(campaign.frf.find("x", "y") != nullptr);
  CHECK(std::abs(campaign.length_s - 1) < 0.06);
  CHECK(campaign.frf.frequency_hz[0] == Approx(1 / campaign.length_s).epsilon(1e-14));
  y.sample_rate_hz = 5120;
  CHECK_THROWS_AS(responses_of({column_of(x), {"y", {"x", "y"}, {y}}}, dynamics::Quantity::kAccelerance, {}),
                  InvalidArgument);
  CHECK_THROWS_AS(responses_of({column_of(exact_record({{0.05, 80}, {0.09, 30}}, 1, 0))},
                               dynamics::Quantity::kAccelerance, {}),
                  NoAnswer);
}

TEST_CASE("lengths of transforms") {
  for (const auto& [length, wanted] :
       {std::pair(51199, 50000), std::pair(51200, 51200), std::pair(7, 6), std::pair(1, 0)})
    CHECK(transform_length(length) == wanted);
}

// Against sums over the samples.
TEST_CASE("a hit's spectrum is the sum of its windowed samples") {
  const Record record = exact_record({{0.02, 80}}, 0.2, 100);
  const HitSearch search = find_hits({record});
  REQUIRE(search.hits.size() == 1);
  const Hit& hit = search.hits[0];
  const Eigen::Index length = 1500;
  const HitSpectrum spectrum = hit_spectrum(record, hit, length, 40, 0, 0, {7});
  for (const Eigen::Index line : {1, 2, 17, 40}) {
    Complex force = 0, response = 0;
    for (Eigen::Index i = 0; i < length; ++i) {
      const Complex s(7, kTwoPi * static_cast<double>(line) * kRate / static_cast<double>(length));
      const Complex factor = std::exp(-s * static_cast<double>(i) / kRate);
      force += factor * record.force[hit.from + i];
      response += factor * record.responses[1][hit.from + i];
    }
    CHECK(std::abs(spectrum.force[line - 1] - force) < 1e-12 * std::abs(force));
    CHECK(std::abs(spectrum.responses[1][line - 1] - response) <
          1e-11 * record.responses[1].cwiseAbs().sum());
  }
}
