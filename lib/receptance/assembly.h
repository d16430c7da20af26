// A tool on its holder over a band of lines: what an assembly document describes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "receptance/held_tool.h"

namespace stablecut::receptance {

/// What the innermost segment of a holder stands on; without segments, what the joint does.
enum class HolderEnd {
  kFixed,
  kFree,   ///< needs a segment
  kGiven,  ///< receptances known line by line: measured, or of modes
};

/// One direction's holder and joint.
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
  std::vector<Receptance<4>> given;  ///< [lines] of ends that are kGiven; zero for the others
  bool couples_directions = false;   ///< given's cross blocks are not zero; then both ends are kGiven
  double tip_mass_kg = 0;            ///< a sensor at the tip
  bool axisymmetric = true;          ///< x and y are the same

  /// What holds the tool at the joint, from within. Throws InvalidArgument for a free end without a segment.
  Receptance<2> holder(int direction, Eigen::Index line) const;
  /// Of one direction of an assembly whose directions are not coupled.
  JointPlane<2> plane(int direction, Eigen::Index line) const;
  /// At the tip.
  Receptance<4> tip(Eigen::Index line) const;
  /// Movement at a distance from the tip per load at another, without a mass on the tip.
  Receptance<4> along_tool(Eigen::Index line, double response_m, double reference_m) const;
};

}  // namespace stablecut::receptance
