// How fit-modes fits: the options that say what is known of the modes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "modal/fit.h"
#include "modal/tap_checks.h"

namespace stablecut {

/// A fit and the lines that it was made of.
struct FittedLines {
  dynamics::FrequencyResponse used;
  modal::ModalFit fit;
  double left_out_hz = 0;      ///< below, lines were left out that drift had ruined; 0: none were
  bool low_end_falls = false;  ///< shown by what modes leave there; else there was no answer with these lines
};

class FitChoice {
 public:
  /// Declares --window-decay, --modes, --model, --exclude, --poles, --poles-are, --residuals and
  /// --shared-poles; the object must stay where it is until they have been parsed.
  void declare(CLI::App& app);
  const std::vector<CLI::Option*>& declared() const { return declared_; }

  /// Decay of the exponential window that the signals went through, 1/s; 0 without one.
  double window_decay_per_s() const { return window_decay_per_s_; }
  /// The file of poles; empty: none.
  const std::string& poles_path() const { return poles_path_; }
  /// Throws WrongUsage for options that do not fit each other.
  void check() const;
  /// Takes that file's poles. Throws DataError.
  void take_poles(const document::Input& input);
  /// Fits modal::usable_part without the lines of --exclude; unless a band was chosen, without the low end
  /// that no modes explain, or that is in doubt where there is no answer with it. Throws InvalidArgument
  /// where no line is left.
  FittedLines fit(const dynamics::FrequencyResponse& measured, modal::TapReport tap, bool band_chosen,
                  const Progress& progress) const;
  /// What of the choice belongs into the field `fit` of the table.
  void add_to_report(document::Json& fit) const;

 private:
  modal::FitOptions options(Progress progress) const;
  dynamics::FrequencyResponse lines_to_fit(const dynamics::FrequencyResponse& measured,
                                           const modal::TapReport& tap, bool band_chosen) const;
  void take_window_decay(const std::string& text);
  void take_modes(const std::string& text);

  double window_decay_per_s_ = 0;
  std::optional<int> modes_;
  std::string model_, poles_path_, poles_are_;
  bool share_poles_ = false;
  bool residual_terms_ = false;
  std::vector<Range> excluded_;
  std::vector<modal::GivenPole> poles_;
  std::vector<CLI::Option*> declared_;
};

}  // namespace stablecut
