#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace stablecut {

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                  const Progress& progress) {
  std::atomic<std::size_t> next{0}, finished{0};
  std::mutex failing, showing;
  std::size_t shown = 0;
  std::size_t failed_index = count;
  std::exception_ptr failure;

  const auto show = [&] {
    if (const std::size_t done = finished; done > shown) {
      shown = done;
      progress(static_cast<double>(done) / static_cast<double>(count));
    }
  };
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (i < failed_index) {
          failed_index = i;
          failure = std::current_exception();
        }
        next = count;
      }
      ++finished;
      if (!progress) continue;
      // Whoever finds another at it goes on working.
      if (const std::unique_lock lock(showing, std::try_to_lock); lock) show();
    }
  };

  const std::size_t helpers = std::min<std::size_t>(count, std::max(threads, 1));
  std::vector<std::jthread> pool;
  try {
    for (std::size_t k = 1; k < helpers; ++k) pool.emplace_back(worker);
  } catch (const std::system_error&) {
    // As many as the system gives: what they work out is the same.
  }
  worker();
  pool.clear();  // joins
  if (progress && count > 0) show();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace stablecut
