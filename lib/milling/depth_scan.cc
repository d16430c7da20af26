#include "milling/depth_scan.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/error.h"
#include "numerics/chebyshev.h"
#include "numerics/eigenvalues.h"
#include "numerics/golden_section.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;
using Coefficients = numerics::ChebyshevSeries<kNodes>;

// A track that no branch follows must stay this share of the largest modulus below it, or the panel is not
// resolved.
constexpr double kRivalGap = 0.1;
static_assert(kRivalGap < 1 - numerics::kLeading);
// A branch below the largest modulus may be wrong by this share of the distance.
constexpr double kShareOfGap = 0.03;
// The last coefficient but one counts as this share of itself in a branch's error: one that is small by
// chance must not hide the other.
constexpr double kSecondLast = 0.1;
// Panel widths, of the largest depth. The least ones are those of unresolved panels: near the limit, and
// where the radius is far from 1.
constexpr double kFirstWidth = 1.0 / 8, kLeastWidth = 1.0 / 512, kLeastFarWidth = 1.0 / 16;
// A rest of the depths up to this many widths is one panel.
constexpr double kLastPanel = 1.25;
// The next width, of the one that should give the wanted error; how much it may change; and after panels
// whose tracks could not be grouped, or that stay unresolved.
constexpr double kSafety = 0.8, kMostGrowth = 1.7, kLeastShrink = 0.25, kMostShrink = 0.7;
constexpr double kUnjoinedShrink = 0.4, kUnresolvedGrowth = 1.5;
// A pair whose real members are closer than this share of their size has lost digits to the square root.
constexpr double kMeeting = 0.02;
constexpr int kSamples = 32;              // of a panel, when boundaries are looked for
constexpr double kDepthTolerance = 1e-9;  // of the largest depth, of a boundary
constexpr int kMostBisections = 100;      // iterations for a boundary
constexpr int kBisectEvery = 4;           // iterations, instead of a secant step
constexpr double kCorrectionStep = 1e-3;  // of the panel, for the slope at a boundary
constexpr int kGoldenSteps = 40;
constexpr int kMostMaps = 2000;       // computed one by one, for the boundaries of one scan
constexpr std::size_t kMeasured = 8;  // depths at which the interpolation is compared with the map

// What the last coefficients say of those that were left out.
double tail(const Coefficients& c) {
  return std::max(std::abs(c[kNodes - 1]), kSecondLast * std::abs(c[kNodes - 2]));
}

}  // namespace

double DepthScan::Branch::radius(double x) const {
  const double s = numerics::chebyshev_value<kNodes>(sum, x);
  if (!is_pair) return std::abs(s);
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
    panel.to_m = from + kLastPanel * width >= largest_depth_m ? largest_depth_m : from + width;
    const double error = resolve(panel);
    panel.error = error;
    panel.resolved = error <= tolerance_;
    width = panel.to_m - from;
    const double wanted = kSafety * std::pow(tolerance_ / std::max(error, std::numeric_limits<double>::min()),
                                             1.0 / (kNodes - 1));
    if (!panel.resolved) {
      const auto [low, high] = std::minmax_element(panel.radius.begin(), panel.radius.end());
      const double spread = *high - *low;
      const bool far = *low - spread > 1 || *high + spread < 1;
      if (width > (far ? kLeastFarWidth : kLeastWidth) * largest_depth_m) {
        width *= std::isfinite(error) ? std::clamp(wanted, kLeastShrink, kMostShrink) : kUnjoinedShrink;
        continue;
      }
    }
    from = panel.to_m;
    // Where rounding alone makes an error near the tolerance, narrower panels are no better.
    width *= panel.resolved ? std::clamp(wanted, kLeastShrink, kMostGrowth) : kUnresolvedGrowth;
    width = std::max(width, kLeastShrink * kLeastWidth * largest_depth_m);
    panels_.push_back(std::move(panel));
  }
}

// The leading multipliers at the panel's nodes, those with imaginary parts not below zero.
std::array<std::vector<Complex>, kNodes> DepthScan::sample(Panel& panel) const {
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    const double share = (1 + numerics::chebyshev_node(i, kNodes)) / 2;
    panel.depth_m[i] = panel.from_m + share * (panel.to_m - panel.from_m);
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
  return leading;
}

// How far a track stays below the largest modulus, as a share of it.
double DepthScan::Panel::gap_of(const Track& track) const {
  double least = 1;
  for (Eigen::Index i = track.first; i < track.end(); ++i)
    least = std::min(least, 1 - std::sqrt(std::norm(track.at(i))) / radius[i]);
  return least;
}

// The smooth functions of a group of tracks. A complex track stands for itself and its conjugate; of three
// tracks the two real ones are the pair where the complex one is not.
DepthScan::Branch DepthScan::branch_of(const TrackGroup& group, const std::vector<Track>& tracks) {
  const Track& track = tracks[group.front()];
  Coefficients sums, products;
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    if (i >= track.first && i < track.end()) {
      const Complex value = track.at(i);
      sums[i] = track.is_real ? value.real() : 2 * value.real();
      products[i] = std::norm(value);
    } else {
      const double one = tracks[group[1]].at(i).real(), other = tracks[group[2]].at(i).real();
      sums[i] = one + other;
      products[i] = one * other;
    }
  }
  static const Eigen::Matrix<double, kNodes, kNodes> transform = numerics::chebyshev_transform<kNodes>();
  Branch branch{!track.is_real, transform * sums, Coefficients::Zero()};
  if (branch.is_pair) branch.product = transform * products;
  return branch;
}

// Fills in a panel: its nodes and their branches. The error of the branches that matter, of max(1, radius);
// infinite where a track that may be the largest is in no group.
double DepthScan::resolve(Panel& panel) const {
  const std::vector<Track> tracks = join_tracks(sample(panel));
  const GroupedTracks grouped = group_tracks(tracks);
  const double size = std::max(1.0, *std::min_element(panel.radius.begin(), panel.radius.end()));
  double error = 0;
  for (const TrackGroup& group : grouped.groups) {
    const Branch branch = branch_of(group, tracks);
    double gap = 1;
    for (const std::size_t member : group) gap = std::min(gap, panel.gap_of(tracks[member]));
    const double own = std::max(tail(branch.sum), branch.is_pair ? tail(branch.product) / size : 0) / size;
    if (own > kShareOfGap * gap) error = std::max(error, own);
    panel.branches.push_back(branch);
  }
  for (const std::size_t track : grouped.loose) {
    if (panel.gap_of(tracks[track]) < kRivalGap) return std::numeric_limits<double>::infinity();
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

double radius_error(double radius, double better) {
  const double known = std::min(better, kFarAbove);
  return std::abs(std::min(radius, kFarAbove) - known) / std::max(1.0, known);
}

double DepthScan::error_against(const PeriodMap& better) const {
  std::vector<const Panel*> worst;
  for (const Panel& panel : panels_) {
    if (panel.resolved) worst.push_back(&panel);
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [](const Panel* a, const Panel* b) { return a->error > b->error; });
  // Between the first two nodes, where an interpolation through Chebyshev points has its largest errors.
  std::vector<double> depths = {0};
  for (const Panel* panel : worst) {
    if (depths.size() < kMeasured) depths.push_back((panel->depth_m[0] + panel->depth_m[1]) / 2);
  }
  const std::vector<double> radii = spectral_radii(depths),
                            computed = milling::spectral_radii(better, depths);
  double error = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    error = std::max(error, radius_error(radii[i], computed[i]));
  }
  return error;
}

Complex DepthScan::largest_multiplier(double depth) const {
  const Eigen::VectorXcd multipliers = leading_multipliers(map_, {depth}).front();
  Eigen::Index largest = 0;
  multipliers.cwiseAbs().maxCoeff(&largest);
  return multipliers[largest];
}

double DepthScan::excess(double depth) const {
  if (const std::optional<double> value = panel_at(depth).interpolated(depth)) return *value - 1;
  if (++maps_ > kMostMaps)
    throw InvalidArgument("the multipliers change too often up to the largest depth to be followed");
  return std::abs(largest_multiplier(depth)) - 1;
}

// Where the excess changes sign: secant steps by the Illinois rule [Dowell1971] with bisections in between,
// then one Newton step with the map itself.
StabilityBoundary DepthScan::boundary_between(double stable_m, double unstable_m) const {
  double stable = stable_m, unstable = unstable_m;
  double stable_excess = excess(stable), unstable_excess = excess(unstable);
  const double tolerance = kDepthTolerance * largest_depth_m_;
  int last_side = 0;
  for (int iteration = 0; iteration < kMostBisections && std::abs(unstable - stable) > tolerance;
       ++iteration) {
    double middle = (stable * unstable_excess - unstable * stable_excess) / (unstable_excess - stable_excess);
    const bool inside = std::min(stable, unstable) < middle && middle < std::max(stable, unstable);
    if (iteration % kBisectEvery == kBisectEvery - 1 || !inside) middle = (stable + unstable) / 2;
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
  const double step = kCorrectionStep * (panel.to_m - panel.from_m);
  const auto low = panel.interpolated(unstable - step), high = panel.interpolated(unstable + step);
  if (!low || !high) return boundary;
  const double correction = -(std::abs(boundary.multiplier) - 1) * 2 * step / (*high - *low);
  if (std::abs(correction) < step) boundary.depth_m += correction;
  return boundary;
}

// The highest (sign 1) or lowest (sign -1) excess between two depths, or the first one found on the other
// side of zero.
DepthScan::Sample DepthScan::climb(double from, double to, double sign) const {
  const auto sample = [&](double depth) { return Sample{depth, excess(depth)}; };
  return numerics::golden_section(
      from, to, sample(from + numerics::kGoldenShare * (to - from)), kGoldenSteps,
      [](const Sample& s) { return s.depth; }, sample,
      [&](const Sample& a, const Sample& b) { return sign * a.excess > sign * b.excess; },
      [&](const Sample& s) { return sign * s.excess > 0; });
}

// Depths at which the excess is known before boundaries are looked for, increasing.
std::vector<DepthScan::Sample> DepthScan::samples() const {
  std::vector<Sample> result;
  for (const Panel& panel : panels_) {
    if (panel.resolved) {
      for (int i = panels_.front().from_m == panel.from_m ? 0 : 1; i <= kSamples; ++i) {
        const double depth = panel.from_m + (panel.to_m - panel.from_m) * i / kSamples;
        result.push_back({depth, excess(depth)});
      }
    } else {
      if (panel.from_m == 0) result.push_back({0, excess(0)});
      for (std::size_t i = 0; i < kNodes; ++i) result.push_back({panel.depth_m[i], panel.radius[i] - 1});
    }
  }
  return result;
}

// Whether the excess may pass zero twice around a sample on one side of zero with both its neighbours,
// without any of the three showing it: the sample is the nearest to zero, and as far as the three bend, it is
// not too far from it.
bool DepthScan::may_hide_crossings(const Sample& before, const Sample& top, const Sample& after) {
  const double sign = top.excess > 0 ? -1 : 1;
  const bool one_side = sign * top.excess <= 0 && (before.excess > 0) == (top.excess > 0) &&
                        (after.excess > 0) == (top.excess > 0);
  const bool nearest = sign * (top.excess - before.excess) >= 0 && sign * (top.excess - after.excess) >= 0;
  const double bend = sign * (2 * top.excess - before.excess - after.excess);
  return one_side && nearest && sign * top.excess + bend > 0;
}

std::vector<StabilityBoundary> DepthScan::boundaries() const {
  const std::vector<Sample> known = samples();
  std::vector<StabilityBoundary> result;
  const auto cross = [&](const Sample& a, const Sample& b) {
    if ((a.excess > 0) == (b.excess > 0)) return;
    result.push_back(b.excess > 0 ? boundary_between(a.depth, b.depth) : boundary_between(b.depth, a.depth));
  };
  for (std::size_t i = 0; i + 1 < known.size(); ++i) {
    if (i > 0 && may_hide_crossings(known[i - 1], known[i], known[i + 1])) {
      const Sample summit = climb(known[i - 1].depth, known[i + 1].depth, known[i].excess > 0 ? -1 : 1);
      if ((summit.excess > 0) != (known[i].excess > 0)) {
        cross(known[i - 1], summit);
        cross(summit, known[i + 1]);
      }
    }
    cross(known[i], known[i + 1]);
  }
  std::sort(result.begin(), result.end(),
            [](const StabilityBoundary& a, const StabilityBoundary& b) { return a.depth_m < b.depth_m; });
  return result;
}

}  // namespace stablecut::milling
