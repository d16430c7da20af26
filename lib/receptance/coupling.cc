#include "receptance/coupling.h"

namespace stablecut::receptance {

BeamReceptances joined(const BeamReceptances& outer, const BeamReceptances& inner) {
  // The load through the joint per load at the outer and at the inner end.
  const Receptance<2> soft = (outer.r22 + inner.r11).inverse();
  const Receptance<2> from_outer = soft * outer.r21, from_inner = soft * inner.r12;
  return {outer.r11 - outer.r12 * from_outer, outer.r12 * from_inner, inner.r21 * from_outer,
          inner.r22 - inner.r21 * from_inner};
}

}  // namespace stablecut::receptance
