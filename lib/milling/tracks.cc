#include "milling/tracks.h"

#include <algorithm>

#include "numerics/chebyshev.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// A value farther from a track's extrapolation than this share of the largest modulus is another
// multiplier's.
constexpr double kFarthest = 0.2;
// Nodes that an extrapolation goes through at most.
constexpr Eigen::Index kRemembered = 4;

using Weights = std::array<double, kRemembered>;  // the first for the last node, and so on backwards

// The value at a node of the polynomial through those at the `count` nodes before it, as weights of them.
Weights extrapolation(Eigen::Index next, Eigen::Index count) {
  const auto place = [](Eigen::Index i) { return numerics::chebyshev_node(i, kNodes); };
  Weights weights{};
  for (Eigen::Index i = 0; i < count; ++i) {
    double weight = 1;
    for (Eigen::Index j = 0; j < count; ++j) {
      if (j != i) weight *= (place(next) - place(next - 1 - j)) / (place(next - 1 - i) - place(next - 1 - j));
    }
    weights[i] = weight;
  }
  return weights;
}

// [node][values before it - 1]
const std::array<std::array<Weights, kRemembered>, kNodes>& extrapolations() {
  static const auto all = [] {
    std::array<std::array<Weights, kRemembered>, kNodes> table{};
    for (Eigen::Index next = 1; next < kNodes; ++next) {
      for (Eigen::Index count = 1; count <= std::min(kRemembered, next); ++count)
        table[next][count - 1] = extrapolation(next, count);
    }
    return table;
  }();
  return all;
}

Complex extrapolated(const Track& track) {
  const std::size_t count = std::min<std::size_t>(kRemembered, track.values.size());
  const Weights& weights = extrapolations()[track.end()][count - 1];
  Complex sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += weights[i] * track.values[track.values.size() - 1 - i];
  return sum;
}

// A track that could go on with a value.
struct Match {
  double distance;  // squared
  std::size_t track, value;
};

// Of all tracks that reach the node, the nearest first.
std::vector<Match> matches_at(Eigen::Index node, const std::vector<Complex>& values,
                              const std::vector<Track>& tracks) {
  double farthest = 0;
  for (const Complex& value : values) farthest = std::max(farthest, kFarthest * kFarthest * std::norm(value));
  std::vector<Match> matches;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (tracks[t].end() != node) continue;
    const Complex place = extrapolated(tracks[t]);
    for (std::size_t v = 0; v < values.size(); ++v) {
      const double distance = std::norm(values[v] - place);
      if (distance <= farthest && tracks[t].is_real == (values[v].imag() == 0))
        matches.push_back({distance, t, v});
    }
  }
  std::sort(matches.begin(), matches.end(),
            [](const Match& a, const Match& b) { return a.distance < b.distance; });
  return matches;
}

// The two real tracks that lie where a complex one does not: behind its end, or before its beginning.
std::vector<std::size_t> real_partners(const Track& track, const std::vector<Track>& tracks,
                                       const std::vector<bool>& used) {
  std::vector<std::size_t> partners;
  for (std::size_t r = 0; r < tracks.size(); ++r) {
    const Track& other = tracks[r];
    const bool fits = track.first == 0 ? other.first == track.end() && other.end() == kNodes
                                       : other.first == 0 && other.end() == track.first;
    if (other.is_real && !used[r] && fits && !other.holds_all_nodes()) partners.push_back(r);
  }
  return partners;
}

}  // namespace

std::vector<Track> join_tracks(const std::array<std::vector<Complex>, kNodes>& at_node) {
  std::vector<Track> tracks;
  for (Eigen::Index node = 0; node < kNodes; ++node) {
    const std::vector<Complex>& values = at_node[node];
    std::vector<bool> taken(values.size(), false);
    for (const Match& match : matches_at(node, values, tracks)) {
      if (tracks[match.track].end() != node || taken[match.value]) continue;
      taken[match.value] = true;
      tracks[match.track].values.push_back(values[match.value]);
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (!taken[v]) tracks.push_back({values[v].imag() == 0, node, {values[v]}});
    }
  }
  return tracks;
}

GroupedTracks group_tracks(const std::vector<Track>& tracks) {
  GroupedTracks result;
  std::vector<bool> used(tracks.size(), false);
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const Track& track = tracks[t];
    TrackGroup group = {t};
    if (!track.holds_all_nodes()) {
      // A complex track that begins and ends inside is no pair that meets once.
      if (track.is_real || (track.first != 0 && track.end() != kNodes)) continue;
      const std::vector<std::size_t> partners = real_partners(track, tracks, used);
      if (partners.size() != 2) continue;
      group.insert(group.end(), partners.begin(), partners.end());
    }
    for (const std::size_t member : group) used[member] = true;
    result.groups.push_back(std::move(group));
  }
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (!used[t]) result.loose.push_back(t);
  }
  return result;
}

}  // namespace stablecut::milling
