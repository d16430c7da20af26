// What tests ask a reader of measurements: the values of a text, what is remarked on it, and what is wrong
// with it.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "document/measured/frf_choice.h"
#include "document/measured/remark.h"
#include "document/text/data_error.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document::fixtures {

using FrfReader = dynamics::FrequencyResponse (*)(const Source&, const FrfChoice&, std::vector<Remark>&);

inline std::vector<Remark> remarks_by(FrfReader reader, const std::string& text, const FrfChoice& choice) {
  std::vector<Remark> remarks;
  reader({"f", text}, choice, remarks);
  return remarks;
}

inline dynamics::FrequencyResponse read_by(FrfReader reader, const std::string& text,
                                           const FrfChoice& choice) {
  std::vector<Remark> remarks;
  return reader({"f", text}, choice, remarks);
}

inline Remark only_remark_by(FrfReader reader, const std::string& text, const FrfChoice& choice) {
  const std::vector<Remark> remarks = remarks_by(reader, text, choice);
  REQUIRE(remarks.size() == 1);
  return remarks[0];
}

/// Empty where nothing is wrong.
inline std::string complaint_by(FrfReader reader, const std::string& text, const FrfChoice& choice) {
  try {
    read_by(reader, text, choice);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace stablecut::document::fixtures
