// Labels: what the user calls a document, carried from inputs to outputs and pictures.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"

namespace stablecut::document {

/// The document's own label; empty where it has none.
std::string label_of(const Json& document);

/// The label of what was made of documents with these labels: each of their parts once, in this order, ", "
/// between them. Parts of a label are what ", " divides, so that a label that came by two ways stands once.
std::string joined_labels(const std::vector<std::string>& labels);

}  // namespace stablecut::document
