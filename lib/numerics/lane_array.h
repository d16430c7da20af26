// Memory of vector lanes.
#pragma once

#include <cstddef>
#include <vector>

#include "numerics/lanes.h"

namespace stablecut::numerics {

/// Lanes in memory, at whole cache lines: a vector that lies across two costs twice as much. Zeros at first.
class LaneArray {
 public:
  explicit LaneArray(std::ptrdiff_t size) : lanes_(size + 1) {}
  double* data() { return lanes_.front().value; }
  const double* data() const { return lanes_.front().value; }

 private:
  struct alignas(kLanes * sizeof(double)) Aligned {
    double value[kLanes] = {};
  };
  std::vector<Aligned> lanes_;
};

}  // namespace stablecut::numerics
