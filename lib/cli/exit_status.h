// Exit statuses of every tool, and the errors that only a command-line program has.
#pragma once

#include <stdexcept>
#include <string>

#include "base/number_text.h"

namespace stablecut::cli {

enum class ExitStatus {
  kDone = 0,
  kNoAnswer = 1,  ///< valid input without an answer
  kUsage = 64,    ///< wrong options
  kData = 65,     ///< wrong data
  kNoInput = 66,  ///< input missing or unreadable
  kInternal = 70,
  kCannotCreate = 73,  ///< output cannot be created
  kIo = 74,            ///< reading or writing failed
  kInterrupted = 130,
  kPipeClosed = 141,  ///< the reader of standard output is gone
};

/// Ends the tool with a status and a line.
class Failure : public std::runtime_error {
 public:
  Failure(ExitStatus status, const std::string& text) : std::runtime_error(text), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// Options that the tool cannot work with. The text is `--option: value: expected ...`; the tool adds where
/// its help is.
class WrongUsage : public Failure {
 public:
  explicit WrongUsage(const std::string& text) : Failure(ExitStatus::kUsage, text) {}
};

/// Throws WrongUsage with the text if the options are wrong.
inline void refuse_if(bool wrong, const std::string& text) {
  if (wrong) throw WrongUsage(text);
}

/// Refuses what one run does not take on, hours of work or more memory than machines have, before it begins:
/// `amount` of `what` that `options` ask for together. `what` may end with what else there is to do.
inline void refuse_beyond(double most, const std::string& options, double amount, const std::string& what) {
  refuse_if(amount > most, options + ": " + number_text(amount, 12) + ": expected at most " +
                               number_text(most, 12) + " " + what);
}

}  // namespace stablecut::cli
