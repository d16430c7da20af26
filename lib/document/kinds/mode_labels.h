// Names of modes that stay with them from table to table.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "dynamics/mode_comparison.h"

namespace stablecut::document {

/// Labels of the modes of a document that `modal_table_from_json` has read, empty where a mode has none.
std::vector<std::string> mode_labels(const Json& table);

/// A modal table with the labels of the reference's modes at those that are the same (`comparison`: the
/// reference first): a mode that has none in the reference is m and its number there, from 1. Other modes in
/// the band get m and the next free numbers, stand-ins outside the band no label.
Json with_labels_of(const Json& reference, Json table, const dynamics::ModeComparison& comparison);

}  // namespace stablecut::document
