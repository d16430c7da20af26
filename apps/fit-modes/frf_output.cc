#include "frf_output.h"

#include <cmath>

#include "cli/exit_status.h"
#include "dynamics/synthesis.h"

namespace stablecut {
namespace {

constexpr double kMostValues = 1e7;  // some 2 GB while they are written

}  // namespace

void FrfOutput::declare(CLI::App& app) {
  app.add_flag("--convert", convert_, "Write the measurement as it was read, an frf, instead of a fit");
  cli::add_range_option(app, "--synthesize", synthesize_,
                        "Read a modal table and write its receptances on these lines, Hz, an frf");
  cli::add_choice_option(app, "--to", to_, "json|uff|uff-binary",
                         "With --convert or --synthesize: form of the output (default: json); uff is dataset "
                         "58, uff-binary 58b");
  const auto any = [](double) { return true; };
  noise_options_ = {
      cli::add_number_option(app, "--noise-db", noise_db_,
                             "With --synthesize: noise this far below |H| on each line, dB", "a number", any),
      cli::add_number_option(app, "--noise-floor-db", noise_floor_db_,
                             "With --synthesize: noise this far below each curve's RMS, dB", "a number", any),
      cli::add_integer_option(app, "--seed", seed_, 0, "With --synthesize: seed of the noise (default: 1)"),
      app.add_flag("--no-variance", no_variance_,
                   "With --synthesize: leave the noise's variance out of the document")};
}

void FrfOutput::check() const {
  if (synthesizes()) {
    cli::refuse_if(convert_, "--convert: expected without --synthesize");
    cli::refuse_if(synthesize_->from < 0, "--synthesize: expected frequencies not below 0 Hz");
    return;
  }
  refuse(noise_options_, "with --synthesize");
  cli::refuse_if(!convert_ && !to_.empty(), "--to: expected with --convert or --synthesize");
}

dynamics::FrequencyResponse FrfOutput::synthesized(const dynamics::ModalModel& model) const {
  cli::refuse_beyond(kMostValues, "--synthesize",
                     static_cast<double>(synthesize_->count) * std::pow(model.dofs.size(), 2),
                     "values, lines times responses");
  const std::vector<double> lines = synthesize_->values();
  dynamics::FrequencyResponse frf =
      dynamics::synthesize(model, Eigen::Map<const Eigen::VectorXd>(lines.data(), lines.size()));
  if (!noise_db_ && !noise_floor_db_) return frf;
  dynamics::add_noise(frf, {noise_db_, noise_floor_db_, static_cast<std::uint64_t>(seed_.value_or(1))});
  for (auto& entry : frf.entries) {
    if (no_variance_) entry.variance.resize(0);
  }
  return frf;
}

std::optional<document::UniversalForm> FrfOutput::universal_form() const {
  if (to_ == "uff") return document::UniversalForm::kText;
  if (to_ == "uff-binary") return document::UniversalForm::kBinary;
  return std::nullopt;
}

bool leave_out_vague_coherences(dynamics::FrequencyResponse& frf) {
  bool some = false;
  for (auto& entry : frf.entries) {
    if (entry.coherence.size() == 0 || entry.averages) continue;
    entry.coherence.resize(0);
    some = true;
  }
  return some;
}

void refuse(const std::vector<CLI::Option*>& options, const std::string& expected) {
  for (const CLI::Option* option : options)
    cli::refuse_if(option->count() > 0, option->get_name() + ": expected " + expected);
}

}  // namespace stablecut
