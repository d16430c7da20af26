// A value inside a document that knows its place: reading with the contract's checks.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/text/json_text.h"

namespace stablecut::document {

/// A number larger than this in size is refused, and one that must not be below 0 and lies between 0 and its
/// inverse: no quantity is so large or small, and products of a few such numbers would overflow.
inline constexpr double kLargestNumber = 1e100;

/// What a number has to be besides that.
struct Bound {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool open_least = false;  ///< least itself is outside
  bool open_most = false;   ///< most itself is outside
  const char* words = "a finite number";
};
inline constexpr Bound kAnyNumber{};
inline constexpr Bound kPositive{.least = 0, .open_least = true, .words = "a number above 0"};
inline constexpr Bound kNotNegative{.least = 0, .words = "a number not below 0"};

/// A view; the document and its source must outlive it. Every failed check throws DataError.
class Node {
 public:
  Node(const Json& value, const Source& source, std::string pointer = "");

  /// The member of that name. `at` needs it; `find` gives nothing when it is absent.
  Node at(std::string_view name) const;
  std::optional<Node> find(std::string_view name) const;
  bool has(std::string_view name) const { return value_->is_object() && value_->contains(std::string(name)); }

  /// Checks this object's names: one that is not known is an error that names the nearest known one, unless
  /// it begins with x_. `known` must not be empty.
  void check_names(std::initializer_list<std::string_view> known) const;
  /// The same for a document's root, which may have `format`, `label` and `provenance` besides.
  void check_document_names(std::initializer_list<std::string_view> known) const;

  double number(const Bound& bound = kAnyNumber) const;
  int integer(int least, int most) const;
  bool boolean() const;
  std::string text() const;
  /// One of the words; the error lists them.
  std::string word(std::initializer_list<std::string_view> words) const;
  Eigen::VectorXd numbers(const Bound& bound = kAnyNumber) const;
  /// [re, im].
  std::complex<double> complex() const;
  /// The items of a list; `least` is how many are needed.
  std::vector<Node> items(std::size_t least = 0) const;

  bool is_null() const { return value_->is_null(); }
  const Json& json() const { return *value_; }
  const std::string& pointer() const { return pointer_; }
  const Source& source() const { return *source_; }

  /// Throws DataError at this place, showing this value (short) and what was expected.
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  void check_known(const std::vector<std::string_view>& known) const;

  const Json* value_;
  const Source* source_;
  std::string pointer_;
};

/// The document's root after checking that it is an object of the kind, `stablecut/<kind>/1`, and that its
/// label, if it has one, is a text. A document inside another has a pointer there.
Node document_root(const Json& value, const Source& source, std::string_view kind, std::string pointer = "");

}  // namespace stablecut::document
