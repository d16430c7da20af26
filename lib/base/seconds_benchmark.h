// Times of work, by the clock on the wall, for benchmarks.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>

namespace stablecut {

inline double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The shortest of several runs: other work on the machine only adds.
inline double least_seconds(const std::function<void()>& work, int runs = 3) {
  double least = seconds(work);
  for (int run = 1; run < runs; ++run) least = std::min(least, seconds(work));
  return least;
}

}  // namespace stablecut
