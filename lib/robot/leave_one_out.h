// Samples that are far from what the other samples predict. README.md, "Each sample against the others".
#pragma once

#include <vector>

#include "robot/compliance_fit.h"

namespace stablecut::robot {

/// A sample that lies farther from what the others predict than chance explains.
struct Outlier {
  int sample = 0;
  double residual_m = 0;  ///< length of the residual deflection
  double deviations = 0;  ///< how far it lies from what the other samples predict, in their deviations: RMS
                          ///< of its rows, or its worst row
  double weight = 1;      ///< what the robust loss left of it
};

/// How outliers are judged.
struct OutlierOptions {
  bool huber = false;              ///< the fit was robust: variances from the median of the residuals
  bool deviations_agreed = false;  ///< the stated deviations fit the residuals: they are the variances
};

/// Outliers, the farthest first. Without either option the variance is what is left without the sample.
std::vector<Outlier> outliers(const ComplianceFit& fit, const OutlierOptions& options);

}  // namespace stablecut::robot
