#include "taps/exponential_window.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "taps/tap_campaign.h"
#include "taps/tap_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::taps;
using fixtures::accelerance, fixtures::column_of, fixtures::exact_record, fixtures::kRate;

namespace {

// Parts of `length` samples of one record, one behind the other, hit with forces that differ by half.
std::vector<Hit> hits_every(Eigen::Index length, int count) {
  std::vector<Hit> hits;
  for (int i = 0; i < count; ++i)
    hits.push_back({0, {i * length, i * length + 8, i * length + 4, i % 2 == 0 ? 90.0 : 60.0}, i * length});
  return hits;
}

}  // namespace

TEST_CASE("a window is laid over records that still ring, and over no others") {
  // 82 Hz with 2 %: e^-10 a second.
  const auto search = [](const Record& record) { return find_hits({record}); };
  std::mt19937_64 generator(4);
  Record ringing = exact_record({{0.05, 80}}, 0.45, 0), still = exact_record({{0.05, 80}}, 2.05, 0);
  for (Record* record : {&ringing, &still}) {
    for (auto& response : record->responses) fixtures::add_noise(response, 0.02, generator);
  }
  const HitSearch of_ringing = search(ringing), of_still = search(still);
  CHECK(needed_decay({still}, of_still.hits, of_still.length) == 0);  // e^-20
  const double decay = needed_decay({ringing}, of_ringing.hits, of_ringing.length);
  CHECK(decay > 5);
  CHECK(decay < 60);
  // With it the average is right to a few deviations of its noise; without it, it is not.
  const auto worst = [&](std::optional<double> chosen) {
    TapChoice choice;
    choice.decay_per_s = chosen;
    const TapCampaign campaign = responses_of({column_of(ringing)}, dynamics::Quantity::kAccelerance, choice);
    double error = 0;
    for (Eigen::Index line = 0; campaign.frf.frequency_hz[line] < 500; ++line) {
      error = std::max(error, std::abs(campaign.frf.entries[0].h[line] - accelerance(campaign.frf, line, 0)));
    }
    return error;
  };
  CHECK(worst(std::nullopt) < worst(0.0) / 10);
}

TEST_CASE("hum is not ringing") {
  // What the real hit of a tool shows: it has come to rest after a tenth of the record, and hum and slow
  // noise go on.
  std::mt19937_64 generator(9);
  Record record = exact_record({{0.05, 80}}, 2.05, 0);
  double slow = 0;
  // Far lower than what rings at first, and still seen in the second block.
  for (Eigen::Index i = 0; i < record.samples(); ++i) {
    slow = 0.9 * slow + 0.02 * numerics::unit_normal(generator);
    for (auto& response : record.responses)
      response[i] += 0.05 * std::sin(kTwoPi * 50 * static_cast<double>(i) / kRate) + slow;
  }
  const HitSearch found = find_hits({record});
  CHECK(needed_decay({record}, found.hits, found.length) == 0);
}

TEST_CASE("noise does not ring") {
  // 100 campaigns of two channels, 15 blocks each: with four deviations a chance of 0.1 for any of them.
  std::mt19937_64 generator(2);
  constexpr Eigen::Index kLength = 16 * 600;
  constexpr int kHits = 5;
  const std::vector<Hit> hits = hits_every(kLength, kHits);
  int rings = 0;
  for (int run = 0; run < 100; ++run) {
    Record record{kRate, {}, {2, Eigen::VectorXd::Zero(kHits * kLength)}};
    for (auto& response : record.responses) fixtures::add_noise(response, 1, generator);
    if (needed_decay({record}, hits, kLength) > 0) ++rings;
  }
  CHECK(rings == 0);
}

TEST_CASE("what has come to rest above a hum needs no window") {
  // 50.02 Hz, thirty times the noise, a thousandth of the largest acceleration, at any phase of the hits.
  std::mt19937_64 generator(6);
  std::vector<fixtures::Blow> blows;
  for (int hit = 0; hit < 5; ++hit) blows.push_back({0.05 + 2.13 * hit, 80});
  const Record exact = exact_record(blows, 10.8, 0);
  for (int run = 0; run < 20; ++run) {
    Record record = exact;
    for (auto& response : record.responses) {
      const double size = response.cwiseAbs().maxCoeff(), phase = numerics::uniform(generator, 0, kTwoPi);
      for (Eigen::Index i = 0; i < response.size(); ++i)
        response[i] += 1e-3 * size * std::sin(kTwoPi * 50.02 * static_cast<double>(i) / kRate + phase);
      fixtures::add_noise(response, 3e-5 * size, generator);
    }
    const HitSearch found = find_hits({record});
    CHECK(needed_decay({record}, found.hits, found.length) == 0);
  }
}
