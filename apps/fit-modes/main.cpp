// fit-modes: frequency responses in, modal table out; or, with --synthesize, the other way.

#include <limits>
#include <type_traits>

#include "base/error.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/kinds/frf_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/kinds/stabilization_json.h"
#include "document/text/data_error.h"
#include "dynamics/synthesis.h"
#include "dynamics/window_noise.h"
#include "fit_choice.h"
#include "frf_output.h"
#include "measurement.h"
#include "modal/fit.h"
#include "modal/stabilization.h"
#include "modal/tap_checks.h"
#include "remedies.h"
#include "report.h"
#include "table_options.h"
#include "tap_options.h"
#include "words.h"

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
    cli::begin_group(app, "Measurement");
    measurement_.declare(app);
    cli::begin_group(app, "Records of hits");
    taps_.declare(app);
    cli::begin_group(app, "Fit");
    choice_.declare(app);
    add_file_option(app, "--fitted", fitted_path_,
                    "Also write the receptances of the fitted modes on the measured lines, an frf");
    add_file_option(app, "--stabilization", stabilization_path_,
                    "Also write the stabilization diagram: poles by order, and the modes chosen");
    fit_options_ = choice_.declared();
    for (const char* name : {"--fitted", "--stabilization"}) fit_options_.push_back(app.get_option(name));
    not_in_provenance(app.get_option("--poles"));  // an input
    cli::begin_group(app, "Frequency responses instead of a fit");
    frf_output_.declare(app);
    cli::begin_group(app, "Modal tables instead of a fit");
    tables_.declare(app);
    for (const CLI::Option* option : tables_.declared()) not_in_provenance(option);
  }

  std::string option_for(Remedy remedy) const override { return option_of(remedy); }

  void run() override {
    if (frf_output_.synthesizes() || tables_.given()) {
      const std::string expected = frf_output_.synthesizes() ? "without --synthesize" : "with a measurement";
      refuse(measurement_.declared(), expected);
      refuse(taps_.declared(), expected);
      refuse(fit_options_, expected);
    }
    if (tables_.given()) return write_about_tables();
    if (taps_.given())
      refuse(measurement_.declared_for_responses(), "without --taps");
    else
      refuse(taps_.declared(), "with --taps");
    frf_output_.check();
    if (frf_output_.synthesizes()) {
      synthesize();
    } else if (frf_output_.converts()) {
      refuse(fit_options_, "without --convert");
      dynamics::FrequencyResponse frf = read_measurement();
      if (leave_out_vague_coherences(frf))
        warn(input_name_ + ": coherences are left out: --averages N says how many are behind them");
      write_frf(frf);
    } else {
      fit();
    }
  }

  // ---- a fit ----

  void fit() {
    choice_.check();
    const dynamics::FrequencyResponse measured = read_receptance();
    if (!choice_.poles_path().empty())
      choice_.take_poles(read_reference(choice_.poles_path(), cli::InputForm::kByContent));
    const modal::TapReport tap = modal::check_tap(measured, !is_document_);
    const bool band_chosen = measurement_.band_is_chosen();
    for (const modal::TapFinding& finding : tap.findings)
      warn(input_name_ + ": " + words_of(finding, band_chosen));
    const FittedLines run = named([&] {
      cli::ProgressBar bar("fit-modes", !quiet());
      return choice_.fit(measured, tap, band_chosen, [&](double share) { bar.show(share); });
    });
    if (run.left_out_hz > 0) warn(input_name_ + ": " + left_out_text(run.left_out_hz, run.low_end_falls));
    const modal::ModalFit& result = run.fit;
    for (const modal::FitFinding& finding : result.findings) {
      const std::string text = input_name_ + ": " + words_of(finding);
      if (modal::is_no_answer(finding.kind))
        throw NoAnswer(text, finding.kind == modal::FitFindingKind::kUnexplained && !finding.restricted
                                 ? Remedy::kBand
                                 : Remedy::kNone);
      warn(text);
    }
    if (!taps_.given() && !is_document_) {
      if (const auto ringing = modal::ringing_at_end(result.model, measured.frequency_hz))
        warn(input_name_ + ": " + ringing_text(*ringing));
    }
    write_table(result, run.used);
    if (!fitted_path_.empty()) write_fitted(result, measured);
    if (!stabilization_path_.empty()) write_stabilization(result, run.used);
  }

  // Without the damping of the exponential window that `used` went through.
  void write_table(const modal::ModalFit& fit, const dynamics::FrequencyResponse& used) {
    const double decay = used.window_decay_per_s;
    dynamics::ModalModel table = fit.model;
    // Where the model is the limit, the correlation length of what is left has widened it already.
    if (fit.variance_given && !fit.limited_by_model)
      table = dynamics::with_window_noise(std::move(table), used);
    if (decay > 0) table = named([&] { return dynamics::without_window(std::move(table), decay); });
    if (const std::string text = untold_text(table); !text.empty()) warn(input_name_ + ": " + text);
    document::Json document = document::modal_table_to_json(table);
    document["fit"].update(fit_report(fit, used));
    choice_.add_to_report(document["fit"]);
    if (decay > 0) document["fit"]["window_decay_per_s"] = decay;
    write_document(main_output(), std::move(document));
  }

  // The entries and lines that were measured, with the damping of the window.
  void write_fitted(const modal::ModalFit& fit, const dynamics::FrequencyResponse& measured) {
    dynamics::FrequencyResponse frf = dynamics::synthesize(fit.model, measured.frequency_hz);
    frf.window_decay_per_s = measured.window_decay_per_s;
    std::erase_if(frf.entries, [&](const auto& entry) {
      return measured.find(entry.response, entry.reference) == nullptr;
    });
    write_document(fitted_path_, document::frf_to_json(frf));
  }

  void write_stabilization(const modal::ModalFit& fit, const dynamics::FrequencyResponse& used) {
    cli::ProgressBar bar("fit-modes: orders", !quiet());
    const auto orders =
        modal::stabilization(fit.data, kHighestOrder, threads(), [&](double share) { bar.show(share); });
    write_document(stabilization_path_, document::stabilization_to_json(orders, fit.model.modes, used));
  }

  // The measurement as a receptance, without a line at 0 Hz.
  dynamics::FrequencyResponse read_receptance() {
    dynamics::FrequencyResponse frf = read_measurement();
    refuse_second_places(frf, input_name_);
    // Nothing is learnt at 0 Hz, and accelerance and mobility cannot be converted there.
    if (frf.frequency_hz[0] == 0) {
      frf =
          dynamics::within_band(frf, std::numeric_limits<double>::min(), std::numeric_limits<double>::max());
      if (frf.frequency_hz.size() == 0)
        throw document::DataError(input_name_, "", "", "no lines in the band: expected some above 0 Hz");
      warn(input_name_ + ": the line at 0 Hz is left out: it tells nothing of a vibration");
    }
    const double decay = choice_.window_decay_per_s();
    if (decay > 0 && frf.window_decay_per_s > 0)
      throw cli::WrongUsage("--window-decay: expected with a measurement that has no window of its own");
    if (decay > 0) frf.window_decay_per_s = decay;
    return dynamics::to_receptance(std::move(frf));
  }

  dynamics::FrequencyResponse read_measurement() {
    const auto reader = [this](const std::string& path, cli::InputForm form) {
      return read_input(path, form);
    };
    if (taps_.given() && main_input() != "-")
      throw cli::WrongUsage(main_input() + ": expected no other input with --taps");
    Measurement measured =
        taps_.given() ? taps_.read(measurement_, reader, [this](const std::string& text) { warn(text); })
                      : measurement_.read(main_input(), reader);
    for (const document::Remark& remark : measured.remarks)
      warn(document::remark_text(remark) + advice(document::remedy(remark.kind)));
    input_name_ = measured.name;
    is_document_ = measured.is_document;
    return std::move(measured.frf);
  }

  void write_about_tables() {
    tables_.check();
    cli::refuse_if(frf_output_.synthesizes() || frf_output_.converts(),
                   "--compare, --track: expected without --synthesize and --convert");
    const document::Input table = read_main_input(cli::InputForm::kJson);
    write_document(main_output(), tables_.result(table, read_reference(tables_.other())));
  }

  // ---- frequency responses instead of a fit ----

  void synthesize() {
    const document::Input input = read_main_input(cli::InputForm::kJson);
    input_name_ = input.source.name;
    write_frf(frf_output_.synthesized(document::modal_table_from_json(input.document, input.source)));
  }

  void write_frf(const dynamics::FrequencyResponse& frf) {
    const auto form = frf_output_.universal_form();
    if (!form) return write_document(main_output(), document::frf_to_json(frf));
    if (frf.window_decay_per_s > 0)
      throw cli::WrongUsage("--to: a universal file cannot tell of an exponential window: expected json");
    write_text(main_output(), named([&] { return document::frf_to_universal_file(frf, *form); }));
  }

  // What `work` gives; its failures get the input's name before them.
  template <typename Work>
  std::invoke_result_t<Work> named(const Work& work) const {
    try {
      return work();
    } catch (const InvalidArgument& error) {
      throw document::DataError(input_name_, "", "", error.what());
    } catch (const NoAnswer& answer) {
      throw NoAnswer(input_name_ + ": " + answer.what(), answer.remedy());
    }
  }

  MeasurementOptions measurement_;
  TapOptions taps_;
  FitChoice choice_;
  FrfOutput frf_output_;
  TableOptions tables_;
  std::string fitted_path_, stabilization_path_, input_name_;
  bool is_document_ = false;
  std::vector<CLI::Option*> fit_options_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::FitModes().main(argc, argv); }
