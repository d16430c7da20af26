// Floquet multipliers of one tooth period, whatever the discretization.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/structure.h"

namespace stablecut {

/// A time in the tooth period at which the cutting force f = depth * drive * (u - u_delayed) is sampled,
/// where u is what the cut senses there: the tip displacement, or a single tooth's chip thickness.
struct ForceSample {
  double time_s = 0;
  double weight_s = 0;    ///< quadrature weight over the period
  Eigen::MatrixXd drive;  ///< [directions x sensed], N/m2
};

/// One tooth period at one speed. The state is the real modal state (Re q, Im q), then for each force sample
/// what was sensed one period before, in units of the structure's displacement scale.
class PeriodMap {
 public:
  PeriodMap(const TipStructure& structure, double period_s) : structure_(structure), period_s_(period_s) {}
  virtual ~PeriodMap() = default;
  PeriodMap(const PeriodMap&) = delete;
  PeriodMap& operator=(const PeriodMap&) = delete;

  /// The map of the state over one tooth period at an axial depth (m), square.
  virtual Eigen::MatrixXd monodromy(double depth_m) const = 0;

  const TipStructure& structure() const { return structure_; }
  double period_s() const { return period_s_; }
  const std::vector<ForceSample>& samples() const { return samples_; }

 protected:
  std::vector<ForceSample> samples_;

 private:
  const TipStructure& structure_;  // outlives the map
  double period_s_;
};

/// The leading multipliers at each depth, those from three quarters of the largest on and perhaps others; of
/// complex pairs at least the one above the real axis. Throws InvalidArgument when a map is not finite.
std::vector<Eigen::VectorXcd> leading_multipliers(const PeriodMap& map, const std::vector<double>& depths_m);

/// Largest modulus among the multipliers, at one depth and at each of several.
double spectral_radius(const PeriodMap& map, double depth_m);
std::vector<double> spectral_radii(const PeriodMap& map, const std::vector<double>& depths_m);

/// How the multiplier leaves the unit circle: a complex pair, through -1, or through +1.
enum class Instability { kHopf, kFlip, kFold };

/// The largest multiplier, and the frequency at which its mode shakes the tip most.
struct CriticalMultiplier {
  std::complex<double> value;
  Instability kind = Instability::kHopf;
  /// Among |arg(mu) / (2 pi T) + k / T| the one with the largest tip amplitude: the force of the Floquet mode
  /// is expanded in harmonics, and each harmonic's amplitude is its receptance times its force. Hz.
  double chatter_frequency_hz = 0;
};
CriticalMultiplier critical_multiplier(const PeriodMap& map, double depth_m);

}  // namespace stablecut
