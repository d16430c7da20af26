#include "taps/hit_search.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "taps/overload.h"
#include "taps/tap_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::taps;

namespace {

using fixtures::kRate;

// A record of force with noise, and a response of noise alone.
Record record_of(const std::vector<fixtures::Blow>& blows, double seconds, double noise, unsigned seed = 1) {
  std::mt19937_64 generator(seed);
  const auto samples = static_cast<Eigen::Index>(seconds * kRate);
  Record record{kRate, fixtures::force_of(blows, kRate, samples), {Eigen::VectorXd::Zero(samples)}};
  fixtures::add_noise(record.force, noise, generator);
  fixtures::add_noise(record.responses[0], 1, generator);
  return record;
}

std::vector<HitFault> faults(const HitSearch& search) {
  std::vector<HitFault> result;
  for (const Hit& hit : search.hits) result.push_back(hit.fault);
  return result;
}

bool cut_off(const Eigen::VectorXd& channel) {
  return overloaded(channel, range_of(channel), 0, channel.size());
}

constexpr HitFault kGood = HitFault::kNone;

}  // namespace

TEST_CASE("hits are found where they are, and their length is what they leave") {
  const Record record = record_of({{0.1, 80}, {1.2, 60}, {2.3, 95}, {3.5, 70}}, 4.6, 0.3);
  const HitSearch search = find_hits({record});
  REQUIRE(faults(search) == std::vector{kGood, kGood, kGood, kGood});
  for (std::size_t i = 0; i < 4; ++i) {
    const double middle = std::array{0.1005, 1.2005, 2.3005, 3.5005}[i];
    // The top of half a sine is flat: noise of 0.3 of 60 N moves it by 0.1 / pi * 2 of a millisecond.
    CHECK(std::abs(static_cast<double>(search.hits[i].pulse.peak) / kRate - middle) < 1.5e-4);
  }
  // 1.1 s between hits, the level's share apart.
  CHECK(std::abs(static_cast<double>(search.length) / kRate - 1.1) < 5e-4);
}

TEST_CASE("noise alone makes no hit") {
  for (unsigned seed = 1; seed <= 20; ++seed) CHECK(find_hits({record_of({}, 2, 1, seed)}).hits.empty());
}

TEST_CASE("a double hit is one hit, with the time between its blows") {
  const Record record = record_of({{0.1, 80}, {1.2, 60}, {1.23, 12}, {2.3, 95}, {3.5, 70}}, 4.6, 0.3);
  const HitSearch search = find_hits({record});
  REQUIRE(faults(search) == std::vector{kGood, HitFault::kDouble, kGood, kGood});
  CHECK(std::abs(search.hits[1].seconds - 0.03) < 3e-4);
  CHECK(std::abs(search.hits[1].pulse.force_n - 60) < 1.5);
  // A file of its own, with nothing to compare with.
  CHECK(faults(find_hits({record_of({{0.1, 80}, {0.13, 40}}, 1.2, 0.3)})) == std::vector{HitFault::kDouble});
}

TEST_CASE("what a hammer cannot do is no hit") {
  // A filter that rings on both sides behind the pulse, 4 % of it.
  Record record = record_of({{0.1, 80}, {1.2, 60}}, 2.3, 0.01);
  for (const double at : {0.1011, 1.2011}) {
    for (Eigen::Index i = 0; i < 100; ++i)
      record.force[static_cast<Eigen::Index>(at * kRate) + i] +=
          3 * std::sin(0.9 * static_cast<double>(i)) * std::exp(-static_cast<double>(i) / 30);
  }
  CHECK(faults(find_hits({record})) == std::vector{kGood, kGood});
}

TEST_CASE("weak hits and short parts are named, and a long silence at the end shortens nothing") {
  const HitSearch search =
      find_hits({record_of({{0.1, 80}, {1.2, 9}, {2.3, 95}, {3.4, 70}, {4.5, 80}}, 5.0, 0.1)});
  REQUIRE(faults(search) == std::vector{kGood, HitFault::kWeak, kGood, kGood, HitFault::kShort});
  CHECK(std::abs(search.hits[4].seconds - 0.5 - 32 / kRate) < 5e-4);
  const HitSearch silence = find_hits({record_of({{0.1, 80}, {1.2, 60}, {2.3, 95}}, 12, 0.1)});
  CHECK(faults(silence) == std::vector{kGood, kGood, kGood});
  CHECK(static_cast<double>(silence.length) / kRate < 1.11);
}

TEST_CASE("an overload is named with its channel, and only in the hits that have one") {
  Record record = record_of({{0.1, 80}, {1.2, 60}, {2.3, 95}, {3.4, 65}}, 4.5, 0.1);
  record.force = record.force.cwiseMin(71.0);
  HitSearch search = find_hits({record});
  REQUIRE(faults(search) == std::vector{HitFault::kOverload, kGood, HitFault::kOverload, kGood});
  CHECK(search.hits[0].channel == 0);
  record = record_of({{0.1, 80}, {1.2, 60}}, 2.3, 0.1);
  for (Eigen::Index i = 0; i < record.samples(); ++i) {
    const double since = static_cast<double>(i) / kRate - 0.1;
    if (since > 0) record.responses[0][i] += 300 * std::sin(kTwoPi * 900 * since) * std::exp(-since / 0.05);
  }
  CHECK(faults(find_hits({record})) == std::vector{kGood, kGood});
  record.responses[0] = record.responses[0].cwiseMax(-150.0);
  search = find_hits({record});
  REQUIRE(faults(search) == std::vector{HitFault::kOverload, kGood});
  CHECK(search.hits[0].channel == 1);
}

TEST_CASE("a coarse converter is no overload") {
  // Wide pulses in steps of 1/200 of their height: ten samples and more share the top step.
  for (const double step : {0.5, 0.25, 0.05}) {
    Eigen::VectorXd channel(2000);
    for (Eigen::Index i = 0; i < 2000; ++i) {
      const double value = 100 * std::sin(kPi * static_cast<double>(i) / 2000);
      channel[i] = step * std::round(value / step);
    }
    CHECK_FALSE(cut_off(channel));
    CHECK_FALSE(cut_off(channel.cwiseMin(90.0)));  // flat, but without steep flanks
  }
  Eigen::VectorXd sharp = fixtures::force_of({{0.001, 100}}, kRate, 2000);
  std::mt19937_64 generator(1);
  fixtures::add_noise(sharp, 0.1, generator);
  CHECK_FALSE(cut_off(sharp));
  CHECK(cut_off(sharp.cwiseMin(80.0)));
}

TEST_CASE("a hammer that pulls is one whose channel is turned") {
  Record record = record_of({{0.1, 80}, {1.2, 60}}, 2.3, 0.1);
  record.force *= -1;
  const HitSearch search = find_hits({record});
  REQUIRE(faults(search) == std::vector{kGood, kGood});
  CHECK(search.hits[0].pulse.force_n < -75);
}

TEST_CASE("what is chosen is taken: trigger, length, time before") {
  const Record record = record_of({{0.1, 80}, {1.2, 30}, {2.3, 95}}, 3.4, 0.1);
  HitChoice choice;
  choice.trigger_n = 40;
  choice.length_s = 0.5;
  choice.pre_trigger_s = 0.02;
  const HitSearch search = find_hits({record}, choice);
  REQUIRE(search.hits.size() == 2);
  CHECK(search.length == 5120);
  for (const Hit& hit : search.hits) CHECK(hit.pulse.from - hit.from == 205);
}
