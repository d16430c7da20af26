#include "document/measured/tap_records.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/range.h"
#include "document/measured/tap_column_name.h"
#include "document/measured/universal_file.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

constexpr double kLongestStep =
    1.6;  // of the mean: times may be rounded to half a step; a lost sample makes 2
constexpr double kFromEvenTimes = 0.6;   // of the mean step: half a step of rounding
constexpr double kDoubleDigits = 1e-12;  // of a rate: what doubles leave unsure

}  // namespace

double sample_rate_of(const Eigen::VectorXd& time_s, const Source& source, const std::string& place) {
  const Eigen::Index last = time_s.size() - 1;
  const auto refuse = [&](double value, const std::string& expected) {
    throw DataError(source.name, place, number_text(value) + " s", expected, Remedy::kSampleRate);
  };
  if (last < 1) refuse(last < 0 ? 0 : time_s[0], "expected two samples at least");
  const double span = time_s[last] - time_s[0];
  if (!(span > 0)) refuse(time_s[last], "expected increasing times");
  const double step = span / static_cast<double>(last);
  double off = 0;
  for (Eigen::Index i = 1; i <= last; ++i) {
    const double from_even = std::abs(time_s[i] - (time_s[0] + step * static_cast<double>(i)));
    const double own = time_s[i] - time_s[i - 1];
    if (!(own >= 0 && own <= kLongestStep * step && from_even <= kFromEvenTimes * step))
      refuse(time_s[i], "expected times in equal steps");
    off = std::max(off, from_even);
  }
  const double rate = 1 / step;
  const double unsure = rate * std::max(2 * off / span, kDoubleDigits);
  // The roundest number that the digits of the times leave.
  for (double unit = std::pow(10, std::floor(std::log10(rate))); unit >= 1; unit /= 10) {
    const double round = unit * std::round(rate / unit);
    if (std::abs(rate - round) <= unsure) return round;
  }
  return rate;
}

std::optional<Sensitivity> sensitivity_named(const std::string& text) {
  const auto equals = text.find('='), slash = text.find('/');
  if (equals == std::string::npos || equals == 0 || slash == std::string::npos || slash < equals)
    return std::nullopt;
  const std::string upper(trimmed(std::string_view(text).substr(equals + 1, slash - equals - 1)));
  const auto letters = upper.find_first_of("uUmMvV");
  if (letters == std::string::npos) return std::nullopt;
  const auto number = parse_number(trimmed(std::string_view(upper).substr(0, letters)));
  const auto volts = voltage_unit(upper.substr(letters));
  const auto unit = physical_unit(text.substr(slash + 1));
  if (!number || *number == 0 || !volts || !unit) return std::nullopt;
  Sensitivity result{text.substr(0, equals), *number * *volts / unit->to_si};
  if (result.channel == "force") {
    if (unit->force != 1 || unit->length != 0 || unit->time != 0) return std::nullopt;
  } else {
    if (unit->length != 1 || unit->force != 0 || unit->time > 0 || unit->time < -2) return std::nullopt;
    result.quantity = static_cast<dynamics::Quantity>(-unit->time);
  }
  return result;
}

const Sensitivity* TapRecordChoice::sensitivity_of(const std::string& channel) const {
  const Sensitivity* general = nullptr;
  for (const Sensitivity& known : sensitivities) {
    if (known.channel == channel) return &known;
    if (known.channel == "response" && channel != "force") general = &known;
  }
  return general;
}

TapRecords tap_records(const Input& input, const std::string& reference, const TapRecordChoice& choice,
                       std::vector<Remark>& remarks) {
  if (!input.document.is_null())
    throw DataError(input.source.name, "", "", "a JSON document: expected columns or a universal file");
  return looks_like_universal_file(input.source.text)
             ? tap_records_from_universal_file(input.source, reference, choice, remarks)
             : tap_records_from_columns(input.source, reference, choice, remarks);
}

}  // namespace stablecut::document
