// Records of hammer blows over the time, as loggers and analysers write them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/measured/frf_unit.h"
#include "document/measured/remark.h"
#include "document/text/json_text.h"
#include "taps/record.h"

namespace stablecut::document {

/// How many volts a sensor gives: `force=2.25mV/N`, `x=100mV/g`.
struct Sensitivity {
  std::string channel;  ///< force, response (all that are not named), or a response's direction
  double volts = 0;     ///< for one unit in SI
  std::optional<dynamics::Quantity> quantity = {};  ///< of a response
};

/// Nothing for another text.
std::optional<Sensitivity> sensitivity_named(const std::string& text);

/// What the user knows better than the file, or the file does not say.
struct TapRecordChoice {
  std::optional<dynamics::Quantity> quantity = {};
  std::optional<FrfUnit> unit = {};  ///< of the response over the force; wins over what the file says
  std::optional<double> sample_rate_hz = {};
  std::vector<Sensitivity> sensitivities = {};

  /// Of `force` or of a response's direction; null: none was given.
  const Sensitivity* sensitivity_of(const std::string& channel) const;
};

/// The records of one input, of one direction of the force.
struct TapRecords {
  std::vector<std::string> responses;  ///< directions, without signs: these have turned the signals
  dynamics::Quantity quantity = dynamics::Quantity::kAccelerance;
  std::vector<taps::Record> records;
};

/// From columns (CSV, TSV; time, force, responses, with or without a header) or a universal file with time
/// records (one force and its responses for each record). `reference` is the direction of the force, which
/// names a response that has none. Throws DataError.
TapRecords tap_records(const Input& input, const std::string& reference, const TapRecordChoice& choice,
                       std::vector<Remark>& remarks);

/// The same of columns and of a universal file.
TapRecords tap_records_from_columns(const Source& source, const std::string& reference,
                                    const TapRecordChoice& choice, std::vector<Remark>& remarks);
TapRecords tap_records_from_universal_file(const Source& source, const std::string& reference,
                                           const TapRecordChoice& choice, std::vector<Remark>& remarks);

/// Samples a second of a record whose samples were taken at these times (s): the roundest whole number that
/// the times' own digits leave. Throws DataError for times that are not in equal steps; `place` says where
/// they are.
double sample_rate_of(const Eigen::VectorXd& time_s, const Source& source, const std::string& place);

}  // namespace stablecut::document
