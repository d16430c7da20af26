#include "modal/tap_checks.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "base/number_text.h"
#include "base/units.h"
#include "dynamics/noise.h"
#include "modal/disturbed_lines.h"
#include "numerics/order_statistics.h"

namespace stablecut::modal {
namespace {

using numerics::median;
using Complex = std::complex<double>;

constexpr double kUnevenLines = 1.05;
// Windows of lines, a sixth of an octave wide and of five lines at least.
constexpr double kWindowRatio = 1.1225;
constexpr Eigen::Index kLeastWindow = 5;
// Of fewer lines nothing can be said.
constexpr Eigen::Index kLeastLines = 20;
// A window tells nothing when the noise's deviation is this share of the signal, and ...
constexpr double kNoiseShare = 0.3;
// ... cannot be a structure's driving point when its imaginary part is positive by this share of the modulus.
constexpr double kPositiveShare = 0.1;
// What is ruined rises towards 0 Hz: by so much over what follows. It ends where a clear curve rises.
constexpr double kRise = 2, kClear = 0.1, kRising = 1.3;
// Noise alone: nothing but it in most windows.
constexpr double kDeadShare = 0.6, kDeadWindows = 0.8;
// A part of H that counts: so many deviations.
constexpr double kSignificant = 2;
constexpr double kWrongSign = 0.8, kPoorCoherence = 0.8, kNotReciprocal = 0.1;
// Of the variance of the coherence, in one period.
constexpr double kOnePeriod = 0.25;
constexpr double kLargestPeak = 1e-2, kSmallestPeak = 1e-11;  // m/N

std::string number(double value) { return number_text(value, 3); }

std::string name_of(const dynamics::FrequencyResponseEntry& entry) {
  return "H" + entry.response + entry.reference;
}

// Some neighbouring lines of an entry, by medians.
struct Window {
  double lo_hz = 0, hi_hz = 0;
  double size = 0;      // |H|
  double noise = 0;     // its deviation over |H|
  double positive = 0;  // Im H / |H|
  double real = 0;      // Re H / |H|
};

std::vector<Window> windows_of(const Eigen::VectorXd& hz, const Eigen::VectorXcd& h,
                               const Eigen::VectorXd& variance) {
  std::vector<Window> windows;
  for (Eigen::Index first = 0; first < hz.size();) {
    Eigen::Index end = std::min(first + kLeastWindow, hz.size());
    while (end < hz.size() && hz[end] <= kWindowRatio * hz[first]) ++end;
    if (hz.size() - end < kLeastWindow) end = hz.size();
    std::vector<double> size, noise, positive, real;
    for (Eigen::Index i = first; i < end; ++i) {
      const double modulus = std::max(std::abs(h[i]), 1e-300);
      size.push_back(modulus);
      noise.push_back(std::sqrt(variance[i]) / modulus);
      positive.push_back(h[i].imag() / modulus);
      real.push_back(h[i].real() / modulus);
    }
    windows.push_back({hz[first], hz[end - 1], median(size), median(noise), median(positive), median(real)});
    first = end;
  }
  return windows;
}

// One entry with what its lines say.
struct Channel {
  const dynamics::FrequencyResponseEntry* entry = nullptr;
  Eigen::VectorXd variance;  // of the noise, [lines]
  std::vector<Window> windows;
  bool driving_point = false;
  bool swapped = false;  // a driving point with the other sign in most windows
  bool dead = false;
};

bool is_driving_point(const dynamics::FrequencyResponseEntry& entry) {
  return entry.response == entry.reference &&
         entry.response_position_m.value_or(0) == entry.reference_position_m.value_or(0);
}

class TapChecks {
 public:
  TapChecks(const dynamics::FrequencyResponse& receptance, bool zeros_are_dead)
      : frf_(receptance), hz_(receptance.frequency_hz), zeros_are_dead_(zeros_are_dead) {
    const dynamics::NoiseShapes floors = dynamics::floor_shapes(hz_);
    for (const auto& entry : frf_.entries) {
      if (entry.h.isZero(0)) continue;
      Channel channel{&entry,
                      dynamics::estimated_variance(hz_, entry.h, entry.h.cwiseAbs(), floors),
                      {},
                      is_driving_point(entry)};
      channel.windows = windows_of(hz_, entry.h, channel.variance);
      const auto windows = [&](double sign) {
        return std::count_if(channel.windows.begin(), channel.windows.end(),
                             [&](const Window& window) { return sign * window.positive > kPositiveShare; });
      };
      channel.swapped = channel.driving_point && windows(1) > 4 * windows(-1);
      channels_.push_back(std::move(channel));
    }
  }

  TapReport report() {
    lines();
    dead_channels();
    low_end();
    high_end();
    signs();
    mirror_images();
    for (const auto& entry : frf_.entries) coherence(entry);
    peak();
    return {std::move(findings_), disturbed()};
  }

 private:
  void say(const std::string& text) { findings_.push_back(text); }

  void lines() {
    if (hz_.size() < 3) return;
    const Eigen::VectorXd steps = hz_.tail(hz_.size() - 1) - hz_.head(hz_.size() - 1);
    if (steps.maxCoeff() <= kUnevenLines * steps.minCoeff()) return;
    // Frequencies that were rounded stay near equally spaced ones.
    const Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(hz_.size(), hz_[0], hz_[hz_.size() - 1]);
    if ((hz_ - even).cwiseAbs().maxCoeff() < steps.mean() / 2) return;
    say("the lines are " + number(steps.minCoeff()) + " to " + number(steps.maxCoeff()) +
        " Hz apart: each counts alike, so that modes where they lie close are weighed more");
  }

  void dead_channels() {
    for (const auto& entry : frf_.entries) {
      if (zeros_are_dead_ && entry.h.isZero(0))
        say(name_of(entry) +
            ": all lines are 0: a dead channel, or one that was not measured; taken as uncoupled");
      else if (!entry.h.isZero(0) && entry.h.size() > 1 && (entry.h.array() == entry.h[0]).all())
        say(name_of(entry) +
            ": the same value on every line: a dead channel; what its modes would be is not measured");
    }
    for (Channel& channel : channels_) {
      const auto count = std::count_if(channel.windows.begin(), channel.windows.end(),
                                       [](const Window& window) { return window.noise > kDeadShare; });
      channel.dead = static_cast<double>(count) > kDeadWindows * static_cast<double>(channel.windows.size());
      if (channel.dead)
        say(name_of(*channel.entry) +
            ": nothing but noise: a dead channel, or uncoupled directions; it tells the fit nothing");
    }
  }

  static bool tells_nothing(const Channel& channel, const Window& window) {
    const double positive = channel.swapped ? -window.positive : window.positive;
    return window.noise > kNoiseShare || (channel.driving_point && positive > kPositiveShare);
  }

  // Up to where integration has ruined the data: there |H| falls from 0 Hz on, and is noise or no driving
  // point's. It ends where a clear curve rises, on the way to a resonance.
  std::optional<double> ruined_up_to(const Channel& channel) const {
    const std::vector<Window>& windows = channel.windows;
    std::size_t ruined = 0;
    double least = windows[0].size;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const Window& window = windows[i];
      least = std::min(least, window.size);
      if (tells_nothing(channel, window)) {
        ruined = i + 1;
      } else if (window.noise < kClear && window.size > kRising * least) {
        break;
      }
    }
    if (ruined == 0 || ruined == windows.size()) return std::nullopt;
    if (windows[0].size < kRise * windows[ruined].size || 3 * windows[ruined - 1].hi_hz > hz_[hz_.size() - 1])
      return std::nullopt;
    return windows[ruined - 1].hi_hz;
  }

  // Driving points tell most; other entries only where there is none.
  void low_end() {
    std::string worst;
    const bool any_driving = std::any_of(channels_.begin(), channels_.end(),
                                         [](const Channel& c) { return c.driving_point && !c.dead; });
    for (const Channel& channel : channels_) {
      if (channel.dead || channel.driving_point != any_driving) continue;
      const auto up_to = ruined_up_to(channel);
      if (!up_to || *up_to <= usable_from_) continue;
      usable_from_ = *up_to;
      worst = name_of(*channel.entry);
    }
    if (usable_from_ == 0) return;
    say("below " + number(usable_from_) + " Hz " + worst +
        " rises towards 0 Hz as no structure does (noise, or an imaginary part above 0): what integration "
        "makes of drift; modes found there are none (--band)");
  }

  void high_end() {
    double from = 0;
    std::string name;
    for (const Channel& channel : channels_) {
      if (channel.dead) continue;
      std::size_t first = channel.windows.size();
      while (first > 0 && channel.windows[first - 1].noise > kNoiseShare) --first;
      if (first == channel.windows.size() || first == 0) continue;
      if (from != 0 && channel.windows[first].lo_hz >= from) continue;
      from = channel.windows[first].lo_hz;
      name = name_of(*channel.entry);
    }
    if (from > 0)
      say("above " + number(from) + " Hz " + name +
          " is within 10 dB of its noise: it adds little but time (--band)");
  }

  // Share of the windows that tell something in which `part` of H / |H| is positive, weighted by it.
  double positive_share(const Channel& channel, double Window::*part) const {
    double positive = 0, all = 0;
    for (const Window& window : channel.windows) {
      if (window.lo_hz <= usable_from_ || window.noise > kNoiseShare) continue;
      if (std::abs(window.*part) < kSignificant * window.noise) continue;
      all += std::abs(window.*part);
      positive += std::max(window.*part, 0.0);
    }
    return all > 0 ? positive / all : 0.0;
  }

  // The imaginary part is a good part of H in a good part of the windows: no stiffness, or mass, alone.
  static bool turning(const Channel& channel) {
    const auto count = std::count_if(channel.windows.begin(), channel.windows.end(),
                                     [](const Window& window) { return std::abs(window.positive) > 0.5; });
    return 5 * count > static_cast<std::ptrdiff_t>(channel.windows.size());
  }

  // Slope of log |H| over log frequency.
  static double slope_of(const Channel& channel) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Window& window : channel.windows) {
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

  void signs() {
    for (const Channel& channel : channels_) {
      if (!channel.driving_point || channel.dead) continue;
      const double imaginary = positive_share(channel, &Window::positive);
      const double real = positive_share(channel, &Window::real);
      const double slope = slope_of(channel);
      const std::string name = name_of(*channel.entry);
      if (imaginary > 0.2 && imaginary < 0.95 && (real > 0.95 || real < 0.05) && turning(channel)) {
        say(name +
            ": its real part has one sign, where a driving point's imaginary part has: is it a velocity "
            "(--quantity), or was it one already? The modes would not be the tool's");
      } else if (imaginary > kWrongSign) {
        say(name + ": a driving point's imaginary part is negative, this is positive on " +
            percent_text(imaginary) +
            (slope > 0.5
                 ? ": is it an acceleration (--quantity)? Else the sign of response or force is swapped"
             : slope < -2.5
                 ? ": is it a displacement already (--quantity)? Else the sign of response or force is "
                   "swapped"
                 : ": the sign of response or force is swapped, or it is another quantity (--quantity)") +
            "; the modes would give energy away");
      }
    }
  }

  // By medians over the lines on which both stand 10 dB above their noise.
  void mirror_images() {
    std::vector<double> difference, noise;
    for (const Channel& a : channels_) {
      for (const Channel& b : channels_) {
        if (a.dead || b.dead || a.entry->response >= a.entry->reference ||
            b.entry->response != a.entry->reference || b.entry->reference != a.entry->response)
          continue;
        std::vector<double> together;
        for (Eigen::Index i = 0; i < hz_.size(); ++i) {
          const Complex of_a = a.entry->h[i], of_b = b.entry->h[i];
          const double clear = kNoiseShare * std::min(std::abs(of_a), std::abs(of_b));
          if (hz_[i] <= usable_from_ || clear * clear < std::max(a.variance[i], b.variance[i]) || clear == 0)
            continue;
          const double sizes = std::abs(of_a) + std::abs(of_b);
          together.push_back((std::conj(of_a) * of_b).real() / (std::abs(of_a) * std::abs(of_b)));
          difference.push_back(std::abs(of_a - of_b) / sizes);
          noise.push_back(std::sqrt(a.variance[i] + b.variance[i]) / sizes);
        }
        if (together.empty() || median(std::move(together)) > -kWrongSign) continue;
        say(name_of(*a.entry) + " is " + name_of(*b.entry) +
            " with the other sign: one direction is swapped in one of them (-x in the file or in --entry); "
            "the modes cannot be reciprocal");
        return;
      }
    }
    if (difference.empty()) return;
    const double index = median(std::move(difference)), of_noise = median(std::move(noise));
    if (index < std::max(kNotReciprocal, 3 * of_noise)) return;
    say("cross entries differ from their mirror images by " + percent_text(index) +
        ", noise alone would by " + percent_text(of_noise) +
        ": not reciprocal, as a controlled robot is, or taps at other places than the sensor's; the modes "
        "follow what was measured");
  }

  // Where a channel responds, its coherence should be near 1.
  void coherence(const dynamics::FrequencyResponseEntry& entry) {
    if (entry.coherence.size() == 0) return;
    const Eigen::VectorXd size = entry.h.cwiseAbs();
    const double typical = median(std::vector<double>(size.begin(), size.end()));
    std::vector<Eigen::Index> responding, poor;
    for (Eigen::Index i = 0; i < hz_.size(); ++i) {
      if (size[i] < 0.3 * typical) continue;
      responding.push_back(i);
      if (entry.coherence[i] < kPoorCoherence) poor.push_back(i);
    }
    if (poor.size() * 20 < responding.size()) return;
    std::string text =
        name_of(entry) + ": coherence below " + number(kPoorCoherence) + " on " +
        percent_text(static_cast<double>(poor.size()) / static_cast<double>(responding.size())) +
        " of the lines that respond, from " + number(hz_[poor.front()]) + " to " + number(hz_[poor.back()]) +
        " Hz";
    const auto delay = time_between_hits(entry);
    text += delay ? ", with dips every " + number(1 / *delay) + " Hz, as of a second hit " +
                        number(1e3 * *delay) + " ms after the first"
                  : ": noise, a double hit or a changing structure";
    say(text + (entry.averages ? "; such lines weigh less" : "; with --averages N such lines weigh less"));
  }

  // Two hits make the force vanish on lines at equal distances: one period holds most of the dips.
  std::optional<double> time_between_hits(const dynamics::FrequencyResponseEntry& entry) const {
    constexpr double kMostDips = 200, kLeastDips = 4, kStep = 0.25;
    const Eigen::Index lines = hz_.size();
    const Eigen::VectorXd dips = (1 - entry.coherence.array()).matrix();
    const double mean = dips.mean();
    const double power = (dips.array() - mean).square().mean();
    const double band = hz_[lines - 1] - hz_[0];
    if (!(power > 0) || !(band > 0)) return std::nullopt;
    double most = 0, delay = 0;
    for (double count = kLeastDips; count <= std::min(kMostDips, static_cast<double>(lines) / 4);
         count += kStep) {
      const Complex turn_s(0, kTwoPi * count / band);
      Complex sum = 0;
      for (Eigen::Index i = 0; i < lines; ++i) sum += (dips[i] - mean) * std::exp(turn_s * (hz_[i] - hz_[0]));
      const double share = 2 * std::norm(sum / static_cast<double>(lines)) / power;
      if (share <= most) continue;
      most = share;
      delay = count / band;
    }
    if (most < kOnePeriod) return std::nullopt;
    return delay;
  }

  void peak() {
    double largest = 0;
    for (const Channel& channel : channels_) {
      for (Eigen::Index i = 0; i < hz_.size(); ++i) {
        if (hz_[i] > usable_from_) largest = std::max(largest, std::abs(channel.entry->h[i]));
      }
    }
    if (largest == 0 || (largest <= kLargestPeak && largest >= kSmallestPeak)) return;
    say("the largest receptance is " + number(largest) + " m/N, a structure as " +
        (largest > kLargestPeak ? "soft" : "stiff") + " as " + number(1 / largest) +
        " N/m: is that the unit (--unit, --quantity)? Depths of cut would be wrong by as much");
  }

  std::vector<Eigen::Index> disturbed() const {
    std::vector<Eigen::Index> lines;
    for (const Channel& channel : channels_) {
      if (channel.dead) continue;
      const std::vector<Eigen::Index> own = disturbed_lines(hz_, channel.entry->h, channel.variance);
      lines.insert(lines.end(), own.begin(), own.end());
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
  }

  const dynamics::FrequencyResponse& frf_;
  const Eigen::VectorXd& hz_;
  const bool zeros_are_dead_;
  std::vector<Channel> channels_;
  double usable_from_ = 0;
  std::vector<std::string> findings_;
};

}  // namespace

TapReport check_tap(const dynamics::FrequencyResponse& receptance, bool zeros_are_dead) {
  if (receptance.frequency_hz.size() < kLeastLines) return {};
  return TapChecks(receptance, zeros_are_dead).report();
}

}  // namespace stablecut::modal
