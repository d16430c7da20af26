#include "receptance/tip_line.h"

#include <cmath>
#include <limits>

namespace stablecut::receptance {

using Complex = std::complex<double>;

Tip tip_of(const TipLine& n, const ToolJoint& joint) {
  // (diag(K1, K2) + z)^-1 by cofactors; the opening of the joint per force at the tip, and the tip's
  // deflection per load that opens it.
  const Complex s1 = n.stiffness(joint.k1, joint.c1) + n.z11, s2 = n.stiffness(joint.k2, joint.c2) + n.z22;
  const Complex inverse = 1.0 / (s1 * s2 - n.z12 * n.z21);
  const Complex open1 = (s2 * n.r1 - n.z12 * n.r2) * inverse, open2 = (s1 * n.r2 - n.z21 * n.r1) * inverse;
  const Complex back1 = (n.l1 * s2 - n.l2 * n.z21) * inverse, back2 = (n.l2 * s1 - n.l1 * n.z12) * inverse;
  return {n.rigid + n.l1 * open1 + n.l2 * open2, -back1 * open1, -back2 * open2};
}

TipLines thinned(const TipLines& lines, Eigen::Index most) {
  const Eigen::Index size = lines.size();
  const Eigen::Index stride = (size + most - 1) / most;
  TipLines result;
  for (Eigen::Index i = 0; i < size; i += stride) result.push_back(lines[i]);
  return result;
}

double residual_of(const TipLine& line, const Tip& tip, JointObjective objective, Complex& residual) {
  residual = objective == JointObjective::kAmplitude ? std::abs(tip.h) - std::abs(line.measured)
                                                     : tip.h - line.measured;
  residual *= line.weight;
  return std::norm(residual);
}

double cost_of(const TipLines& lines, const ToolJoint& joint, JointObjective objective) {
  double sum = 0;
  Complex residual;
  for (const TipLine& line : lines) sum += residual_of(line, tip_of(line, joint), objective, residual);
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

double middle_omega(const TipLines& lines) { return std::sqrt(lines.front().omega * lines.back().omega); }

}  // namespace stablecut::receptance
