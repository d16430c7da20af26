#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>

#include "base/units.h"
#include "document/kinds/load_samples_json.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

// What a column holds: a quantity, its component, and the factor to SI.
enum class Quantity {
  kJoint,
  kForce,
  kMoment,
  kDeflection,
  kRotation,
  kStd,
  kStdRotation,
  kForcePoint,
  kMeasuringPoint
};

struct Column {
  Quantity quantity;
  int component;
  double to_si;
};

// "dx [um]", "dx (um)", "dx_um", "Dx/um" -> name "dx", unit "um"; punctuation inside the name is dropped.
std::pair<std::string, std::string> name_and_unit(std::string header, const std::vector<std::string>& units) {
  header = lower(std::move(header));
  std::string unit;
  if (const auto open = header.find_first_of("[("); open != std::string::npos) {
    const auto close = header.find_first_of("])", open);
    unit = header.substr(open + 1, close == std::string::npos ? close : close - open - 1);
    header.erase(open);
  } else {
    for (const std::string& candidate : units) {
      for (const char separator : {'_', ' ', '/'}) {
        const std::string ending = separator + candidate;
        if (header.size() > ending.size() && header.ends_with(ending)) {
          unit = candidate;
          header.resize(header.size() - ending.size());
          break;
        }
      }
      if (!unit.empty()) break;
    }
  }
  std::string name;
  for (const char c : header) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  }
  // Other signs than the micro sign, such as the dot of N.m, are dropped.
  if (unit.find("\xC2\xB0") != std::string::npos) unit = "deg";
  unit = plain_signs(unit);
  std::erase_if(unit, [](unsigned char c) { return !std::isalnum(c) || c > 127; });
  return {name, unit};
}

// In SI: far beyond any robot, and far within what the arithmetic bears. The JSON reader has the same bounds.
double largest(Quantity quantity) {
  switch (quantity) {
    case Quantity::kForce:
    case Quantity::kMoment:
      return kLargestLoad;
    case Quantity::kDeflection:
    case Quantity::kForcePoint:
    case Quantity::kMeasuringPoint:
    case Quantity::kStd:
      return kLargestLength;
    case Quantity::kJoint:
    case Quantity::kRotation:
    case Quantity::kStdRotation:
      return kLargestAngle;
  }
  return 0;
}

struct Known {
  Quantity quantity;
  std::vector<std::string> names;                     // without the component
  std::vector<std::pair<std::string, double>> units;  // the first is the default
};

const std::vector<Known>& known_columns() {
  static const std::vector<Known> kKnown = {
      {Quantity::kForce, {"f", "force"}, {{"n", 1}, {"kn", 1e3}}},
      {Quantity::kMoment, {"m", "moment", "t", "torque"}, {{"nm", 1}, {"nmm", 1e-3}, {"knm", 1e3}}},
      {Quantity::kDeflection,
       {"d", "u", "delta", "deflection", "displacement"},
       {{"mm", 1e-3}, {"um", 1e-6}, {"m", 1}}},
      {Quantity::kRotation,
       {"r", "rot", "rotation"},
       {{"rad", 1}, {"mrad", 1e-3}, {"urad", 1e-6}, {"deg", kPi / 180}}},
      {Quantity::kForcePoint, {"forcepoint", "loadpoint"}, {{"mm", 1e-3}, {"m", 1}}},
      {Quantity::kMeasuringPoint, {"measuringpoint", "measurementpoint"}, {{"mm", 1e-3}, {"m", 1}}},
  };
  return kKnown;
}

const std::vector<std::pair<std::string, double>>& units_of(Quantity quantity) {
  const auto& known = known_columns();
  return std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.quantity == quantity; })
      ->units;
}

std::optional<double> factor(const std::vector<std::pair<std::string, double>>& units,
                             const std::string& unit) {
  if (unit.empty()) return units.front().second;
  for (const auto& [name, value] : units) {
    if (name == unit) return value;
  }
  return std::nullopt;
}

// Nothing for a column that holds none of them. `unit_error` is set where the name is known but not the unit.
std::optional<Column> column_of(const std::string& header, const robot::Robot& robot, bool& unit_error) {
  static const std::vector<std::string> kUnits = {"n_mm", "nmm", "kn_m",      "knm",  "n_m", "nm",
                                                  "kn",   "n",   "urad",      "mrad", "rad", "deg",
                                                  "mm",   "um",  "\xc2\xb5m", "m"};
  const auto [name, unit] = name_and_unit(header, kUnits);
  const std::vector<std::pair<std::string, double>> angles = {{"deg", kPi / 180}, {"rad", 1}};
  const auto with_unit = [&](Quantity quantity, int component, const auto& units) -> std::optional<Column> {
    const auto to_si = factor(units, unit);
    unit_error = !to_si;
    return Column{quantity, component, to_si.value_or(0)};
  };
  for (int j = 0; j < robot::kJoints; ++j) {
    const std::string number = std::to_string(j + 1);
    const std::string own = name_and_unit(robot.joints[j].name, {}).first;
    if (name == own || name == "a" + number || name == "j" + number || name == "q" + number ||
        name == "joint" + number || name == "axis" + number || name == "theta" + number) {
      return with_unit(Quantity::kJoint, j, angles);
    }
  }
  if (name == "std") {
    const bool rotation = !unit.empty() && factor(units_of(Quantity::kRotation), unit);
    return rotation ? with_unit(Quantity::kStdRotation, 0, units_of(Quantity::kRotation))
                    : with_unit(Quantity::kStd, 0, units_of(Quantity::kDeflection));
  }
  if (name.empty()) return std::nullopt;
  const auto component = std::string("xyz").find(name.back());
  if (component == std::string::npos) return std::nullopt;
  const std::string stem = name.substr(0, name.size() - 1);
  for (const Known& known : known_columns()) {
    if (std::find(known.names.begin(), known.names.end(), stem) != known.names.end()) {
      return with_unit(known.quantity, static_cast<int>(component), known.units);
    }
  }
  return std::nullopt;
}

std::vector<std::optional<Column>> columns_of(const Source& source, const TableRow& header,
                                              const robot::Robot& robot) {
  std::vector<std::optional<Column>> columns;
  for (const std::string& field : header.fields) {
    bool unit_error = false;
    columns.push_back(column_of(field, robot, unit_error));
    if (unit_error) {
      throw DataError(source.name, line_place(header.line), '"' + field + '"',
                      "expected a unit of that quantity, such as deg, N, mm, um or rad");
    }
    const auto& last = columns.back();
    for (std::size_t i = 0; last && i + 1 < columns.size(); ++i) {
      if (columns[i] && columns[i]->quantity == last->quantity && columns[i]->component == last->component) {
        throw DataError(source.name, line_place(header.line), '"' + field + '"', "expected each column once");
      }
    }
  }
  return columns;
}

}  // namespace

LoadSamplesDocument load_samples_from_csv(const Source& source, const robot::Robot& robot,
                                          const std::array<bool, 3>& components) {
  std::vector<TableRow> rows = table_rows(source);
  if (rows.empty())
    throw DataError(source.name, "", "", "empty input: expected joint angles, forces and deflections");
  std::vector<std::optional<Column>> columns;
  const long header_line = rows.front().line;
  if (is_header(rows.front())) {
    columns = columns_of(source, rows.front(), robot);
    rows.erase(rows.begin());
  } else {
    if (rows.front().fields.size() != 12) {
      throw DataError(source.name, line_place(header_line),
                      std::to_string(rows.front().fields.size()) + " columns",
                      "expected a header, or 12 columns: six joints (deg), force (N), deflection (mm)");
    }
    for (int j = 0; j < robot::kJoints; ++j) columns.push_back(Column{Quantity::kJoint, j, kPi / 180});
    for (int d = 0; d < 3; ++d) columns.push_back(Column{Quantity::kForce, d, 1});
    for (int d = 0; d < 3; ++d) columns.push_back(Column{Quantity::kDeflection, d, 1e-3});
  }
  const auto find = [&](Quantity quantity, int component) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i] && columns[i]->quantity == quantity && columns[i]->component == component) return i;
    }
    return std::nullopt;
  };
  const auto need = [&](Quantity quantity, int component, const std::string& name) {
    if (!find(quantity, component)) {
      throw DataError(source.name, line_place(header_line), "",
                      "expected a column " + name + " in the header");
    }
  };
  for (int j = 0; j < robot::kJoints; ++j) need(Quantity::kJoint, j, robot.joints[j].name);
  static const std::string kAxes = "xyz";
  for (int d = 0; d < 3; ++d) {
    need(Quantity::kForce, d, std::string("f") + kAxes[d]);
    if (components[d]) {
      need(Quantity::kDeflection, d, std::string("d") + kAxes[d]);
    }
  }

  // Of moments, rotations and points all three or none: a missing one is not 0.
  for (const auto& [quantity, name] : {std::pair<Quantity, std::string>{Quantity::kMoment, "m"},
                                       {Quantity::kRotation, "r"},
                                       {Quantity::kForcePoint, "force_point_"},
                                       {Quantity::kMeasuringPoint, "measuring_point_"}}) {
    if (!find(quantity, 0) && !find(quantity, 1) && !find(quantity, 2)) continue;
    for (int d = 0; d < 3; ++d) need(quantity, d, name + kAxes[d]);
  }

  // A spreadsheet's empty lines are rows of empty fields.
  std::erase_if(rows, [](const TableRow& row) {
    return std::all_of(row.fields.begin(), row.fields.end(),
                       [](const std::string& field) { return field.empty(); });
  });
  if (rows.empty())
    throw DataError(source.name, line_place(header_line), "", "expected rows below the header");
  LoadSamplesDocument result;
  for (const TableRow& row : rows) {
    for (std::size_t i = columns.size(); i < row.fields.size(); ++i) {
      if (row.fields[i].empty()) continue;
      throw DataError(source.name, line_place(row.line), std::to_string(row.fields.size()) + " columns",
                      "expected " + std::to_string(columns.size()) +
                          ", as in the first line (with decimal commas separate by semicolons or tabs)");
    }
    const auto value = [&](Quantity quantity, int component) -> std::optional<double> {
      const auto column = find(quantity, component);
      if (!column) return std::nullopt;
      if (quantity == Quantity::kDeflection && !components[component]) return std::nullopt;
      const double si = table_number(source, row, *column, "a number") * columns[*column]->to_si;
      if (!(std::abs(si) <= largest(quantity))) {
        throw DataError(source.name, line_place(row.line), row.fields[*column],
                        "expected a number of a robot's size");
      }
      return si;
    };
    const auto vector = [&](Quantity quantity) -> std::optional<Eigen::Vector3d> {
      Eigen::Vector3d v = Eigen::Vector3d::Zero();
      bool any = false;
      for (int d = 0; d < 3; ++d) {
        if (const auto x = value(quantity, d)) {
          v[d] = *x;
          any = true;
        }
      }
      return any ? std::optional(v) : std::nullopt;
    };
    const auto deviation = [&](Quantity quantity) -> std::optional<Eigen::Vector3d> {
      const auto x = value(quantity, 0);
      if (!x) return std::nullopt;
      if (!(*x >= kLeastDeviation)) {
        throw DataError(source.name, line_place(row.line), row.fields[*find(quantity, 0)],
                        "expected a standard deviation above 0");
      }
      return Eigen::Vector3d::Constant(*x);
    };
    robot::LoadSample sample;
    for (int j = 0; j < robot::kJoints; ++j) sample.angles[j] = *value(Quantity::kJoint, j);
    sample.force_n = *vector(Quantity::kForce);
    sample.moment_n_m = vector(Quantity::kMoment).value_or(Eigen::Vector3d::Zero());
    sample.deflection_m = vector(Quantity::kDeflection).value_or(Eigen::Vector3d::Zero());
    sample.rotation_rad = vector(Quantity::kRotation);
    sample.force_point = vector(Quantity::kForcePoint).value_or(robot.tool.translation());
    sample.measuring_point = vector(Quantity::kMeasuringPoint).value_or(robot.tool.translation());
    sample.deflection_std_m = deviation(Quantity::kStd);
    sample.rotation_std_rad = deviation(Quantity::kStdRotation);
    if (sample.rotation_rad && sample.rotation_std_rad.has_value() != sample.deflection_std_m.has_value()) {
      throw DataError(source.name, line_place(header_line), "",
                      "expected both std and std_rad where rotations are measured, or neither");
    }
    result.samples.push_back(std::move(sample));
    result.places.push_back(line_place(row.line));
  }
  return result;
}

}  // namespace stablecut::document
