// Materials and round beam segments of an assembly document.
#pragma once

#include <map>
#include <string>

#include "document/text/node.h"
#include "receptance/held_tool.h"

namespace stablecut::document {

/// By name: segments of that material, without sizes.
using Materials = std::map<std::string, receptance::BeamSegment>;

/// Throws DataError.
Materials materials_from(const Node& node);

/// A list of at least `least` segments. Throws DataError.
receptance::BeamChain segments_from(const Node& node, const Materials& materials, std::size_t least);

}  // namespace stablecut::document
