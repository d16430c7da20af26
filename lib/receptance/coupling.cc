#include "receptance/coupling.h"

#include <Eigen/LU>

namespace stablecut {

Eigen::Matrix2cd ToolJoint::receptance(double omega) const {
  Eigen::Matrix2cd result = Eigen::Matrix2cd::Zero();
  result(0, 0) = 1.0 / std::complex<double>(k1, omega * c1);
  result(1, 1) = 1.0 / std::complex<double>(k2, omega * c2);
  return result;
}

BeamReceptances joined(const BeamReceptances& outer, const BeamReceptances& inner) {
  const Eigen::Matrix2cd between = (outer.r22 + inner.r11).inverse();
  return {outer.r11 - outer.r12 * between * outer.r21, outer.r12 * between * inner.r12,
          inner.r21 * between * outer.r21, inner.r22 - inner.r21 * between * inner.r12};
}

Eigen::Matrix2cd coupled_tip(const BeamReceptances& tool, const Eigen::Matrix2cd& holder,
                             const std::optional<Eigen::Matrix2cd>& joint) {
  Eigen::Matrix2cd between = tool.r22 + holder;
  if (joint) between += *joint;
  return tool.r11 - tool.r12 * between.inverse() * tool.r21;
}

}  // namespace stablecut
