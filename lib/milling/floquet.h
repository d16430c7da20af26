// Floquet multipliers of one period, whatever the discretization.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/structure.h"

namespace stablecut::milling {

/// The cutting force's impulse around a time in the period.
struct ForceImpulse {
  double time_s = 0;
  Eigen::VectorXcd impulse;  ///< [directions], N s to a common factor
};

/// One period at one speed: the tooth period, or the revolution where the pitches differ. The state begins
/// with the real modal state (Re q, Im q); what was sensed before follows, in units of the structure's
/// displacement scale.
class PeriodMap {
 public:
  PeriodMap(const TipStructure& structure, double period_s, int passes)
      : structure_(structure), period_s_(period_s), passes_(passes) {}
  virtual ~PeriodMap() = default;
  PeriodMap(const PeriodMap&) = delete;
  PeriodMap& operator=(const PeriodMap&) = delete;

  /// The map of the state over one period at an axial depth (m), square.
  virtual Eigen::MatrixXd monodromy(double depth_m) const = 0;

  /// The forces over a period that starts with an eigenvector of the monodromy matrix and its multiplier.
  virtual std::vector<ForceImpulse> forces(double depth_m, std::complex<double> multiplier,
                                           const Eigen::VectorXcd& state) const = 0;

  const TipStructure& structure() const { return structure_; }
  double period_s() const { return period_s_; }
  int passes() const { return passes_; }  ///< teeth that pass in a period

 private:
  const TipStructure& structure_;  // outlives the map
  double period_s_;
  int passes_;
};

/// The leading multipliers of each matrix of the map (sizes may differ), those from three quarters of the
/// largest on and perhaps others; of complex pairs at least the one above the real axis. `states` as in
/// leading_eigenvalues. Throws InvalidArgument when a matrix is not finite.
std::vector<Eigen::VectorXcd> leading_multipliers(std::vector<Eigen::MatrixXd> monodromy,
                                                  Eigen::Index states);

/// The same at each depth.
std::vector<Eigen::VectorXcd> leading_multipliers(const PeriodMap& map, const std::vector<double>& depths_m);

/// Largest modulus among the multipliers, for one tooth's pass (its root where several pass in a period), at
/// one depth and at each of several.
double spectral_radius(const PeriodMap& map, double depth_m);
std::vector<double> spectral_radii(const PeriodMap& map, const std::vector<double>& depths_m);

/// How the multiplier leaves the unit circle: a complex pair, through -1, or through +1.
enum class Instability { kHopf, kFlip, kFold };

/// The largest multiplier, and how its mode shakes the tip.
struct CriticalMultiplier {
  std::complex<double> value;
  Instability kind = Instability::kHopf;
  /// Among |arg(mu) / (2 pi T) + k / T| the one with the largest tip amplitude: the force of the Floquet mode
  /// is expanded in harmonics, and each harmonic's amplitude is its receptance times its force. Hz.
  double chatter_frequency_hz = 0;
  /// Share of each of the structure's modes in the tip's motion at that frequency, along it; they add up
  /// to 1.
  Eigen::VectorXd participation;
};
/// `near` is the largest multiplier but for some rounding or a step in depth.
CriticalMultiplier critical_multiplier(const PeriodMap& map, double depth_m, std::complex<double> near);

}  // namespace stablecut::milling
