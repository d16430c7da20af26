#include "dynamics/frequency_response.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "dynamics/interpolation.h"
#include "dynamics/noise.h"

namespace stablecut::dynamics {
namespace {

constexpr double kSameLine = 1e-9;        // relative distance below which two frequencies are one line
constexpr double kLeastCoherence = 1e-6;  // a coherence of 0 would make the variance infinite
constexpr double kLeastModulus = 1e-300;  // of |h|^2, in a quotient

}  // namespace

bool FrequencyResponseEntry::is_driving_point() const {
  return response == reference && response_position_m.value_or(0) == reference_position_m.value_or(0);
}

bool FrequencyResponseEntry::same_places(const FrequencyResponseEntry& other) const {
  return response == other.response && reference == other.reference &&
         response_position_m.value_or(0) == other.response_position_m.value_or(0) &&
         reference_position_m.value_or(0) == other.reference_position_m.value_or(0);
}

bool same_values(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() && a == b;
}

const FrequencyResponseEntry* FrequencyResponse::find(std::string_view response,
                                                      std::string_view reference) const {
  for (const auto& entry : entries) {
    if (entry.response == response && entry.reference == reference) return &entry;
  }
  return nullptr;
}

FrequencyResponse to_receptance(FrequencyResponse frf) {
  const int order = static_cast<int>(frf.quantity);
  if (order == 0) return frf;
  if (frf.frequency_hz.size() > 0 && frf.frequency_hz.minCoeff() <= 0) {
    throw InvalidArgument("frequency 0 Hz: expected lines above 0 Hz to convert to a receptance");
  }
  for (Eigen::Index line = 0; line < frf.frequency_hz.size(); ++line) {
    const double omega = rad_per_s_from_hz(frf.frequency_hz[line]);
    const std::complex<double> s(frf.window_decay_per_s, omega);
    const std::complex<double> divisor = order == 1 ? s : s * s;
    for (auto& entry : frf.entries) {
      entry.h[line] /= divisor;
      if (entry.variance.size() > 0) entry.variance[line] /= std::norm(divisor);
    }
    for (auto& covariance : frf.covariances) covariance.value[line] /= std::norm(divisor);
  }
  frf.quantity = Quantity::kReceptance;
  return frf;
}

FrequencyResponse select(const FrequencyResponse& frf, const std::vector<Eigen::Index>& lines) {
  FrequencyResponse part = frf;
  part.frequency_hz = frf.frequency_hz(lines);
  for (std::size_t e = 0; e < frf.entries.size(); ++e) {
    const auto& from = frf.entries[e];
    auto& entry = part.entries[e];
    entry.h = from.h(lines);
    if (from.variance.size() > 0) entry.variance = from.variance(lines);
    if (from.coherence.size() > 0) entry.coherence = from.coherence(lines);
  }
  for (std::size_t c = 0; c < frf.covariances.size(); ++c)
    part.covariances[c].value = frf.covariances[c].value(lines);
  return part;
}

FrequencyResponse within_band(const FrequencyResponse& frf, double lo_hz, double hi_hz) {
  std::vector<Eigen::Index> inside;
  for (Eigen::Index line = 0; line < frf.frequency_hz.size(); ++line) {
    if (frf.frequency_hz[line] >= lo_hz && frf.frequency_hz[line] <= hi_hz) inside.push_back(line);
  }
  return select(frf, inside);
}

FrequencyResponse without_lines(const FrequencyResponse& frf, const std::vector<Eigen::Index>& lines) {
  std::vector<Eigen::Index> kept;
  auto next = lines.begin();
  for (Eigen::Index i = 0; i < frf.frequency_hz.size(); ++i) {
    if (next != lines.end() && *next == i) {
      ++next;
    } else {
      kept.push_back(i);
    }
  }
  return select(frf, kept);
}

void correct(FrequencyResponse& frf, std::size_t entry, double delay_s, double factor) {
  FrequencyResponseEntry& own = frf.entries[entry];
  const double size = factor * std::exp(frf.window_decay_per_s * delay_s);
  Eigen::VectorXcd change(frf.frequency_hz.size());
  for (Eigen::Index i = 0; i < change.size(); ++i)
    change[i] = size * std::polar(1.0, kTwoPi * frf.frequency_hz[i] * delay_s);
  own.h = own.h.cwiseProduct(change);
  own.variance *= size * size;
  for (ColumnCovariance& covariance : frf.covariances) {
    if (covariance.reference != own.reference) continue;
    if (covariance.response == own.response) covariance.value = covariance.value.cwiseProduct(change);
    if (covariance.other == own.response)
      covariance.value = covariance.value.cwiseProduct(change.conjugate());
  }
}

FrequencyResponse on_lines(const FrequencyResponse& frf, const Eigen::VectorXd& frequency_hz) {
  const Eigen::VectorXd& from = frf.frequency_hz;
  const Eigen::Index measured = from.size(), lines = frequency_hz.size();
  FrequencyResponse result = frf;
  result.frequency_hz = frequency_hz;
  result.covariances.clear();
  for (auto& entry : result.entries) {
    entry.h.resize(lines);
    if (entry.variance.size() > 0) entry.variance.resize(lines);
    entry.coherence.resize(0);
    entry.averages.reset();
  }
  for (Eigen::Index i = 0; i < lines; ++i) {
    const double hz = frequency_hz[i], rounding = kSameLine * hz;
    if (!(hz >= from[0] - rounding && hz <= from[measured - 1] + rounding)) {
      throw InvalidArgument("line at " + number_text(hz) + " Hz: expected the measured band, " +
                            number_text(from[0]) + " to " + number_text(from[measured - 1]) + " Hz");
    }
    const Eigen::Index above = std::min<Eigen::Index>(
        std::lower_bound(from.begin(), from.end(), hz - rounding) - from.begin(), measured - 1);
    const bool same = above == 0 || std::abs(from[above] - hz) <= rounding;
    const LineWeights weights = same ? LineWeights{{above, 1}} : cubic_weights(from, above, hz);
    for (std::size_t e = 0; e < frf.entries.size(); ++e) {
      const auto& entry = frf.entries[e];
      auto& target = result.entries[e];
      std::complex<double> value = 0;
      for (const auto& [line, weight] : weights) value += weight * entry.h[line];
      target.h[i] = value;
      if (entry.variance.size() == 0) continue;
      const double share = same ? 1 : (hz - from[above - 1]) / (from[above] - from[above - 1]);
      target.variance[i] =
          share * entry.variance[above] + (same ? 0 : (1 - share) * entry.variance[above - 1]);
    }
  }
  return result;
}

namespace {

// The variances with each 0 replaced by a share of |h|^2: the mean share of the nearest lines on either side
// that have a variance.
Eigen::VectorXd without_zeros(Eigen::VectorXd variance, const Eigen::VectorXcd& h) {
  if ((variance.array() > 0).all() || (variance.array() == 0).all()) return variance;
  const Eigen::Index lines = variance.size();
  const auto filled = [&](Eigen::Index from, Eigen::Index step) {
    Eigen::VectorXd shares(lines);
    double last = -1;  // none yet
    for (Eigen::Index i = from; i >= 0 && i < lines; i += step) {
      if (variance[i] > 0) last = variance[i] / std::max(std::norm(h[i]), kLeastModulus);
      shares[i] = last;
    }
    return shares;
  };
  const Eigen::VectorXd below = filled(0, 1), above = filled(lines - 1, -1);
  for (Eigen::Index i = 0; i < lines; ++i) {
    if (variance[i] > 0) continue;
    const double share = below[i] < 0 ? above[i] : above[i] < 0 ? below[i] : (below[i] + above[i]) / 2;
    variance[i] = share * std::norm(h[i]);
  }
  return variance;
}

}  // namespace

Eigen::VectorXd known_variance(const FrequencyResponseEntry& entry) {
  if (entry.variance.size() > 0) return without_zeros(entry.variance, entry.h);
  if (entry.coherence.size() == 0 || !entry.averages) return {};
  // Var H1 = (1 - coherence) / (2 averages coherence) |H|^2 for each of the two parts [Bendat2010]. The
  // coherence was estimated from the same averages, which costs one of them.
  const Eigen::ArrayXd coherence = entry.coherence.array().max(kLeastCoherence);
  const double averages = std::max(*entry.averages - 1, 1.0);
  return without_zeros((1 - coherence) / (coherence * averages) * entry.h.array().abs2(), entry.h);
}

Eigen::VectorXd weighing_variance(const FrequencyResponseEntry& entry, const Eigen::VectorXd& frequency_hz) {
  Eigen::VectorXd variance = known_variance(entry);
  if (variance.size() == 0 || !entry.averages) return variance;
  return pooled_variance(variance, std::max(*entry.averages - 1, 1.0), entry.h.cwiseAbs(),
                         floor_shapes(frequency_hz));
}

}  // namespace stablecut::dynamics
