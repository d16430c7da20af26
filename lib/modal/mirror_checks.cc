#include "modal/mirror_checks.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "numerics/order_statistics.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;
using numerics::median;

// Relative difference of mirrored entries that is said, also in units of what noise alone would make.
constexpr double kNotReciprocalShare = 0.1, kNotReciprocalNoises = 3;
constexpr double kOpposite = 0.3;  // of the sum of mirrored entries, below which one has the other sign
// Logarithm of the odds from which on responses were exchanged, and what share of energy noise and hits
// beside the sensor may add then. What counts as an octave: so many clear lines.
constexpr double kSureExchange = 3, kMoreEnergy = 0.05;
constexpr std::size_t kLeastOctave = 5;
constexpr double kEqual = 1e-12;  // relative difference below which two values are the same

// Two entries that may be mirror images of each other.
struct Mirrors {
  const Channel &first, &second;
};

const Channel* find(const std::vector<Channel>& channels, const std::string& response,
                    const std::string& reference) {
  const auto at = std::find_if(channels.begin(), channels.end(), [&](const Channel& channel) {
    return channel.entry->response == response && channel.entry->reference == reference;
  });
  return at == channels.end() ? nullptr : &*at;
}

// Whether a line stands 10 dB above the noise of both.
bool is_clear(const Mirrors& mirrors, Eigen::Index line) {
  const auto stands_out = [&](const Channel& channel) {
    const double size = kNoiseShare * std::abs(channel.entry->h[line]);
    return size > 0 && size * size >= channel.variance[line];
  };
  return stands_out(mirrors.first) && stands_out(mirrors.second);
}

struct LineDifference {
  double difference;  // |H_ij - H_ji| over |H_ij| + |H_ji|
  double opposite;    // |H_ij + H_ji| over that
  double noise;       // what the noise alone makes of either
};

LineDifference difference_on(const Mirrors& mirrors, Eigen::Index line) {
  const Complex a = mirrors.first.entry->h[line], b = mirrors.second.entry->h[line];
  const double sizes = std::abs(a) + std::abs(b);
  return {std::abs(a - b) / sizes, std::abs(a + b) / sizes,
          std::sqrt(mirrors.first.variance[line] + mirrors.second.variance[line]) / sizes};
}

// The same on all clear lines.
struct MirrorComparison {
  std::vector<double> difference, opposite, noise;
};

MirrorComparison compare(const Eigen::VectorXd& hz, const Mirrors& mirrors, double usable_from_hz) {
  MirrorComparison comparison;
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    if (hz[i] <= usable_from_hz || !is_clear(mirrors, i)) continue;
    const LineDifference on = difference_on(mirrors, i);
    comparison.difference.push_back(on.difference);
    comparison.opposite.push_back(on.opposite);
    comparison.noise.push_back(on.noise);
  }
  return comparison;
}

// Whether differences are no more than noise and a usual structure make.
bool is_usual(const MirrorComparison& comparison) {
  return !comparison.difference.empty() &&
         median(comparison.difference) <
             std::max(kNotReciprocalShare, kNotReciprocalNoises * median(comparison.noise));
}

// Logarithm of the odds that the second two are the mirror images and not the first, up to their sign: of a
// difference whose size nobody knows the likelihood is its inverse, and each octave tells once.
double odds_of(const Eigen::VectorXd& hz, const Mirrors& measured, const Mirrors& instead,
               double usable_from_hz) {
  const auto size_on = [](const Mirrors& mirrors, Eigen::Index line) {
    const LineDifference on = difference_on(mirrors, line);
    return std::hypot(std::min(on.difference, on.opposite), on.noise, kEqual);
  };
  std::map<int, std::vector<double>> octaves;
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    if (hz[i] <= usable_from_hz || !is_clear(measured, i) || !is_clear(instead, i)) continue;
    octaves[std::ilogb(hz[i])].push_back(std::log(size_on(measured, i) / size_on(instead, i)));
  }
  double odds = 0;
  for (const auto& [octave, logarithms] : octaves)
    if (logarithms.size() >= kLeastOctave) odds += median(logarithms);
  return odds;
}

// A 2 x 2 matrix of entries: those in the place of driving points, and the two across.
struct Matrix {
  const Channel &aa, &bb;
  Mirrors cross;
};

// The share of the power that a structure would give away in some direction: -Im H, symmetric part, has no
// eigenvalue below 0 where a structure takes energy; mean over clear lines of the negative one over the
// larger one, each octave alike, for the better of both signs.
double energy_given(const Eigen::VectorXd& hz, const Matrix& matrix, double usable_from_hz) {
  double given = 0, with_other_sign = 0, weights = 0;
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    if (hz[i] <= usable_from_hz || !is_clear(matrix.cross, i) || !is_clear({matrix.aa, matrix.bb}, i))
      continue;
    const auto taken = [&](const Channel& channel) { return -channel.entry->h[i].imag(); };
    const double a = taken(matrix.aa), b = taken(matrix.bb),
                 c = (taken(matrix.cross.first) + taken(matrix.cross.second)) / 2;
    const double middle = (a + b) / 2, radius = std::hypot((a - b) / 2, c);
    const double largest = std::abs(middle) + radius;
    if (largest == 0) continue;
    given += std::max(radius - middle, 0.0) / largest / hz[i];
    with_other_sign += std::max(radius + middle, 0.0) / largest / hz[i];
    weights += 1 / hz[i];
  }
  return weights > 0 ? std::min(given, with_other_sign) / weights : 0;
}

// The responses to one force, or to both, were exchanged, where others than the cross entries are mirror
// images and the structure then gives no more energy than as measured.
std::optional<TapFinding> exchanged(const Eigen::VectorXd& hz, const Matrix& measured,
                                    double usable_from_hz) {
  const Channel &aa = measured.aa, &bb = measured.bb, &ab = measured.cross.first, &ba = measured.cross.second;
  const double allowed = energy_given(hz, measured, usable_from_hz) + kMoreEnergy;
  std::optional<TapFinding> best;
  double most = kSureExchange;
  const auto consider = [&](TapFinding finding, const Matrix& instead) {
    const double odds = odds_of(hz, measured.cross, instead.cross, usable_from_hz);
    if (odds < most || energy_given(hz, instead, usable_from_hz) > allowed) return;
    most = odds;
    best = std::move(finding);
    best->least = median(compare(hz, instead.cross, usable_from_hz).difference);
    best->most = median(compare(hz, measured.cross, usable_from_hz).difference);
  };
  consider({.kind = TapFindingKind::kExchanged, .entry = aa.name(), .mirror = ba.name()}, {ba, bb, {ab, aa}});
  consider({.kind = TapFindingKind::kExchanged, .entry = ab.name(), .mirror = bb.name()}, {aa, ab, {bb, ba}});
  consider({.kind = TapFindingKind::kBothExchanged, .entry = ab.name()}, {ba, ab, {bb, aa}});
  return best;
}

}  // namespace

std::vector<TapFinding> check_mirrors(const Eigen::VectorXd& hz, const std::vector<Channel>& channels,
                                      double usable_from_hz) {
  MirrorComparison all;
  for (const Channel& ab : channels) {
    const std::string &a = ab.entry->response, &b = ab.entry->reference;
    const Channel* ba = find(channels, b, a);
    if (a >= b || ba == nullptr) continue;
    const Channel *aa = find(channels, a, a), *bb = find(channels, b, b);
    if (aa != nullptr && bb != nullptr) {
      const Matrix matrix{*aa, *bb, {ab, *ba}};
      std::optional<TapFinding> finding = exchanged(hz, matrix, usable_from_hz);
      // What gives energy at the low end as drift does may be a cross entry in a driving point's place.
      if (!finding && usable_from_hz > 0) finding = exchanged(hz, matrix, 0);
      if (finding) return {std::move(*finding)};
    }
    const MirrorComparison measured = compare(hz, {ab, *ba}, usable_from_hz);
    if (measured.difference.empty()) continue;
    if (const double sum = median(measured.opposite); sum < kOpposite && !is_usual(measured))
      return {{.kind = TapFindingKind::kOppositeMirror,
               .entry = ab.name(),
               .mirror = ba->name(),
               .least = sum,
               .most = median(measured.difference)}};
    all.difference.insert(all.difference.end(), measured.difference.begin(), measured.difference.end());
    all.noise.insert(all.noise.end(), measured.noise.begin(), measured.noise.end());
  }
  if (all.difference.empty() || is_usual(all)) return {};
  return {
      {.kind = TapFindingKind::kNotReciprocal, .least = median(all.noise), .most = median(all.difference)}};
}

}  // namespace stablecut::modal
