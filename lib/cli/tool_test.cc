#include "cli/tool.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "cli/exit_status.h"
#include "cli/help_formatter.h"
#include "cli/progress_bar.h"
#include "cli/scratch_folder_test.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::cli;
namespace fs = std::filesystem;

namespace {

// A tool whose work the test gives. It has an option for one remedy, and for no other.
class TestTool : public Tool {
 public:
  explicit TestTool(std::function<void()> work)
      : Tool("test-tool", "Does what a test says.", "test-tool", "frf"), work_(std::move(work)) {}
  using Tool::main_output;
  using Tool::write_text;

 private:
  void setup(CLI::App& app) override { app.add_option("--unit", unit_, "A unit"); }
  void run() override { work_ ? work_() : write_text(main_output(), "text"); }
  std::string option_for(Remedy remedy) const override { return remedy == Remedy::kUnit ? "--unit" : ""; }

  std::function<void()> work_;
  std::string unit_;
};

struct Outcome {
  int status = 0;
  std::string said;  // on standard error
};

Outcome run(TestTool& tool, std::vector<std::string> arguments = {}) {
  arguments.insert(arguments.begin(), "test-tool");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  std::fflush(stderr);
  const int saved = dup(STDERR_FILENO);
  std::FILE* caught = std::tmpfile();
  dup2(fileno(caught), STDERR_FILENO);
  Outcome outcome;
  outcome.status = tool.main(static_cast<int>(argv.size()), argv.data());
  std::fflush(stderr);
  dup2(saved, STDERR_FILENO);
  close(saved);
  std::rewind(caught);
  for (int c = std::fgetc(caught); c != EOF; c = std::fgetc(caught)) outcome.said += static_cast<char>(c);
  std::fclose(caught);
  return outcome;
}

Outcome run_with(std::vector<std::string> arguments) {
  TestTool tool({});
  return run(tool, std::move(arguments));
}

Outcome run_throwing(const std::function<void()>& work) {
  TestTool tool(work);
  return run(tool);
}

}  // namespace

TEST_CASE("texts of the help are lines of words") {
  CHECK(wrapped("", 8).empty());
  CHECK(wrapped("one", 8) == "one");
  CHECK(wrapped("one two three", 7) == "one two\nthree");
  CHECK(wrapped("one two three", 13) == "one two three");
  CHECK(wrapped("one\n\nExample: x", 8) == "one\n\nExample:\nx");
  CHECK(wrapped("a incomprehensible b", 5) == "a\nincomprehensible\nb");
}

TEST_CASE("the time left is that of the share that is done") {
  using std::chrono::seconds;
  CHECK(time_left(0.5, seconds(12)) == "12 s left");
  CHECK(time_left(0.9, seconds(9)) == "1 s left");
  CHECK(time_left(0.25, seconds(30)) == "2 min left");
  CHECK(time_left(0.02, seconds(150)) == "2 h 3 min left");
  CHECK(time_left(1, seconds(5)) == "0 s left");
  CHECK(time_left(0.01, seconds(5)).empty());
  CHECK(time_left(std::nan(""), seconds(5)).empty());
}

TEST_CASE("each failure has its exit status and one line") {
  const auto data = run_throwing([] { throw document::DataError("f", "line 1", "x", "expected y"); });
  CHECK(data.status == 65);
  CHECK(data.said == "test-tool: f: line 1: x: expected y\n");
  const auto argument = run_throwing([] { throw InvalidArgument("a: expected b"); });
  CHECK(argument.status == 65);
  CHECK(argument.said == "test-tool: a: expected b\n");
  const auto answer = run_throwing([] { throw NoAnswer("no pole\n in the band"); });
  CHECK(answer.status == 1);
  CHECK(answer.said == "test-tool: no pole  in the band\n");
  const auto usage = run_throwing([] { throw WrongUsage("--unit: x: expected y"); });
  CHECK(usage.status == 64);
  CHECK(usage.said == "test-tool: --unit: x: expected y (see test-tool --help)\n");
  CHECK(run_with({"--nonsense"}).status == 64);
  CHECK(run_throwing([] { throw Failure(ExitStatus::kIo, "f: cannot be written"); }).status == 74);
  const auto internal = run_throwing([] { throw std::logic_error("oops"); });
  CHECK(internal.status == 70);
  CHECK(internal.said == "test-tool: internal error: oops\n");
}

TEST_CASE("an error's remedy is named by the tool's own option, where it has one") {
  CHECK(run_throwing([] { throw document::DataError("f", "", "", "no unit", Remedy::kUnit); }).said ==
        "test-tool: f: no unit (--unit)\n");
  CHECK(run_throwing([] { throw document::DataError("f", "", "", "no band", Remedy::kBand); }).said ==
        "test-tool: f: no band\n");
  CHECK(run_throwing([] { throw NoAnswer("no unit", Remedy::kUnit); }).said ==
        "test-tool: no unit (--unit)\n");
}

TEST_CASE("an output that cannot be created is status 73 and names the path") {
  const ScratchFolder folder;
  const auto refused = [&](const fs::path& path) {
    INFO(path);
    const Outcome outcome = run_with({"-o", path.string()});
    CHECK(outcome.status == 73);
    CHECK(outcome.said.find("test-tool: " + path.string() + ": cannot be created: ") == 0);
  };
  std::ofstream(folder.path / "file") << "text";
  refused(folder.path / "none" / "x");
  refused(folder.path / "file" / "x");
  refused(folder.path / std::string(300, 'a'));
  fs::create_symlink("loop", folder.path / "loop");
  refused(folder.path / "loop");
  refused(folder.path / "loop" / "x");

  // A folder that may not be entered. Permissions do not bind root, who becomes nobody for as long.
  constexpr uid_t kNobody = 65534;
  fs::permissions(folder.path, fs::perms::none);
  const bool root = geteuid() == 0;
  if (root && seteuid(kNobody) != 0) {
    WARN("skipped: root may not become another user");
  } else {
    refused(folder.path / "x");
    if (root) REQUIRE(seteuid(0) == 0);
    fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
    if (root) REQUIRE(seteuid(kNobody) == 0);
    refused(folder.path / "x");
    if (root) REQUIRE(seteuid(0) == 0);
  }
  fs::permissions(folder.path, fs::perms::owner_all);
}

TEST_CASE("two spellings of one output are refused") {
  const ScratchFolder folder;
  const std::string file = (folder.path / "a").string(), same = (folder.path / "." / "a").string();
  TestTool* tool = nullptr;
  TestTool twice([&] {
    tool->write_text(file, "one");
    tool->write_text(same, "two");
  });
  tool = &twice;
  CHECK(run(twice).status == 64);
  CHECK_FALSE(fs::exists(file));
}
