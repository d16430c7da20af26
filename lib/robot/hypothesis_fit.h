// How well samples predict each other, with a hypothesis and without. README.md, "Hypotheses".
#pragma once

#include "robot/hypotheses.h"
#include "robot/normal_equations.h"
#include "robot/sample_groups.h"

namespace stablecut::robot {

/// What the samples of each pose are off by when the other poses predict them.
struct PosePredictions {
  Hypothesis hypothesis;     ///< with its fitted vector
  Eigen::VectorXd square;    ///< [poses] mean of the squared errors over their deviations; empty: no fit
  double rows_per_pose = 0;  ///< measured components
  double residual_m = 0;     ///< root mean square of the deflections' residuals, of all samples together
};

/// Compares hypotheses on the same samples, at most some 1000 of those given.
class HypothesisFits {
 public:
  HypothesisFits(const Robot& robot, const std::vector<LoadSample>& samples,
                 const std::array<bool, 3>& components);

  int poses() const { return poses_.count; }
  /// The residuals are rounding, or nothing is deflected.
  bool exact(const PosePredictions& fit) const { return !(fit.residual_m > kExact * size_m_); }

  /// With the elastic model that predicts best, and a vector fitted where the hypothesis has one.
  PosePredictions with(const Hypothesis& hypothesis) const;

 private:
  static constexpr double kExact = 1e-6;  // of the measured values: what normal equations leave
  struct System;

  System system_with(const Hypothesis& hypothesis) const;
  NormalEquations normal_of(const System& system, const std::vector<Eigen::Index>& columns) const;
  PosePredictions predictions(const System& system, const std::vector<Eigen::Index>& columns) const;
  void fit_vector(Hypothesis& hypothesis, System& system, const std::vector<Eigen::Index>& springs) const;

  Robot robot_;
  std::vector<LoadSample> samples_;
  std::array<bool, 3> components_;
  SampleGroups poses_;
  std::vector<Spring> springs_;                    // of the richest model
  std::vector<std::vector<Eigen::Index>> models_;  // their columns in each model
  Eigen::VectorXd per_std_;                        // [rows]
  double size_m_ = 0;                              // root mean square of the deflections
};

/// Logarithms of how much worse each pose is predicted by `one` than by `other`: of the squared errors, to
/// which the usual one of the better fit is added, so that no single pose decides.
Eigen::VectorXd log_gains(const PosePredictions& one, const PosePredictions& other);

}  // namespace stablecut::robot
