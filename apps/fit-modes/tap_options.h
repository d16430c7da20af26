// How fit-modes takes records of hits in: the options that say what they are, and what is made of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "document/measured/tap_records.h"
#include "fit_values.h"
#include "measurement.h"
#include "taps/tap_campaign.h"

namespace stablecut {

class TapOptions {
 public:
  /// Declares the options; the object must stay where it is until they have been parsed.
  void declare(CLI::App& app);
  /// Those without --taps itself, which is among them.
  const std::vector<CLI::Option*>& declared() const { return declared_; }
  bool given() const { return !parts_.empty(); }

  /// The responses that the records of --taps give. `general` are the options that hold for all measurements;
  /// `warn` gets what there is to say. Throws Failure, DataError and NoAnswer.
  using Warn = std::function<void(const std::string& text)>;
  Measurement read(const MeasurementOptions& general, const MeasurementOptions::Reader& read_input,
                   const Warn& warn) const;

 private:
  struct Column;

  void take_decay(const std::string& text);
  void take_sensitivity(const std::string& text);
  std::vector<Column> read_columns(const MeasurementOptions& general,
                                   const MeasurementOptions::Reader& read_input, Measurement& result) const;

  std::vector<TapFile> parts_;
  document::TapRecordChoice records_;
  std::optional<double> trigger_n_, length_s_, pre_trigger_s_, decay_per_s_;
  std::string estimator_, force_window_;
  std::vector<CLI::Option*> declared_;
};

}  // namespace stablecut
