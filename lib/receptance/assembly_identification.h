// The joints of an assembly from frequency responses measured at its tip, in x and in y.
#pragma once

#include <array>
#include <optional>

#include "dynamics/frequency_response.h"
#include "receptance/assembly.h"
#include "receptance/joint_identification.h"

namespace stablecut::receptance {

/// The measured receptances xx and yy at the tip; null where there is none.
using MeasuredTip = std::array<const dynamics::FrequencyResponseEntry*, 2>;

/// The two entries among those of a measurement, which must outlive them.
MeasuredTip tip_entries(const dynamics::FrequencyResponse& measured);

struct IdentifiedJoints {
  std::array<std::optional<JointEstimate>, 2> estimate;  ///< in x and in y; none where nothing was measured
  bool one_for_both = false;  ///< x and y are the same, in assembly and measurement
};

/// The joint in each measured direction. The tip is a receptance on the assembly's lines, and the assembly's
/// directions are not coupled. Throws as identify_joint.
IdentifiedJoints identify_joints(const Assembly& assembly, const MeasuredTip& tip, const JointBounds& bounds,
                                 JointObjective objective, int threads);

}  // namespace stablecut::receptance
