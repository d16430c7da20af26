// A measurement in whatever form a laboratory has it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/measured/frf_unit.h"
#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

enum class FrfForm { kJson, kUniversalFile, kColumns, kCutPro };

/// `json`, `uff`, `csv`, `frf`; nothing for another word.
std::optional<FrfForm> frf_form_from_name(const std::string& name);

/// What the user knows better than the file.
struct FrfChoice {
  std::optional<FrfForm> form;  ///< empty: by content
  std::optional<dynamics::Quantity> quantity;
  std::optional<FrfUnit> unit;
  std::vector<int> functions;      ///< of a universal file
  std::optional<int> node;         ///< of a universal file
  std::optional<double> averages;  ///< behind coherences that came without
};

/// The form that is read: the one that was chosen, else by content.
FrfForm frf_form_of(const Input& input, const FrfChoice& choice);

/// The frequency responses of one input, in SI. Remarks are what the user should know about how the file was
/// read. Throws DataError; a quantity that a `frf` document contradicts is one too.
dynamics::FrequencyResponse import_frf(const Input& input, const FrfChoice& choice,
                                       std::vector<std::string>& remarks);

/// One input of several, which hold an entry each.
struct FrfPart {
  std::string response, reference;  ///< with a sign where the entry is to be turned: "-x"
  Input input;
};

/// Takes `xy`, `x,y`, `-xy`, `x@3,y@4`; nothing for another text.
std::optional<FrfPart> frf_part_named(const std::string& directions);

/// The inputs' entries together, each under its part's directions. Throws DataError for an input of several
/// entries, other lines or another quantity than the first, and a pair of directions that comes twice.
dynamics::FrequencyResponse import_frf_parts(const std::vector<FrfPart>& parts, const FrfChoice& choice,
                                             std::vector<std::string>& remarks);

}  // namespace stablecut::document
