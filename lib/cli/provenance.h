// Where a document came from.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"

namespace stablecut::cli {

/// Hexadecimal SHA-256 of the bytes.
std::string sha256(const std::string& bytes);

/// One input as the document names it: its bytes' hash, and the provenance that it carried itself.
struct ProvenanceInput {
  std::string name;
  std::string sha256;
  document::Json from;  ///< null when the input carried none
  std::string label;    ///< empty when the input carried none; not part of the entry
};

/// The input's entry; `document` is its parsed value, null when it is not JSON.
ProvenanceInput provenance_input(const document::Source& source, const document::Json& document);

/// The label of a document that was made of these inputs; empty when none has one.
std::string inherited_label(const std::vector<ProvenanceInput>& inputs);

/// The "provenance" member: tool, version, the arguments that change the result, the inputs.
document::Json provenance(const std::string& tool, const std::string& version,
                          const std::vector<std::string>& arguments,
                          const std::vector<ProvenanceInput>& inputs);

}  // namespace stablecut::cli
