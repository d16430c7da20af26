#include "milling/circle_count.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "base/units.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Depths at which multipliers are counted, and how far below each in their distances.
constexpr int kCounts = 8;
constexpr double kBesideCount[] = {0, -0.1, -0.2, -0.3, -0.4};
// Radians that a determinant's phase may change from place to place, and places at which that is given up.
constexpr double kMostTurnOfWhole = 1;
constexpr std::size_t kMostPlacesOfWhole = 6000;

}  // namespace

std::optional<int> winding(CircleLanes& lanes, std::vector<double> angles, double depth_m) {
  std::vector<std::pair<double, Complex>> known;  // angle, phase
  while (!angles.empty()) {
    for (std::size_t first = 0; first < angles.size(); first += CircleLanes::kPlaces) {
      const std::size_t count = std::min(CircleLanes::kPlaces, angles.size() - first);
      const CircleLanes::Angles eight = CircleLanes::eight_from(angles, first);
      lanes.form(eight);
      const auto phases = lanes.determinant_phases(depth_m);
      for (std::size_t i = 0; i < count; ++i) known.emplace_back(eight[i], phases[i]);
    }
    std::sort(known.begin(), known.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    angles.clear();
    double turn = 0;
    for (std::size_t i = 0; i + 1 < known.size(); ++i) {
      const double step = std::arg(known[i + 1].second * std::conj(known[i].second));
      turn += step;
      if (std::abs(step) > kMostTurnOfWhole) angles.push_back((known[i].first + known[i + 1].first) / 2);
    }
    if (angles.empty()) return -static_cast<int>(std::lround(turn / kPi));
    if (known.size() + angles.size() > kMostPlacesOfWhole) break;
  }
  return std::nullopt;
}

std::vector<double> depths_to_count_at(const std::vector<CirclePassage>& found, double largest_depth_m) {
  std::vector<double> depths;
  for (int k = 1; k <= kCounts; ++k) {
    double best = 0, widest = -1;
    for (const double beside : kBesideCount) {
      const double depth = (k + beside) / kCounts * largest_depth_m;
      double nearest = largest_depth_m;
      for (const CirclePassage& p : found) nearest = std::min(nearest, std::abs(p.depth_m - depth));
      if (nearest > widest) {
        widest = nearest;
        best = depth;
      }
    }
    depths.push_back(best);
  }
  return depths;
}

int unstable_at(const std::vector<CirclePassage>& found, double depth_m) {
  int count = 0;
  for (const CirclePassage& p : found)
    if (p.depth_m <= depth_m) count += p.change();
  return count;
}

}  // namespace stablecut::milling
