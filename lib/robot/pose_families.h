// Poses that are as good as another: what symmetry leaves free. README.md, "Families".
#pragma once

#include <optional>

#include "robot/pose_scan.h"

namespace stablecut::robot {

/// Poses that are as good as the best.
struct PoseFamily {
  enum class Kind {
    kBaseTurn,  ///< joint 1 may stand anywhere from..to: arm, tool and tool point turn together about axis 1
    kToolTurn,  ///< joint 6 may stand anywhere from..to: it only turns the tool about its own axis
    kFlippedWrist,  ///< the same tool frame with the other branch of the wrist: `angles`
    kEqual,         ///< another pose of equal score: `angles`
  };
  Kind kind;
  double from_rad = 0, to_rad = 0;
  JointAngles angles = JointAngles::Zero();
};

/// Which joints may be turned without changing the score.
struct Symmetry {
  bool base_turn =
      false;  ///< joint 1: tool axis and plane's normal along axis 1, and a load that turns with
              ///< the arm, lies along axis 1 or does not count; and a base that is alike about it
  bool tool_turn = false;  ///< joint 6: coaxial tool, a bearing alike about axis 6, and a task that does not
                           ///< feel its turn
};
Symmetry symmetry_of(const PoseScanner& scanner);

/// The interval in which joint 1 or 6 (index 0 or 5) can be turned with all of the task's intervals and
/// limits held, found in steps from where it stands.
PoseFamily family_of(const PoseScanner& scanner, const FoundPose& found, PoseFamily::Kind kind, int joint);

/// The member of the symmetry's families whose free joints stand nearest to 0, where the intervals allow it.
FoundPose central_member(const PoseScanner& scanner, FoundPose found, const Symmetry& symmetry);

/// The same tool frame with the other branch of the wrist, where the limits allow it.
std::optional<FoundPose> flipped_wrist(const PoseScanner& scanner, const FoundPose& found);

/// True for poses that differ by less than 1e-4 rad in every joint that the symmetry does not leave free.
bool same_pose(const FoundPose& a, const FoundPose& b, const Symmetry& symmetry);

}  // namespace stablecut::robot
