// Each target takes what is kept for it in testdata/fuzz, without libFuzzer: inputs that reach much of the
// code, and those that were findings.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz_targets.h"

using namespace stablecut;
namespace fs = std::filesystem;

TEST_CASE("what is kept of fuzzing is read or refused") {
  REQUIRE(!fuzz_targets().empty());
  for (const FuzzTarget& target : fuzz_targets()) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(STABLECUT_TESTDATA) / "fuzz" / target.name))
      files.push_back(entry.path());
    CHECK(files.size() >= 2);
    for (const fs::path& path : files) {
      CAPTURE(path);
      std::ifstream file(path, std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(file), {});
      CHECK_NOTHROW(feed(target, bytes));
      // A text that was cut off, at a few places.
      for (std::size_t part = 1; part < 4; ++part)
        CHECK_NOTHROW(feed(target, bytes.substr(0, bytes.size() * part / 4)));
    }
  }
}

TEST_CASE("every folder of kept inputs has its target") {
  for (const auto& entry : fs::directory_iterator(fs::path(STABLECUT_TESTDATA) / "fuzz")) {
    const std::string name = entry.path().filename();
    bool known = false;
    for (const FuzzTarget& target : fuzz_targets()) known = known || name == target.name;
    CAPTURE(name);
    CHECK(known);
  }
}
