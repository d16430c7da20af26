// A measurement in whatever form a laboratory has it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/measured/frf_choice.h"
#include "document/measured/remark.h"
#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// `json`, `uff`, `csv`, `frf`; nothing for another word.
std::optional<FrfForm> frf_form_from_name(const std::string& name);

/// The form that is read: the one that was chosen, else by content.
FrfForm frf_form_of(const Input& input, const FrfChoice& choice);

/// The frequency responses of one input, in SI. Remarks are what the user should know about how the file was
/// read. Throws DataError; a quantity that a `frf` document contradicts is one too.
dynamics::FrequencyResponse import_frf(const Input& input, const FrfChoice& choice,
                                       std::vector<Remark>& remarks);

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
                                             std::vector<Remark>& remarks);

}  // namespace stablecut::document
