// What hostile bytes are fed to: every reader of documents and measured files, and every parser of lists and
// ranges. Whatever the bytes, it returns or throws what a tool turns into a message.
#pragma once

#include <string>
#include <vector>

namespace stablecut {

struct FuzzTarget {
  const char* name;
  /// Works with the bytes. Throws std::logic_error where what was read is not what it has to be.
  void (*take)(const std::string& bytes);
};

const std::vector<FuzzTarget>& fuzz_targets();

/// `take`, with the refusals of wrong data, arguments and options caught.
void feed(const FuzzTarget& target, const std::string& bytes);

}  // namespace stablecut
