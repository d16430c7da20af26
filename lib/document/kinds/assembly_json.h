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
#include "receptance/plausibility.h"

namespace stablecut::document {

/// What the user should know of a holder that was measured.
struct HolderFinding {
  enum class Kind {
    kTakenFromOther,  ///< nothing was measured in `direction`: it is taken as the other one
    kLimits,          ///< of what was measured in `direction`: `quality`
    kCrossLeftOut,    ///< entries between x and y were measured, but too few to be of use
  };
  Kind kind;
  std::string place;  ///< document and JSON pointer of the measurement, as messages name it
  int direction = 0;
  receptance::HolderQuality quality;
  std::size_t lines = 0;  ///< of the assembly
};

/// A material that is no solid's, and segments that are no tool's: likely in other units.
struct DoubtfulMaterial {
  std::string place;  ///< document and JSON pointer, as messages name it
  receptance::MaterialDoubt doubt;
  receptance::BeamSegment material;
};
struct DoubtfulSize {
  std::string place;
  receptance::SizeDoubt doubt;
  receptance::BeamChain segments;
};

struct AssemblyDocument {
  receptance::Assembly assembly;
  /// Of directions whose holder was measured.
  std::array<std::optional<receptance::HolderQuality>, 2> quality;
  std::vector<Remark> remarks;  ///< on how the files that it names were read
  std::vector<HolderFinding> findings;
  std::vector<DoubtfulMaterial> material_doubts;
  std::vector<DoubtfulSize> size_doubts;
};

/// Reads the file that the document names by {"file": path}.
using DocumentLoader = std::function<Input(const std::string& path)>;

/// The lines that the document asks for, Hz. Throws DataError.
Eigen::VectorXd assembly_frequencies(const Json& document, const Source& source);

/// The assembly on the given lines (Hz, above 0, increasing), which may be other lines than it asks for.
/// Throws DataError.
AssemblyDocument assembly_from_json(const Json& document, const Source& source,
                                    const Eigen::VectorXd& frequency_hz, const DocumentLoader& load);

/// What is known of the quality of a measured holder, for the member `holder` of a tip's document; null when
/// nothing was measured.
Json holder_quality_to_json(const AssemblyDocument& document);

}  // namespace stablecut::document
