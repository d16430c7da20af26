#include "fit_values.h"

#include <cmath>

#include "cli/exit_status.h"
#include "document/kinds/frf_json.h"

namespace stablecut {

std::optional<double> parse_decay(std::string_view text) {
  const bool is_time = text.ends_with('s');
  const auto number = parse_number(text.substr(0, text.size() - (is_time ? 1 : 0)));
  if (!number || !(*number > 0) || !std::isfinite(1 / *number)) return std::nullopt;
  return is_time ? 1 / *number : *number;
}

void add_bands(const std::string& text, std::vector<Range>& bands) {
  for (const std::string_view part : split(text, ',')) {
    const auto band = parse_band(part);
    cli::refuse_if(!band, "--exclude: " + std::string(part) + ": expected LO:HI in Hz, LO below HI");
    bands.push_back(*band);
  }
}

Correction parse_correction(const std::string& option, const std::string& text) {
  const auto equals = text.find('=');
  Correction correction{option, text, equals == std::string::npos ? "" : text.substr(0, equals)};
  const auto number = parse_number(equals == std::string::npos ? text : text.substr(equals + 1));
  const bool is_delay = option == "--delay";
  if (!number || equals == 0 || (!is_delay && *number == 0)) {
    throw cli::WrongUsage(option + ": " + text + ": expected " +
                          (is_delay ? "milliseconds, as 0.25 or xy=0.25" : "a factor, as 9.81 or xy=1.05"));
  }
  (is_delay ? correction.delay_ms : correction.factor) = *number;
  return correction;
}

void add_taps(const std::string& text, std::vector<TapFile>& files) {
  const auto equals = text.find('=');
  std::string direction = text.substr(0, equals);
  document::take_sign(direction);
  cli::refuse_if(equals == std::string::npos || direction.empty() || equals + 1 == text.size(),
                 "--taps: " + text + ": expected DIRECTION=FILE, as x=hits.csv (force along x)");
  for (const std::string_view path : split(std::string_view(text).substr(equals + 1), ',')) {
    cli::refuse_if(path.empty(), "--taps: " + text + ": expected files between commas");
    files.push_back({text.substr(0, equals), std::string(path)});
  }
}

}  // namespace stablecut
