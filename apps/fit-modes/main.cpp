// fit-modes: frequency responses in, modal table out; or, with --synthesize, the other way.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "cli/exit_status.h"
#include "cli/progress_bar.h"
#include "cli/tool.h"
#include "document/error.h"
#include "document/frf.h"
#include "document/frf_csv.h"
#include "document/modal_table.h"
#include "dynamics/synthesis.h"
#include "modal/fit.h"
#include "report.h"

namespace stablecut {
namespace {

constexpr int kHighestOrder = 40;  // of the stabilization diagram, pole pairs

class FitModes : public cli::Tool {
 public:
  FitModes()
      : Tool("fit-modes",
             "Modes of the tool tip from measured frequency responses, nothing guessed by hand; with "
             "--synthesize the "
             "frequency responses of a modal table.",
             "modal-table") {}

 private:
  void setup(CLI::App& app) override {
    cli::add_choice_option(app, "--from", from_, "json|csv", "Form of the input (default: by content)");
    cli::add_choice_option(app, "--quantity", quantity_, "receptance|mobility|accelerance",
                           "What a CSV holds (default: receptance)");
    cli::add_band_option(app, "--band", band_, "Use only the lines in this band, Hz");
    app.add_option_function<std::string>(
           "--modes",
           [this](const std::string& text) {
             if (text == "auto") return;
             modes_ = parse_integer(text);
             if (!modes_ || *modes_ < 1)
               throw CLI::ValidationError("--modes", text + ": expected auto or a number of modes");
           },
           "Number of modes (default: auto)")
        ->type_name("auto|N");
    cli::add_choice_option(app, "--model", model_, "nonsymmetric|symmetric|proportional|best",
                           "Form of the modes (default: nonsymmetric); best: by Schwarz' criterion");
    add_file_option(app, "--fitted", fitted_path_,
                    "Also write the fitted model on the measured lines, an frf");
    add_file_option(app, "--stabilization", stabilization_path_,
                    "Also write the stabilization diagram: poles by order, and the modes chosen");
    fit_options_ = {app.get_option("--from"),         app.get_option("--quantity"),
                    app.get_option("--band"),         app.get_option("--modes"),
                    app.get_option("--model"),        app.get_option("--fitted"),
                    app.get_option("--stabilization")};

    cli::add_range_option(app, "--synthesize", synthesize_,
                          "Write the frf of a modal table on these lines, Hz");
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

  void run() override {
    for (const CLI::Option* option : synthesize_ ? fit_options_ : noise_options_) {
      if (option->count() == 0) continue;
      throw cli::Failure(cli::ExitStatus::kUsage,
                         option->get_name() + (synthesize_ ? ": expected without --synthesize"
                                                           : ": expected with --synthesize"));
    }
    synthesize_ ? synthesize_table() : fit();
  }

  void synthesize_table() {
    if (synthesize_->from < 0)
      throw cli::Failure(cli::ExitStatus::kUsage, "--synthesize: expected frequencies not below 0 Hz");
    const cli::Input input = read_main_input(true);
    const ModalModel model = modal_table_from_json(input.document, input.source);
    const std::vector<double> lines = synthesize_->values();
    FrequencyResponse frf = synthesize(
        model, Eigen::Map<const Eigen::VectorXd>(lines.data(), static_cast<Eigen::Index>(lines.size())));
    if (noise_db_ || noise_floor_db_) {
      add_noise(frf, {noise_db_, noise_floor_db_, static_cast<std::uint64_t>(seed_.value_or(1))});
      if (no_variance_) {
        for (auto& entry : frf.entries) entry.variance.resize(0);
      }
    }
    write_document(main_output(), frf_to_json(frf));
  }

  void fit() {
    const FrequencyResponse measured = read_receptance();
    const ModalFit result = fit_measured(measured);
    for (const std::string& text : result.warnings) warn(input_name_ + ": " + text);

    Json document = modal_table_to_json(result.model);
    document["fit"].update(fit_report(result, measured));
    write_document(main_output(), std::move(document));
    if (!fitted_path_.empty()) {
      FrequencyResponse fitted = synthesize(result.model, measured.frequency_hz);
      std::erase_if(fitted.entries, [&](const auto& entry) {
        return measured.find(entry.response, entry.reference) == nullptr;
      });
      write_document(fitted_path_, frf_to_json(fitted));
    }
    if (!stabilization_path_.empty()) {
      cli::ProgressBar bar("fit-modes: orders", !quiet());
      const auto orders =
          stabilization(result.data, kHighestOrder, threads(), [&](double share) { bar.show(share); });
      write_document(stabilization_path_, stabilization_to_json(orders, result, measured));
    }
  }

  std::optional<ModeModel> mode_model() const {
    if (model_ == "best") return std::nullopt;
    const auto name = std::find(kModelNames.begin(), kModelNames.end(), model_);
    return name == kModelNames.end() ? ModeModel::kNonsymmetric
                                     : static_cast<ModeModel>(name - kModelNames.begin());
  }

  // Failures with the input's name before them.
  ModalFit fit_measured(const FrequencyResponse& measured) const {
    try {
      cli::ProgressBar bar("fit-modes", !quiet());
      ModalFit result = fit_modes(measured, {modes_, mode_model(), [&](double share) { bar.show(share); }});
      if (!result.converged) throw NoAnswer("the fit did not converge");
      return result;
    } catch (const InvalidArgument& error) {
      throw DataError(input_name_, "", "", error.what());
    } catch (const NoAnswer& answer) {
      throw NoAnswer(input_name_ + ": " + answer.what());
    }
  }

  // The measurement in the band, as a receptance.
  FrequencyResponse read_receptance() {
    const cli::Input input = read_main_input(from_ == "json");
    input_name_ = input.source.name;
    FrequencyResponse frf;
    if (from_ == "csv" || (from_.empty() && input.document.is_null())) {
      if (!quantity_.empty()) frf.quantity = quantity_from_name(quantity_);
      frf = frf_from_csv(input.source, frf.quantity);
    } else {
      frf = frf_from_json(input.document, input.source);
      if (!quantity_.empty() && frf.quantity != quantity_from_name(quantity_)) {
        throw cli::Failure(cli::ExitStatus::kUsage, "--quantity: " + quantity_ + ": expected " +
                                                        quantity_name(frf.quantity) +
                                                        ", as the document says");
      }
    }
    for (std::size_t e = 0; e < frf.entries.size(); ++e) {
      if (frf.find(frf.entries[e].response, frf.entries[e].reference) != &frf.entries[e]) {
        throw DataError(input.source.name, "/h/" + std::to_string(e),
                        frf.entries[e].response + frf.entries[e].reference,
                        "measured at another position too: expected each pair of directions once");
      }
    }
    // Nothing is learnt at 0 Hz, and inertance and mobility cannot be converted there.
    const double least = std::numeric_limits<double>::min();
    frf = within_band(frf, std::max(band_ ? band_->from : least, least),
                      band_ ? band_->to : std::numeric_limits<double>::max());
    if (frf.frequency_hz.size() == 0) {
      throw DataError(
          input.source.name, "", "",
          "no lines in the band: expected some above 0 Hz" + std::string(band_ ? " in --band" : ""));
    }
    return to_receptance(std::move(frf));
  }

  std::string from_, quantity_, model_, fitted_path_, stabilization_path_, input_name_;
  std::optional<Range> band_, synthesize_;
  std::optional<int> modes_, seed_;
  std::optional<double> noise_db_, noise_floor_db_;
  bool no_variance_ = false;
  std::vector<CLI::Option*> fit_options_, noise_options_;
};

}  // namespace
}  // namespace stablecut

int main(int argc, char** argv) { return stablecut::FitModes().main(argc, argv); }
