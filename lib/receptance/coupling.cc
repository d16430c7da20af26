#include "receptance/coupling.h"

namespace stablecut::receptance {

BeamReceptances rigidly_coupled(const BeamReceptances& outer, const BeamReceptances& inner) {
  // The load through the joint per load at the outer part's end 1 and at the inner part's end 2.
  const Receptance<2> stiffness = (outer.r22 + inner.r11).inverse();
  const Receptance<2> from_outer = stiffness * outer.r21, from_inner = stiffness * inner.r12;
  return {outer.r11 - outer.r12 * from_outer, outer.r12 * from_inner, inner.r21 * from_outer,
          inner.r22 - inner.r21 * from_inner};
}

BeamReceptances turned_round(const BeamReceptances& part) {
  const auto mirrored = [](const Receptance<2>& h) {
    return Receptance<2>{{h(0, 0), -h(0, 1)}, {-h(1, 0), h(1, 1)}};
  };
  return {mirrored(part.r22), mirrored(part.r21), mirrored(part.r12), mirrored(part.r11)};
}

}  // namespace stablecut::receptance
