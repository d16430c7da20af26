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
  std::optional<double> averages;  ///< number behind the coherence, where known
  std::optional<double> response_position_m;   ///< distance from the tip
  std::optional<double> reference_position_m;  ///< distance from the tip

  /// The same directions at the same places; without a position it is the tip.
  bool same_places(const FrequencyResponseEntry& other) const;
};

/// Entries may be missing (unknown); an entry of exact zeros means uncoupled.
struct FrequencyResponse {
  Quantity quantity = Quantity::kReceptance;
  Eigen::VectorXd frequency_hz;  ///< [lines], increasing
  std::vector<FrequencyResponseEntry> entries;

  /// The entry of a pair of directions, or null.
  const FrequencyResponseEntry* find(std::string_view response, std::string_view reference) const;
};

/// The same measurement as displacement over force: H / s^k, s = i omega. Where the signals were measured
/// through an exponential window exp(-decay t), decay_per_s, their transforms are those at s = i omega +
/// decay. Throws InvalidArgument when a line at 0 Hz would have to be divided by zero.
FrequencyResponse to_receptance(FrequencyResponse frf, double decay_per_s = 0);

/// These lines (indices in the order wanted), of every entry with what is known of it.
FrequencyResponse select(const FrequencyResponse& frf, const std::vector<Eigen::Index>& lines);

/// The lines with lo_hz <= frequency <= hi_hz. May be empty.
FrequencyResponse within_band(const FrequencyResponse& frf, double lo_hz, double hi_hz);

/// All lines but these (increasing indices).
FrequencyResponse without_lines(const FrequencyResponse& frf, const std::vector<Eigen::Index>& lines);

/// The same on other lines (Hz, increasing): where a line was measured its values, between lines a cubic
/// through the four nearest. Variances likewise but linear; coherences are left out. Throws InvalidArgument
/// for lines outside the measured band.
FrequencyResponse on_lines(const FrequencyResponse& frf, const Eigen::VectorXd& frequency_hz);

/// Equal in number and value.
bool same_values(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Variance of an entry's complex values [lines], in its quantity's unit squared: given, or by its coherence
/// and averages (Bendat and Piersol); empty when neither is known. A 0 (a coherence rounded to 1) where
/// others have a variance is no certainty: the share of |h|^2 of the nearest lines that have one is taken
/// instead.
Eigen::VectorXd known_variance(const FrequencyResponseEntry& entry);

}  // namespace stablecut::dynamics
