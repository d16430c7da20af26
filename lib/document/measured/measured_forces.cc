#include "document/measured/measured_forces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "document/text/data_error.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

constexpr std::size_t kNone = -1;
constexpr std::array<const char*, 3> kForces = {"fx_n", "fy_n", "fz_n"};
constexpr std::array<const char*, 3> kDeviations = {"fx_std_n", "fy_std_n", "fz_std_n"};
constexpr std::array<const char*, 8> kOthers = {"feed_per_tooth_mm", "depth_mm", "speed_rpm",
                                                "entry_deg",         "exit_deg", "radial_immersion",
                                                "milling",           "record"};
constexpr double kUnequalStep = 0.01;  // of the mean step of time
constexpr double kLargestForce = 1e7;  // N

// A table with a header.
class Columns {
 public:
  explicit Columns(const Source& source) : source_(source), rows_(table_rows(source)) {
    if (rows_.empty()) throw DataError(source.name, "", "", "empty input: expected a header and rows");
    header_ = rows_.front();
    if (!is_header(header_))
      throw DataError(source.name, line_place(header_.line), "", "expected a header that names the columns");
    rows_.erase(rows_.begin());
    // A spreadsheet's empty lines are rows of empty fields.
    std::erase_if(rows_, [](const TableRow& row) {
      return std::all_of(row.fields.begin(), row.fields.end(),
                         [](const auto& field) { return field.empty(); });
    });
    if (rows_.empty()) fail_header("expected rows below the header");
  }

  const std::vector<TableRow>& rows() const { return rows_; }
  const TableRow& header() const { return header_; }
  bool has(const char* name) const { return find(name) != kNone; }
  double number(const TableRow& row, const char* name, bool (*inside)(double), const char* expected) const {
    const double value = table_number(source_, row, find(name), expected);
    if (!inside(value))
      throw DataError(source_.name, line_place(row.line), row.fields[find(name)],
                      std::string("expected ") + expected);
    return value;
  }
  std::string text(const TableRow& row, const char* name) const {
    const std::size_t column = find(name);
    return column < row.fields.size() ? row.fields[column] : "";
  }
  [[noreturn]] void fail_header(const std::string& expected) const {
    throw DataError(source_.name, line_place(header_.line), "", expected);
  }
  [[noreturn]] void fail(const TableRow& row, const std::string& value, const std::string& expected) const {
    throw DataError(source_.name, line_place(row.line), value, expected);
  }

 private:
  std::size_t find(const char* name) const {
    const auto at = std::find(header_.fields.begin(), header_.fields.end(), name);
    return at == header_.fields.end() ? kNone : static_cast<std::size_t>(at - header_.fields.begin());
  }
  const Source& source_;
  std::vector<TableRow> rows_;
  TableRow header_;
};

bool is_positive(double value) { return value > 0; }
bool is_angle(double value) { return value >= 0 && value <= 180; }
bool is_immersion(double value) { return value > 0 && value <= 1; }
bool is_force(double value) { return std::abs(value) <= kLargestForce; }

void set_engagement(const Columns& columns, const TableRow& row, milling::Cutter& cutter) {
  if (columns.has("radial_immersion")) {
    const std::string way = columns.text(row, "milling");
    if (way != "up" && way != "down") columns.fail(row, '"' + way + '"', "expected up or down as milling");
    milling::set_immersion(cutter, way == "up",
                           columns.number(row, "radial_immersion", is_immersion,
                                          "a radial immersion ae/D above 0 and at most 1"));
  } else if (columns.has("entry_deg")) {
    const double entry = columns.number(row, "entry_deg", is_angle, "an angle from 0 to 180 degrees");
    const double exit = columns.number(row, "exit_deg", is_angle, "an angle from 0 to 180 degrees");
    if (!(entry < exit))
      columns.fail(row, columns.text(row, "exit_deg"), "expected an angle above entry_deg");
    cutter.entry_rad = radians_from_degrees(entry);
    cutter.exit_rad = radians_from_degrees(exit);
  }
}

void check_columns(const Columns& columns, const CutDocument& cut) {
  const auto any = [&](const auto& names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return columns.has(name); });
  };
  if (any(kForces) == columns.has("record"))
    columns.fail_header("expected columns fx_n, fy_n, fz_n (those that were measured), or record");
  if (!columns.has("depth_mm")) columns.fail_header("expected a column depth_mm");
  if (!columns.has("feed_per_tooth_mm") && !cut.feed_per_tooth_m)
    columns.fail_header("expected a column feed_per_tooth_mm, or feed_per_tooth_mm in the cut");
  if (columns.has("record") && !columns.has("speed_rpm"))
    columns.fail_header("expected a column speed_rpm beside record");
  if (columns.has("entry_deg") != columns.has("exit_deg"))
    columns.fail_header("expected both entry_deg and exit_deg");
  if (columns.has("radial_immersion") != columns.has("milling"))
    columns.fail_header("expected both radial_immersion and milling");
  if (columns.has("radial_immersion") && columns.has("entry_deg"))
    columns.fail_header("expected either radial_immersion with milling or entry_deg with exit_deg");
  // What looks like a force and is none that is known has another unit.
  for (const std::string& name : columns.header().fields) {
    const auto known = [&](const auto& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    const bool like = name.starts_with("fx") || name.starts_with("fy") || name.starts_with("fz") ||
                      name.starts_with("feed") || name.starts_with("depth");
    if (like && !known(kForces) && !known(kDeviations) && !known(kOthers))
      columns.fail(columns.header(), '"' + name + '"',
                   "expected fx_n, fy_n, fz_n, fx_std_n, fy_std_n, fz_std_n, feed_per_tooth_mm or depth_mm");
  }
}

}  // namespace

std::vector<MeasuredForceRow> measured_forces(const Source& source, const CutDocument& cut) {
  const Columns columns(source);
  check_columns(columns, cut);
  std::vector<MeasuredForceRow> result;
  for (const TableRow& row : columns.rows()) {
    MeasuredForceRow measured;
    measured.place = line_place(row.line);
    milling::MeasuredForce& force = measured.force;
    force.cutter = cut.cutter;
    force.runout_m = cut.load.runout_m;
    set_engagement(columns, row, force.cutter);
    force.depth_m = metres_from_mm(columns.number(row, "depth_mm", is_positive, "a depth above 0 mm"));
    force.feed_per_tooth_m =
        columns.has("feed_per_tooth_mm")
            ? metres_from_mm(columns.number(row, "feed_per_tooth_mm", is_positive, "a feed above 0 mm"))
            : *cut.feed_per_tooth_m;
    if (columns.has("speed_rpm"))
      measured.speed_rpm = columns.number(row, "speed_rpm", is_positive, "a speed above 0 rpm");
    measured.record = columns.text(row, "record");
    if (columns.has("record") && measured.record.empty())
      columns.fail(row, "", "expected a file's name as record");
    for (int axis = 0; axis < 3; ++axis) {
      if (columns.has(kForces[axis]) && !columns.text(row, kForces[axis]).empty())
        force.force_n[axis] = columns.number(row, kForces[axis], is_force, "a force in N");
      if (columns.has(kDeviations[axis]) && !columns.text(row, kDeviations[axis]).empty())
        force.std_n[axis] =
            columns.number(row, kDeviations[axis], is_positive, "a standard deviation above 0 N");
    }
    result.push_back(std::move(measured));
  }
  return result;
}

std::array<std::optional<double>, 3> mean_of_record(const Source& source, double speed_rpm) {
  const Columns columns(source);
  if (!columns.has("time_s")) columns.fail_header("expected a column time_s");
  const auto any_number = [](double) { return true; };
  std::vector<double> time;
  for (const TableRow& row : columns.rows())
    time.push_back(columns.number(row, "time_s", any_number, "a time in s"));
  const std::size_t count = time.size();
  if (count < 3) columns.fail_header("expected three rows at least");
  const double step = (time.back() - time.front()) / static_cast<double>(count - 1);
  for (std::size_t i = 1; i < count; ++i) {
    if (!(std::abs(time[i] - time[i - 1] - step) <= kUnequalStep * step))
      columns.fail(columns.rows()[i], columns.text(columns.rows()[i], "time_s"),
                   "expected times in equal steps");
  }
  // Each number stands for a step; the last revolution ends within one.
  const double revolution = 60 / speed_rpm / step;
  const double whole = std::floor(static_cast<double>(count) / revolution * (1 + 1e-12)) * revolution;
  if (!(whole >= 1))
    columns.fail_header("expected one revolution at least, " + number_text(60 / speed_rpm) + " s");
  std::array<std::optional<double>, 3> mean;
  for (int axis = 0; axis < 3; ++axis) {
    if (!columns.has(kForces[axis])) continue;
    double sum = 0;
    for (std::size_t i = 0; i < count && static_cast<double>(i) < whole; ++i)
      sum += std::min(1.0, whole - static_cast<double>(i)) *
             columns.number(columns.rows()[i], kForces[axis], is_force, "a force in N");
    mean[axis] = sum / whole;
  }
  if (!mean[0] && !mean[1] && !mean[2])
    columns.fail_header("expected columns fx_n, fy_n, fz_n (those that were measured)");
  return mean;
}

}  // namespace stablecut::document
