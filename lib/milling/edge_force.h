// The force of whole edges over a turn: at each angle, its harmonics and its peak. README.md, "The force of a
// cut".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/cutting_force.h"

namespace stablecut::milling {

/// The force at one depth; a helical edge is straight ones one after the other.
class EdgeForce {
 public:
  /// Where helices differ: throws NoAnswer where edges meet within the depth, InvalidArgument with runout.
  EdgeForce(const Cutter& cutter, const CuttingLoad& load, double depth_m);

  double period_rad() const { return cycle_.period_rad; }
  /// N, at a turn; where a straight tooth enters or leaves, after it.
  ForceParts at(double turn_rad) const { return at(turn_rad, turn_rad); }
  /// The same as it is on the side of `beside_rad`, with no break in between: straight teeth jump into cut.
  ForceParts at(double turn_rad, double beside_rad) const;
  /// Turns of a period at which any part of an edge begins or ends to cut, each once, in order.
  const std::vector<double>& breaks() const { return breaks_; }
  /// How far it is from a turn to the next break, or back to the one before; a period where there is none.
  double room(double turn_rad, bool after) const;
  /// By how much the top of the edge lags; 0 for a straight one, and where helices differ.
  double lag_rad() const { return lag_rad_; }
  ForceParts mean() const { return depth_m_ * cycle_.mean(); }
  /// Coefficient of exp(i order 2 pi turn / period) in the force's Fourier series.
  Eigen::Matrix<std::complex<double>, 4, 1> harmonic(int order) const;

  struct Peak {
    double turn_rad = 0, force_n = 0, along_n = 0;  ///< the largest length; the largest sum along the cut
  };
  Peak peak() const;

 private:
  // One of the edges whose helices differ: a chip that changes linearly over the depth, turns counted from
  // the tip.
  struct Edge {
    double behind_rad, lag_rad;  // of the tip; of the top
    TurningArc<4> at_tip, at_top;

    TurningArc<4> at(double share) const;
    ForceParts of_part(double from, double to, double turn_rad) const;
  };

  double in_period(double turn_rad) const;
  void set_edges(const Cutter& cutter, const CuttingLoad& load);
  ForceParts of_edges(double turn_rad, double beside_rad) const;
  void add_break(double turn_rad, double lag_rad);

  ForceCycle cycle_;
  std::vector<Edge> edges_;  // empty where helices are alike
  double depth_m_, lag_rad_;
  std::vector<double> breaks_;
};

}  // namespace stablecut::milling
