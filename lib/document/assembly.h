// Kind `assembly`: a tool, its holder and the joint between them.
#pragma once

#include <array>
#include <vector>

#include "document/json_text.h"
#include "receptance/assembly.h"

namespace stablecut {

struct AssemblyDocument {
  Eigen::VectorXd frequency_hz;
  BeamTheory theory = BeamTheory::kTimoshenko;
  std::vector<BeamSegment> tool;
  std::array<HeldTool, 2> held;  ///< in x and in y
  bool axisymmetric = true;      ///< the same in both
};

/// Throws DataError; also for what is valid in the format but not computed: a holder by modes or by
/// receptances.
AssemblyDocument assembly_from_json(const Json& document, const Source& source);

}  // namespace stablecut
