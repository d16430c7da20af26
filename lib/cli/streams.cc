#include "cli/streams.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "cli/exit_status.h"
#include "document/text/data_error.h"

namespace stablecut::cli {
namespace {

// Far above any measurement, far below what a workstation has: an endless device comes to an end.
constexpr std::size_t kLargestInput = std::size_t{1} << 30;

}  // namespace

document::Source read_source(const std::string& path) {
  const bool standard = path == "-";
  document::Source source{standard ? "<stdin>" : path, ""};
  const auto fail = [&](ExitStatus status, const char* what) -> void {
    throw Failure(status, source.name + ": " + what + ": " + std::strerror(errno));
  };
  const int file = standard ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(ExitStatus::kNoInput, "cannot be read");
  struct stat status {};
  if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
    source.text.reserve(status.st_size);
  }
  std::array<char, 1 << 16> buffer;
  ssize_t got = 0;
  while ((got = read(file, buffer.data(), buffer.size())) != 0) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      const bool unreadable = errno == EISDIR || errno == EBADF;
      if (!standard) close(file);
      fail(unreadable ? ExitStatus::kNoInput : ExitStatus::kIo, "cannot be read");
    }
    source.text.append(buffer.data(), got);
    if (source.text.size() > kLargestInput) {
      if (!standard) close(file);
      throw document::DataError(source.name, "", "", "expected at most 1 GiB");
    }
  }
  if (!standard) close(file);
  return source;
}

}  // namespace stablecut::cli
