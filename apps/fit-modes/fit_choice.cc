#include "fit_choice.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cli/exit_status.h"
#include "report.h"

namespace stablecut {

std::optional<double> parse_decay(std::string_view text) {
  const bool is_time = text.ends_with('s');
  const auto number = parse_number(text.substr(0, text.size() - (is_time ? 1 : 0)));
  if (!number || !(*number > 0) || !std::isfinite(1 / *number)) return std::nullopt;
  return is_time ? 1 / *number : *number;
}

void FitChoice::declare(CLI::App& app) {
  app.add_option_function<std::string>(
         "--window-decay", [this](const std::string& text) { take_window_decay(text); },
         "Decay of the exponential window that the signals went through, 1/s (5), or its time constant "
         "(0.2s): its damping is taken off the modes")
      ->type_name("DECAY");
  app.add_option_function<std::string>(
         "--modes", [this](const std::string& text) { take_modes(text); },
         "Number of modes to keep (default: auto, as many as stand out of the noise)")
      ->type_name("auto|N");
  cli::add_choice_option(app, "--model", model_, "nonsymmetric|symmetric|proportional|best",
                         "What is assumed of a mode's vectors (default: nonsymmetric); best: what Schwarz' "
                         "criterion prefers");
}

void FitChoice::take_window_decay(const std::string& text) {
  const auto decay = parse_decay(text);
  cli::refuse_if(!decay,
                 "--window-decay: " + text + ": expected a decay in 1/s above 0, or a time constant as 0.2s");
  window_decay_per_s_ = *decay;
}

void FitChoice::take_modes(const std::string& text) {
  if (text == "auto") return;
  modes_ = parse_integer(text);
  cli::refuse_if(!modes_ || *modes_ < 1, "--modes: " + text + ": expected auto or a number of modes");
}

modal::FitOptions FitChoice::options(Progress progress) const {
  modal::FitOptions options;
  options.modes = modes_;
  options.progress = std::move(progress);
  const auto name = std::find(kModelNames.begin(), kModelNames.end(), model_);
  if (model_ == "best") options.model = std::nullopt;
  if (name != kModelNames.end()) options.model = static_cast<modal::ModeModel>(name - kModelNames.begin());
  return options;
}

}  // namespace stablecut
