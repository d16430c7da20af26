#include "document/measured/universal_file_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "base/number_text.h"
#include "document/measured/fortran_number.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

// As many digits as twelve characters hold, right-aligned in thirteen columns.
std::string in_13_columns(double value) {
  std::string text;
  for (int digits = 12; digits >= 5; --digits) {
    text = printed(("%." + std::to_string(digits) + "g").c_str(), value);
    if (text.find_first_of(".e") == std::string::npos) text += '.';
    if (text.find('e') != std::string::npos && text.find('.') == std::string::npos)
      text.insert(text.find('e'), ".");
    if (text.size() <= 12) break;
  }
  return std::string(text.size() < 13 ? 13 - text.size() : 0, ' ') + text;
}

double read_back(const std::string& text) {
  std::string_view rest = trimmed(text);
  return take_number(rest).value_or(0);
}

std::string axis_record(const UniversalAxis& axis, int length_exponent, int force_exponent) {
  char text[96];
  std::snprintf(text, sizeof text, "%10d%5d%5d%5d %-20.20s %-20.20s\n", axis.data_type, length_exponent,
                force_exponent, 0, axis.label.empty() ? "NONE" : axis.label.c_str(),
                axis.unit.empty() ? "NONE" : axis.unit.c_str());
  return text;
}

std::string dof_field(const UniversalDof& dof) {
  char text[40];
  std::snprintf(text, sizeof text, " %-10.10s%10d%4d", dof.entity.empty() ? "NONE" : dof.entity.c_str(),
                dof.node, dof.direction);
  return text;
}

void append_double(std::string& bytes, double value) {
  auto bits = std::bit_cast<std::uint64_t>(value);
  for (int i = 0; i < 8; ++i) {
    bytes += static_cast<char>(bits & 0xFF);
    bits >>= 8;
  }
}

}  // namespace

std::string universal_si_units() {
  return "    -1\n   164\n         1SI                           2\n"
         "  1.00000000000000000D+00  1.00000000000000000D+00  1.00000000000000000D+00\n"
         "  2.73160000000000025D+02\n    -1\n";
}

std::string universal_function(const UniversalFunction& function, UniversalForm form) {
  const bool binary = form == UniversalForm::kBinary;
  const Eigen::VectorXd& abscissa = function.abscissa;
  const Eigen::Index count = abscissa.size();
  const double first = abscissa[0],
               step = count > 1 ? (abscissa[count - 1] - first) / static_cast<double>(count - 1) : 0;
  const std::string first_text = in_13_columns(first), step_text = in_13_columns(step);
  const double first_read = read_back(first_text), step_read = read_back(step_text);
  double farthest = 0;
  for (Eigen::Index i = 0; i < count; ++i)
    farthest = std::max(farthest, std::abs(first_read + static_cast<double>(i) * step_read - abscissa[i]));
  const double allowed = binary ? 0 : 1e-9 * std::max(std::abs(first), std::abs(abscissa[count - 1]));
  const bool even = farthest <= allowed;

  std::string values;
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::array<double, 2> parts = {function.values[i].real(), function.values[i].imag()};
    if (binary) {
      if (!even) append_double(values, abscissa[i]);
      for (const double part : parts) append_double(values, part);
      continue;
    }
    if (!even) values += in_13_columns(abscissa[i]);
    for (const double part : parts) values += printed("%20.12E", part);
    // Even lines: two values a line, 4E20.12; uneven: E13.5,2E20.12.
    if (!even || i % 2 == 1 || i + 1 == count) values += '\n';
  }

  std::string text = "    -1\n";
  char line[128];
  if (binary) {
    std::snprintf(line, sizeof line, "%6db%6d%6d%12d%12zu%6d%6d%12d%12d\n", 58, 1, 2, kUniversalHeaderRecords,
                  values.size(), 0, 0, 0, 0);
    text += line;
  } else {
    text += "    58\n";
  }
  for (const std::string& id : function.id) text += (id.empty() ? "NONE" : id.substr(0, 80)) + "\n";
  std::snprintf(line, sizeof line, "%5d%10d%5d%10d", function.type, 0, 0, 0);
  text += line + dof_field(function.response) + dof_field(function.reference) + "\n";
  std::snprintf(line, sizeof line, "%10d%10ld%10d", 6, static_cast<long>(count), even ? 1 : 0);
  text +=
      line + (even ? first_text + step_text : in_13_columns(0) + in_13_columns(0)) + in_13_columns(0) + "\n";
  text += axis_record(function.abscissa_axis, 0, 0) + axis_record(function.ordinate, 1, 0) +
          axis_record(function.denominator, 0, 1) + axis_record({}, 0, 0);
  return text + values + "    -1\n";
}

}  // namespace stablecut::document
