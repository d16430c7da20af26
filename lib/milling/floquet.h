// Floquet multipliers of one period [Floquet1883], whatever the discretization. README.md, "Multipliers".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/structure.h"

namespace stablecut::milling {

/// A part of the cutting force's integral over a period: force times quadrature weight at a time.
struct ForceImpulse {
  double time_s = 0;
  Eigen::VectorXcd impulse;  ///< [directions], N s times a factor that all share
};

/// The motion over one period at one speed: the tooth period, or the revolution where the pitches differ. Its
/// state begins with the real modal state (Re q, Im q); displacements that the surface keeps follow, in units
/// of the structure's displacement scale.
class PeriodMap {
 public:
  PeriodMap(const TipStructure& structure, double period_s, int passes)
      : structure_(structure), period_s_(period_s), passes_(passes) {}
  virtual ~PeriodMap() = default;
  PeriodMap(const PeriodMap&) = delete;
  PeriodMap& operator=(const PeriodMap&) = delete;

  /// The map of the state over one period at an axial depth (m), square.
  virtual Eigen::MatrixXd monodromy(double depth_m) const = 0;

  /// The forces over a period that starts in an eigenvector of the monodromy matrix, to its multiplier.
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

/// The leading multipliers of each of some matrices (of sizes that may differ): those from numerics::kLeading
/// times the largest modulus on, and perhaps others; of a complex pair at least the one above the real axis.
/// `states` are the first rows of the matrices, those of the modal state. Throws InvalidArgument when a
/// matrix is not finite.
std::vector<Eigen::VectorXcd> leading_multipliers(std::vector<Eigen::MatrixXd> monodromy,
                                                  Eigen::Index states);

/// Those of a map at each depth.
std::vector<Eigen::VectorXcd> leading_multipliers(const PeriodMap& map, const std::vector<double>& depths_m);

/// The largest modulus among the multipliers at one depth, and at each of several. Where several teeth pass
/// in a period it is the root for one tooth.
double spectral_radius(const PeriodMap& map, double depth_m);
std::vector<double> spectral_radii(const PeriodMap& map, const std::vector<double>& depths_m);

/// How the multiplier leaves the unit circle: a complex pair, through -1, or through +1.
enum class Instability { kHopf, kFlip, kFold };

/// How a motion on the unit circle shakes the tip. README.md, "Chatter frequency".
struct Chatter {
  Instability kind = Instability::kHopf;
  /// The one of the frequencies |arg(mu) / (2 pi T) + k / T| at which the tip moves most, Hz [Dombovari2010].
  double frequency_hz = 0;
  /// [modes] Share of each mode in the tip's motion at that frequency; they add up to 1.
  Eigen::VectorXd participation;
};
/// Of a motion with a multiplier on the unit circle, from its forces over a period.
Chatter chatter_of(const TipStructure& structure, double period_s, std::complex<double> multiplier,
                   const std::vector<ForceImpulse>& forces);
/// Of the map at a depth; `near` is a value close to the multiplier that is wanted.
Chatter chatter_at(const PeriodMap& map, double depth_m, std::complex<double> near);

}  // namespace stablecut::milling
