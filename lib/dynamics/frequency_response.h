// A matrix of frequency responses on common lines, as measured at a tool tip or computed.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stablecut::dynamics {

/// Displacement, velocity or acceleration over force: m/N, m/(N s), m/(N s2).
enum class Quantity { kReceptance = 0, kMobility = 1, kAccelerance = 2 };

/// One measured pair of directions: H_ij is the response in direction i to a force in direction j.
struct FrequencyResponseEntry {
  std::string response;            ///< direction name: "x", "y", "slope_x", ...
  std::string reference;           ///< direction name of the force (or moment)
  Eigen::VectorXcd h;              ///< [lines]
  Eigen::VectorXd variance;        ///< [lines] E|error|^2 of the complex value, both parts; empty: unknown
  Eigen::VectorXd coherence;       ///< [lines] 0..1; empty: unknown
  std::optional<double> averages;  ///< number behind the coherence and the variance, where known
  std::optional<double> response_position_m;   ///< distance from the tip
  std::optional<double> reference_position_m;  ///< distance from the tip

  /// Response and force are at one place in one direction.
  bool is_driving_point() const;
  /// The same directions at the same places; without a position it is the tip.
  bool same_places(const FrequencyResponseEntry& other) const;
};

/// What the errors of two responses to one force have in common, as where the force's channel has noise.
struct ColumnCovariance {
  std::string response, other, reference;  ///< directions
  Eigen::VectorXcd value;  ///< [lines] E[error of response times the conjugate of that of other]
};

/// Entries may be missing (unknown); an entry of exact zeros means uncoupled.
struct FrequencyResponse {
  Quantity quantity = Quantity::kReceptance;
  Eigen::VectorXd frequency_hz;  ///< [lines], increasing
  std::vector<FrequencyResponseEntry> entries;
  std::vector<ColumnCovariance> covariances;  ///< those that are known, of each pair once
  /// Decay of the exponential window that the signals went through: h is H(i omega + decay), 0 without one.
  double window_decay_per_s = 0;

  /// The entry of a pair of directions, or null.
  const FrequencyResponseEntry* find(std::string_view response, std::string_view reference) const;
};

/// The same measurement as displacement over force, H / s^k with k = 0, 1, 2 by quantity. s = i omega +
/// decay, where exp(-decay t) is the window that the signals were measured through [Fladung1997]
/// (FrequencyResponse::window_decay_per_s). Throws InvalidArgument for a line at 0 Hz where k > 0.
FrequencyResponse to_receptance(FrequencyResponse frf);

/// The lines with these indices, in this order, of every entry: values, variances and coherences.
FrequencyResponse select(const FrequencyResponse& frf, const std::vector<Eigen::Index>& lines);

/// The lines with lo_hz <= frequency <= hi_hz. May be empty.
FrequencyResponse within_band(const FrequencyResponse& frf, double lo_hz, double hi_hz);

/// All lines except those with these (increasing) indices.
FrequencyResponse without_lines(const FrequencyResponse& frf, const std::vector<Eigen::Index>& lines);

/// Takes a delay of the response (s) off an entry, h exp(s delay_s) with s = i omega + decay as above, and
/// multiplies it by the factor; its variance and covariances follow.
void correct(FrequencyResponse& frf, std::size_t entry, double delay_s, double factor);

/// The same on other lines (Hz, increasing). A line that was measured keeps its values; between lines h
/// follows the cubic through the four nearest ones, and the variance a straight line. Coherences are left
/// out. Throws InvalidArgument for lines outside the measured band.
FrequencyResponse on_lines(const FrequencyResponse& frf, const Eigen::VectorXd& frequency_hz);

/// Whether both have the same size and the same values (Eigen asserts equal sizes).
bool same_values(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Variance of an entry's complex values [lines], in its quantity's unit squared: as given, or from coherence
/// and averages [Bendat2010]; empty when neither is known. A variance of 0 on a line, where others have one,
/// is a coherence that was rounded to 1, and not certainty: it is replaced by the share of |h|^2 that the
/// nearest lines with a variance have.
Eigen::VectorXd known_variance(const FrequencyResponseEntry& entry);

/// The same to weigh lines by: where it rests on few averages, pooled over lines (`pooled_variance`,
/// noise.h). `frequency_hz` [lines], above 0.
Eigen::VectorXd weighing_variance(const FrequencyResponseEntry& entry, const Eigen::VectorXd& frequency_hz);

}  // namespace stablecut::dynamics
