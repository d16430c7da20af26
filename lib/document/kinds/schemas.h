// The JSON Schemas of all document kinds, from the folder schemas/.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace stablecut::document {

/// The schema's text, or nothing for an unknown kind.
std::optional<std::string_view> schema_text(std::string_view kind);

/// All kinds, comma-separated.
std::string schema_kinds();

}  // namespace stablecut::document
