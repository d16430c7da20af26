// The measured curves as the fit sees them: receptances on common lines, weighted by their noise.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "dynamics/frequency_response.h"

namespace stablecut::modal {

/// One measured pair of directions.
struct Curve {
  Eigen::Index response = 0;   ///< row of psi_r
  Eigen::Index reference = 0;  ///< row of psi_l
  Eigen::VectorXcd h;          ///< [lines] m/N
  Eigen::VectorXd weight;      ///< [lines] 1 / variance of the complex value
  /// [lines] The part of the error that all curves of one reference share: a curve's error is that times one
  /// unit complex normal number for each reference and line, plus an error of its own. Empty: none.
  Eigen::VectorXcd shared{};
};

/// The curves of one independent group of directions.
struct FitData {
  Eigen::VectorXcd s;     ///< [lines] i omega, rad/s
  Eigen::Index dofs = 0;  ///< number of directions: the size of psi_r and psi_l
  std::vector<Curve> curves;
  bool independent_lines = true;  ///< noise is; through an exponential window it is not
  bool poles_fixed = false;       ///< known: only vectors are refined, and deviations are given the poles
  /// Where the model is the limit lines weigh by the size of their curve near them, so that each octave
  /// counts alike, and not by that of the whole curve.
  bool levelled = false;
  /// What lies outside the band is terms at residual_poles, which stay there, and no mode leaves the band.
  bool residual_terms = false;

  /// Which curves share components of psi_r or psi_l, directly or by others: a number from 0 on for each
  /// curve. Between two parts the scale of a mode's vectors is free.
  std::vector<std::size_t> vector_parts() const;

  Eigen::Index lines() const { return s.size(); }
  double lowest() const { return s[0].imag(); }             ///< rad/s
  double highest() const { return s[lines() - 1].imag(); }  ///< rad/s
  /// Whether a pole lies in the band of the lines. The one definition of it: README.md, "In the band".
  bool in_band(std::complex<double> pole) const;
  /// Whether a pole is that of a residual term, and whether it stays where it is.
  bool is_residual(std::complex<double> pole) const { return residual_terms && !in_band(pole); }
  bool holds(std::complex<double> pole) const { return poles_fixed || is_residual(pole); }
  /// Mean distance between lines, rad/s.
  double line_spacing() const { return (s[lines() - 1] - s[0]).imag() / static_cast<double>(lines() - 1); }
  /// Number of real values measured.
  double values() const { return 2.0 * static_cast<double>(lines()) * static_cast<double>(curves.size()); }
};

/// Root mean square of a curve on the lines within a factor `reach` of each line's frequency [lines].
Eigen::ArrayXd local_rms(const FitData& data, const Curve& curve, double reach);

/// Poles of the terms that stand for what lies below and above the band, one of each for a direction, as the
/// residual matrix of so many directions has that rank: README.md, "Residual terms".
Eigen::VectorXcd residual_poles(const FitData& data);

/// Directions that some entry other than an exact zero connects, directly or by others. Between two groups
/// there is nothing but zeros (or nothing was measured): they are independent structures, and each is fitted
/// alone.
struct DirectionGroup {
  std::vector<std::size_t>
      entries;  ///< indices in the frequency response: all between directions of the group
};

/// The groups in the order of their first entry.
std::vector<DirectionGroup> independent_groups(const dynamics::FrequencyResponse& frf);

/// Direction names in the order x, y, z, then as they come.
std::vector<std::string> direction_names(const dynamics::FrequencyResponse& frf);

}  // namespace stablecut::modal
