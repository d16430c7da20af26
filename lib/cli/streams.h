// Reading inputs whole.
#pragma once

#include <string>

#include "document/text/json_text.h"

namespace stablecut::cli {

/// The bytes of a file, or of standard input for "-" (named <stdin> in messages). At most 1 GiB. Throws
/// Failure, and DataError where there is more.
document::Source read_source(const std::string& path);

}  // namespace stablecut::cli
