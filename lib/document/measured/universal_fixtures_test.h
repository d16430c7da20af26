// Universal files that the tests of their reader and their writer share.
#pragma once

#include <algorithm>
#include <complex>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "document/measured/frf_uff.h"
#include "document/measured/reader_fixtures_test.h"

namespace stablecut::document::fixtures {

inline dynamics::FrequencyResponse read(const std::string& text, const FrfChoice& choice = {}) {
  return read_by(frf_from_universal_file, text, choice);
}
inline std::vector<Remark> remarks_on(const std::string& text, const FrfChoice& choice = {}) {
  return remarks_by(frf_from_universal_file, text, choice);
}
inline Remark only_remark(const std::string& text, const FrfChoice& choice = {}) {
  return only_remark_by(frf_from_universal_file, text, choice);
}
inline std::string complaint(const std::string& text, const FrfChoice& choice = {}) {
  return complaint_by(frf_from_universal_file, text, choice);
}

// A dataset 58 as the definition of the format asks for it; each record can be another.
struct Dataset {
  std::string header = "    58\n";
  std::string id = "NONE\nNONE\nNONE\nNONE\nNONE\n";
  std::string places = "    4         0    0         0 NONE               1   1 NONE               1   1\n";
  std::string layout = "         5         3         1  1.00000E+00  5.00000E-01  0.00000E+00\n";
  std::string abscissa = "        18    0    0    0 Frequency            Hz                  \n";
  std::string ordinate = "        12    1    0    0 Acceleration         m/s^2               \n";
  std::string denominator = "        13    0    1    0 Force                N                   \n";
  std::string z = "         0    0    0    0 NONE                 NONE                \n";
  std::string values = "  1.00000E+00  2.00000E+00  3.00000E+00 -4.00000E+00  5.00000E-03  6.00000E+03\n";
  std::string end = "    -1\n";

  std::string text() const {
    return "    -1\n" + header + id + places + layout + abscissa + ordinate + denominator + z + values + end;
  }
};

inline std::string changed(const std::function<void(Dataset&)>& change) {
  Dataset dataset;
  change(dataset);
  return dataset.text();
}

inline std::string bytes_of(const std::vector<double>& values, bool single, bool big) {
  std::string bytes;
  for (const double value : values) {
    char raw[8];
    const auto f = static_cast<float>(value);
    const std::size_t size = single ? 4 : 8;
    std::copy_n(single ? reinterpret_cast<const char*>(&f) : reinterpret_cast<const char*>(&value), size,
                raw);
    if (big) std::reverse(raw, raw + size);
    bytes.append(raw, size);
  }
  return bytes;
}

inline std::string binary_header(int order, std::size_t bytes) {
  char line[100];
  std::snprintf(line, sizeof line, "%6db%6d%6d%12d%12zu%6d%6d%12d%12d\n", 58, order, 2, 11, bytes, 0, 0, 0,
                0);
  return line;
}

inline const Eigen::Vector3cd kValues(std::complex<double>(1, 2), std::complex<double>(3, -4),
                                      std::complex<double>(5e-3, 6e3));
inline const Eigen::Vector3d kLines(1, 1.5, 2);

inline std::string crlf(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

}  // namespace stablecut::document::fixtures
