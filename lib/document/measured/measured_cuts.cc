#include "document/measured/measured_cuts.h"

#include <algorithm>

#include "base/units.h"
#include "document/text/data_error.h"
#include "document/text/node.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

constexpr std::size_t kNone = -1;

std::vector<MeasuredCut> from_json(const Json& document, const Source& source) {
  const Node root(document, source);
  std::vector<MeasuredCut> cuts;
  for (const Node& item : (document.is_object() ? root.at("points") : root).items()) {
    item.check_names({"depth_mm", "speed_rpm", "observed"});
    MeasuredCut cut{item.at("depth_mm").number(kNotNegative), item.at("speed_rpm").number(kPositive), {}};
    if (const auto observed = item.find("observed")) {
      cut.observed_stable = observed->word({"stable", "chatter"}) == "stable";
    }
    cuts.push_back(cut);
  }
  return cuts;
}

std::vector<MeasuredCut> from_csv(const Source& source) {
  std::vector<TableRow> rows = table_rows(source);
  if (rows.empty())
    throw DataError(source.name, "", "", "empty input: expected depth_mm,speed_rpm[,observed]");
  std::size_t depth = 0, speed = 1, observed = 2;
  if (is_header(rows.front())) {
    const auto column = [&](const char* name) {
      const auto& fields = rows.front().fields;
      const auto found = std::find(fields.begin(), fields.end(), name);
      return found == fields.end() ? kNone : static_cast<std::size_t>(found - fields.begin());
    };
    depth = column("depth_mm");
    speed = column("speed_rpm");
    observed = column("observed");
    if (depth == kNone || speed == kNone) {
      throw DataError(source.name, line_place(rows.front().line), "",
                      "expected columns depth_mm and speed_rpm in the header");
    }
    rows.erase(rows.begin());
  }
  std::vector<MeasuredCut> cuts;
  for (const TableRow& row : rows) {
    MeasuredCut cut{table_number(source, row, depth, "a depth in mm"),
                    table_number(source, row, speed, "a speed in rpm"),
                    {}};
    if (cut.depth_mm < 0) {
      throw DataError(source.name, line_place(row.line), row.fields[depth],
                      "expected a depth not below 0 mm");
    }
    if (!(cut.speed_rpm > 0)) {
      throw DataError(source.name, line_place(row.line), row.fields[speed], "expected a speed above 0 rpm");
    }
    if (observed < row.fields.size() && !row.fields[observed].empty()) {
      const std::string& word = row.fields[observed];
      if (word != "stable" && word != "chatter") {
        throw DataError(source.name, line_place(row.line), '"' + word + '"', "expected stable or chatter");
      }
      cut.observed_stable = word == "stable";
    }
    cuts.push_back(cut);
  }
  return cuts;
}

}  // namespace

std::vector<MeasuredCut> measured_cuts(const Source& source, const Json& document) {
  return document.is_null() ? from_csv(source) : from_json(document, source);
}

std::vector<milling::TestedCut> tested_cuts(const std::vector<MeasuredCut>& cuts) {
  std::vector<milling::TestedCut> tested;
  for (const MeasuredCut& cut : cuts)
    tested.push_back(
        {revolutions_per_s_from_rpm(cut.speed_rpm), metres_from_mm(cut.depth_mm), cut.observed_stable});
  return tested;
}

}  // namespace stablecut::document
