// What a simulated cut shows: whether it settles, what it leaves, how it chatters. README.md, "Simulation".
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "milling/simulated_growth.h"

namespace stablecut::milling {

struct SimulationRequest {
  double revolutions_per_s = 0;
  double depth_m = 0;
  std::optional<int> passes;     ///< teeth to follow; none: until what was there at the start is gone
  std::optional<int> per_pitch;  ///< steps; none: as many as the growth needs
  /// Begins at rest in the full cut, which is a blow; else on the motion that repeats, pushed aside.
  bool from_rest = false;
  double push = 1e-4;  ///< of that motion: small, since the linear verdict is one about small deviations
  ToothPath path = ToothPath::kCircle;  ///< of the motion; the growth is that of circles
};

struct SimulationResult {
  SimulatedGrowth growth;
  bool stable() const { return growth.per_tooth < 1; }
  /// The growth's error leaves open on which side of 1 it is.
  bool is_open() const { return !(std::abs(growth.per_tooth - 1) > growth.error * growth.per_tooth); }

  /// The motion that repeats while teeth are in contact as those of a rigid tool are is one of this cut. Else
  /// it would leave a tooth without its chip, or give one to a tooth that has none, and the growth says
  /// nothing about the motion that takes its place.
  bool keeps_contact = true;

  int steps_per_tooth = 0;  ///< of the mean pitch
  int passes = 0;           ///< teeth followed, from rest in the cut
  bool settled = true;      ///< the motion at the end repeats with the teeth
  /// The tip has gone a decimetre away: the modes are not those of a structure that holds a
  /// tool. Followed to there; only the growth says anything.
  bool ran_away = false;
  /// The tip in the cut's frame, m, whenever a tooth's tip left the cut: the last teeth.
  std::vector<Eigen::Vector2d> samples_m;
  /// Over the last revolution: share of the chip of a rigid tool that found no contact.
  double without_contact = 0;
  ForceParts mean_force_n = ForceParts::Zero();
  double peak_force_n = 0;      ///< of its length, over the last revolutions
  double peak_vibration_m = 0;  ///< largest distance of the tip from its mean
  Eigen::Vector2d mean_deflection_m = Eigen::Vector2d::Zero();
  /// Where the last revolution left the wall, as SurfacePoint's; none where no tooth touches one.
  std::optional<double> location_error_m;
  /// Where it has not settled: the largest part of the motion that does not repeat with the teeth.
  std::optional<double> chatter_frequency_hz;
  double chatter_amplitude_m = 0;
};

/// The feed must be above 0. Throws NoAnswer as simulated_growth().
SimulationResult simulate_cut(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                              const SimulationRequest& request);

}  // namespace stablecut::milling
