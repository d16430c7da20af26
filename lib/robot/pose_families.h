// Poses that are as good as another: what symmetry leaves free.
#pragma once

#include <optional>

#include "robot/pose_scan.h"

namespace stablecut::robot {

/// Poses that are as good as the best.
struct PoseFamily {
  enum class Kind {
    kBaseTurn,  ///< joint 1 may stand anywhere from..to: the whole robot turns about it, tool and plane point
                ///< with it
    kToolTurn,  ///< joint 6 may stand anywhere from..to: it only turns the tool
    kFlippedWrist,  ///< the same tool frame with joints 4 to 6 the other way round: `angles`
    kEqual,         ///< another pose of equal score: `angles`
  };
  Kind kind;
  double from_rad = 0, to_rad = 0;
  JointAngles angles = JointAngles::Zero();
};

/// What may be turned without changing the score.
struct Symmetry {
  bool base_turn = false;  ///< joint 1: vertical tool, horizontal plane, a load that does not mind
  bool tool_turn = false;  ///< joint 6: coaxial tool, an index that does not see its turn
};
Symmetry symmetry_of(const PoseScanner& scanner);

/// As far as joint 1 or 6 can be turned either way with all intervals and limits of the task held.
PoseFamily family_of(const PoseScanner& scanner, const FoundPose& found, PoseFamily::Kind kind, int joint);

/// The member of the families that a symmetry makes whose free joints stand nearest to 0, where the intervals
/// allow it.
FoundPose centred(const PoseScanner& scanner, FoundPose found, const Symmetry& symmetry);

/// The same tool frame with the wrist the other way round, where the limits allow it.
std::optional<FoundPose> flipped(const PoseScanner& scanner, const FoundPose& found);

/// True for poses nearer than 1e-4 rad in every joint that the symmetry does not leave free.
bool same_pose(const FoundPose& a, const FoundPose& b, const Symmetry& symmetry);

}  // namespace stablecut::robot
