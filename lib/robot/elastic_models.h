// Which elastic model the data support: nested models compared by what they predict. README.md, "Models".
#pragma once

#include <optional>
#include <vector>

#include "robot/compliance_fit.h"
#include "robot/sample_groups.h"

namespace stablecut::robot {

struct ModelTrial {
  ElasticModel model = ElasticModel::kJointsOnly;
  int springs = 0;                    ///< of the model
  double residual_rms_m = 0;          ///< of the deflections, with all samples
  std::optional<double> block_rms_m;  ///< of deflections predicted from the other blocks
};

struct ModelChoice {
  std::vector<ModelTrial> trials;  ///< the simplest first
  ElasticModel best = ElasticModel::kJointsOnly;
  /// Probability that noise alone makes the richest model fit as much better than the one with joints only;
  /// 1 where there are too few samples to tell. For independent normal errors.
  double joints_suffice_tail = 1;
};

/// `equations` of the richest model. Each model is fitted without one block after the other, compliances not
/// below 0, and predicts that block. A richer one is chosen when it predicts the blocks better, by more than
/// chance: by a one-sided t test over the blocks, or by the F test of nested models.
ModelChoice compare_models(const Robot& robot, const ComplianceEquations& equations,
                           const SampleGroups& blocks);

}  // namespace stablecut::robot
