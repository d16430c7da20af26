#include "cli/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "cli/exit_status.h"

namespace stablecut::cli {
namespace {

// Names of unfinished files, for the signal handler: it may only read and unlink.
constexpr std::size_t kSlots = 16;
std::array<std::atomic<const char*>, kSlots> unfinished;

void register_unfinished(const char* name) {
  for (auto& slot : unfinished) {
    const char* empty = nullptr;
    if (slot.compare_exchange_strong(empty, name)) return;
  }
}

void forget_unfinished(const char* name) {
  for (auto& slot : unfinished) {
    const char* held = name;
    if (slot.compare_exchange_strong(held, nullptr)) return;
  }
}

void remove_unfinished() {
  for (auto& slot : unfinished) {
    if (const char* name = slot.load()) unlink(name);
  }
}

extern "C" void remove_unfinished_and_exit(int signal) {
  remove_unfinished();
  _exit(128 + signal);
}

std::string out_of_memory;  // the line that says so, made while there is memory

[[noreturn]] void end_without_memory() {
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    remove_unfinished();
    std::fputs(out_of_memory.c_str(), stderr);
    _exit(static_cast<int>(ExitStatus::kInternal));
  } catch (...) {
  }
  std::abort();
}

[[noreturn]] void fail(ExitStatus status, const std::string& name, const char* what) {
  throw Failure(status, name + ": " + what + ": " + std::strerror(errno));
}

void write_all(int file, const std::string& text, const std::string& name) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t wrote = write(file, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0 && errno == EPIPE) throw Failure(ExitStatus::kPipeClosed, "");
    if (wrote < 0) fail(ExitStatus::kIo, name, "cannot be written");
    done += static_cast<std::size_t>(wrote);
  }
}

// Follows symbolic links, also one to a file that is not there yet, so that a rename replaces the file and
// not the link.
std::string resolved(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the Linux kernel follows
  std::filesystem::path target = path;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(target, error); ++links) {
    if (links == kMostLinks) {
      errno = ELOOP;
      fail(ExitStatus::kCannotCreate, path, "cannot be created");
    }
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target.string();
}

}  // namespace

OutputSet::~OutputSet() {
  for (const Item& item : items_) {
    if (item.temporary.empty()) continue;
    unlink(item.temporary.c_str());
    forget_unfinished(item.temporary.c_str());
  }
}

void OutputSet::add(const std::string& path, std::string text) {
  items_.push_back({path, std::move(text), "", ""});
}

void OutputSet::prepare(Item& item) {
  struct stat status {};
  const bool exists = stat(item.path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    errno = EISDIR;
    fail(ExitStatus::kCannotCreate, item.path, "cannot be created");
  }
  if (exists && !S_ISREG(status.st_mode)) return;
  if (exists && access(item.path.c_str(), W_OK) != 0)
    fail(ExitStatus::kCannotCreate, item.path, "cannot be created");
  item.target = resolved(item.path);
  const auto slash = item.target.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : item.target.substr(0, slash + 1);
  std::string temporary = folder + ".stablecut-XXXXXX";
  const int file = mkstemp(temporary.data());
  if (file < 0) fail(ExitStatus::kCannotCreate, item.path, "cannot be created");
  item.temporary = temporary;
  register_unfinished(item.temporary.c_str());
  try {
    const mode_t mask = umask(0);
    umask(mask);
    if (fchmod(file, exists ? status.st_mode & 07777 : 0666 & ~mask) != 0) {
      fail(ExitStatus::kCannotCreate, item.path, "cannot be created");
    }
    write_all(file, item.text, item.path);
    if (fsync(file) != 0) fail(ExitStatus::kIo, item.path, "cannot be written");
  } catch (...) {
    close(file);
    throw;
  }
  if (close(file) != 0) fail(ExitStatus::kIo, item.path, "cannot be written");
}

void OutputSet::commit() {
  for (Item& item : items_) {
    if (item.path != "-") prepare(item);
  }
  // Devices and pipes before standard output, which gets nothing when one of them fails.
  for (const Item& item : items_) {
    if (!item.temporary.empty() || item.path == "-") continue;
    const int file = open(item.path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) fail(ExitStatus::kCannotCreate, item.path, "cannot be created");
    try {
      write_all(file, item.text, item.path);
    } catch (...) {
      close(file);
      throw;
    }
    if (close(file) != 0) fail(ExitStatus::kIo, item.path, "cannot be written");
  }
  for (const Item& item : items_) {
    if (item.path == "-") write_all(STDOUT_FILENO, item.text, "<stdout>");
  }
  for (Item& item : items_) {
    if (item.temporary.empty()) continue;
    if (rename(item.temporary.c_str(), item.target.c_str()) != 0) {
      fail(ExitStatus::kCannotCreate, item.path, "cannot be created");
    }
    forget_unfinished(item.temporary.c_str());
    item.temporary.clear();
  }
}

void install_signal_handlers() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is a failed write
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    // What the caller chose to ignore (nohup, a background job) stays ignored.
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = remove_unfinished_and_exit;
    sigaction(signal, &action, nullptr);
  }
}

void install_memory_handler(const std::string& tool) {
  out_of_memory = tool + ": out of memory\n";
  std::set_terminate(end_without_memory);
}

}  // namespace stablecut::cli
