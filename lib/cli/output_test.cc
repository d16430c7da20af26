#include "cli/output.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/exit_status.h"
#include "cli/scratch_folder_test.h"

using namespace stablecut::cli;
namespace fs = std::filesystem;

namespace {

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("files appear whole, and a link stays a link") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "old") << "before";
  fs::create_symlink("old", folder.path / "link");
  OutputSet outputs;
  outputs.add((folder.path / "new").string(), "one");
  outputs.add((folder.path / "link").string(), "two");
  outputs.commit();
  CHECK(content(folder.path / "new") == "one");
  CHECK(content(folder.path / "old") == "two");
  CHECK(fs::is_symlink(folder.path / "link"));
}

TEST_CASE("when one output fails, no file has changed and nothing is left over") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "old") << "before";
  for (const auto& [bad, status] : {std::pair{folder.path / "none" / "x", ExitStatus::kCannotCreate},
                                    std::pair{fs::path("/dev/full"), ExitStatus::kIo},
                                    std::pair{folder.path, ExitStatus::kCannotCreate}}) {
    try {
      OutputSet outputs;
      outputs.add((folder.path / "old").string(), "after");
      outputs.add(bad.string(), "text");
      outputs.commit();
      FAIL("expected a failure for " << bad);
    } catch (const Failure& failure) {
      CHECK(failure.status() == status);
    }
    CHECK(content(folder.path / "old") == "before");
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
  }
}
