// A document in some words, for who wrote it into a file.
#pragma once

#include <string>

#include "document/text/json_text.h"

namespace stablecut::cli {

/// What a document of ours says, in one line without its end: `15 modes, 25.1 to 980 Hz`. Kinds that no line
/// says more of than their name have it alone.
std::string summary(const document::Json& document);

}  // namespace stablecut::cli
