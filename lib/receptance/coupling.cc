#include "receptance/coupling.h"

#include <Eigen/LU>

namespace stablecut {

Eigen::Matrix2cd ToolJoint::receptance(double omega) const {
  Eigen::Matrix2cd result = Eigen::Matrix2cd::Zero();
  result(0, 0) = 1.0 / std::complex<double>(k1, omega * c1);
  result(1, 1) = 1.0 / std::complex<double>(k2, omega * c2);
  return result;
}

Eigen::Matrix2cd coupled_tip(const BeamReceptances& tool, const Eigen::Matrix2cd& holder) {
  return tool.r11 - tool.r12 * (tool.r22 + holder).inverse() * tool.r21;
}

}  // namespace stablecut
