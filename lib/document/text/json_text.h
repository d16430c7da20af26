// JSON text to values and back, with the contract's rules: no duplicate keys, finite numbers, errors by
// place.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace stablecut::document {

/// Keeps the order of fields.
using Json = nlohmann::ordered_json;

/// The bytes of an input, and the name that messages use for it.
struct Source {
  std::string name;
  std::string text;
};

/// An input read and, when it is JSON, parsed.
struct Input {
  Source source;
  Json document;  ///< null when the text is not JSON
};

/// The one JSON value of the text. Throws DataError with pointer and line for broken JSON, a duplicate key,
/// or a number that a double cannot hold.
Json parse_json(const Source& source);

/// Shortest text that reads back to the same numbers: objects and lists of objects indented, lists of numbers
/// on one line, a newline at the end. Bytes of texts that are not UTF-8 become U+FFFD. Throws
/// std::logic_error when a number is not finite.
std::string json_text(const Json& value);

}  // namespace stablecut::document
