// What fit-modes writes instead of a fit: the frequency responses that it read, or those of a modal table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "document/measured/frf_uff_writer.h"
#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"

namespace stablecut {

class FrfOutput {
 public:
  /// Declares --convert, --synthesize, --to and the options of the noise; the object must stay where it is
  /// until they have been parsed.
  void declare(CLI::App& app);

  bool converts() const { return convert_; }
  bool synthesizes() const { return synthesize_.has_value(); }
  /// Throws WrongUsage for options that do not fit each other.
  void check() const;

  /// The receptances of a modal table on the lines of --synthesize, with the noise that is wanted.
  dynamics::FrequencyResponse synthesized(const dynamics::ModalModel& model) const;
  /// The form of a universal file where one is wanted instead of a document.
  std::optional<document::UniversalForm> universal_form() const;

 private:
  bool convert_ = false, no_variance_ = false;
  std::optional<Range> synthesize_;
  std::string to_;
  std::optional<double> noise_db_, noise_floor_db_;
  std::optional<int> seed_;
  std::vector<CLI::Option*> noise_options_;
};

/// A frf document must say how many averages are behind a coherence: leaves out those that do not. Whether
/// there were some.
bool leave_out_vague_coherences(dynamics::FrequencyResponse& frf);

/// Throws WrongUsage for those of the options that were given.
void refuse(const std::vector<CLI::Option*>& options, const std::string& expected);

}  // namespace stablecut
