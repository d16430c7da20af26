// The tip's deflection per force at one line, as a function of the joint. README.md, section 11.
#pragma once

#include <complex>
#include <utility>
#include <vector>

#include "receptance/joint_identification.h"

namespace stablecut::receptance {

/// One line: the measured tip and what JointPlane says of it. With the joint's dynamic stiffnesses K1 and K2,
///   tip = rigid + (l1 l2) (diag(K1, K2) + z)^-1 (r1 r2)^T.
struct TipLine {
  double omega;                   ///< rad/s
  std::complex<double> measured;  ///< m/N
  double weight;                  ///< of the residual
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

  /// The same line with K1 and K2 in each other's places.
  TipLine exchanged() const {
    TipLine line = *this;
    std::swap(line.l1, line.l2);
    std::swap(line.r1, line.r2);
    std::swap(line.z11, line.z22);
    std::swap(line.z12, line.z21);
    return line;
  }
  /// The dynamic stiffness k + i w c.
  std::complex<double> stiffness(double k, double c) const { return {k, omega * c}; }
};

using TipLines = std::vector<TipLine>;

/// The tip with a joint, and its derivatives by K1 and K2.
struct Tip {
  std::complex<double> h, by_k1, by_k2;
};
Tip tip_of(const TipLine& line, const ToolJoint& joint);

/// Every n-th line, so that at most `most` are left.
TipLines thinned(const TipLines& lines, Eigen::Index most);

/// Geometric mean of the first and the last angular frequency, rad/s.
double middle_omega(const TipLines& lines);

/// Sets the weighted residual of a line, real for amplitudes. Returns its square.
double residual_of(const TipLine& line, const Tip& tip, JointObjective objective,
                   std::complex<double>& residual);

/// The objective: the sum of the squares over the lines; infinite where a tip is not finite.
double cost_of(const TipLines& lines, const ToolJoint& joint, JointObjective objective);

}  // namespace stablecut::receptance
