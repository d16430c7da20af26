#include "document/text/flat_table.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

namespace stablecut::document {
namespace {

// A list of more items is a table of its own instead of columns of one.
constexpr std::size_t kMostColumns = 12;

// Grids: lists of rows, whose axes are these fields of the document.
struct Grid {
  const char *format, *rows, *columns;
};
constexpr std::array<Grid, 2> kGrids = {
    {{"stablecut/lobes/1", "depth_mm", "speed_rpm"}, {"stablecut/pose-map/1", "y_mm", "x_mm"}}};

bool is_list_of_objects(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_object(); });
}

bool is_list_of_lists(const Json& value) {
  return value.is_array() &&
         std::any_of(value.begin(), value.end(), [](const Json& item) { return item.is_array(); });
}

std::string joined(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "/" + name;
}

// A list of rows that hold a value for each of these: columns beside them.
constexpr const char* kLines = "frequency_hz";

// A row as it grows: names of columns in order, and values.
using Row = std::vector<std::pair<std::string, Json>>;

// A field and its path.
using Member = std::pair<std::string, const Json*>;

// Complex numbers are lists of two.
bool is_complex(const std::string& name) {
  return name.starts_with("psi_") || name.find("/psi_") != name.npos;
}

// Whether a field of a row goes into that row's columns.
bool fits_in_row(const Json& value) {
  if (!value.is_array()) return !value.is_object();
  return value.size() <= kMostColumns && !is_list_of_objects(value) &&
         std::all_of(value.begin(), value.end(), fits_in_row);
}

void add_to_row(Row& row, const std::string& name, const Json& value) {
  if (!value.is_array()) {
    row.emplace_back(name, value);
    return;
  }
  const bool complex = is_complex(name) && value.size() == 2 && value[0].is_number();
  for (std::size_t i = 0; i < value.size(); ++i)
    add_to_row(row, name + (complex ? (i == 0 ? "_re" : "_im") : "_" + std::to_string(i + 1)), value[i]);
}

// Rows of different names as one table: columns in the order in which they come first.
FlatTable table_of(const std::string& name, const std::vector<Row>& rows) {
  FlatTable table{name, {}, {}};
  std::map<std::string, std::size_t> place;
  for (const Row& row : rows) {
    for (const auto& [column, value] : row) {
      if (place.emplace(column, table.columns.size()).second) table.columns.push_back(column);
    }
  }
  for (const Row& row : rows) {
    std::vector<Json>& cells = table.rows.emplace_back(table.columns.size());
    for (const auto& [column, value] : row) cells[place.at(column)] = value;
  }
  return table;
}

class Flattener {
 public:
  explicit Flattener(const Json& document) : document_(document) {
    for (const Grid& grid : kGrids) {
      if (document.value("format", "") == grid.format) grid_ = &grid;
    }
    if (document.contains(kLines)) lines_ = document.at(kLines).size();
    Row single;
    add_object(document, "", single);
    std::vector<Row> rows;
    for (auto& [name, value] : single) rows.push_back({{"field", name}, {"value", std::move(value)}});
    tables_.insert(tables_.begin(), table_of("document", rows));
    if (!grid_columns_.empty()) add_grid();
  }
  std::vector<FlatTable> take() { return std::move(tables_); }

 private:
  bool is_axis(const std::string& path) const {
    return grid_ != nullptr && (path == grid_->rows || path == grid_->columns);
  }
  bool is_grid(const Json& value) const {
    return grid_ != nullptr && is_list_of_lists(value) && value.size() == document_.at(grid_->rows).size() &&
           value[0].size() == document_.at(grid_->columns).size();
  }

  // Single values go to `single`; lists as long as each other are columns of one table.
  void add_object(const Json& object, const std::string& path, Row& single) {
    std::vector<Member> lists;
    for (const auto& [name, value] : object.items()) {
      if (name == "provenance") continue;
      const std::string here = joined(path, name);
      if (value.is_object()) {
        add_object(value, here, single);
      } else if (is_grid(value)) {
        grid_columns_.emplace_back(here, &value);
      } else if (is_list_of_objects(value)) {
        add_rows(value, here);
      } else if (value.is_array()) {
        if (!is_axis(here)) lists.emplace_back(here, &value);
      } else {
        single.emplace_back(here, value);
      }
    }
    if (path.empty()) lists.insert(lists.end(), line_columns_.begin(), line_columns_.end());
    while (!lists.empty()) {
      const std::size_t length = lists.front().second->size();
      const auto others = std::stable_partition(
          lists.begin(), lists.end(), [length](const auto& list) { return list.second->size() == length; });
      const std::vector<Member> together(lists.begin(), others);
      lists.erase(lists.begin(), others);
      const auto& [name, first] = together.front();
      // A short list alone of its length is no table.
      if (together.size() == 1 && fits_in_row(*first) && !is_list_of_lists(*first))
        add_to_row(single, name, *first);
      else
        tables_.push_back(table_of(name, rows_of(together)));
    }
  }

  // Lists side by side, as many rows as the longest has items.
  static std::vector<Row> rows_of(const std::vector<Member>& lists, const Row& before = {}) {
    std::size_t longest = 0;
    for (const auto& [name, list] : lists) longest = std::max(longest, list->size());
    std::vector<Row> rows(longest, before);
    for (const auto& [name, list] : lists) {
      for (std::size_t i = 0; i < list->size(); ++i) add_to_row(rows[i], name, (*list)[i]);
    }
    return rows;
  }

  // A row an object; what does not fit into it becomes tables whose first columns say of which row.
  void add_rows(const Json& list, const std::string& path) {
    std::vector<Row> rows;
    std::vector<std::pair<std::string, std::vector<Row>>> parts;
    for (std::size_t i = 0; i < list.size(); ++i)
      add_item(list[i], path, "", {{path, i + 1}}, rows.emplace_back(), parts);
    tables_.push_back(table_of(path, rows));
    for (const auto& [name, part] : parts) tables_.push_back(table_of(name, part));
  }

  void add_item(const Json& object, const std::string& path, const std::string& prefix, const Row& place,
                Row& row, std::vector<std::pair<std::string, std::vector<Row>>>& parts) {
    std::vector<Member> lists;
    for (const auto& [name, value] : object.items()) {
      const std::string here = joined(prefix, name);
      if (value.is_object()) {
        add_item(value, path, here, place, row, parts);
      } else if (fits_in_row(value)) {
        add_to_row(row, here, value);
      } else if (is_list_of_objects(value)) {
        for (std::size_t i = 0; i < value.size(); ++i) {
          Row part = place;
          add_item(value[i], path, "", place, part, parts);
          part_named(parts, joined(path, here)).push_back(std::move(part));
        }
      } else if (value.size() == lines_) {
        std::string column = path;
        for (const auto& [field, text] : row) column += text.is_string() ? "_" + text.get<std::string>() : "";
        line_columns_.emplace_back(column + "_" + here, &value);
      } else {
        lists.emplace_back(here, &value);
      }
    }
    if (lists.empty()) return;
    const std::vector<Row> lines = rows_of(lists, place);
    std::vector<Row>& part = part_named(parts, joined(path, lists.front().first));
    part.insert(part.end(), lines.begin(), lines.end());
  }

  static std::vector<Row>& part_named(std::vector<std::pair<std::string, std::vector<Row>>>& parts,
                                      const std::string& name) {
    for (auto& part : parts) {
      if (part.first == name) return part.second;
    }
    return parts.emplace_back(name, std::vector<Row>{}).second;
  }

  void add_grid() {
    FlatTable table{"grid", {grid_->columns, grid_->rows}, {}};
    for (const auto& column : grid_columns_) table.columns.push_back(column.first);
    const Json &down = document_.at(grid_->rows), &across = document_.at(grid_->columns);
    for (std::size_t a = 0; a < across.size(); ++a) {
      for (std::size_t d = 0; d < down.size(); ++d) {
        std::vector<Json>& row = table.rows.emplace_back(std::vector<Json>{across[a], down[d]});
        for (const auto& column : grid_columns_) row.push_back((*column.second)[d][a]);
      }
    }
    tables_.push_back(std::move(table));
  }

  const Json& document_;
  const Grid* grid_ = nullptr;
  std::size_t lines_ = std::string::npos;
  std::vector<Member> grid_columns_, line_columns_;
  std::vector<FlatTable> tables_;
};

std::string csv_field(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  const std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\n\r") == text.npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

std::string shown_value(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number_float()) return value.dump();
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value.get<double>());
  return text.data();
}

// Letters of UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::vector<FlatTable> flat_tables(const Json& document) { return Flattener(document).take(); }

std::string csv_text(const FlatTable& table) {
  std::string text;
  const auto add_line = [&](const auto& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) text += (c > 0 ? "," : "") + csv_field(cells[c]);
    text += "\n";
  };
  add_line(table.columns);
  for (const auto& row : table.rows) add_line(row);
  return text;
}

std::string aligned_text(const std::vector<FlatTable>& tables, const TableSize& most) {
  std::string text;
  for (const FlatTable& table : tables) {
    if (table.rows.empty()) continue;
    text += (text.empty() ? "" : "\n") + table.name;
    if (table.rows.size() > most.rows || table.columns.size() > most.columns) {
      text += ": " + std::to_string(table.rows.size()) + " rows, " + std::to_string(table.columns.size()) +
              " columns\n";
      continue;
    }
    text += "\n";
    std::vector<std::size_t> width;
    for (const std::string& column : table.columns) width.push_back(width_of(column));
    for (const auto& row : table.rows) {
      for (std::size_t c = 0; c < row.size(); ++c)
        width[c] = std::max(width[c], width_of(shown_value(row[c])));
    }
    const auto add_line = [&](const auto& cells, bool header) {
      std::string line;
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const std::string cell = shown_value(cells[c]);
        const std::string blanks(width[c] - width_of(cell), ' ');
        const bool left = !header && Json(cells[c]).is_string();
        line += "  " + (left ? cell + blanks : blanks + cell);
      }
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    };
    add_line(table.columns, true);
    for (const auto& row : table.rows) add_line(row, false);
  }
  return text;
}

}  // namespace stablecut::document
