#include "document/measured/given_poles.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "base/number_text.h"
#include "base/units.h"
#include "document/kinds/modal_table_json.h"
#include "document/text/data_error.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

constexpr double kMostHz = 1e100;  // its square is still a number

std::vector<modal::GivenPole> poles_of_table(const dynamics::ModalModel& model) {
  std::vector<modal::GivenPole> poles;
  for (const dynamics::Mode& mode : model.modes) {
    modal::GivenPole given{mode.pole(), {}};
    for (std::size_t i = 0; i < model.dofs.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (mode.psi_r[at] != 0.0 || mode.psi_l[at] != 0.0) given.directions.push_back(model.dofs[i]);
    }
    poles.push_back(std::move(given));
  }
  return poles;
}

std::size_t column_named(const Source& source, const TableRow& header, const std::string& name) {
  const auto found = std::find(header.fields.begin(), header.fields.end(), name);
  if (found == header.fields.end())
    throw DataError(source.name, line_place(header.line), "", "expected a column " + name);
  return found - header.fields.begin();
}

double number_between(const Source& source, const TableRow& row, std::size_t column, double most,
                      const char* words) {
  const double value = table_number(source, row, column, words);
  if (value > 0 && value < most) return value;
  throw DataError(source.name, line_place(row.line), row.fields[column], std::string("expected ") + words);
}

}  // namespace

std::vector<modal::GivenPole> given_poles(const Input& input) {
  if (!input.document.is_null()) return poles_of_table(modal_table_from_json(input.document, input.source));
  const Source& source = input.source;
  const std::vector<TableRow> rows = table_rows(source);
  if (rows.size() < 2)
    throw DataError(source.name, "", "",
                    "expected a modal-table, or a header frequency_hz,damping_ratio and rows below it");
  const std::size_t frequency = column_named(source, rows[0], "frequency_hz"),
                    damping = column_named(source, rows[0], "damping_ratio");
  std::vector<modal::GivenPole> poles;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double hz = number_between(source, rows[i], frequency, kMostHz, "a frequency above 0 Hz");
    const double ratio = number_between(source, rows[i], damping, 1, "a damping ratio above 0 and below 1");
    const std::complex<double> pole =
        rad_per_s_from_hz(hz) * std::complex<double>(-ratio, std::sqrt(1 - ratio * ratio));
    if (std::any_of(poles.begin(), poles.end(), [&](const auto& other) { return other.pole == pole; }))
      throw DataError(source.name, line_place(rows[i].line), number_text(hz) + " Hz",
                      "expected each pole once");
    poles.push_back({pole, {}});
  }
  return poles;
}

}  // namespace stablecut::document
