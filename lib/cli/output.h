// Writing outputs whole or not at all.
#pragma once

#include <string>
#include <vector>

namespace stablecut::cli {

/// Collects the texts of a run and writes them together: files are written beside their targets and synced
/// first, then standard output is written, then the files are renamed into place. When anything fails,
/// Failure is thrown and no file has changed. A target that is not a regular file (a device, a pipe) is
/// written directly.
class OutputSet {
 public:
  OutputSet() = default;
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;
  ~OutputSet();

  /// "-" is standard output.
  void add(const std::string& path, std::string text);
  void commit();

 private:
  struct Item {
    std::string path;
    std::string text;
    std::string temporary;  // empty: written directly
    std::string target;     // the file that a rename replaces
  };
  void prepare(Item& item);

  std::vector<Item> items_;
};

/// From now on an interrupt or a termination removes unfinished files and ends the process, with 130 and 143,
/// and a closed pipe is an error of the write.
void install_signal_handlers();

/// From now on memory that ends where nothing can be thrown (the JSON library's moves and destructors) ends
/// the process with a line of that tool and 70, as anywhere else.
void install_memory_handler(const std::string& tool);

}  // namespace stablecut::cli
