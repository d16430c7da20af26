// Kind `assembly`: a tool, its holder and the joint between them.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "document/measured/remark.h"
#include "document/text/json_text.h"
#include "receptance/assembly.h"
#include "receptance/measured_holder.h"

namespace stablecut::document {

struct AssemblyDocument {
  receptance::Assembly assembly;
  /// Of directions whose holder was measured.
  std::array<std::optional<receptance::HolderQuality>, 2> quality;
  std::vector<Remark> remarks;  ///< on how the files that it names were read
  std::vector<std::string> warnings;
};

/// Reads what the document names by {"file": path}.
using DocumentLoader = std::function<Input(const std::string& path)>;

/// The lines that the document asks for, Hz. Throws DataError.
Eigen::VectorXd assembly_frequencies(const Json& document, const Source& source);

/// The assembly on the given lines (Hz, above 0, increasing). Throws DataError.
AssemblyDocument assembly_from_json(const Json& document, const Source& source,
                                    const Eigen::VectorXd& frequency_hz, const DocumentLoader& load);

/// What is known of measured holders, for the member `holder` of a tip's document; null when there is none.
Json holder_quality_to_json(const AssemblyDocument& document);

}  // namespace stablecut::document
