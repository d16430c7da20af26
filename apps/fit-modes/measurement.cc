#include "measurement.h"

#include <limits>
#include <utility>

#include "cli/exit_status.h"
#include "document/kinds/frf_json.h"
#include "document/text/data_error.h"

namespace stablecut {

void MeasurementOptions::declare(CLI::App& app) {
  cli::add_choice_option(app, "--from", from_, "json|uff|csv|frf", "Form of the input (default: by content)");
  cli::add_choice_option(app, "--quantity", quantity_, "receptance|mobility|accelerance",
                         "What a file holds that does not say so (default of columns: receptance)");
  cli::add_unit_option(app, choice_.unit,
                       "Unit of the file's numbers, as um/N or (m/s^2)/N; wins over what the file says");
  cli::add_repeated_option(
      app, "--entry", "XY=FILE",
      "One entry from each of several files: response, force, and the file; -xy turns a sign",
      [this](const std::string& text) { take_entry(text); });
  app.add_option_function<std::string>(
         "--functions",
         [this](const std::string& text) {
           const auto list = parse_index_list(text);
           if (!list) throw cli::WrongUsage("--functions: " + text + ": expected a list, as 1-4,7");
           choice_.functions = *list;
         },
         "Only these functions of a universal file, as 1-4,7")
      ->type_name("LIST");
  cli::add_integer_option(app, "--node", choice_.node, std::numeric_limits<int>::min(),
                          "Only what was measured at this node of a universal file");
  cli::add_number_option(app, "--averages", choice_.averages, "Averages behind the file's coherences",
                         "a number, at least 1", [](double value) { return value >= 1; });
  for (const std::string option : {"--delay", "--scale"}) {
    cli::add_repeated_option(
        app, option, option == "--delay" ? "[XY=]MS" : "[XY=]FACTOR",
        option == "--delay" ? "The response of the entry (of all) is that late, ms: it is taken off"
                            : "Multiply the entry (all) by that",
        [this, option](const std::string& text) { corrections_.push_back(parse_correction(option, text)); });
  }
  cli::add_band_option(app, "--band", band_, "Use only the lines in this band, Hz");
  declared_ = {app.get_option("--from"),     app.get_option("--quantity"),  app.get_option("--unit"),
               app.get_option("--entry"),    app.get_option("--functions"), app.get_option("--node"),
               app.get_option("--averages"), app.get_option("--delay"),     app.get_option("--scale"),
               app.get_option("--band")};
  for (const char* name : {"--from", "--entry", "--functions", "--node", "--averages"})
    for_responses_.push_back(app.get_option(name));
}

std::optional<dynamics::Quantity> MeasurementOptions::quantity() const {
  if (quantity_.empty()) return std::nullopt;
  return document::quantity_from_name(quantity_);
}

void MeasurementOptions::take_entry(const std::string& text) {
  const auto equals = text.find('=');
  auto part = equals == std::string::npos ? std::nullopt : document::frf_part_named(text.substr(0, equals));
  if (!part || equals + 1 == text.size())
    throw cli::WrongUsage("--entry: " + text +
                          ": expected DIRECTIONS=FILE, as xy=tap.csv (response x, force along y)");
  parts_.push_back(*part);
  part_paths_.push_back(text.substr(equals + 1));
}

void MeasurementOptions::finish(Measurement& measurement) const {
  for (const Correction& correction : corrections_) {
    bool any = false;
    for (std::size_t e = 0; e < measurement.frf.entries.size(); ++e) {
      const dynamics::FrequencyResponseEntry& entry = measurement.frf.entries[e];
      if (!correction.entry.empty() && correction.entry != entry.response + entry.reference) continue;
      any = true;
      dynamics::correct(measurement.frf, e, 1e-3 * correction.delay_ms, correction.factor);
    }
    if (!any)
      throw cli::WrongUsage(correction.option + ": " + correction.text + ": expected an entry of " +
                            measurement.name);
  }
  if (!band_) return;
  measurement.frf = dynamics::within_band(measurement.frf, band_->from, band_->to);
  if (measurement.frf.frequency_hz.size() == 0)
    throw document::DataError(measurement.name, "", "", "no lines in the band: expected some in --band");
}

// Options that the input's form has no use for are a mistake.
void MeasurementOptions::check_form(const document::Input& input, const document::FrfChoice& choice) const {
  const document::FrfForm form = document::frf_form_of(input, choice);
  if (form != document::FrfForm::kUniversalFile && (!choice.functions.empty() || choice.node))
    throw cli::WrongUsage(input.source.name + ": expected a universal file with --functions and --node");
  if (form != document::FrfForm::kJson) return;
  if (choice.unit || choice.averages)
    throw cli::WrongUsage(
        input.source.name +
        ": a frf document says its units and averages itself: expected no --unit, no --averages");
  if (!choice.quantity) return;
  const dynamics::Quantity told = document::frf_from_json(input.document, input.source).quantity;
  if (told != *choice.quantity) {
    throw cli::WrongUsage("--quantity: " + quantity_ + ": expected " + document::quantity_name(told) +
                          ", as the document says");
  }
}

Measurement MeasurementOptions::read(const std::string& main_input, const Reader& read_input) const {
  document::FrfChoice choice = choice_;
  choice.form = document::frf_form_from_name(from_);
  choice.quantity = quantity();
  const auto form = from_.empty()     ? cli::InputForm::kByContent
                    : from_ == "json" ? cli::InputForm::kJson
                                      : cli::InputForm::kText;
  Measurement result;
  const auto checked = [&](const std::string& path) {
    document::Input input = read_input(path, form);
    check_form(input, choice);
    if (result.name.empty()) result.name = input.source.name;
    result.is_document = document::frf_form_of(input, choice) == document::FrfForm::kJson;
    return input;
  };
  if (parts_.empty()) {
    result.frf = document::import_frf(checked(main_input), choice, result.remarks);
  } else {
    if (main_input != "-") throw cli::WrongUsage(main_input + ": expected no other input with --entry");
    std::vector<document::FrfPart> parts = parts_;
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].input = checked(part_paths_[i]);
    result.frf = document::import_frf_parts(parts, choice, result.remarks);
  }
  finish(result);
  return result;
}

void refuse_second_places(const dynamics::FrequencyResponse& frf, const std::string& name) {
  for (std::size_t e = 0; e < frf.entries.size(); ++e) {
    const dynamics::FrequencyResponseEntry& entry = frf.entries[e];
    if (frf.find(entry.response, entry.reference) == &entry) continue;
    throw document::DataError(name, "/h/" + std::to_string(e), entry.response + entry.reference,
                              "measured at another position too: expected each pair of directions once");
  }
}

}  // namespace stablecut
