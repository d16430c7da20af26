// What fit-modes does with modal tables alone: comparing two, and carrying labels from one to another.
#pragma once

#include <string>
#include <vector>

#include "cli/tool.h"
#include "document/text/json_text.h"

namespace stablecut {

class TableOptions {
 public:
  /// Declares --compare and --track; the object must stay where it is until they have been parsed.
  void declare(CLI::App& app);
  const std::vector<CLI::Option*>& declared() const { return declared_; }
  bool given() const { return !compared_path_.empty() || !reference_path_.empty(); }
  /// The other table's file.
  const std::string& other() const { return compared_path_.empty() ? reference_path_ : compared_path_; }
  /// Throws WrongUsage for both at once.
  void check() const;

  /// The document that is asked for. Throws DataError, naming the files.
  document::Json result(const document::Input& table, const document::Input& other) const;

 private:
  std::string compared_path_, reference_path_;
  std::vector<CLI::Option*> declared_;
};

}  // namespace stablecut
