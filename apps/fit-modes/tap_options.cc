#include "tap_options.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "cli/exit_status.h"
#include "document/kinds/frf_json.h"
#include "document/text/data_error.h"

namespace stablecut {
namespace {

bool is_positive(double value) { return value > 0; }
bool is_not_negative(double value) { return value >= 0; }

std::string time_text(double seconds) {
  return seconds < 1 ? number_text(seconds * 1e3, 3) + " ms" : number_text(seconds, 3) + " s";
}

}  // namespace

// What was read for one direction of the force.
struct TapOptions::Column {
  taps::TapColumn data;
  std::vector<std::string> files;  // [records]
  dynamics::Quantity quantity;
};

void TapOptions::declare(CLI::App& app) {
  cli::add_repeated_option(
      app, "--taps", "X=FILE,...",
      "Records of hits instead of frequency responses: the direction of the force, and files with columns of "
      "time, force and responses, or universal files",
      [this](const std::string& text) { add_taps(text, parts_); });
  cli::add_number_option(app, "--sample-rate", records_.sample_rate_hz,
                         "Samples a second of the records (default: by their times)", "a rate above 0 Hz",
                         is_positive);
  cli::add_repeated_option(
      app, "--sensitivity", "CHANNEL=V/UNIT",
      "Of a sensor whose volts were recorded, as force=2.25mV/N, x=100mV/g; response: all others",
      [this](const std::string& text) { take_sensitivity(text); });
  cli::add_choice_option(app, "--estimator", estimator_, "H1|H2|Hv",
                         "Average over the hits (default: H1, all noise in the responses)");
  cli::add_number_option(app, "--trigger", trigger_n_,
                         "Force at which a hit begins, N (default: above the noise)", "a force above 0 N",
                         is_positive);
  cli::add_number_option(
      app, "--pre-trigger", pre_trigger_s_,
      "What is taken before a hit, s (default: two widths of its pulse, 32 samples at least)",
      "a time in s, not below 0", is_not_negative);
  cli::add_number_option(app, "--tap-length", length_s_,
                         "What is taken of each hit, s (default: as much as most leave)", "a time above 0 s",
                         is_positive);
  app.add_option_function<std::string>(
         "--tap-window", [this](const std::string& text) { take_decay(text); },
         "Exponential window over force and responses: auto (default: what is needed), none, a decay in 1/s "
         "(5) or a time constant (0.2s); its damping is taken off the modes")
      ->type_name("auto|none|DECAY");
  cli::add_choice_option(
      app, "--force-window", force_window_, "auto|pulse|none",
      "pulse: take the force as 0 away from its pulse (default: auto, where it is more than "
      "noise there)");
  declared_ = {
      app.get_option("--taps"),       app.get_option("--sample-rate"), app.get_option("--sensitivity"),
      app.get_option("--estimator"),  app.get_option("--trigger"),     app.get_option("--pre-trigger"),
      app.get_option("--tap-length"), app.get_option("--tap-window"),  app.get_option("--force-window")};
}

void TapOptions::take_decay(const std::string& text) {
  if (text == "auto") return;
  if (text == "none") {
    decay_per_s_ = 0;
    return;
  }
  const auto decay = parse_decay(text);
  cli::refuse_if(!decay, "--tap-window: " + text +
                             ": expected auto, none, a decay in 1/s above 0, or a time constant as 0.2s");
  decay_per_s_ = *decay;
}

void TapOptions::take_sensitivity(const std::string& text) {
  const auto sensitivity = document::sensitivity_named(text);
  cli::refuse_if(!sensitivity, "--sensitivity: " + text +
                                   ": expected a channel and its volts, as force=2.25mV/N or x=100mV/g");
  records_.sensitivities.push_back(*sensitivity);
}

std::vector<TapOptions::Column> TapOptions::read_columns(const MeasurementOptions& general,
                                                         const MeasurementOptions::Reader& read_input,
                                                         Measurement& result) const {
  document::TapRecordChoice choice = records_;
  choice.quantity = general.quantity();
  choice.unit = general.unit();
  std::vector<Column> columns;
  for (const TapFile& part : parts_) {
    std::string reference = part.reference;
    const double sign = document::take_sign(reference);
    const document::Input input = read_input(part.path, cli::InputForm::kByContent);
    const std::string& name = input.source.name;
    if (result.name.empty()) result.name = name;
    document::TapRecords records = document::tap_records(input, reference, choice, result.remarks);
    if (!columns.empty() && records.quantity != columns.front().quantity)
      throw document::DataError(name, "", document::quantity_name(records.quantity),
                                std::string("expected ") + document::quantity_name(columns.front().quantity) +
                                    ", as in the first file");
    auto column = std::find_if(columns.begin(), columns.end(),
                               [&](const Column& known) { return known.data.reference == reference; });
    if (column == columns.end()) {
      columns.push_back({{reference, records.responses, {}}, {}, records.quantity});
      column = columns.end() - 1;
    }
    if (records.responses != column->data.responses)
      throw document::DataError(name, "", "", "expected the responses of the first file with that force");
    for (taps::Record& record : records.records) {
      record.force *= sign;
      column->data.records.push_back(std::move(record));
      column->files.push_back(name);
    }
  }
  return columns;
}

namespace {

std::string fault_text(const taps::Hit& hit, const taps::TapColumn& column) {
  switch (hit.fault) {
    case taps::HitFault::kNone:
      return "";
    case taps::HitFault::kDouble:
      return "a double hit, the other blow " + time_text(hit.seconds) + " apart";
    case taps::HitFault::kOverload:
      return "an overload of " + (hit.channel == 0 ? std::string("the force")
                                                   : "the response " + column.responses[hit.channel - 1]);
    case taps::HitFault::kWeak:
      return "weak, " + number_text(std::abs(hit.pulse.force_n), 3) + " N";
    case taps::HitFault::kShort:
      return "too short, " + time_text(hit.seconds) + " to the next hit or the end";
  }
  return "";
}

void warn_of_hits(const taps::TapColumn& column, const std::vector<std::string>& files,
                  const std::vector<taps::Hit>& hits, const TapOptions::Warn& warn) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const taps::Hit& hit = hits[i];
    if (hit.fault == taps::HitFault::kNone) continue;
    const double at = static_cast<double>(hit.pulse.peak) / column.records[hit.record].sample_rate_hz;
    warn(files[hit.record] + ": hit " + std::to_string(i + 1) + " along " + column.reference + ", at " +
         number_text(at, 4) + " s: " + fault_text(hit, column) + ": left out");
  }
}

}  // namespace

Measurement TapOptions::read(const MeasurementOptions& general, const MeasurementOptions::Reader& read_input,
                             const Warn& warn) const {
  Measurement result;
  const std::vector<Column> columns = read_columns(general, read_input, result);
  std::vector<taps::TapColumn> data;
  data.reserve(columns.size());
  for (const Column& column : columns) data.push_back(column.data);
  taps::TapChoice choice;
  choice.hits = {trigger_n_, length_s_, pre_trigger_s_};
  choice.decay_per_s = decay_per_s_;
  if (force_window_ == "none" || force_window_ == "pulse") choice.force_window = force_window_ == "pulse";
  choice.estimator = estimator_ == "H2"   ? taps::Estimator::kH2
                     : estimator_ == "Hv" ? taps::Estimator::kHv
                                          : taps::Estimator::kH1;
  std::vector<std::vector<taps::Hit>> found;
  const auto tell = [&] {
    for (std::size_t c = 0; c < found.size(); ++c) warn_of_hits(data[c], columns[c].files, found[c], warn);
  };
  taps::TapCampaign campaign;
  try {
    campaign = taps::responses_of(data, columns.front().quantity, choice, &found);
  } catch (const InvalidArgument& error) {
    throw document::DataError(result.name, "", "", error.what(), Remedy::kSampleRate);
  } catch (const NoAnswer& answer) {
    tell();
    throw NoAnswer(result.name + ": " + answer.what());
  }
  tell();
  const double decay = campaign.frf.window_decay_per_s;
  if (!decay_per_s_ && decay > 0)
    warn(result.name + ": the structure still rings after " + time_text(campaign.length_s) +
         ": an exponential window of " + number_text(decay, 3) +
         " 1/s is laid over the hits (--tap-window); longer records tell more");
  if (campaign.ends_with_force)
    warn(result.name + ": above " +
         number_text(campaign.frf.frequency_hz[campaign.frf.frequency_hz.size() - 1]) +
         " Hz the hits have no force that stands out of its noise: no lines there");
  result.frf = std::move(campaign.frf);
  general.finish(result);
  return result;
}

}  // namespace stablecut
