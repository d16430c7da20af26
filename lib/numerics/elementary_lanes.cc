#include "numerics/elementary_lanes.h"

namespace stablecut::numerics {

STABLECUT_WIDE void sines_and_cosines(const double angle[kLanes], double sine[kLanes],
                                      double cosine[kLanes]) {
  for (std::ptrdiff_t half = 0; half < kLanes; half += kFourLanes) {
    FourLanes s, c;
    sine_and_cosine(load_lanes<FourLanes>(angle + half), s, c);
    store_lanes(s, sine + half);
    store_lanes(c, cosine + half);
  }
}

}  // namespace stablecut::numerics
