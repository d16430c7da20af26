#include "fit_choice.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "cli/exit_status.h"
#include "document/measured/given_poles.h"
#include "fit_values.h"
#include "report.h"

namespace stablecut {

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
  cli::add_repeated_option(app, "--exclude", "LO:HI,...",
                           "Leave the lines in these bands (Hz) out of the fit",
                           [this](const std::string& text) { add_bands(text, excluded_); });
  app.add_option(
         "--poles", poles_path_,
         "Modes at the poles of this modal table, or of columns frequency_hz,damping_ratio; as many, none "
         "looked for")
      ->type_name("FILE");
  cli::add_choice_option(
      app, "--poles-are", poles_are_, "starts|fixed",
      "The refinement begins at the poles of --poles (default), or leaves them as they are");
  app.add_flag("--shared-poles", share_poles_,
               "Where nothing was measured across (xx and yy alone): one pole for modes whose poles agree");
  app.add_flag(
      "--residuals", residual_terms_,
      "What lies outside the band is one fixed term below and one above it for each direction: --modes "
      "and --poles are those in the band");
  for (const char* name : {"--window-decay", "--modes", "--model", "--exclude", "--poles", "--poles-are",
                           "--shared-poles", "--residuals"})
    declared_.push_back(app.get_option(name));
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

void FitChoice::check() const {
  cli::refuse_if(modes_ && !poles_path_.empty(), "--modes: expected without --poles, which says how many");
  cli::refuse_if(share_poles_ && poles_are_ == "fixed", "--shared-poles: expected without --poles-are fixed");
  cli::refuse_if(!poles_are_.empty() && poles_path_.empty(), "--poles-are: expected only with --poles");
}

void FitChoice::take_poles(const document::Input& input) { poles_ = document::given_poles(input); }

dynamics::FrequencyResponse FitChoice::lines_to_fit(const dynamics::FrequencyResponse& measured,
                                                    const modal::TapReport& tap, bool band_chosen) const {
  const dynamics::FrequencyResponse usable = modal::usable_part(measured, tap, band_chosen);
  std::vector<Eigen::Index> left_out;
  for (Eigen::Index i = 0; i < usable.frequency_hz.size(); ++i) {
    const double hz = usable.frequency_hz[i];
    if (std::any_of(excluded_.begin(), excluded_.end(),
                    [&](const Range& band) { return hz >= band.from && hz <= band.to; }))
      left_out.push_back(i);
  }
  if (!excluded_.empty() && static_cast<Eigen::Index>(left_out.size()) == usable.frequency_hz.size())
    throw InvalidArgument("no lines left: expected some outside --exclude");
  return dynamics::without_lines(usable, left_out);
}

FittedLines FitChoice::fit(const dynamics::FrequencyResponse& measured, modal::TapReport tap,
                           bool band_chosen, const Progress& progress) const {
  FittedLines result;
  const auto run = [&] {
    result.used = lines_to_fit(measured, tap, band_chosen);
    modal::FitOptions chosen = options(progress);
    chosen.falls_to_hz = tap.falls_to_hz;
    result.fit = modal::fit_modes(result.used, chosen);
  };
  run();
  const bool answered = modal::has_answer(result.fit);
  const auto& findings = result.fit.findings;
  const bool falls = std::any_of(findings.begin(), findings.end(), [](const modal::FitFinding& finding) {
    return finding.kind == modal::FitFindingKind::kLowEndLeft;
  });
  const double from_hz = std::max(falls ? tap.falls_to_hz : 0.0, answered ? 0.0 : tap.doubtful_to_hz);
  if (band_chosen || from_hz <= tap.usable_from_hz) return result;
  FittedLines with_low_end = std::move(result);
  result.left_out_hz = tap.usable_from_hz = from_hz;
  result.low_end_falls = falls;
  run();
  return answered && !modal::has_answer(result.fit) ? std::move(with_low_end) : std::move(result);
}

void FitChoice::add_to_report(document::Json& fit) const {
  if (!excluded_.empty()) {
    fit["excluded_hz"] = document::Json::array();
    for (const Range& band : excluded_) fit["excluded_hz"].push_back({band.from, band.to});
  }
  if (residual_terms_) fit["residuals"] = true;
  if (!poles_.empty()) fit["poles"] = poles_are_ == "fixed" ? "fixed" : "starts";
}

modal::FitOptions FitChoice::options(Progress progress) const {
  modal::FitOptions options;
  options.modes = modes_;
  options.progress = std::move(progress);
  options.poles = poles_;
  options.share_poles = share_poles_;
  options.residual_terms = residual_terms_;
  options.poles_fixed = poles_are_ == "fixed";
  const auto name = std::find(kModelNames.begin(), kModelNames.end(), model_);
  if (model_ == "best") options.model = std::nullopt;
  if (name != kModelNames.end()) options.model = static_cast<modal::ModeModel>(name - kModelNames.begin());
  return options;
}

}  // namespace stablecut
