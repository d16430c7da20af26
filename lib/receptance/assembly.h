// A tool, its joint and its holder over a band of lines: what an assembly document describes. README.md,
// section 5.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "receptance/held_tool.h"

namespace stablecut::receptance {

/// What the innermost segment of a holder stands on, or the joint itself where the holder has no segment.
enum class HolderEnd {
  kFixed,
  kFree,   ///< the holder needs a segment
  kGiven,  ///< a spindle whose receptances are known line by line, by measurement or from its modes
};

/// Holder and joint in one direction.
struct HeldBy {
  BeamChain segments;  ///< from the joint inwards
  HolderEnd end = HolderEnd::kFixed;
  std::optional<ToolJoint> joint;  ///< none: rigid
};

struct Assembly {
  Eigen::VectorXd frequency_hz;  ///< [lines], above 0, increasing
  BeamTheory theory = BeamTheory::kTimoshenko;
  BeamChain tool;                    ///< from the tip to the joint; the same in both directions
  std::array<HeldBy, 2> held;        ///< in x and in y
  std::vector<Receptance<4>> given;  ///< [lines] of the ends that are kGiven; zero for the others
  bool couples_directions = false;   ///< the cross blocks of `given` are not zero; then both ends are kGiven
  double tip_mass_kg = 0;            ///< an accelerometer on the tip
  bool axisymmetric = true;          ///< x and y are the same

  /// The receptance of the holder's face in one direction. Throws InvalidArgument for a free end without a
  /// segment.
  Receptance<2> holder(int direction, Eigen::Index line) const;
  /// Tool and holder cut at the joint, in one direction; only where directions are not coupled.
  JointPlane<2> plane(int direction, Eigen::Index line) const;
  /// The receptance at the tip.
  Receptance<4> tip(Eigen::Index line) const;
  /// Movement at one place on the tool per load at another, distances from the tip; without the tip's mass.
  Receptance<4> along_tool(Eigen::Index line, double response_m, double reference_m) const;

  /// The joints in x and in y, none: rigid.
  void set_joints(const std::array<std::optional<ToolJoint>, 2>& joints);
};

}  // namespace stablecut::receptance
