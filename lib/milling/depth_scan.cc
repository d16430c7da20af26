#include "milling/depth_scan.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "numerics/chebyshev.h"
#include "numerics/eigenvalues.h"
#include "numerics/golden_section.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;
constexpr Eigen::Index kNodes = DepthScan::kNodes;
using Coefficients = numerics::ChebyshevSeries<kNodes>;

// Branches that come closer to the largest modulus than this share could be the largest.
constexpr double kRivalGap = 0.1;
static_assert(kRivalGap < 1 - numerics::kLeading);
// A branch below the largest modulus may be wrong by this share of the distance.
constexpr double kShareOfGap = 0.03;
// Panel widths, of the largest depth.
constexpr double kFirstWidth = 1.0 / 8, kLeastWidth = 1.0 / 512, kLeastFarWidth = 1.0 / 16;
constexpr double kMostGrowth = 1.7, kLeastShrink = 0.25, kUnjoinedShrink = 0.4;
// A pair whose members are closer than this share of their size has lost digits to the square root.
constexpr double kMeeting = 0.02;
// A value farther from what is expected than this share of the largest is another multiplier's.
constexpr double kFarthest = 0.2;
constexpr int kSamples = 32;  // of a panel, when boundaries are looked for
constexpr double kDepthTolerance = 1e-9;
constexpr int kGoldenSteps = 40;

double node_place(Eigen::Index i) { return numerics::chebyshev_node(i, kNodes); }

// What the last coefficients say of the rest.
double tail(const Coefficients& c) {
  return std::max(std::abs(c[kNodes - 1]), 0.1 * std::abs(c[kNodes - 2]));
}

// One multiplier through the nodes from `first` on, all real or all complex (above the real axis).
struct Track {
  bool real;
  Eigen::Index first;
  std::vector<Complex> values;

  Eigen::Index end() const { return first + static_cast<Eigen::Index>(values.size()); }
};

// Values at the next node from those at the last few: weights of the polynomial through them, [nodes before].
constexpr Eigen::Index kRemembered = 4;
using Weights = std::array<double, kRemembered>;  // the first for the last node, and so on backwards

Weights extrapolation(Eigen::Index next, Eigen::Index count) {
  Weights weights{};
  for (Eigen::Index i = 0; i < count; ++i) {
    double weight = 1;
    for (Eigen::Index j = 0; j < count; ++j) {
      if (j != i)
        weight *= (node_place(next) - node_place(next - 1 - j)) /
                  (node_place(next - 1 - i) - node_place(next - 1 - j));
    }
    weights[i] = weight;
  }
  return weights;
}

// [next node][values at hand - 1]
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

Complex expected(const Track& track) {
  const std::size_t count = std::min<std::size_t>(kRemembered, track.values.size());
  const Weights& weights = extrapolations()[track.end()][count - 1];
  Complex sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += weights[i] * track.values[track.values.size() - 1 - i];
  return sum;
}

// Joins the values of the nodes, nearest to what is expected first.
std::vector<Track> joined(const std::array<std::vector<Complex>, kNodes>& at_node) {
  std::vector<Track> tracks;
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    const std::vector<Complex>& values = at_node[i];
    struct Match {
      double distance;  // squared
      std::size_t track, value;
    };
    std::vector<Match> matches;
    double farthest = 0;
    for (const Complex& value : values)
      farthest = std::max(farthest, kFarthest * kFarthest * std::norm(value));
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      if (tracks[t].end() != i) continue;
      const Complex place = expected(tracks[t]);
      for (std::size_t v = 0; v < values.size(); ++v) {
        const double distance = std::norm(values[v] - place);
        if (distance <= farthest && tracks[t].real == (values[v].imag() == 0))
          matches.push_back({distance, t, v});
      }
    }
    std::sort(matches.begin(), matches.end(),
              [](const Match& a, const Match& b) { return a.distance < b.distance; });
    std::vector<bool> taken(values.size(), false);
    for (const Match& match : matches) {
      if (tracks[match.track].end() != i || taken[match.value]) continue;
      taken[match.value] = true;
      tracks[match.track].values.push_back(values[match.value]);
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (!taken[v]) tracks.push_back({values[v].imag() == 0, i, {values[v]}});
    }
  }
  return tracks;
}

}  // namespace

double DepthScan::Branch::radius(double x) const {
  const double s = numerics::chebyshev_value<kNodes>(sum, x);
  if (!pair) return std::abs(s);
  const double p = numerics::chebyshev_value<kNodes>(product, x);
  const double discriminant = s * s / 4 - p;
  if (discriminant <= 0) return std::sqrt(p);
  if (discriminant < kMeeting * kMeeting * p) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(s / 2) + std::sqrt(discriminant);
}

DepthScan::DepthScan(const PeriodMap& map, double largest_depth_m, double tolerance)
    : map_(map), largest_depth_m_(largest_depth_m), tolerance_(tolerance) {
  double from = 0, width = kFirstWidth * largest_depth_m;
  while (from < largest_depth_m) {
    Panel panel;
    panel.from_m = from;
    // No sliver at the end.
    panel.to_m = from + 1.25 * width >= largest_depth_m ? largest_depth_m : from + width;
    const double error = resolve(panel);
    panel.resolved = error <= tolerance_;
    width = panel.to_m - from;
    const double wanted = 0.8 * std::pow(tolerance_ / std::max(error, 1e-30), 1.0 / (kNodes - 1));
    if (!panel.resolved) {
      const auto [low, high] = std::minmax_element(panel.radius.begin(), panel.radius.end());
      const double spread = *high - *low;
      const bool far = *low - spread > 1 || *high + spread < 1;
      if (width > (far ? kLeastFarWidth : kLeastWidth) * largest_depth_m) {
        width *= std::isfinite(error) ? std::clamp(wanted, kLeastShrink, 0.7) : kUnjoinedShrink;
        continue;
      }
    }
    from = panel.to_m;
    width *= panel.resolved ? std::clamp(wanted, kLeastShrink, kMostGrowth) : 1.5;
    panels_.push_back(std::move(panel));
  }
}

// Computes the nodes and joins them; the error of the branches that matter, infinite where they cannot be
// joined.
double DepthScan::resolve(Panel& panel) const {
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    panel.depth_m[i] = panel.from_m + (1 + node_place(i)) / 2 * (panel.to_m - panel.from_m);
  }
  const std::vector<Eigen::VectorXcd> multipliers =
      leading_multipliers(map_, {panel.depth_m.begin(), panel.depth_m.end()});
  std::array<std::vector<Complex>, kNodes> leading;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double largest = multipliers[i].cwiseAbs2().maxCoeff();
    panel.radius[i] = std::sqrt(largest);
    for (const Complex& value : multipliers[i]) {
      if (value.imag() >= 0 && std::norm(value) >= numerics::kLeading * numerics::kLeading * largest)
        leading[i].push_back(value);
    }
  }

  const std::vector<Track> tracks = joined(leading);
  // How far a track stays below the largest modulus, of that.
  const auto gap = [&](const Track& track) {
    double least = 1;
    for (Eigen::Index i = track.first; i < track.end(); ++i) {
      const double modulus = std::sqrt(std::norm(track.values[i - track.first]));
      least = std::min(least, 1 - modulus / panel.radius[i]);
    }
    return least;
  };
  static const Eigen::Matrix<double, kNodes, kNodes> transform = numerics::chebyshev_transform<kNodes>();
  const double size = std::max(1.0, *std::min_element(panel.radius.begin(), panel.radius.end()));
  double error = 0;
  const auto add = [&](bool pair, const Coefficients& sums, const Coefficients& products, double below) {
    Branch branch{pair, transform * sums, Coefficients::Zero()};
    if (pair) branch.product = transform * products;
    const double own = std::max(tail(branch.sum), pair ? tail(branch.product) / size : 0) / size;
    if (own > kShareOfGap * below) error = std::max(error, own);
    panel.branches.push_back(branch);
  };
  // What ends or begins inside: a pair that meets on the real axis, or it cannot be followed.
  std::vector<bool> used(tracks.size(), false);
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const Track& track = tracks[t];
    if (track.values.size() == kNodes) {
      used[t] = true;
      Coefficients sums, products;
      for (Eigen::Index i = 0; i < kNodes; ++i) {
        const Complex value = track.values[i];
        sums[i] = track.real ? value.real() : 2 * value.real();
        products[i] = std::norm(value);
      }
      add(!track.real, sums, products, gap(track));
      continue;
    }
    if (track.real) continue;
    std::vector<std::size_t> partners;
    for (std::size_t r = 0; r < tracks.size(); ++r) {
      const bool fits = track.first == 0 ? tracks[r].first == track.end() && tracks[r].end() == kNodes
                                         : tracks[r].first == 0 && tracks[r].end() == track.first;
      if (tracks[r].real && !used[r] && fits && tracks[r].values.size() < kNodes) partners.push_back(r);
    }
    if (partners.size() != 2 || (track.first != 0 && track.end() != kNodes)) continue;
    used[t] = used[partners[0]] = used[partners[1]] = true;
    Coefficients sums, products;
    for (Eigen::Index i = 0; i < kNodes; ++i) {
      if (i >= track.first && i < track.end()) {
        const Complex value = track.values[i - track.first];
        sums[i] = 2 * value.real();
        products[i] = std::norm(value);
      } else {
        const auto real_at = [&](std::size_t partner) {
          return tracks[partner].values[i - tracks[partner].first].real();
        };
        sums[i] = real_at(partners[0]) + real_at(partners[1]);
        products[i] = real_at(partners[0]) * real_at(partners[1]);
      }
    }
    add(true, sums, products, std::min({gap(track), gap(tracks[partners[0]]), gap(tracks[partners[1]])}));
  }
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (!used[t] && gap(tracks[t]) < kRivalGap) return std::numeric_limits<double>::infinity();
  }
  return error;
}

std::optional<double> DepthScan::Panel::interpolated(double depth) const {
  if (!resolved) return std::nullopt;
  const double x = place(depth);
  double largest = 0;
  for (const Branch& branch : branches) {
    const double value = branch.radius(x);
    if (std::isnan(value)) return std::nullopt;
    largest = std::max(largest, value);
  }
  return largest;
}

const DepthScan::Panel& DepthScan::panel_at(double depth) const {
  const auto after = std::partition_point(panels_.begin(), panels_.end() - 1,
                                          [&](const Panel& panel) { return panel.to_m < depth; });
  return *after;
}

std::vector<double> DepthScan::spectral_radii(const std::vector<double>& depths_m) const {
  std::vector<double> result;
  std::vector<double> missing;
  std::vector<std::size_t> missing_index;
  for (const double depth : depths_m) {
    const std::optional<double> value = panel_at(depth).interpolated(depth);
    if (!value) {
      missing.push_back(depth);
      missing_index.push_back(result.size());
    }
    // Multipliers are of the period, radii of one tooth.
    result.push_back(value && map_.passes() > 1 ? std::pow(*value, 1.0 / map_.passes()) : value.value_or(0));
  }
  const std::vector<double> computed = milling::spectral_radii(map_, missing);
  for (std::size_t i = 0; i < missing.size(); ++i) result[missing_index[i]] = computed[i];
  return result;
}

Complex DepthScan::largest_multiplier(double depth) const {
  const Eigen::VectorXcd multipliers = leading_multipliers(map_, {depth}).front();
  Eigen::Index largest = 0;
  multipliers.cwiseAbs().maxCoeff(&largest);
  return multipliers[largest];
}

double DepthScan::excess(double depth) const {
  const std::optional<double> value = panel_at(depth).interpolated(depth);
  return (value ? *value : std::abs(largest_multiplier(depth))) - 1;
}

// Where the excess changes sign: bisection with secant steps (Illinois), then a step with the map itself.
StabilityBoundary DepthScan::boundary_between(double stable_m, double unstable_m) const {
  double stable = stable_m, unstable = unstable_m;
  double stable_excess = excess(stable), unstable_excess = excess(unstable);
  const double tolerance = kDepthTolerance * largest_depth_m_;
  int last_side = 0;
  for (int iteration = 0; iteration < 100 && std::abs(unstable - stable) > tolerance; ++iteration) {
    double middle = (stable * unstable_excess - unstable * stable_excess) / (unstable_excess - stable_excess);
    const bool inside = std::min(stable, unstable) < middle && middle < std::max(stable, unstable);
    if (iteration % 4 == 3 || !inside) middle = (stable + unstable) / 2;
    const double value = excess(middle);
    if (value > 0) {
      unstable = middle;
      unstable_excess = value;
      if (last_side == 1) stable_excess /= 2;
      last_side = 1;
    } else {
      stable = middle;
      stable_excess = value;
      if (last_side == -1) unstable_excess /= 2;
      last_side = -1;
    }
  }
  StabilityBoundary boundary{unstable, stable_m < unstable_m, largest_multiplier(unstable)};
  const Panel& panel = panel_at(unstable);
  const double step = 1e-3 * (panel.to_m - panel.from_m);
  const auto low = panel.interpolated(unstable - step), high = panel.interpolated(unstable + step);
  if (!low || !high) return boundary;
  const double correction = -(std::abs(boundary.multiplier) - 1) * 2 * step / (*high - *low);
  if (std::abs(correction) < step) boundary.depth_m += correction;
  return boundary;
}

// The highest (sign 1) or lowest (sign -1) excess between two depths, or the first found beyond zero (golden
// section).
DepthScan::Sample DepthScan::climb(double from, double to, double sign) const {
  const auto sample = [&](double depth) { return Sample{depth, excess(depth)}; };
  return numerics::golden_section(
      from, to, sample(from + numerics::kGoldenShare * (to - from)), kGoldenSteps,
      [](const Sample& s) { return s.depth; }, sample,
      [&](const Sample& a, const Sample& b) { return sign * a.excess > sign * b.excess; },
      [&](const Sample& s) { return sign * s.excess > 0; });
}

std::vector<StabilityBoundary> DepthScan::boundaries() const {
  std::vector<Sample> samples;
  for (const Panel& panel : panels_) {
    if (panel.resolved) {
      for (int i = panels_.front().from_m == panel.from_m ? 0 : 1; i <= kSamples; ++i) {
        const double depth = panel.from_m + (panel.to_m - panel.from_m) * i / kSamples;
        samples.push_back({depth, excess(depth)});
      }
    } else {
      for (std::size_t i = 0; i < kNodes; ++i) samples.push_back({panel.depth_m[i], panel.radius[i] - 1});
    }
  }
  std::vector<StabilityBoundary> result;
  const auto cross = [&](const Sample& a, const Sample& b) {
    if ((a.excess > 0) == (b.excess > 0)) return;
    result.push_back(b.excess > 0 ? boundary_between(a.depth, b.depth) : boundary_between(b.depth, a.depth));
  };
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    // A hump that only shows between the samples: from its highest one on, when the rise may reach zero.
    if (i > 0) {
      const Sample &before = samples[i - 1], &top = samples[i], &after = samples[i + 1];
      const double sign = top.excess > 0 ? -1 : 1;
      const double rise = sign * (2 * top.excess - before.excess - after.excess);
      if (sign * top.excess <= 0 && sign * (top.excess - before.excess) >= 0 &&
          sign * (top.excess - after.excess) >= 0 && (before.excess > 0) == (top.excess > 0) &&
          (after.excess > 0) == (top.excess > 0) && sign * top.excess + rise > 0) {
        const Sample summit = climb(before.depth, after.depth, sign);
        if ((summit.excess > 0) != (top.excess > 0)) {
          cross(before, summit);
          cross(summit, after);
        }
      }
    }
    cross(samples[i], samples[i + 1]);
  }
  std::sort(result.begin(), result.end(),
            [](const StabilityBoundary& a, const StabilityBoundary& b) { return a.depth_m < b.depth_m; });
  return result;
}

}  // namespace stablecut::milling
