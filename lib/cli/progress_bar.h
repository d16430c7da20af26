// A progress bar on standard error, when that is a terminal.
#pragma once

#include <chrono>
#include <string>

namespace stablecut::cli {

/// The time that is left when the rest goes as fast as the share that is done: `12 s left`, `3 min left`, `2
/// h 5 min left`. Empty before a fiftieth is done, of which little can be told.
std::string time_left(double share, std::chrono::duration<double> elapsed);

class ProgressBar {
 public:
  /// Silent unless standard error is a terminal and `wanted`.
  ProgressBar(std::string label, bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows the share, 0 to 1, and the time left; nothing in the first half second, then at most ten times a
  /// second.
  void show(double share);

 private:
  std::string label_;
  bool enabled_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace stablecut::cli
