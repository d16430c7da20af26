// How fit-modes takes a measurement in: the options that say what the files are, and what they hold.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "document/measured/frf_import.h"
#include "fit_values.h"

namespace stablecut {

struct Measurement {
  dynamics::FrequencyResponse frf;        ///< in the band, in the quantity that was measured
  std::string name;                       ///< of the input, or of the first of several
  bool is_document = false;               ///< a frf document, in which zeros mean uncoupled
  std::vector<document::Remark> remarks;  ///< on how the files were read
};

class MeasurementOptions {
 public:
  /// Declares the options; the object must stay where it is until they have been parsed.
  void declare(CLI::App& app);
  /// All of them, to be refused where nothing is read.
  const std::vector<CLI::Option*>& declared() const { return declared_; }

  /// Those that frequency responses need and records of hits do not.
  std::vector<CLI::Option*> declared_for_responses() const { return for_responses_; }
  std::optional<dynamics::Quantity> quantity() const;
  const std::optional<document::FrfUnit>& unit() const { return choice_.unit; }
  /// --delay, --scale and --band. Throws WrongUsage for an entry that is not there, DataError where no line
  /// is left.
  void finish(Measurement& measurement) const;
  /// Whether --band says which lines count.
  bool band_is_chosen() const { return band_.has_value(); }

  /// Reads `main_input` ("-" by default), or the files of --entry. Throws Failure for options that do not fit
  /// each other or the input, DataError for what the files hold.
  using Reader = std::function<document::Input(const std::string& path, cli::InputForm form)>;
  Measurement read(const std::string& main_input, const Reader& read_input) const;

 private:
  void take_entry(const std::string& text);
  void check_form(const document::Input& input, const document::FrfChoice& choice) const;

  std::string from_, quantity_;
  document::FrfChoice choice_;
  std::optional<Range> band_;
  std::vector<document::FrfPart> parts_;
  std::vector<std::string> part_paths_;
  std::vector<CLI::Option*> declared_, for_responses_;
  std::vector<Correction> corrections_;
};

/// Throws DataError where a pair of directions was measured at several positions.
void refuse_second_places(const dynamics::FrequencyResponse& frf, const std::string& name);

}  // namespace stablecut
