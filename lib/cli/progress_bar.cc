#include "cli/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace stablecut::cli {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kSilence{500};
constexpr milliseconds kBetween{100};
constexpr int kWidth = 40;

}  // namespace

ProgressBar::ProgressBar(std::string label, bool wanted)
    : label_(std::move(label)),
      enabled_(wanted && isatty(STDERR_FILENO) == 1),
      started_(std::chrono::steady_clock::now()),
      last_(started_) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(double share) {
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - started_ < kSilence || now - last_ < kBetween) return;
  last_ = now;
  drawn_ = true;
  const int filled = std::clamp(static_cast<int>(share * kWidth), 0, kWidth);
  std::fprintf(stderr, "\r%s [%.*s%*s] %3d %%", label_.c_str(), filled,
               "########################################", kWidth - filled, "",
               static_cast<int>(share * 100));
}

}  // namespace stablecut::cli
