// Reading inputs whole.
#pragma once

#include <string>

#include "document/text/json_text.h"

namespace stablecut::cli {

/// The bytes of a file, or of standard input for "-" (named <stdin> in messages). Throws Failure.
document::Source read_source(const std::string& path);

}  // namespace stablecut::cli
