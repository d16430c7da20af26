// fit-modes: frequency responses in, modal table out; or, with --synthesize, the other way.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/number_text.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/kinds/frf_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/measured/frf_uff_writer.h"
#include "document/text/data_error.h"
#include "dynamics/synthesis.h"
#include "measurement.h"
#include "modal/fit.h"
#include "modal/tap_checks.h"
#include "report.h"

namespace stablecut {
namespace {

constexpr int kHighestOrder = 40;  // of the stabilization diagram, pole pairs

class FitModes : public cli::Tool {
 public:
  FitModes()
      : cli::Tool("fit-modes",
                  "Modes of the tool tip from measured frequency responses, nothing guessed by hand; with "
                  "--synthesize the "
                  "frequency responses of a modal table.",
                  "fit-modes tap.uff --band 20:2000 > modes.json", "modal-table") {}

 private:
  void setup(CLI::App& app) override {
    measurement_.declare(app);
    // Fitting it.
    app.add_option_function<std::string>(
           "--window-decay", [this](const std::string& text) { take_window_decay(text); },
           "Decay of the exponential window, 1/s (5), or its time constant (0.2s): taken off the damping")
        ->type_name("DECAY");
    app.add_option_function<std::string>(
           "--modes",
           [this](const std::string& text) {
             if (text == "auto") return;
             modes_ = parse_integer(text);
             if (!modes_ || *modes_ < 1)
               throw cli::WrongUsage("--modes: " + text + ": expected auto or a number of modes");
           },
           "Number of modes (default: auto)")
        ->type_name("auto|N");
    cli::add_choice_option(app, "--model", model_, "nonsymmetric|symmetric|proportional|best",
                           "Form of the modes (default: nonsymmetric); best: by Schwarz' criterion");
    add_file_option(app, "--fitted", fitted_path_,
                    "Also write the fitted model on the measured lines, an frf");
    add_file_option(app, "--stabilization", stabilization_path_,
                    "Also write the stabilization diagram: poles by order, and the modes chosen");
    fit_options_ = {app.get_option("--window-decay"), app.get_option("--modes"), app.get_option("--model"),
                    app.get_option("--fitted"), app.get_option("--stabilization")};

    // Writing frequency responses.
    app.add_flag("--convert", convert_, "Write the measurement as it was read, an frf, instead of a fit");
    cli::add_range_option(app, "--synthesize", synthesize_,
                          "Write the frf of a modal table on these lines, Hz");
    cli::add_choice_option(
        app, "--to", to_, "json|uff|uff-binary",
        "Convert, synthesize: form of the output (default: json); uff is dataset 58, uff-binary 58b");
    const auto any = [](double) { return true; };
    noise_options_ = {
        cli::add_number_option(app, "--noise-db", noise_db_,
                               "Synthesize: noise this far below |H| on each line, dB", "a number", any),
        cli::add_number_option(app, "--noise-floor-db", noise_floor_db_,
                               "Synthesize: noise this far below each curve's RMS, dB", "a number", any),
        cli::add_integer_option(app, "--seed", seed_, 0, "Synthesize: seed of the noise (default: 1)"),
        app.add_flag("--no-variance", no_variance_,
                     "Synthesize: leave the noise's variance out of the document")};
  }

  void take_window_decay(const std::string& text) {
    const bool is_time = text.ends_with('s');
    const auto number = parse_number(std::string_view(text).substr(0, text.size() - (is_time ? 1 : 0)));
    if (!number || !(*number > 0) || !std::isfinite(1 / *number))
      throw cli::WrongUsage("--window-decay: " + text +
                            ": expected a decay in 1/s above 0, or a time constant as 0.2s");
    window_decay_per_s_ = is_time ? 1 / *number : *number;
  }

  // Options that belong to another of the tool's works than the one that is asked for.
  void refuse(const std::vector<CLI::Option*>& options, const std::string& expected) const {
    for (const CLI::Option* option : options) {
      if (option->count() > 0) throw cli::WrongUsage(option->get_name() + ": expected " + expected);
    }
  }

  std::string option_for(Remedy remedy) const override {
    switch (remedy) {
      case Remedy::kNone:
        return "";
      case Remedy::kBand:
        return "--band";
      case Remedy::kQuantity:
        return "--quantity";
      case Remedy::kUnit:
        return "--unit";
      case Remedy::kQuantityOrUnit:
        return "--quantity or --unit";
      case Remedy::kFunctions:
        return "--functions";
      case Remedy::kNode:
        return "--node";
      case Remedy::kModes:
        return "--modes";
    }
    return "";
  }

  void run() override {
    if (synthesize_) {
      refuse(measurement_.declared(), "without --synthesize");
      refuse(fit_options_, "without --synthesize");
      if (convert_) throw cli::WrongUsage("--convert: expected without --synthesize");
      synthesize_table();
      return;
    }
    refuse(noise_options_, "with --synthesize");
    if (convert_) {
      refuse(fit_options_, "without --convert");
      write_frf(main_output(), with_known_averages(read_measurement()));
      return;
    }
    if (!to_.empty()) throw cli::WrongUsage("--to: expected with --convert or --synthesize");
    fit();
  }

  void synthesize_table() {
    if (synthesize_->from < 0) throw cli::WrongUsage("--synthesize: expected frequencies not below 0 Hz");
    const document::Input input = read_main_input(cli::InputForm::kJson);
    input_name_ = input.source.name;
    const dynamics::ModalModel model = document::modal_table_from_json(input.document, input.source);
    const std::vector<double> lines = synthesize_->values();
    dynamics::FrequencyResponse frf =
        dynamics::synthesize(model, Eigen::Map<const Eigen::VectorXd>(lines.data(), lines.size()));
    if (noise_db_ || noise_floor_db_) {
      dynamics::add_noise(frf, {noise_db_, noise_floor_db_, static_cast<std::uint64_t>(seed_.value_or(1))});
      if (no_variance_) {
        for (auto& entry : frf.entries) entry.variance.resize(0);
      }
    }
    write_frf(main_output(), frf);
  }

  // A frf document says how many averages are behind a coherence.
  dynamics::FrequencyResponse with_known_averages(dynamics::FrequencyResponse frf) const {
    bool lost = false;
    for (auto& entry : frf.entries) {
      if (entry.coherence.size() == 0 || entry.averages) continue;
      entry.coherence.resize(0);
      lost = true;
    }
    if (lost) warn(input_name_ + ": coherences are left out: --averages N says how many are behind them");
    return frf;
  }

  void write_frf(const std::string& path, const dynamics::FrequencyResponse& frf) {
    if (!to_.starts_with("uff")) {
      write_document(path, document::frf_to_json(frf));
      return;
    }
    try {
      write_text(path, document::frf_to_universal_file(frf, to_ == "uff" ? document::UniversalForm::kText
                                                                         : document::UniversalForm::kBinary));
    } catch (const InvalidArgument& error) {
      throw document::DataError(input_name_, "", "", error.what());
    }
  }

  void fit() {
    const dynamics::FrequencyResponse measured = read_receptance();
    const modal::TapReport report = modal::check_tap(measured, zeros_are_dead_);
    for (const std::string& text : report.findings) warn(input_name_ + ": " + text);
    const dynamics::FrequencyResponse used = without_disturbed_lines(measured, report.disturbed_lines);
    const modal::ModalFit result = fit_measured(used);
    for (const std::string& text : result.warnings) warn(input_name_ + ": " + text);

    const dynamics::ModalModel table = table_of(result);
    document::Json document = document::modal_table_to_json(table);
    document["fit"].update(fit_report(result, used));
    if (window_decay_per_s_ > 0) document["fit"]["window_decay_per_s"] = window_decay_per_s_;
    write_document(main_output(), std::move(document));
    if (!fitted_path_.empty()) {
      // Over the measurement, the window in it.
      dynamics::FrequencyResponse fitted = dynamics::synthesize(result.model, measured.frequency_hz);
      std::erase_if(fitted.entries, [&](const auto& entry) {
        return measured.find(entry.response, entry.reference) == nullptr;
      });
      write_document(fitted_path_, document::frf_to_json(fitted));
    }
    if (!stabilization_path_.empty()) {
      cli::ProgressBar bar("fit-modes: orders", !quiet());
      const auto orders =
          modal::stabilization(result.data, kHighestOrder, threads(), [&](double share) { bar.show(share); });
      write_document(stabilization_path_, stabilization_to_json(orders, result, used));
    }
  }

  // A few lines that mains hum or a spur disturbs would become modes without width.
  dynamics::FrequencyResponse without_disturbed_lines(const dynamics::FrequencyResponse& measured,
                                                      const std::vector<Eigen::Index>& lines) const {
    constexpr Eigen::Index kFew = 5;
    constexpr double kFewShare = 0.02;
    constexpr std::size_t kShown = 5;
    const auto most = std::max(
        kFew, static_cast<Eigen::Index>(kFewShare * static_cast<double>(measured.frequency_hz.size())));
    if (lines.empty() || static_cast<Eigen::Index>(lines.size()) > most) return measured;
    std::string list;
    for (std::size_t i = 0; i < std::min(lines.size(), kShown); ++i)
      list += (i == 0 ? "" : ", ") + number_text(measured.frequency_hz[lines[i]]);
    if (lines.size() > kShown) list += ", ...";
    warn(input_name_ + ": single lines stand out of their neighbours (" + std::to_string(lines.size()) +
         ": " + list + " Hz), as hum does: left out, since each would be taken for a mode");
    return dynamics::without_lines(measured, lines);
  }

  dynamics::ModalModel table_of(const modal::ModalFit& result) const {
    if (window_decay_per_s_ == 0) return result.model;
    try {
      return dynamics::without_window(result.model, window_decay_per_s_);
    } catch (const NoAnswer& answer) {
      throw NoAnswer(input_name_ + ": " + answer.what());
    }
  }

  std::optional<modal::ModeModel> mode_model() const {
    if (model_ == "best") return std::nullopt;
    const auto name = std::find(kModelNames.begin(), kModelNames.end(), model_);
    return name == kModelNames.end() ? modal::ModeModel::kNonsymmetric
                                     : static_cast<modal::ModeModel>(name - kModelNames.begin());
  }

  // Failures with the input's name before them.
  modal::ModalFit fit_measured(const dynamics::FrequencyResponse& measured) const {
    try {
      cli::ProgressBar bar("fit-modes", !quiet());
      modal::ModalFit result =
          modal::fit_modes(measured, {modes_, mode_model(), [&](double share) { bar.show(share); }});
      if (!result.converged) throw NoAnswer("the fit did not converge");
      return result;
    } catch (const InvalidArgument& error) {
      throw document::DataError(input_name_, "", "", error.what());
    } catch (const NoAnswer& answer) {
      throw NoAnswer(input_name_ + ": " + answer.what());
    }
  }

  dynamics::FrequencyResponse read_measurement() {
    Measurement measured = measurement_.read(
        main_input(),
        [this](const std::string& path, cli::InputForm form) { return read_input(path, form); });
    for (const document::Remark& remark : measured.remarks)
      warn(document::remark_text(remark) + advice(document::remedy(remark.kind)));
    input_name_ = measured.name;
    zeros_are_dead_ = !measured.is_document;
    return std::move(measured.frf);
  }

  // The measurement as a receptance, without a line at 0 Hz, and what it shows about itself.
  dynamics::FrequencyResponse read_receptance() {
    dynamics::FrequencyResponse frf = read_measurement();
    for (std::size_t e = 0; e < frf.entries.size(); ++e) {
      if (frf.find(frf.entries[e].response, frf.entries[e].reference) != &frf.entries[e]) {
        throw document::DataError(input_name_, "/h/" + std::to_string(e),
                                  frf.entries[e].response + frf.entries[e].reference,
                                  "measured at another position too: expected each pair of directions once");
      }
    }
    // Nothing is learnt at 0 Hz, and inertance and mobility cannot be converted there.
    if (frf.frequency_hz[0] == 0) {
      frf =
          dynamics::within_band(frf, std::numeric_limits<double>::min(), std::numeric_limits<double>::max());
      if (frf.frequency_hz.size() == 0)
        throw document::DataError(input_name_, "", "", "no lines in the band: expected some above 0 Hz");
      warn(input_name_ + ": the line at 0 Hz is left out: it tells nothing of a vibration");
    }
    frf = dynamics::to_receptance(std::move(frf), window_decay_per_s_);
    return frf;
  }

  MeasurementOptions measurement_;
  std::string to_, model_, fitted_path_, stabilization_path_, input_name_;
  std::optional<Range> synthesize_;
  std::optional<int> modes_, seed_;
  std::optional<double> noise_db_, noise_floor_db_;
  double window_decay_per_s_ = 0;
  bool no_variance_ = false, convert_ = false, zeros_are_dead_ = true;
  std::vector<CLI::Option*> fit_options_, noise_options_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::FitModes().main(argc, argv); }
