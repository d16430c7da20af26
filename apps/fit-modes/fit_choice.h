// How fit-modes fits: the options that say what is known of the modes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cli/tool.h"
#include "modal/fit.h"

namespace stablecut {

/// The decay of an exponential window, 1/s, above 0: as such or as a time constant, 0.2s. Nothing for another
/// text.
std::optional<double> parse_decay(std::string_view text);

class FitChoice {
 public:
  /// Declares --window-decay, --modes and --model; the object must stay where it is until they have been
  /// parsed.
  void declare(CLI::App& app);

  /// Decay of the exponential window that the signals went through, 1/s; 0 without one.
  double window_decay_per_s() const { return window_decay_per_s_; }
  modal::FitOptions options(Progress progress) const;

 private:
  void take_window_decay(const std::string& text);
  void take_modes(const std::string& text);

  double window_decay_per_s_ = 0;
  std::optional<int> modes_;
  std::string model_;
};

}  // namespace stablecut
