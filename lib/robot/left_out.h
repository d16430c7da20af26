// Groups of samples predicted from all others, without a second fit. README.md, "Each group against the
// others".
#pragma once

#include <optional>
#include <vector>

#include "robot/compliance_fit.h"
#include "robot/sample_groups.h"

namespace stablecut::robot {

/// What the samples outside a group say of it, for every group.
struct LeftOut {
  Eigen::VectorXd error;        ///< [rows] measured less predicted by the other groups, m or rad
  std::vector<bool> predicted;  ///< of each sample: false where it is alone in what it says of a spring
  /// Sum over the groups of the squared change of the compliances when the group is left out: their
  /// covariance when only groups, and not rows, are independent [Bell2002]. Of the columns of the fit.
  Eigen::MatrixXd jackknife;

  /// Root mean square of the errors of the predicted deflections, m.
  std::optional<double> rms_m(const ComplianceEquations& equations) const;
  int samples_not_predicted() const;
};

/// With the weights and the compliances held at 0 as all samples have them.
LeftOut leave_out(const ComplianceFit& fit, const SampleGroups& groups);

}  // namespace stablecut::robot
