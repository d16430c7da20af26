// What the other samples say of each sample: cross-validation and outliers, in closed form. README.md,
// "Each sample against the others".
#pragma once

#include <optional>
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

struct CrossValidation {
  std::optional<double> rms_m;    ///< of deflections less their prediction from the other samples
  int samples_not_predicted = 0;  ///< alone in what they say of some compliance
};

/// Every sample predicted from all others, with the robust weights and the joints held at 0 as all samples
/// have them.
CrossValidation cross_validation(const ComplianceFit& fit);

/// How outliers are judged.
struct OutlierOptions {
  bool huber = false;              ///< the fit was robust: variances from the median of the residuals
  bool deviations_agreed = false;  ///< the stated deviations fit the residuals: they are the variances
};

/// Outliers, the farthest first. Without either option the variance is what is left without the sample.
std::vector<Outlier> outliers(const ComplianceFit& fit, const OutlierOptions& options);

}  // namespace stablecut::robot
