#pragma once

#include <cstddef>
#include <functional>

#include "base/progress.h"

namespace stablecut {

/// Calls `work(i)` once for every i in [0, count), on `threads` threads (at least 1), each index on any of
/// them. The result cannot depend on the number of threads as long as work(i) writes only to what belongs to
/// i. The first exception (least index among those seen) is thrown again after all threads have stopped.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                  const Progress& progress = {});

}  // namespace stablecut
