// Section 3 of Liu et al., which several tests of this room share.
#pragma once

#include "base/units.h"
#include "receptance/held_tool.h"

namespace stablecut::receptance::fixtures {

constexpr BeamTheory kBoth[] = {BeamTheory::kEulerBernoulli, BeamTheory::kTimoshenko};

/// 12 mm steel.
inline BeamSegment bar(double length_mm) {
  return {metres_from_mm(length_mm), 0.012, 0, 200e9, 7800, 0.3, 0.02};
}

inline ToolJoint published_joint() { return {97062227, 18.633, 95978423, 10.399}; }

/// A segment fixed at its end 2, at its end 1.
inline Receptance<2> fixed_free_receptance(const BeamSegment& segment, BeamTheory theory, double omega) {
  return SegmentMotion(segment, theory, omega).held<2>(Receptance<2>::Zero());
}

/// Largest relative difference of an entry.
inline double relative(const Eigen::Matrix2cd& a, const Eigen::Matrix2cd& b) {
  return (a - b).cwiseAbs().cwiseQuotient(b.cwiseAbs()).maxCoeff();
}

}  // namespace stablecut::receptance::fixtures
