#include "modal/tap_checks.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "base/units.h"
#include "modal/disturbed_lines.h"
#include "modal/low_end.h"
#include "modal/mirror_checks.h"
#include "modal/tap_channels.h"
#include "numerics/order_statistics.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;
using numerics::median;
using Findings = std::vector<TapFinding>;

constexpr Eigen::Index kLeastTapLines = 20;  // of fewer nothing is said
constexpr double kUnevenLines = 1.05;        // largest over smallest distance of lines
constexpr double kRoundedLines = 0.5;        // of the mean distance: rounded frequencies are off by less
constexpr double kWrongSign = 0.8;           // share of what counts with a sign from which on that is said
// The imaginary part is a good part of H (kTurned) in a good part of the windows (one in kTurningWindows).
constexpr double kTurned = 0.5;
constexpr std::ptrdiff_t kTurningWindows = 5;
constexpr double kRisingSlope = 0.5, kFallingSlope = -2.5;  // of log |H| over log frequency
// Coherence is looked at where |H| is this part of its median; it is poor on one line in kPoorLines.
constexpr double kPoorCoherenceLimit = 0.8, kResponding = 0.3;
constexpr std::size_t kPoorLines = 20;
// Dips of two hits: how many periods in the band are tried, in what steps, at least so many lines a period,
// and the share of the coherence's variance that one period must hold.
constexpr double kLeastDips = 4, kMostDips = 200, kDipStep = 0.25, kLinesPerDip = 4, kOnePeriod = 0.25;
constexpr double kLargestPeak = 1e-2, kSmallestPeak = 1e-11;  // m/N
// So many disturbed lines, or that share of all, are few.
constexpr Eigen::Index kFewLines = 5;
constexpr double kFewShare = 0.02;

void check_spacing(const Eigen::VectorXd& hz, Findings& findings) {
  const Eigen::VectorXd steps = hz.tail(hz.size() - 1) - hz.head(hz.size() - 1);
  if (steps.maxCoeff() <= kUnevenLines * steps.minCoeff()) return;
  const Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(hz.size(), hz[0], hz[hz.size() - 1]);
  if ((hz - even).cwiseAbs().maxCoeff() < kRoundedLines * steps.mean()) return;
  findings.push_back(
      {.kind = TapFindingKind::kUnevenLines, .least = steps.minCoeff(), .most = steps.maxCoeff()});
}

void check_dead_channels(const dynamics::FrequencyResponse& receptance, const std::vector<Channel>& channels,
                         bool zeros_are_dead, Findings& findings) {
  for (const auto& entry : receptance.entries) {
    const EntryName name{entry.response, entry.reference};
    if (entry.h.isZero(0)) {
      if (zeros_are_dead) findings.push_back({.kind = TapFindingKind::kZeroEntry, .entry = name});
    } else if ((entry.h.array() == entry.h[0]).all()) {
      findings.push_back({.kind = TapFindingKind::kConstantEntry, .entry = name});
    }
  }
  for (const Channel& channel : channels) {
    if (channel.dead) findings.push_back({.kind = TapFindingKind::kNothingButNoise, .entry = channel.name()});
  }
}

// Up to where channels are of no use, or in doubt. Driving points tell most; others count only where there is
// none.
void check_low_end(const Eigen::VectorXd& hz, const std::vector<Channel>& channels, TapReport& report) {
  const bool any_driving = std::any_of(channels.begin(), channels.end(),
                                       [](const Channel& c) { return c.driving_point && !c.dead; });
  double risen_hz = hz[hz.size() - 1];
  for (const Channel& channel : channels) {
    if (!channel.dead && channel.driving_point == any_driving)
      risen_hz = std::min(risen_hz, first_rise_hz(hz, channel));
  }
  if (kLowEndShare * risen_hz < hz[hz.size() - 1]) report.falls_to_hz = risen_hz;
  TapFinding worst{.kind = TapFindingKind::kDrift};
  for (const Channel& channel : channels) {
    if (channel.dead || channel.driving_point != any_driving) continue;
    const std::optional<LowEnd> end = low_end_of(hz, channel, risen_hz);
    if (!end) continue;
    report.usable_from_hz = std::max(report.usable_from_hz, end->ruined_hz);
    report.doubtful_to_hz = std::max(report.doubtful_to_hz, end->doubtful_hz);
    if (std::pair(end->ruined_hz, end->doubtful_hz) <= std::pair(worst.lo_hz, worst.hi_hz)) continue;
    worst.entry = channel.name();
    worst.lo_hz = end->ruined_hz;
    worst.hi_hz = end->doubtful_hz;
  }
  if (worst.hi_hz > 0) report.findings.push_back(worst);
}

// Modes there are not seen. Below an octave there is little to see.
void check_low_noise(const std::vector<Channel>& channels, Findings& findings) {
  TapFinding worst{.kind = TapFindingKind::kNoiseAtLowEnd};
  for (const TapFinding& finding : findings)
    if (finding.kind == TapFindingKind::kDrift) worst.hi_hz = finding.hi_hz;
  for (const Channel& channel : channels) {
    if (channel.dead || !channel.driving_point) continue;
    std::size_t noisy = 0;
    while (noisy < channel.windows.size() && channel.windows[noisy].noise > kNoiseShare) ++noisy;
    if (noisy == 0) continue;
    const double up_to_hz = channel.windows[noisy - 1].hi_hz;
    if (up_to_hz < 2 * channel.windows[0].lo_hz || up_to_hz <= worst.hi_hz) continue;
    worst.entry = channel.name();
    worst.hi_hz = up_to_hz;
  }
  if (!worst.entry.response.empty()) findings.push_back(worst);
}

void check_high_end(const std::vector<Channel>& channels, Findings& findings) {
  double from = 0;
  EntryName name;
  for (const Channel& channel : channels) {
    if (channel.dead) continue;
    std::size_t first = channel.windows.size();
    while (first > 0 && channel.windows[first - 1].noise > kNoiseShare) --first;
    if (first == channel.windows.size() || first == 0) continue;
    if (from != 0 && channel.windows[first].lo_hz >= from) continue;
    from = channel.windows[first].lo_hz;
    name = channel.name();
  }
  if (from > 0) findings.push_back({.kind = TapFindingKind::kNoiseAtHighEnd, .entry = name, .lo_hz = from});
}

// Not the curve of a stiffness or a mass alone, which is real.
bool turns(const Channel& channel) {
  const auto count =
      std::count_if(channel.windows.begin(), channel.windows.end(),
                    [](const WindowSummary& window) { return std::abs(window.imaginary) > kTurned; });
  return kTurningWindows * count > static_cast<std::ptrdiff_t>(channel.windows.size());
}

// Slope of log |H| over log frequency, by least squares over the windows.
double slope_of(const Channel& channel) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const WindowSummary& window : channel.windows) {
    const double u = std::log(window.lo_hz), v = std::log(window.size);
    n += 1;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  const double spread = n * xx - x * x;
  return spread > 0 ? (n * xy - x * y) / spread : 0;
}

void check_signs(const std::vector<Channel>& channels, double usable_from_hz, Findings& findings) {
  for (const Channel& channel : channels) {
    if (!channel.driving_point || channel.dead) continue;
    const double imaginary = positive_share(channel, usable_from_hz, &WindowSummary::imaginary);
    const double real = positive_share(channel, usable_from_hz, &WindowSummary::real);
    const bool real_has_one_sign = real > 1 - kOneSign || real < kOneSign;
    if (imaginary > kSomeSign && imaginary < 1 - kOneSign && real_has_one_sign && turns(channel)) {
      findings.push_back({.kind = TapFindingKind::kLikeVelocity, .entry = channel.name()});
    } else if (imaginary > kWrongSign) {
      const double slope = slope_of(channel);
      const TapFindingKind kind = slope > kRisingSlope    ? TapFindingKind::kPositiveRising
                                  : slope < kFallingSlope ? TapFindingKind::kPositiveFalling
                                                          : TapFindingKind::kPositive;
      findings.push_back({.kind = kind, .entry = channel.name(), .most = imaginary});
    }
  }
}

// Two hits make the force vanish on lines at equal distances: one period holds most of the dips.
std::optional<double> time_between_hits(const Eigen::VectorXd& hz, const Eigen::VectorXd& coherence) {
  const Eigen::Index lines = hz.size();
  const Eigen::VectorXd dips = (1 - coherence.array()).matrix();
  const double mean = dips.mean();
  const double power = (dips.array() - mean).square().mean();
  const double band = hz[lines - 1] - hz[0];
  if (!(power > 0) || !(band > 0)) return std::nullopt;
  double most = 0, delay = 0;
  const double most_dips = std::min(kMostDips, static_cast<double>(lines) / kLinesPerDip);
  const auto counts = static_cast<int>(std::floor((most_dips - kLeastDips) / kDipStep)) + 1;
  for (int k = 0; k < counts; ++k) {
    const double count = kLeastDips + k * kDipStep;
    const Complex turn_s(0, kTwoPi * count / band);
    Complex sum = 0;
    for (Eigen::Index i = 0; i < lines; ++i) sum += (dips[i] - mean) * std::exp(turn_s * (hz[i] - hz[0]));
    const double share = 2 * std::norm(sum / static_cast<double>(lines)) / power;
    if (share <= most) continue;
    most = share;
    delay = count / band;
  }
  return most < kOnePeriod ? std::nullopt : std::optional(delay);
}

// Where a channel responds, its coherence should be near 1.
void check_coherence(const Eigen::VectorXd& hz, const dynamics::FrequencyResponseEntry& entry,
                     Findings& findings) {
  if (entry.coherence.size() == 0) return;
  const Eigen::VectorXd size = entry.h.cwiseAbs();
  const double typical = median(std::vector<double>(size.begin(), size.end()));
  std::size_t responding = 0;
  std::vector<Eigen::Index> poor;
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    if (size[i] < kResponding * typical) continue;
    ++responding;
    if (entry.coherence[i] < kPoorCoherenceLimit) poor.push_back(i);
  }
  if (poor.size() * kPoorLines < responding) return;
  findings.push_back({.kind = TapFindingKind::kPoorCoherence,
                      .entry = {entry.response, entry.reference},
                      .lo_hz = hz[poor.front()],
                      .hi_hz = hz[poor.back()],
                      .least = kPoorCoherenceLimit,
                      .most = static_cast<double>(poor.size()) / static_cast<double>(responding),
                      .hit_delay_s = time_between_hits(hz, entry.coherence),
                      .averages_known = entry.averages.has_value()});
}

void check_peak(const Eigen::VectorXd& hz, const std::vector<Channel>& channels, double usable_from_hz,
                Findings& findings) {
  double largest = 0;
  for (const Channel& channel : channels) {
    for (Eigen::Index i = 0; i < hz.size(); ++i) {
      if (hz[i] > usable_from_hz) largest = std::max(largest, std::abs(channel.entry->h[i]));
    }
  }
  if (largest == 0 || (largest <= kLargestPeak && largest >= kSmallestPeak)) return;
  findings.push_back(
      {.kind = largest > kLargestPeak ? TapFindingKind::kSoft : TapFindingKind::kStiff, .most = largest});
}

// Lines that hum or a spur disturbs in any channel; none where they are too many for that.
std::vector<Eigen::Index> check_disturbed_lines(const Eigen::VectorXd& hz,
                                                const std::vector<Channel>& channels, Findings& findings) {
  std::vector<Eigen::Index> lines;
  for (const Channel& channel : channels) {
    if (channel.dead) continue;
    const std::vector<Eigen::Index> own = disturbed_lines(hz, channel.entry->h, channel.variance);
    lines.insert(lines.end(), own.begin(), own.end());
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  const auto few = std::max(kFewLines, static_cast<Eigen::Index>(kFewShare * static_cast<double>(hz.size())));
  if (lines.empty() || static_cast<Eigen::Index>(lines.size()) > few) return {};
  TapFinding finding{.kind = TapFindingKind::kDisturbedLines};
  for (const Eigen::Index line : lines) finding.lines_hz.push_back(hz[line]);
  findings.push_back(std::move(finding));
  return lines;
}

}  // namespace

TapReport check_tap(const dynamics::FrequencyResponse& receptance, bool zeros_are_dead) {
  const Eigen::VectorXd& hz = receptance.frequency_hz;
  TapReport report;
  if (hz.size() < kLeastTapLines) return report;
  const std::vector<Channel> channels = channels_of(receptance);
  check_spacing(hz, report.findings);
  check_dead_channels(receptance, channels, zeros_are_dead, report.findings);
  check_low_end(hz, channels, report);
  const double usable_from_hz = report.usable_from_hz;
  check_low_noise(channels, report.findings);
  check_high_end(channels, report.findings);
  check_signs(channels, usable_from_hz, report.findings);
  for (TapFinding& finding : check_mirrors(hz, channels, usable_from_hz))
    report.findings.push_back(std::move(finding));
  for (const auto& entry : receptance.entries) check_coherence(hz, entry, report.findings);
  check_peak(hz, channels, usable_from_hz, report.findings);
  report.disturbed_lines = check_disturbed_lines(hz, channels, report.findings);
  return report;
}

dynamics::FrequencyResponse usable_part(dynamics::FrequencyResponse receptance, const TapReport& report,
                                        bool from_lowest) {
  const auto is_dead = [&](const dynamics::FrequencyResponseEntry& entry) {
    return std::any_of(report.findings.begin(), report.findings.end(), [&](const TapFinding& finding) {
      return finding.kind == TapFindingKind::kNothingButNoise && finding.entry.response == entry.response &&
             finding.entry.reference == entry.reference;
    });
  };
  const auto& entries = receptance.entries;
  if (std::any_of(entries.begin(), entries.end(),
                  [&](const auto& e) { return !e.h.isZero(0) && !is_dead(e); }))
    std::erase_if(receptance.entries, is_dead);
  receptance = dynamics::without_lines(receptance, report.disturbed_lines);
  if (from_lowest) return receptance;
  return dynamics::within_band(receptance, std::nextafter(report.usable_from_hz, HUGE_VAL), HUGE_VAL);
}

}  // namespace stablecut::modal
