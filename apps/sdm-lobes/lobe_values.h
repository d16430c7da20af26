// The values of sdm-lobes' own options.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/kinds/lobes_json.h"

namespace stablecut {

/// Modes of a table, by their numbers or by their labels.
struct ModeList {
  std::optional<std::vector<int>> indices;  ///< 1-based
  std::vector<std::string> labels;          ///< where there are no indices
};

/// The modes of `--modes LIST`. Throws WrongUsage.
ModeList parse_modes(const std::string& text);

/// The part of `--shard K/N`. Throws WrongUsage.
document::Shard parse_shard(const std::string& text);

}  // namespace stablecut
