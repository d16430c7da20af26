#include "milling/tracks.h"

#include <catch2/catch.hpp>
#include <functional>

#include "numerics/chebyshev.h"

using namespace stablecut;
using namespace stablecut::milling;
using Complex = std::complex<double>;

namespace {

using AtNode = std::array<std::vector<Complex>, kNodes>;

// Multipliers as functions of the place in [-1, 1], at the nodes; at every other one in the opposite order.
AtNode sampled(const std::vector<std::function<Complex(double)>>& multipliers) {
  AtNode at_node;
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    for (const auto& multiplier : multipliers)
      at_node[i].push_back(multiplier(numerics::chebyshev_node(i, kNodes)));
    if (i % 2 == 1) std::reverse(at_node[i].begin(), at_node[i].end());
  }
  return at_node;
}

// The square root that is real above zero and lies above the real axis below it.
Complex root(double square) { return std::sqrt(Complex(square, 0.0)); }

}  // namespace

TEST_CASE("tracks follow multipliers that pass each other") {
  // Real ones that change places at 0.1, and complex ones of equal modulus at 0.
  const std::vector<std::function<Complex(double)>> multipliers = {
      [](double x) { return Complex(0.9 + 0.1 * (x - 0.1), 0); },
      [](double x) { return Complex(0.9 - 0.1 * (x - 0.1), 0); },
      [](double x) { return std::polar(0.8 + 0.1 * x, 1 + 0.2 * x); },
      [](double x) { return std::polar(0.8 - 0.1 * x, 1.1 - 0.2 * x); }};
  const std::vector<Track> tracks = join_tracks(sampled(multipliers));
  REQUIRE(tracks.size() == 4);
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    REQUIRE(tracks[t].holds_all_nodes());
    for (Eigen::Index i = 0; i < kNodes; ++i)
      CHECK(tracks[t].at(i) == multipliers[t](numerics::chebyshev_node(i, kNodes)));
  }
  const GroupedTracks grouped = group_tracks(tracks);
  CHECK(grouped.groups.size() == 4);
  CHECK(grouped.loose.empty());
}

TEST_CASE("a pair that meets on the real axis is one group, whichever side is complex") {
  for (const double side : {1.0, -1.0}) {
    const auto pair = [&](double sign) {
      return [=](double x) { return -0.9 + sign * root(0.01 * side * (x + 0.05)); };
    };
    const auto above = [&](double x) { return pair(1)(x); };
    // Of a complex pair only the member above the axis is given.
    AtNode at_node = sampled({above, pair(-1)});
    for (auto& values : at_node) std::erase_if(values, [](Complex value) { return value.imag() < 0; });
    const std::vector<Track> tracks = join_tracks(at_node);
    REQUIRE(tracks.size() == 3);
    const GroupedTracks grouped = group_tracks(tracks);
    REQUIRE(grouped.groups.size() == 1);
    REQUIRE(grouped.groups[0].size() == 3);
    CHECK(!tracks[grouped.groups[0][0]].is_real);
    CHECK(tracks[grouped.groups[0][1]].is_real);
    CHECK(tracks[grouped.groups[0][2]].is_real);
    CHECK(grouped.loose.empty());
  }
}

TEST_CASE("a multiplier that appears inside a panel is in no group") {
  AtNode at_node = sampled({[](double x) { return Complex(0.9 + 0.05 * x, 0); }});
  at_node[kNodes - 1].push_back(Complex(0.7, 0));
  at_node[kNodes / 2].push_back(Complex(0, 0.8));
  const std::vector<Track> tracks = join_tracks(at_node);
  CHECK(tracks.size() == 3);
  const GroupedTracks grouped = group_tracks(tracks);
  CHECK(grouped.groups.size() == 1);
  CHECK(grouped.loose.size() == 2);
}

TEST_CASE("a value far from every extrapolation begins a track of its own") {
  AtNode at_node = sampled({[](double x) { return Complex(0.9 + 0.05 * x, 0); }});
  at_node[2][0] = -at_node[2][0];
  const std::vector<Track> tracks = join_tracks(at_node);
  CHECK(tracks.size() == 3);
  CHECK(group_tracks(tracks).groups.empty());
}
