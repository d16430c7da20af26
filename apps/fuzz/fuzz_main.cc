// One executable of libFuzzer for all targets: STABLECUT_FUZZ_TARGET names the one. scripts/fuzz runs it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz_targets.h"

using namespace stablecut;

namespace {

const FuzzTarget& chosen() {
  const char* name = std::getenv("STABLECUT_FUZZ_TARGET");
  for (const FuzzTarget& target : fuzz_targets())
    if (name != nullptr && std::string(name) == target.name) return target;
  std::fputs("STABLECUT_FUZZ_TARGET: expected the name of a target\n", stderr);
  std::_Exit(64);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const FuzzTarget& target = chosen();
  // An exception that is no refusal ends the process, and is a finding.
  feed(target, std::string(reinterpret_cast<const char*>(bytes), size));
  return 0;
}
