// What a numeric room may throw. Bad documents have their own error, in lib/document.
#pragma once

#include <stdexcept>

namespace stablecut {

/// An argument outside what the function can take; the text names quantity, value and what was expected.
class InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The input is valid, but the question has no answer: a fit that does not converge, an empty band.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace stablecut
