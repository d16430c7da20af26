// Records of taps in universal files: time records, dataset 58 with function type 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "document/kinds/frf_json.h"
#include "document/measured/tap_records.h"
#include "document/measured/universal_meaning.h"
#include "document/text/data_error.h"

namespace stablecut::document {
namespace {

using namespace universal;

constexpr int kTimeResponse = 1;  // function type

class TapFunctions {
 public:
  TapFunctions(const Source& source, const std::string& reference, const TapRecordChoice& choice,
               std::vector<Remark>& remarks)
      : source_(source), reference_(reference), choice_(choice), remarks_(remarks) {}

  TapRecords read() {
    const auto functions = read_universal_file(source_);
    for (const UniversalFunction& function : functions) sort_in(function);
    if (forces_.empty() || responses_.empty()) refuse(functions);
    TapRecords result;
    for (const auto& [direction, own] : responses_) {
      if (own.size() != forces_.size())
        throw DataError(source_.name, own.front()->place(6).text(),
                        std::to_string(own.size()) + " records along " + direction,
                        "expected one for each of " + std::to_string(forces_.size()) + " records of force");
      result.responses.push_back(direction);
    }
    for (std::size_t i = 0; i < forces_.size(); ++i) result.records.push_back(record(i));
    result.quantity = quantity_.value_or(dynamics::Quantity::kAccelerance);
    return result;
  }

 private:
  static bool is_time_record(const UniversalFunction& function) {
    return !function.is_complex && (function.type == kTimeResponse || function.type == kGeneral) &&
           (function.abscissa_axis.data_type == kTime || function.abscissa_axis.data_type <= kLastUnspecific);
  }

  static bool is_force(const UniversalFunction& function) {
    if (function.ordinate.data_type == kForce || function.ordinate.data_type == kReactionForce) return true;
    const auto unit = physical_unit(function.ordinate.unit);
    return function.ordinate.data_type <= kLastUnspecific && unit && unit->force == 1 && unit->length == 0 &&
           unit->time == 0;
  }

  void sort_in(const UniversalFunction& function) {
    if (!is_time_record(function) || !function.response.is_translation()) return;
    if (is_force(function)) {
      forces_.push_back(&function);
      return;
    }
    double sign = 1;
    responses_[direction_of(function, sign)].push_back(&function);
  }

  // Functions of one direction; no direction is that of the force.
  std::string direction_of(const UniversalFunction& function, double& sign) const {
    static constexpr std::array kNames = {"", "x", "y", "z"};
    const int direction = function.response.direction;
    if (direction < 0) sign = -sign;
    return direction == 0 ? reference_ : kNames[std::abs(direction)];
  }

  [[noreturn]] void refuse(const std::vector<UniversalFunction>& functions) const {
    const UniversalFunction& first = functions.front();
    for (const UniversalFunction& function : functions) {
      if (is_time_record(function)) continue;
      throw DataError(source_.name, function.place(6).text(), function_type_text(function.type),
                      "expected time records (type 1) of a force and of responses");
    }
    throw DataError(source_.name, first.place(9).text(), axis_text(first.ordinate),
                    forces_.empty() ? "expected a force too, data type 13"
                                    : "expected responses too, data type 8, 11 or 12");
  }

  // The factor to SI. A channel is a response over 1 N, with the units of its length alone.
  double scale(const UniversalFunction& function, const std::string& direction) {
    if (const Sensitivity* known = choice_.sensitivity_of(direction)) {
      if (known->quantity) quantity_ = known->quantity;
      return 1 / known->volts;
    }
    if (direction == "force") {
      if (choice_.unit) return 1;
      if (function.units) return 1 / function.units->force_factor;
      const auto unit = physical_unit(function.ordinate.unit);
      return unit && unit->force == 1 ? unit->to_si : 1;
    }
    UniversalFunction alone = function;
    alone.denominator = {kForce, "", ""};
    if (alone.units) alone.units->force_factor = 1;
    FrfChoice choice;
    choice.quantity = choice_.quantity;
    choice.unit = choice_.unit;
    const bool told = choice.unit || choice.quantity || function.ordinate.data_type > kLastUnspecific ||
                      !function.ordinate.unit.empty();
    if (!told) {
      remarks_.push_back({RemarkKind::kMotionTaken, source_.name, {}, "", "", {}});
      choice.quantity = dynamics::Quantity::kAccelerance;
    }
    const FrfUnit meaning = meaning_of(alone, choice, [&](Remark remark) {
      remark.file = source_.name;
      const bool said = std::any_of(remarks_.begin(), remarks_.end(),
                                    [&](const Remark& other) { return same_but_for_place(other, remark); });
      if (!said) remarks_.push_back(std::move(remark));
    });
    if (quantity_ && *quantity_ != meaning.quantity)
      throw DataError(source_.name, function.place(9).text(), axis_text(function.ordinate),
                      "expected the quantity of the functions before");
    quantity_ = meaning.quantity;
    return meaning.to_si;
  }

  Eigen::VectorXd signal(const UniversalFunction& function, double factor) const {
    if (!function.values.real().array().isFinite().all())
      throw DataError(source_.name, function.place(12).text(), "", "expected finite numbers");
    return factor * function.values.real();
  }

  taps::Record record(std::size_t index) {
    const UniversalFunction& force = *forces_[index];
    double sign = 1;
    const std::string along = direction_of(force, sign);
    if (along != reference_ && index == 0)
      remarks_.push_back({RemarkKind::kForceOverruled, source_.name, {}, along, reference_, {}});
    taps::Record record;
    record.sample_rate_hz = choice_.sample_rate_hz
                                ? *choice_.sample_rate_hz
                                : sample_rate_of(force.abscissa, source_, force.place(7).text());
    record.force = signal(force, sign * scale(force, "force"));
    for (const auto& [direction, own] : responses_) {
      const UniversalFunction& function = *own[index];
      if (function.values.size() != force.values.size())
        throw DataError(source_.name, function.place(7).text(),
                        std::to_string(function.values.size()) + " samples",
                        "expected " + std::to_string(force.values.size()) + ", as of the force");
      double turned = 1;
      direction_of(function, turned);
      record.responses.push_back(signal(function, turned * scale(function, direction)));
    }
    return record;
  }

  const Source& source_;
  const std::string& reference_;
  const TapRecordChoice& choice_;
  std::vector<Remark>& remarks_;
  std::vector<const UniversalFunction*> forces_;
  std::map<std::string, std::vector<const UniversalFunction*>> responses_;
  std::optional<dynamics::Quantity> quantity_;
};

}  // namespace

TapRecords tap_records_from_universal_file(const Source& source, const std::string& reference,
                                           const TapRecordChoice& choice, std::vector<Remark>& remarks) {
  return TapFunctions(source, reference, choice, remarks).read();
}

}  // namespace stablecut::document
