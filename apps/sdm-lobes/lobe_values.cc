#include "lobe_values.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/range.h"
#include "cli/exit_status.h"

namespace stablecut {

ModeList parse_modes(const std::string& text) {
  ModeList list{parse_index_list(text), {}};
  if (list.indices) return list;
  for (const std::string_view label : split(text, ',')) list.labels.emplace_back(label);
  // A label that begins with a digit would be an index that was mistyped.
  if (std::any_of(list.labels.begin(), list.labels.end(), [](const std::string& label) {
        return label.empty() || !std::isalpha(static_cast<unsigned char>(label[0]));
      }))
    throw cli::WrongUsage("--modes: " + text +
                          ": expected 1-based indices such as 1-7,14-15, or labels such as m1,m3");
  return list;
}

document::Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  const auto index = parse_integer(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : parse_integer(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count)
    throw cli::WrongUsage("--shard: " + text + ": expected K/N with 1 <= K <= N");
  return {*index, *count, {}};
}

}  // namespace stablecut
