#include "document/measured/load_samples_csv.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/units.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

enum class ColumnKind {
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
  ColumnKind kind = ColumnKind::kJoint;
  int component = 0;  // joint 0..5, or x, y, z
  double to_si = 1;
};

struct NamedUnit {
  std::string name;
  double to_si;
};
using UnitList = std::vector<NamedUnit>;  // the first is the default

const UnitList& units_of(ColumnKind kind) {
  static const UnitList kAngles = {{"deg", kPi / 180}, {"rad", 1}};
  static const UnitList kForces = {{"n", 1}, {"kn", 1e3}};
  static const UnitList kMoments = {{"nm", 1}, {"nmm", 1e-3}, {"knm", 1e3}};
  static const UnitList kDeflections = {{"mm", 1e-3}, {"um", 1e-6}, {"m", 1}};
  static const UnitList kRotations = {{"rad", 1}, {"mrad", 1e-3}, {"urad", 1e-6}, {"deg", kPi / 180}};
  static const UnitList kPoints = {{"mm", 1e-3}, {"m", 1}};
  switch (kind) {
    case ColumnKind::kJoint:
      return kAngles;
    case ColumnKind::kForce:
      return kForces;
    case ColumnKind::kMoment:
      return kMoments;
    case ColumnKind::kDeflection:
    case ColumnKind::kStd:
      return kDeflections;
    case ColumnKind::kRotation:
    case ColumnKind::kStdRotation:
      return kRotations;
    case ColumnKind::kForcePoint:
    case ColumnKind::kMeasuringPoint:
      return kPoints;
  }
  return kAngles;
}

// In SI: far beyond any robot, and far within what the arithmetic bears. The JSON reader has the same bounds.
double largest(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::kForce:
    case ColumnKind::kMoment:
      return kLargestLoad;
    case ColumnKind::kDeflection:
    case ColumnKind::kForcePoint:
    case ColumnKind::kMeasuringPoint:
    case ColumnKind::kStd:
      return kLargestLength;
    case ColumnKind::kJoint:
    case ColumnKind::kRotation:
    case ColumnKind::kStdRotation:
      return kLargestAngle;
  }
  return 0;
}

// ---- header ----

struct HeaderField {
  std::string name;  // in lower case, letters and digits only
  std::string unit;  // likewise; empty where none is told
};

std::string letters_and_digits(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c))) result += c;
  }
  return result;
}

// "dx [um]", "dx (um)", "dx_um", "Dx/um": the name dx and the unit um.
HeaderField header_field(std::string text) {
  static const std::vector<std::string> kEndings = {"n_mm", "nmm", "kn_m",      "knm",  "n_m", "nm",
                                                    "kn",   "n",   "urad",      "mrad", "rad", "deg",
                                                    "mm",   "um",  "\xc2\xb5m", "m"};
  text = lower(std::move(text));
  HeaderField field;
  if (const auto open = text.find_first_of("[("); open != std::string::npos) {
    const auto close = text.find_first_of("])", open);
    field.unit = text.substr(open + 1, close == std::string::npos ? close : close - open - 1);
    text.erase(open);
  } else {
    for (const std::string& unit : kEndings) {
      if (text.size() < unit.size() + 2 || !text.ends_with(unit)) continue;
      const char separator = text[text.size() - unit.size() - 1];
      if (separator != '_' && separator != ' ' && separator != '/') continue;
      field.unit = unit;
      text.resize(text.size() - unit.size() - 1);
      break;
    }
  }
  field.name = letters_and_digits(text);
  // Other signs than the micro sign, such as the dot of N.m, are dropped.
  if (field.unit.find("\xC2\xB0") != std::string::npos) field.unit = "deg";
  field.unit = plain_signs(field.unit);
  std::erase_if(field.unit, [](unsigned char c) { return !std::isalnum(c) || c > 127; });
  return field;
}

std::optional<double> factor(ColumnKind kind, const std::string& unit) {
  const UnitList& units = units_of(kind);
  if (unit.empty()) return units.front().to_si;
  const auto known =
      std::find_if(units.begin(), units.end(), [&](const NamedUnit& u) { return u.name == unit; });
  return known == units.end() ? std::nullopt : std::optional(known->to_si);
}

// The kind and component that a field names, whatever its unit; nothing for a column of something else.
std::optional<Column> named_column(const HeaderField& field, const robot::Robot& robot) {
  for (int j = 0; j < robot::kJoints; ++j) {
    const std::string number = std::to_string(j + 1);
    for (const char* prefix : {"a", "j", "q", "joint", "axis", "theta"}) {
      if (field.name == prefix + number) return Column{ColumnKind::kJoint, j};
    }
    // The robot's own name, without brackets behind it.
    const std::string own = lower(robot.joints[j].name);
    if (field.name == letters_and_digits(own.substr(0, own.find_first_of("[("))))
      return Column{ColumnKind::kJoint, j};
  }
  if (field.name == "std") {
    const bool rotation = !field.unit.empty() && factor(ColumnKind::kStdRotation, field.unit);
    return Column{rotation ? ColumnKind::kStdRotation : ColumnKind::kStd};
  }
  if (field.name.empty()) return std::nullopt;
  struct Stem {
    ColumnKind kind;
    std::vector<std::string> words;  // without the component
  };
  static const std::vector<Stem> kStems = {
      {ColumnKind::kForce, {"f", "force"}},
      {ColumnKind::kMoment, {"m", "moment", "t", "torque"}},
      {ColumnKind::kDeflection, {"d", "u", "delta", "deflection", "displacement"}},
      {ColumnKind::kRotation, {"r", "rot", "rotation"}},
      {ColumnKind::kForcePoint, {"forcepoint", "loadpoint"}},
      {ColumnKind::kMeasuringPoint, {"measuringpoint", "measurementpoint"}},
  };
  const auto component = std::string_view("xyz").find(field.name.back());
  if (component == std::string_view::npos) return std::nullopt;
  const std::string word = field.name.substr(0, field.name.size() - 1);
  for (const Stem& stem : kStems) {
    if (std::find(stem.words.begin(), stem.words.end(), word) != stem.words.end())
      return Column{stem.kind, static_cast<int>(component)};
  }
  return std::nullopt;
}

// ---- table ----

class SampleTable {
 public:
  SampleTable(const Source& source, const robot::Robot& robot, const std::array<bool, 3>& components)
      : source_(source), robot_(robot), components_(components), rows_(table_rows(source)) {}

  LoadSamplesDocument read() {
    if (rows_.empty())
      throw DataError(source_.name, "", "", "empty input: expected joint angles, forces and deflections");
    header_line_ = rows_.front().line;
    if (is_header(rows_.front())) {
      name_columns(rows_.front());
      rows_.erase(rows_.begin());
    } else {
      columns_by_count(rows_.front());
    }
    check_columns();
    // A spreadsheet's empty lines are rows of empty fields.
    std::erase_if(rows_, [](const TableRow& row) {
      return std::all_of(row.fields.begin(), row.fields.end(),
                         [](const std::string& field) { return field.empty(); });
    });
    if (rows_.empty()) fail(header_line_, "", "expected rows below the header");
    LoadSamplesDocument result;
    result.deflection_unit_m = common_unit(ColumnKind::kDeflection);
    result.force_unit_n = common_unit(ColumnKind::kForce);
    for (const TableRow& row : rows_) {
      check_width(row);
      result.samples.push_back(sample_of(row));
      result.places.push_back(line_place(row.line));
      result.names.push_back(name_column_ && *name_column_ < row.fields.size() ? row.fields[*name_column_]
                                                                               : "");
    }
    return result;
  }

 private:
  [[noreturn]] void fail(long line, const std::string& value, const std::string& expected) const {
    throw DataError(source_.name, line_place(line), value, expected);
  }

  void name_columns(const TableRow& header) {
    for (const std::string& text : header.fields) {
      const HeaderField field = header_field(text);
      if (field.name == "name" && !name_column_) name_column_ = columns_.size();
      std::optional<Column> column = named_column(field, robot_);
      if (column) {
        const auto to_si = factor(column->kind, field.unit);
        if (!to_si)
          fail(header.line, '"' + text + '"',
               "expected a unit of that quantity, such as deg, N, mm, um or rad");
        column->to_si = *to_si;
        if (find(column->kind, column->component))
          fail(header.line, '"' + text + '"', "expected each column once");
      }
      columns_.push_back(column);
    }
  }

  void columns_by_count(const TableRow& row) {
    if (row.fields.size() != 12) {
      fail(row.line, std::to_string(row.fields.size()) + " columns",
           "expected a header, or 12 columns: six joints (deg), force (N), deflection (mm)");
    }
    for (const auto& [kind, count] :
         {std::pair(ColumnKind::kJoint, robot::kJoints), std::pair(ColumnKind::kForce, 3),
          std::pair(ColumnKind::kDeflection, 3)}) {
      for (int i = 0; i < count; ++i) columns_.push_back(Column{kind, i, units_of(kind).front().to_si});
    }
  }

  std::optional<std::size_t> find(ColumnKind kind, int component) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i] && columns_[i]->kind == kind && columns_[i]->component == component) return i;
    }
    return std::nullopt;
  }

  std::optional<double> common_unit(ColumnKind kind) const {
    std::optional<double> unit;
    for (const auto& column : columns_) {
      if (!column || column->kind != kind) continue;
      if (unit && *unit != column->to_si) return std::nullopt;
      unit = column->to_si;
    }
    return unit;
  }

  void need(ColumnKind kind, int component, const std::string& name) const {
    if (!find(kind, component)) fail(header_line_, "", "expected a column " + name + " in the header");
  }

  // Joints, forces and the components that are used; of moments, rotations and points all three or none,
  // since a missing one is not 0.
  void check_columns() const {
    static const std::string kAxes = "xyz";
    for (int j = 0; j < robot::kJoints; ++j) need(ColumnKind::kJoint, j, robot_.joints[j].name);
    for (int d = 0; d < 3; ++d) {
      need(ColumnKind::kForce, d, std::string("f") + kAxes[d]);
      if (components_[d]) need(ColumnKind::kDeflection, d, std::string("d") + kAxes[d]);
    }
    for (const auto& [kind, name] : {std::pair<ColumnKind, std::string>{ColumnKind::kMoment, "m"},
                                     {ColumnKind::kRotation, "r"},
                                     {ColumnKind::kForcePoint, "force_point_"},
                                     {ColumnKind::kMeasuringPoint, "measuring_point_"}}) {
      if (!find(kind, 0) && !find(kind, 1) && !find(kind, 2)) continue;
      for (int d = 0; d < 3; ++d) need(kind, d, name + kAxes[d]);
    }
  }

  void check_width(const TableRow& row) const {
    for (std::size_t i = columns_.size(); i < row.fields.size(); ++i) {
      if (row.fields[i].empty()) continue;
      fail(row.line, std::to_string(row.fields.size()) + " columns",
           "expected " + std::to_string(columns_.size()) +
               ", as in the first line (with decimal commas separate by semicolons or tabs)");
    }
  }

  // In SI. Nothing where there is no such column, or its component is not used.
  std::optional<double> number(const TableRow& row, ColumnKind kind, int component) const {
    const auto column = find(kind, component);
    if (!column || (kind == ColumnKind::kDeflection && !components_[component])) return std::nullopt;
    const double si = table_number(source_, row, *column, "a number") * columns_[*column]->to_si;
    if (!(std::abs(si) <= largest(kind)))
      fail(row.line, row.fields[*column], "expected a number of a robot's size");
    return si;
  }

  // Components that are not used are 0; nothing where none is.
  std::optional<Eigen::Vector3d> vector(const TableRow& row, ColumnKind kind) const {
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    bool any = false;
    for (int d = 0; d < 3; ++d) {
      if (const auto x = number(row, kind, d)) {
        v[d] = *x;
        any = true;
      }
    }
    return any ? std::optional(v) : std::nullopt;
  }

  std::optional<Eigen::Vector3d> deviation(const TableRow& row, ColumnKind kind) const {
    const auto x = number(row, kind, 0);
    if (!x) return std::nullopt;
    if (!(*x >= kLeastDeviation))
      fail(row.line, row.fields[*find(kind, 0)], "expected a standard deviation above 0");
    return Eigen::Vector3d::Constant(*x);
  }

  robot::LoadSample sample_of(const TableRow& row) const {
    const Eigen::Vector3d nothing = Eigen::Vector3d::Zero(), tool_point = robot_.tool.translation();
    robot::LoadSample sample;
    for (int j = 0; j < robot::kJoints; ++j) sample.angles[j] = *number(row, ColumnKind::kJoint, j);
    sample.force_n = *vector(row, ColumnKind::kForce);
    sample.moment_n_m = vector(row, ColumnKind::kMoment).value_or(nothing);
    sample.deflection_m = vector(row, ColumnKind::kDeflection).value_or(nothing);
    sample.rotation_rad = vector(row, ColumnKind::kRotation);
    sample.force_point = vector(row, ColumnKind::kForcePoint).value_or(tool_point);
    sample.measuring_point = vector(row, ColumnKind::kMeasuringPoint).value_or(tool_point);
    sample.deflection_std_m = deviation(row, ColumnKind::kStd);
    sample.rotation_std_rad = deviation(row, ColumnKind::kStdRotation);
    if (sample.rotation_rad && sample.rotation_std_rad.has_value() != sample.deflection_std_m.has_value())
      fail(header_line_, "", "expected both std and std_rad where rotations are measured, or neither");
    return sample;
  }

  const Source& source_;
  const robot::Robot& robot_;
  const std::array<bool, 3>& components_;
  std::vector<TableRow> rows_;
  std::vector<std::optional<Column>> columns_;  // nothing: a column of something else
  std::optional<std::size_t> name_column_;
  long header_line_ = 0;
};

}  // namespace

LoadSamplesDocument load_samples_from_csv(const Source& source, const robot::Robot& robot,
                                          const std::array<bool, 3>& components) {
  return SampleTable(source, robot, components).read();
}

}  // namespace stablecut::document
