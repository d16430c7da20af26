// What a numeric room may throw. Bad documents have their own error, in lib/document.
#pragma once

#include <stdexcept>
#include <string>

namespace stablecut {

/// What whoever asked could change, where an error suggests it. A tool knows which of its options that is,
/// and a room below it knows of none.
enum class Remedy {
  kNone,
  kBand,            ///< another band of the measurement
  kQuantity,        ///< say what was measured
  kUnit,            ///< say in which unit
  kQuantityOrUnit,  ///< either of the two
  kFunctions,       ///< take some of the file's functions
  kNode,            ///< take what was measured at one node
  kModes,           ///< take some of the modes
  kTaps,            ///< say that it is a record of a tap
  kSampleRate,      ///< say how often it was sampled
  kSensitivity      ///< say how many volts a sensor gives
};

/// An argument outside what the function can take; the text names quantity, value and what was expected.
class InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The input is valid, but the question has no answer: a fit that does not converge, an empty band.
class NoAnswer : public std::runtime_error {
 public:
  explicit NoAnswer(const std::string& text, Remedy remedy = Remedy::kNone)
      : std::runtime_error(text), remedy_(remedy) {}
  Remedy remedy() const { return remedy_; }

 private:
  Remedy remedy_;
};

}  // namespace stablecut
