#include "modal/tap_checks.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>

#include "base/number_text.h"
#include "base/units.h"
#include "dynamics/noise.h"

namespace stablecut {
namespace {

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
// What is ruined rises towards 0 Hz: by so much over what follows.
constexpr double kRise = 2;
// Noise alone: nothing but it in most windows.
constexpr double kDeadShare = 0.6, kDeadWindows = 0.8;
constexpr double kWrongSign = 0.8, kPoorCoherence = 0.8, kNotReciprocal = 0.1;
// Of the variance of the coherence, in one period.
constexpr double kOnePeriod = 0.25;
constexpr double kLargestPeak = 1e-2, kSmallestPeak = 1e-11;  // m/N
// A line that stands out by so many deviations.
constexpr double kOutstanding = 10;

std::string number(double value) { return printed("%.3g", value); }

std::string name_of(const FrequencyResponseEntry& entry) { return "H" + entry.response + entry.reference; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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
                               const Eigen::VectorXd& deviation) {
  std::vector<Window> windows;
  for (Eigen::Index first = 0; first < hz.size();) {
    Eigen::Index end = std::min(first + kLeastWindow, hz.size());
    while (end < hz.size() && hz[end] <= kWindowRatio * hz[first]) ++end;
    if (hz.size() - end < kLeastWindow) end = hz.size();
    std::vector<double> size, noise, positive, real;
    for (Eigen::Index i = first; i < end; ++i) {
      const double modulus = std::max(std::abs(h[i]), 1e-300);
      size.push_back(modulus);
      noise.push_back(deviation[i] / modulus);
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
  const FrequencyResponseEntry* entry = nullptr;
  Eigen::VectorXd deviation;  // of the noise, [lines]
  std::vector<Window> windows;
  bool driving_point = false;
  bool swapped = false;  // a driving point with the other sign in most windows
  bool dead = false;
};

bool is_driving_point(const FrequencyResponseEntry& entry) {
  return entry.response == entry.reference &&
         entry.response_position_m.value_or(0) == entry.reference_position_m.value_or(0);
}

class TapChecks {
 public:
  TapChecks(const FrequencyResponse& receptance, bool zeros_are_dead)
      : frf_(receptance), hz_(receptance.frequency_hz), zeros_are_dead_(zeros_are_dead) {
    const Eigen::VectorXd omega = kTwoPi * hz_;
    const NoiseShapes floors = floor_shapes(omega);
    for (const auto& entry : frf_.entries) {
      if (entry.h.isZero(0)) continue;
      const Eigen::VectorXd deviation =
          estimated_variance(omega, entry.h, entry.h.cwiseAbs(), floors).cwiseSqrt();
      Channel channel{&entry, deviation, windows_of(hz_, entry.h, deviation), is_driving_point(entry)};
      const auto windows = [&](double sign) {
        return std::count_if(channel.windows.begin(), channel.windows.end(),
                             [&](const Window& window) { return sign * window.positive > kPositiveShare; });
      };
      channel.swapped = channel.driving_point && windows(1) > 4 * windows(-1);
      channels_.push_back(std::move(channel));
    }
  }

  std::vector<std::string> all() {
    lines();
    dead_channels();
    low_end();
    high_end();
    signs();
    mirror_images();
    for (const auto& entry : frf_.entries) coherence(entry);
    peak();
    return std::move(findings_);
  }

 private:
  void say(const std::string& text) { findings_.push_back(text); }

  void lines() {
    if (hz_.size() < 3) return;
    const Eigen::VectorXd steps = hz_.tail(hz_.size() - 1) - hz_.head(hz_.size() - 1);
    if (steps.maxCoeff() <= kUnevenLines * steps.minCoeff()) return;
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

  // Up to where integration has ruined the data: there |H| rises towards 0 Hz, and is noise or no driving
  // point's. Looked for below the highest window whose acceleration is a twentieth of the largest.
  std::optional<double> ruined_up_to(const Channel& channel) const {
    const std::vector<Window>& windows = channel.windows;
    const auto acceleration = [](const Window& window) { return window.size * window.lo_hz * window.hi_hz; };
    double most = 0;
    for (const Window& window : windows) most = std::max(most, acceleration(window));
    std::size_t end = 0;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      if (acceleration(windows[i]) < 0.05 * most && windows[i].hi_hz < hz_[hz_.size() - 1] / 3) end = i + 1;
    }
    std::size_t ruined = 0;
    for (std::size_t i = 0; i < end; ++i) {
      if (tells_nothing(channel, windows[i])) ruined = i + 1;
    }
    if (ruined == 0 || ruined == windows.size()) return std::nullopt;
    double largest = 0;
    for (std::size_t i = 0; i < ruined; ++i) largest = std::max(largest, windows[i].size);
    if (largest < kRise * windows[ruined].size) return std::nullopt;
    return windows[ruined - 1].hi_hz;
  }

  void low_end() {
    for (const Channel& channel : channels_) {
      if (channel.dead) continue;
      const auto up_to = ruined_up_to(channel);
      if (!up_to || *up_to <= usable_from_) continue;
      usable_from_ = *up_to;
      worst_ = name_of(*channel.entry);
    }
    if (usable_from_ == 0) return;
    say("below " + number(usable_from_) + " Hz " + worst_ +
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
      all += std::abs(window.*part);
      positive += std::max(window.*part, 0.0);
    }
    return all > 0 ? positive / all : 0.0;
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
      if (imaginary > 0.2 && imaginary < 0.95 && (real > 0.95 || real < 0.05)) {
        say(name +
            ": its real part has one sign, where a driving point's imaginary part has: is it a velocity "
            "(--quantity), or was it one already? The modes would not be the tool's");
      } else if (imaginary > kWrongSign) {
        say(name + ": a driving point's imaginary part is negative, this is positive on " +
            percent(imaginary) +
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

  void mirror_images() {
    double difference = 0, sizes = 0, noise = 0;
    for (const Channel& a : channels_) {
      for (const Channel& b : channels_) {
        if (a.dead || b.dead || a.entry->response >= a.entry->reference ||
            b.entry->response != a.entry->reference || b.entry->reference != a.entry->response)
          continue;
        const Eigen::VectorXcd& of_a = a.entry->h;
        const Eigen::VectorXcd& of_b = b.entry->h;
        if (of_a.dot(of_b).real() < -kWrongSign * of_a.norm() * of_b.norm()) {
          say(name_of(*a.entry) + " is " + name_of(*b.entry) +
              " with the other sign: one direction is swapped in one of them (-x in the file or in --entry); "
              "the modes cannot be reciprocal");
          return;
        }
        difference += (of_a - of_b).squaredNorm();
        sizes += std::pow(of_a.norm() + of_b.norm(), 2);
        noise += a.deviation.squaredNorm() + b.deviation.squaredNorm();
      }
    }
    if (sizes == 0) return;
    const double index = std::sqrt(difference / sizes), of_noise = std::sqrt(noise / sizes);
    if (index < std::max(kNotReciprocal, 3 * of_noise)) return;
    say("cross entries differ from their mirror images by " + percent(index) + ", noise alone would by " +
        percent(of_noise) +
        ": not reciprocal, as a controlled robot is, or taps at other places than the sensor's; the modes "
        "follow what was measured");
  }

  // Where a channel responds, its coherence should be near 1.
  void coherence(const FrequencyResponseEntry& entry) {
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
    std::string text = name_of(entry) + ": coherence below " + number(kPoorCoherence) + " on " +
                       percent(static_cast<double>(poor.size()) / static_cast<double>(responding.size())) +
                       " of the lines that respond, from " + number(hz_[poor.front()]) + " to " +
                       number(hz_[poor.back()]) + " Hz";
    const auto delay = time_between_hits(entry);
    text += delay ? ", with dips every " + number(1 / *delay) + " Hz, as of a second hit " +
                        number(1e3 * *delay) + " ms after the first"
                  : ": noise, a double hit or a changing structure";
    say(text + (entry.averages ? "; such lines weigh less" : "; with --averages N such lines weigh less"));
  }

  // Two hits make the force vanish on lines at equal distances: one period holds most of the dips.
  std::optional<double> time_between_hits(const FrequencyResponseEntry& entry) const {
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

  const FrequencyResponse& frf_;
  const Eigen::VectorXd& hz_;
  const bool zeros_are_dead_;
  std::vector<Channel> channels_;
  double usable_from_ = 0;
  std::string worst_;
  std::vector<std::string> findings_;
};

// Lines that stand out of what their neighbours say, in one entry.
class DisturbedLines {
 public:
  DisturbedLines(const Eigen::VectorXd& hz, const Eigen::VectorXcd& h)
      : hz_(hz),
        h_(h),
        variance_(estimated_variance(hz, h, h.cwiseAbs(), floor_shapes(hz))),
        out_(static_cast<std::size_t>(hz.size()), false) {}

  // The one that stands out most first: the others may only stand out because of it.
  std::vector<Eigen::Index> find() {
    std::vector<double> shares;
    for (Eigen::Index i = 0; i < h_.size(); ++i)
      shares.push_back(std::sqrt(variance_[i]) / std::max(std::abs(h_[i]), 1e-300));
    if (median(std::move(shares)) > kNoiseShare) return {};  // nothing but noise
    std::vector<double> standing(static_cast<std::size_t>(h_.size()), 0.0);
    for (Eigen::Index i = 0; i < h_.size(); ++i) standing[static_cast<std::size_t>(i)] = outstanding(i);
    std::vector<Eigen::Index> lines;
    for (;;) {
      const auto most = std::max_element(standing.begin(), standing.end());
      if (*most < kOutstanding) return lines;
      const Eigen::Index at = most - standing.begin();
      lines.push_back(at);
      out_[static_cast<std::size_t>(at)] = true;
      for (Eigen::Index i = std::max<Eigen::Index>(at - kReach, 0); i <= std::min(at + kReach, h_.size() - 1);
           ++i)
        standing[static_cast<std::size_t>(i)] = outstanding(i);
    }
  }

 private:
  static constexpr Eigen::Index kReach = 12;
  static constexpr std::size_t kEachSide = 4;

  // The nearest lines that are not out, `count` on each side; fewer at the ends.
  std::vector<Eigen::Index> neighbours(Eigen::Index at, std::size_t count) const {
    std::vector<Eigen::Index> lines;
    for (const Eigen::Index step : {-1, 1}) {
      std::size_t found = 0;
      for (Eigen::Index i = at + step; i >= 0 && i < h_.size() && found < count && std::abs(i - at) <= kReach;
           i += step) {
        if (out_[static_cast<std::size_t>(i)]) continue;
        lines.push_back(i);
        ++found;
      }
    }
    return lines;
  }

  // Distance of the line from what a model of its neighbours says, linear in its unknowns and with the value
  // on the line as the first, over the deviation that noise gives to it.
  double distance(Eigen::Index at, const std::vector<Eigen::Index>& others, bool one_pole) const {
    const auto rows = static_cast<Eigen::Index>(others.size());
    Eigen::Matrix<Complex, Eigen::Dynamic, 4> design(rows, 4);
    Eigen::VectorXcd values(rows);
    double noise = 0;
    const double scale = hz_[others.back()] - hz_[others.front()];
    for (Eigen::Index r = 0; r < rows; ++r) {
      const Eigen::Index i = others[static_cast<std::size_t>(r)];
      const double x = (hz_[i] - hz_[at]) / scale;
      values[r] = h_[i];
      // A cubic, or a quadratic over 1 + a x, which holds a resonance between two lines or over some.
      design.row(r) << 1, x, x * x, one_pole ? -x * h_[i] : Complex(x * x * x);
      noise += variance_[i];
    }
    const Eigen::Vector4d norms = design.colwise().norm().cwiseMax(1e-300);
    const Eigen::MatrixXcd scaled = design * norms.cwiseInverse().asDiagonal();
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXcd> solver(scaled);
    const Eigen::MatrixXcd inverse = solver.pseudoInverse();
    const Complex predicted = (inverse.row(0) * values).value() / norms[0];
    const double spread = 1 + inverse.row(0).squaredNorm() / (norms[0] * norms[0]);
    const double deviation = std::sqrt(spread * noise / static_cast<double>(rows));
    return std::abs(h_[at] - predicted) / std::max(deviation, 1e-13 * std::abs(h_[at]));
  }

  // By the simpler model first: only few lines need the other.
  double outstanding(Eigen::Index at) const {
    if (out_[static_cast<std::size_t>(at)]) return 0;
    const std::vector<Eigen::Index> near = neighbours(at, 2), far = neighbours(at, kEachSide);
    if (near.size() < 4 || far.size() < 2 * kEachSide) return 0;
    const double by_cubic = distance(at, near, false);
    return by_cubic < kOutstanding ? 0 : std::min(by_cubic, distance(at, far, true));
  }

  const Eigen::VectorXd& hz_;
  const Eigen::VectorXcd& h_;
  const Eigen::VectorXd variance_;
  std::vector<bool> out_;
};

}  // namespace

std::vector<std::string> tap_findings(const FrequencyResponse& receptance, bool zeros_are_dead) {
  if (receptance.frequency_hz.size() < kLeastLines) return {};
  return TapChecks(receptance, zeros_are_dead).all();
}

std::vector<Eigen::Index> disturbed_lines(const FrequencyResponse& receptance) {
  std::vector<Eigen::Index> lines;
  for (const auto& entry : receptance.entries) {
    if (entry.h.isZero(0) || entry.h.size() < kLeastLines) continue;
    const std::vector<Eigen::Index> own = DisturbedLines(receptance.frequency_hz, entry.h).find();
    lines.insert(lines.end(), own.begin(), own.end());
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

}  // namespace stablecut
