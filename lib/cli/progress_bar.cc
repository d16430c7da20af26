#include "cli/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace stablecut::cli {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kSilence{500};
constexpr milliseconds kBetween{100};
constexpr int kWidth = 40;
constexpr double kLeastShare = 0.02;

}  // namespace

std::string time_left(double share, std::chrono::duration<double> elapsed) {
  if (!(share >= kLeastShare) || share > 1) return "";
  const auto seconds = static_cast<long>(std::ceil(elapsed.count() * (1 - share) / share));
  const long minutes = (seconds + 30) / 60;
  if (seconds < 60) return std::to_string(seconds) + " s left";
  if (minutes < 60) return std::to_string(minutes) + " min left";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min left";
}

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
  const std::string left = time_left(share, now - started_);
  std::fprintf(stderr, "\r%s [%.*s%*s] %3d %%%s%s\033[K", label_.c_str(), filled,
               "########################################", kWidth - filled, "", static_cast<int>(share * 100),
               left.empty() ? "" : ", ", left.c_str());
}

}  // namespace stablecut::cli
