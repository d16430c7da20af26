// How a pose yields under a cut, and what of it shows on the part. README.md, "The deflection under a cut".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/joint_stiffness.h"
#include "robot/stiffness_index.h"

namespace stablecut::robot {

struct CutDeflection {
  /// With its standard deviation, where anything is known of it.
  struct Value {
    double m = 0;
    std::optional<double> std_m;
  };

  Eigen::Matrix3d frame;         ///< cut_frame() at the pose, base frame
  std::array<Value, 3> mean;     ///< along its axes, under the mean force
  std::array<Value, 3> largest;  ///< sizes of the components, each the largest of the turn

  /// Positive where material is left.
  struct Wall {
    bool left = true;
    Value mean_error;            ///< of a tool that yields to the mean alone
    std::optional<Value> error;  ///< while teeth touch it; along the edge the largest in size
  };
  std::vector<Wall> walls;
};

/// `task` has a cut. What the discrepancy adds to a component is that of the whole deflection: nothing is
/// known of its direction.
CutDeflection cut_deflection(const RobotPose& pose, const StiffnessTask& task, const Elasticity& elasticity,
                             const ElasticityErrors& errors);

}  // namespace stablecut::robot
