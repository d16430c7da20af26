// Multipliers joined from depth to depth, within a panel of depths. README.md, "Tracks" and "Pairs".
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace stablecut::milling {

/// Chebyshev nodes of a panel; a multiple of numerics::kLanes costs least. README.md, "Another number of
/// nodes".
inline constexpr Eigen::Index kNodes = 8;

/// One multiplier at consecutive nodes, real at all of them or complex (above the real axis) at all of them.
struct Track {
  bool is_real = false;
  Eigen::Index first = 0;                    ///< node
  std::vector<std::complex<double>> values;  ///< at the nodes from `first` on

  Eigen::Index end() const { return first + static_cast<Eigen::Index>(values.size()); }
  std::complex<double> at(Eigen::Index node) const { return values[node - first]; }
  bool holds_all_nodes() const { return first == 0 && end() == kNodes; }
};

/// Tracks through the multipliers at each node: each goes on with the value nearest to its extrapolation, the
/// nearest of all tracks first. A value that no track takes begins one.
std::vector<Track> join_tracks(const std::array<std::vector<std::complex<double>>, kNodes>& at_node);

/// What one smooth branch follows: the index of a track through all nodes; or those of a complex track that
/// ends or begins inside the panel, where its pair meets on the real axis, and of the two real ones there.
using TrackGroup = std::vector<std::size_t>;

struct GroupedTracks {
  std::vector<TrackGroup> groups;
  std::vector<std::size_t> loose;  ///< tracks in no group
};
GroupedTracks group_tracks(const std::vector<Track>& tracks);

}  // namespace stablecut::milling
