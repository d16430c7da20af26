// The tip of a held tool at one line, as the joint's stiffnesses make it.
#pragma once

#include <complex>
#include <vector>

#include "receptance/joint_identification.h"

namespace stablecut::receptance {

/// What a line's tip is made of (displacement per force), and its measured value, m/N.
struct TipLine {
  double omega;
  std::complex<double> measured;
  double weight;  ///< of the residual
  std::complex<double> rigid, l1, l2, r1, r2, z11, z12, z21, z22;

  TipLine(const JointPlane<2>& plane, double omega_rad_per_s, std::complex<double> h)
      : omega(omega_rad_per_s),
        measured(h),
        weight(1),
        rigid(plane.rigid_tip(0, 0)),
        l1(plane.of_opening(0, 0)),
        l2(plane.of_opening(0, 1)),
        r1(plane.transmitted(0, 0)),
        r2(plane.transmitted(1, 0)),
        z11(plane.stiffness(0, 0)),
        z12(plane.stiffness(0, 1)),
        z21(plane.stiffness(1, 0)),
        z22(plane.stiffness(1, 1)) {}

  /// The same with deflection and slope of the joint in each other's places.
  TipLine exchanged() const {
    TipLine line = *this;
    std::swap(line.l1, line.l2);
    std::swap(line.r1, line.r2);
    std::swap(line.z11, line.z22);
    std::swap(line.z12, line.z21);
    return line;
  }
  std::complex<double> stiffness(double k, double c) const { return {k, omega * c}; }
};

/// The tip for joint stiffnesses K1, K2, and its derivatives in them.
struct Tip {
  std::complex<double> h, by_k1, by_k2;
};
Tip tip_of(const TipLine& line, const ToolJoint& joint);

using TipLines = std::vector<TipLine>;

/// At most that many lines, evenly spaced.
TipLines thinned(const TipLines& lines, Eigen::Index most);

/// Geometric middle of the band, rad/s.
double middle_of(const TipLines& lines);

/// The weighted residual of a line; an amplitude's is real. Returns its square.
double residual_of(const TipLine& line, const Tip& tip, JointObjective objective,
                   std::complex<double>& residual);

/// Sum of the squares over the lines; infinite where the tip is not finite.
double cost_of(const TipLines& lines, const ToolJoint& joint, JointObjective objective);

}  // namespace stablecut::receptance
