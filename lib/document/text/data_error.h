// What is wrong with a document, and where.
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include "base/error.h"

namespace stablecut::document {

/// Wrong data: the text reads `file: place: value: expected ...`; parts that are empty are left out.
class DataError : public std::runtime_error {
 public:
  DataError(const std::string& file, const std::string& place, const std::string& value,
            const std::string& expected, Remedy remedy = Remedy::kNone);
  Remedy remedy() const { return remedy_; }

 private:
  Remedy remedy_;
};

/// A JSON pointer grown by one step, with ~ and / escaped.
std::string pointer_step(const std::string& pointer, const std::string& step);

/// `line 12`.
std::string line_place(long line);

/// `12 lines from 100 to 155 Hz`, of frequencies in Hz, at least one.
std::string lines_text(const Eigen::VectorXd& frequency_hz);

/// A value for a message: on one line, control characters and bytes that are not UTF-8
/// replaced, shortened when long.
std::string shown(std::string value);

}  // namespace stablecut::document
