// Records of taps in columns of text.
#include <algorithm>
#include <array>
#include <utility>

#include "base/range.h"
#include "document/kinds/frf_json.h"
#include "document/measured/tap_column_name.h"
#include "document/measured/tap_records.h"
#include "document/text/data_error.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

constexpr std::size_t kNoColumn = -1;

struct Channel {
  std::size_t column = kNoColumn;
  TapColumnName name;
  double to_si = 1;  // with the sign of the direction
};

class TapColumns {
 public:
  TapColumns(const Source& source, const std::string& reference, const TapRecordChoice& choice,
             std::vector<Remark>& remarks)
      : source_(source),
        reference_(reference),
        choice_(choice),
        remarks_(remarks),
        rows_(table_rows(source)) {}

  TapRecords read() {
    find_numbers();
    if (header_ == kNoColumn)
      plan_without_header();
    else
      plan_by_header();
    name_directions();
    TapRecords result;
    set_scales(result);
    result.records.push_back(record());
    for (const Channel& response : responses_) result.responses.push_back(response.name.direction);
    return result;
  }

 private:
  [[noreturn]] void fail(long line, const std::string& value, const std::string& expected,
                         Remedy remedy = Remedy::kNone) const {
    throw DataError(source_.name, line > 0 ? line_place(line) : "", value, expected, remedy);
  }

  static bool holds_numbers(const TableRow& row) {
    return row.fields.size() >= 2 && std::all_of(row.fields.begin(), row.fields.end(), [](const auto& field) {
             return field.empty() || parse_number(field).has_value();
           });
  }

  // The first row of numbers, and the names above it: the nearest row of which one tells what it is.
  void find_numbers() {
    while (first_ < rows_.size() && !holds_numbers(rows_[first_])) ++first_;
    if (first_ == rows_.size())
      fail(0, "", "no rows of numbers: expected columns of time, force and responses");
    for (std::size_t i = first_; i-- > 0;) {
      const auto& fields = rows_[i].fields;
      const bool names = std::count_if(fields.begin(), fields.end(), [](const std::string& field) {
                           return tap_column_name(field).has_value();
                         }) >= 2;
      if (!names) continue;
      // Of two rows, names and then units, the names are the upper one.
      if (header_ != kNoColumn && rows_[i].fields.size() != rows_[header_].fields.size()) break;
      header_ = i;
    }
  }

  void plan_without_header() {
    const std::size_t columns = rows_[first_].fields.size();
    const bool with_time = !choice_.sample_rate_hz || increases(0);
    const std::size_t least = with_time ? 3 : 2;
    if (columns < least)
      fail(rows_[first_].line, std::to_string(columns) + " columns",
           "expected time, force and responses, or a header that names them");
    if (with_time) time_.column = 0;
    force_.column = least - 2;
    for (std::size_t c = least - 1; c < columns; ++c) responses_.push_back({c, {}, 1});
  }

  bool increases(std::size_t column) const {
    for (std::size_t i = first_ + 1; i < rows_.size(); ++i) {
      if (!(number(i, column) > number(i - 1, column))) return false;
    }
    return true;
  }

  void plan_by_header() {
    const TableRow& header = rows_[header_];
    for (std::size_t c = 0; c < header.fields.size(); ++c) {
      if (header.fields[c].empty() && c >= rows_[first_].fields.size()) continue;
      std::string field = header.fields[c];
      for (std::size_t i = header_ + 1; i < first_; ++i) {
        if (c < rows_[i].fields.size() && !rows_[i].fields[c].empty())
          field += " [" + rows_[i].fields[c] + "]";
      }
      const auto name = tap_column_name(field);
      if (!name)
        fail(header.line, '"' + header.fields[c] + '"', "expected a time, a force, or a motion as acc_x (g)");
      take(c, *name, header);
    }
    if (force_.column == kNoColumn) fail(header.line, "", "expected a column of the force");
    if (responses_.empty()) fail(header.line, "", "expected a column of a response, as acc_x (g)");
  }

  void take(std::size_t column, const TapColumnName& name, const TableRow& header) {
    if (name.kind == TapColumnKind::kResponse) {
      responses_.push_back({column, name, 1});
      return;
    }
    Channel& channel = name.kind == TapColumnKind::kTime ? time_ : force_;
    if (channel.column != kNoColumn)
      fail(header.line, '"' + header.fields[column] + '"',
           name.kind == TapColumnKind::kTime ? "expected one column of times"
                                             : "expected one column of force");
    channel = {column, name, 1};
  }

  // A single response is where the force is; several have their names, or are x, y, z.
  void name_directions() {
    const auto unnamed = std::count_if(responses_.begin(), responses_.end(),
                                       [](const Channel& channel) { return channel.name.direction.empty(); });
    if (responses_.size() == 1 && unnamed == 1) {
      responses_[0].name.direction = reference_;
    } else if (unnamed > 0) {
      static constexpr std::array kUsual = {"x", "y", "z"};
      if (header_ != kNoColumn || responses_.size() > kUsual.size())
        fail(header_ == kNoColumn ? rows_[first_].line : rows_[header_].line, "",
             "expected the direction of each response, as acc_x, acc_y");
      std::string all;
      for (std::size_t i = 0; i < responses_.size(); ++i) {
        responses_[i].name.direction = kUsual[i];
        all += (i == 0 ? "" : ", ") + responses_[i].name.direction;
      }
      remarks_.push_back({RemarkKind::kResponsesTakenAs, source_.name, {}, all, "", {}});
    }
    for (std::size_t i = 0; i < responses_.size(); ++i) {
      std::string& own = responses_[i].name.direction;
      responses_[i].to_si = take_sign(own);
      for (std::size_t j = 0; j < i; ++j) {
        if (responses_[j].name.direction == own)
          fail(rows_[first_].line, own, "expected one response in each direction");
      }
    }
    std::string along = force_.name.direction;
    if (along.empty()) return;
    force_.to_si = take_sign(along);
    if (along != reference_)
      remarks_.push_back({RemarkKind::kForceOverruled, source_.name, {}, along, reference_, {}});
  }

  // The factor to SI of one channel; its quantity, if told, goes to `quantity`.
  double scale(const Channel& channel, const std::string& direction,
               std::optional<dynamics::Quantity>& quantity) const {
    const long line = header_ == kNoColumn ? 0 : rows_[header_].line;
    const TapColumnName& name = channel.name;
    const Sensitivity* sensitivity = choice_.sensitivity_of(direction);
    if (sensitivity) {
      if (!name.unit.empty() && !name.in_volts)
        fail(line, name.unit, "expected volts where a sensitivity is given", Remedy::kSensitivity);
      quantity = sensitivity->quantity;
      return name.to_si / sensitivity->volts;
    }
    if (choice_.unit) {
      quantity = choice_.unit->quantity;
      return direction == "force" ? 1 : choice_.unit->to_si;
    }
    if (name.in_volts) fail(line, name.unit, "expected a sensitivity in volts", Remedy::kSensitivity);
    quantity = name.quantity;
    if (!name.unit.empty() && !name.unit_known)
      fail(line, name.unit,
           direction == "force" ? "expected a unit of force" : "expected a unit of a motion, as m/s^2 or g",
           Remedy::kUnit);
    return name.to_si;
  }

  void set_scales(TapRecords& result) {
    std::optional<dynamics::Quantity> none, quantity = choice_.quantity;
    force_.to_si *= scale(force_, "force", none);
    if (force_.name.unit.empty() && !choice_.unit && !choice_.sensitivity_of("force"))
      remarks_.push_back({RemarkKind::kForceUnitMissing, source_.name, {}, "", "", {}});
    for (Channel& response : responses_) {
      std::optional<dynamics::Quantity> own;
      response.to_si *= scale(response, response.name.direction, own);
      if (!own) continue;
      if (quantity && *own != *quantity)
        fail(header_ == kNoColumn ? 0 : rows_[header_].line, response.name.unit,
             std::string("expected ") + quantity_name(*quantity) + ", as the others or as chosen",
             Remedy::kQuantity);
      quantity = own;
    }
    if (!quantity) remarks_.push_back({RemarkKind::kMotionTaken, source_.name, {}, "", "", {}});
    result.quantity = quantity.value_or(dynamics::Quantity::kAccelerance);
  }

  double number(std::size_t row, std::size_t column) const {
    return table_number(source_, rows_[row], column, "a number");
  }

  taps::Record record() const {
    const Eigen::Index samples = rows_.size() - first_;
    const auto signal = [&](const Channel& channel, double factor) {
      Eigen::VectorXd values(samples);
      for (Eigen::Index i = 0; i < samples; ++i) values[i] = factor * number(first_ + i, channel.column);
      return values;
    };
    taps::Record record;
    if (choice_.sample_rate_hz) {
      record.sample_rate_hz = *choice_.sample_rate_hz;
    } else if (time_.column == kNoColumn) {
      fail(rows_[header_].line, "", "expected a column of times", Remedy::kSampleRate);
    } else {
      record.sample_rate_hz =
          sample_rate_of(signal(time_, time_.name.to_si), source_, line_place(rows_[first_].line));
    }
    record.force = signal(force_, force_.to_si);
    for (const Channel& response : responses_) record.responses.push_back(signal(response, response.to_si));
    return record;
  }

  const Source& source_;
  const std::string& reference_;
  const TapRecordChoice& choice_;
  std::vector<Remark>& remarks_;
  const std::vector<TableRow> rows_;
  std::size_t first_ = 0, header_ = kNoColumn;
  Channel time_, force_;
  std::vector<Channel> responses_;
};

}  // namespace

TapRecords tap_records_from_columns(const Source& source, const std::string& reference,
                                    const TapRecordChoice& choice, std::vector<Remark>& remarks) {
  return TapColumns(source, reference, choice, remarks).read();
}

}  // namespace stablecut::document
