#include "document/text/label.h"

#include <algorithm>
#include <string_view>

namespace stablecut::document {

std::string label_of(const Json& document) {
  if (!document.is_object()) return "";
  const auto found = document.find("label");
  return found != document.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string joined_labels(const std::vector<std::string>& labels) {
  constexpr std::string_view kBetween = ", ";
  std::vector<std::string_view> parts;
  std::string joined;
  for (const std::string& label : labels) {
    std::string_view rest = label;
    while (!rest.empty()) {
      const auto end = rest.find(kBetween);
      const std::string_view part = rest.substr(0, end);
      rest = end == std::string_view::npos ? "" : rest.substr(end + kBetween.size());
      if (part.empty() || std::find(parts.begin(), parts.end(), part) != parts.end()) continue;
      parts.push_back(part);
      if (!joined.empty()) joined += kBetween;
      joined += part;
    }
  }
  return joined;
}

}  // namespace stablecut::document
