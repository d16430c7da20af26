#include "document/measured/tool_path_text.h"

#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/range.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

constexpr double kLongestPosition = 1e3;  // m
constexpr double kFastest = 1e3;          // m/s

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void fail(const Source& source, long line, const std::string& value,
                       const std::string& expected) {
  throw DataError(source.name, line_place(line), value, expected);
}

// The points, and what every form of text asks of one.
class PathPoints {
 public:
  PathPoints(const Source& source, const ToolPathDefaults& defaults) : source_(source), defaults_(defaults) {}

  // `ijk` from the tip to the holder, or as the defaults say; m and m/s.
  void add(long line, const Eigen::Vector3d& position, const Eigen::Vector3d& ijk, double speed) {
    add_with_axis(line, position, defaults_.axis_to_tip ? ijk : Eigen::Vector3d(-ijk), speed, std::nullopt);
  }
  void add_with_axis(long line, const Eigen::Vector3d& position, const Eigen::Vector3d& axis, double speed,
                     const std::optional<Eigen::Vector3d>& feed) {
    if (!(axis.stableNorm() > 0)) fail(source_, line, "0, 0, 0", "expected a direction of the tool axis");
    if (feed && !(feed->stableNorm() > 0)) fail(source_, line, "0, 0, 0", "expected a direction of the feed");
    if (!(position.lpNorm<Eigen::Infinity>() <= kLongestPosition))
      fail(source_, line, "", "expected a position of a robot's size");
    if (std::isnan(speed)) speed = defaults_.speed.value_or(speed);
    if (std::isnan(speed)) fail(source_, line, "", "expected a speed in the file or from the command");
    if (!(speed > 0 && speed <= kFastest)) fail(source_, line, "", "expected a speed above 0");
    if (path_.size() >= kMostPathPoints)
      fail(source_, line, "",
           "expected at most " + std::to_string(kMostPathPoints) + " points (divide the path)");
    path_.push_back({position, axis.stableNormalized(), feed, speed});
    if (feed) path_.back().feed = feed->stableNormalized();
  }
  ToolPathDocument take() {
    if (path_.empty()) throw DataError(source_.name, "", "", "expected the points of a path");
    return in_base_frame(std::move(path_), defaults_.frame);
  }

 private:
  const Source& source_;
  const ToolPathDefaults& defaults_;
  robot::ToolPath path_;
};

// ---- words of a letter and a number ----

// The line without remarks in brackets and behind a semicolon, in upper case.
std::string without_remarks(std::string_view line) {
  std::string result;
  int depth = 0;
  for (const char c : line) {
    if (c == ';') break;
    if (c == '(') ++depth;
    if (depth == 0) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (c == ')' && depth > 0) --depth;
  }
  return std::string(trimmed(result));
}

bool begins_number(std::string_view text) {
  const auto at = text.find_first_not_of(kBlanks);
  return at != std::string_view::npos &&
         std::string_view("+-.0123456789").find(text[at]) != std::string_view::npos;
}

bool has_words(std::string_view line) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (std::string_view("XYZ").find(line[i]) != std::string_view::npos &&
        begins_number(line.substr(i + 1)) &&
        (i == 0 || !std::isalpha(static_cast<unsigned char>(line[i - 1]))))
      return true;
  }
  return line.starts_with("GOTO");
}

class WordReader {
 public:
  WordReader(const Source& source, const ToolPathDefaults& defaults)
      : source_(source), points_(source, defaults) {}

  void line(long number, const std::string& text) {
    if (text.empty() || text.front() == '%') return;
    line_ = number;
    moved_ = false;
    if (text.starts_with("GOTO"))
      cutter_location(text);
    else
      words(text);
    if (!moved_) return;
    for (int d = 0; d < 3; ++d) {
      if (!std::isfinite(position_[d])) fail(source_, line_, "", "expected X, Y and Z in the first move");
    }
    points_.add(line_, position_ * 1e-3, ijk_, speed_);
  }
  ToolPathDocument take() { return points_.take(); }

 private:
  void cutter_location(const std::string& text) {
    const auto fields = split(std::string_view(text).substr(std::min(text.find('/') + 1, text.size())), ',');
    if (fields.size() != 3 && fields.size() != 6)
      fail(source_, line_, text, "expected GOTO/x,y,z or GOTO/x,y,z,i,j,k");
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto value = parse_number(trimmed(fields[i]));
      if (!value) fail(source_, line_, std::string(fields[i]), "expected a number");
      (i < 3 ? position_[static_cast<int>(i)] : ijk_[static_cast<int>(i) - 3]) = *value;
    }
    moved_ = true;
  }

  void words(std::string_view rest) {
    while (!rest.empty()) {
      const char letter = rest.front();
      rest.remove_prefix(1);
      if (!std::isalpha(static_cast<unsigned char>(letter))) continue;
      if ((letter == 'N' || letter == 'T') && !rest.empty() &&
          std::string_view("XYZ").find(rest.front()) != std::string_view::npos)
        fail(source_, line_, std::string{letter, rest.front()}, "expected the tool axis as I, J and K");
      if (!begins_number(rest)) continue;
      rest = rest.substr(rest.find_first_not_of(kBlanks));
      const std::string_view digits = rest.substr(0, rest.find_first_not_of("+-.0123456789"));
      rest.remove_prefix(digits.size());
      word(letter, digits);
    }
  }

  void word(char letter, std::string_view digits) {
    const std::string shown = letter + std::string(digits);
    const auto value = parse_number(digits.starts_with('+') ? digits.substr(1) : digits);
    if (!value) fail(source_, line_, shown, "expected a number behind the letter");
    if (letter == 'G') return mode(shown, *value);
    if (letter == 'A' || letter == 'B' || letter == 'C')
      fail(source_, line_, shown, "expected the tool axis as I, J and K, not as angles");
    if (letter == 'F') speed_ = *value * 1e-3 / 60;
    if (const auto d = std::string_view("XYZ").find(letter); d != std::string_view::npos) {
      position_[static_cast<int>(d)] = *value;
      moved_ = true;
    }
    if (const auto d = std::string_view("IJK").find(letter); d != std::string_view::npos) {
      ijk_[static_cast<int>(d)] = *value;
      moved_ = true;
    }
  }

  void mode(const std::string& shown, double number) const {
    if (number == 2 || number == 3) fail(source_, line_, shown, "expected straight moves (G0, G1)");
    if (number == 91) fail(source_, line_, shown, "expected absolute positions (G90)");
    if (number == 20 || number == 70) fail(source_, line_, shown, "expected mm (G21)");
    if (number == 93 || number == 95) fail(source_, line_, shown, "expected feeds in mm/min (G94)");
  }

  const Source& source_;
  PathPoints points_;
  long line_ = 0;
  bool moved_ = false;
  Eigen::Vector3d position_ = Eigen::Vector3d::Constant(kNotGiven);  // mm
  Eigen::Vector3d ijk_ = Eigen::Vector3d::UnitZ();
  double speed_ = kNotGiven;
};

// ---- tables ----

enum Column { kPosition = 0, kIjk = 3, kAxis = 6, kFeed = 9, kSpeed = 12, kColumns = 13 };
constexpr std::array<std::string_view, kColumns> kNames = {
    "x", "y", "z", "i", "j", "k", "axisx", "axisy", "axisz", "feedx", "feedy", "feedz", "speed"};

struct NamedUnit {
  std::string_view name;  // letters only
  double to_si;
};
constexpr NamedUnit kLengths[] = {{"mm", 1e-3}, {"m", 1}};
constexpr NamedUnit kSpeeds[] = {
    {"mmpers", 1e-3},        {"mms", 1e-3},        {"mpers", 1},          {"ms", 1},
    {"mmpermin", 1e-3 / 60}, {"mmmin", 1e-3 / 60}, {"mpermin", 1.0 / 60}, {"mmin", 1.0 / 60}};

std::string letters(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::isalpha(static_cast<unsigned char>(c))) result += c;
  }
  return result;
}

// Which column a header names, and the factor of its unit; kColumns where it is something else.
std::pair<int, double> column_of(const Source& source, const TableRow& header, std::string text) {
  const std::string shown = text;
  text = lower(std::move(text));
  std::string unit;
  if (const auto open = text.find_first_of("[("); open != std::string::npos) {
    unit = letters(text.substr(open));
    text.erase(open);
  }
  std::string name = letters(text);
  const auto try_units = [&](const auto& units, int column) -> std::optional<double> {
    for (const NamedUnit& known : units) {
      if (unit == known.name ||
          (unit.empty() && name == std::string(kNames[column]) + std::string(known.name)))
        return known.to_si;
    }
    return std::nullopt;
  };
  for (int c = 0; c < kColumns; ++c) {
    const bool length = c < kIjk, speed = c == kSpeed;
    if (name == kNames[c] && unit.empty()) return {c, length || speed ? 1e-3 : 1};
    if (!name.starts_with(kNames[c]) || !(length || speed)) continue;
    if (!unit.empty() && name != kNames[c]) continue;
    const auto factor = length ? try_units(kLengths, c) : try_units(kSpeeds, c);
    if (factor) return {c, *factor};
    if (name == kNames[c])
      fail(source, header.line, '"' + shown + '"', "expected a unit such as mm, m, mm/s or mm/min");
  }
  return {kColumns, 1};
}

ToolPathDocument path_of_table(const Source& source, const ToolPathDefaults& defaults) {
  std::vector<TableRow> rows = table_rows(source);
  if (rows.empty()) throw DataError(source.name, "", "", "empty input: expected the points of a path");
  std::array<std::optional<std::pair<std::size_t, double>>, kColumns> columns;
  const TableRow header = rows.front();
  if (is_header(header)) {
    for (std::size_t f = 0; f < header.fields.size(); ++f) {
      const auto [column, factor] = column_of(source, header, header.fields[f]);
      if (column == kColumns) continue;
      if (columns[column])
        fail(source, header.line, '"' + header.fields[f] + '"', "expected each column once");
      columns[column] = {f, factor};
    }
    rows.erase(rows.begin());
  } else {
    const std::size_t count = header.fields.size();
    if (count != 3 && count != 6)
      fail(source, header.line, std::to_string(count) + " columns",
           "expected a header, or x, y, z, or x, y, z, i, j, k");
    for (std::size_t f = 0; f < count; ++f) columns[f] = {f, f < 3 ? 1e-3 : 1};
  }
  const auto has = [&](int first) { return columns[first] || columns[first + 1] || columns[first + 2]; };
  for (const int first : {kPosition, kIjk, kAxis, kFeed}) {
    for (int d = 0; d < 3; ++d) {
      if (!columns[first + d] && (first == kPosition || has(first)))
        fail(source, header.line, "",
             "expected a column " + std::string(kNames[first + d]) + " in the header");
    }
  }
  if (has(kIjk) && has(kAxis))
    fail(source, header.line, "", "expected the tool axis as i, j, k or as axis_x, axis_y, axis_z");
  PathPoints points(source, defaults);
  for (const TableRow& row : rows) {
    const auto number = [&](int column) {
      return table_number(source, row, columns[column]->first, "a number") * columns[column]->second;
    };
    const auto vector = [&](int first) {
      return Eigen::Vector3d(number(first), number(first + 1), number(first + 2));
    };
    const double speed = columns[kSpeed] ? number(kSpeed) : kNotGiven;
    const auto feed = has(kFeed) ? std::optional<Eigen::Vector3d>(vector(kFeed)) : std::nullopt;
    Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ();
    if (has(kAxis)) axis = vector(kAxis);
    if (has(kIjk)) axis = defaults.axis_to_tip ? vector(kIjk) : Eigen::Vector3d(-vector(kIjk));
    points.add_with_axis(row.line, vector(kPosition), axis, speed, feed);
  }
  return points.take();
}

}  // namespace

ToolPathDocument tool_path_from_text(const Source& source, const ToolPathDefaults& defaults) {
  std::vector<std::string> lines;
  bool words = false;
  for (const std::string_view line : split(source.text, '\n')) {
    lines.push_back(without_remarks(line));
    words = words || has_words(lines.back());
  }
  if (!words) return path_of_table(source, defaults);
  WordReader reader(source, defaults);
  for (std::size_t i = 0; i < lines.size(); ++i) reader.line(static_cast<long>(i) + 1, lines[i]);
  return reader.take();
}

}  // namespace stablecut::document
