#include "option_values.h"

#include <algorithm>
#include <string_view>

#include "base/number_text.h"
#include "base/range.h"
#include "base/units.h"
#include "cli/exit_status.h"

namespace stablecut {
namespace {

constexpr std::size_t kMostPositions = 10;

}  // namespace

void add_positions(const std::string& text, std::vector<double>& positions_m) {
  for (const std::string_view part : split(text, ',')) {
    const auto position = parse_number(part);
    if (!position || *position < 0 || positions_m.size() == kMostPositions)
      throw cli::WrongUsage("--positions: " + text +
                            ": expected up to 10 distances from the tip in mm, as 0,40");
    const double metres = metres_from_mm(*position);
    cli::refuse_if(std::find(positions_m.begin(), positions_m.end(), metres) != positions_m.end(),
                   "--positions: " + text + ": expected each place once");
    positions_m.push_back(metres);
  }
}

void set_bounds(const std::string& text, receptance::JointBounds& bounds) {
  for (const std::string_view part : split(text, ',')) {
    const auto equals = part.find('=');
    const auto name = std::find(kJointNames.begin(), kJointNames.end(), part.substr(0, equals));
    const auto band = equals == std::string::npos ? std::nullopt : parse_band(part.substr(equals + 1));
    const std::size_t at = name - kJointNames.begin();
    if (name == kJointNames.end() || !band || band->from < receptance::kLeastBound[at] ||
        band->to > receptance::kLargestBound) {
      throw cli::WrongUsage("--bounds: " + std::string(part) +
                            ": expected k1=LO:HI, c1=LO:HI, k2=LO:HI or c2=LO:HI, where LO is below HI and "
                            "at least 1e-20 (k1, k2) or 0 (c1, c2), and HI at most 1e20");
    }
    bounds.least[at] = band->from;
    bounds.most[at] = band->to;
  }
}

void set_overhang(double overhang_mm, receptance::BeamChain& tool) {
  receptance::BeamSegment& shank = tool.back();
  const double before_m = receptance::length_of(tool) - shank.length_m;
  const double left_m = metres_from_mm(overhang_mm) - before_m;
  cli::refuse_if(left_m <= 0, "--overhang: " + number_text(overhang_mm) + ": expected more than " +
                                  number_text(mm_from_metres(before_m)) +
                                  " mm, the tool without its segment at the joint");
  shank.length_m = left_m;
}

}  // namespace stablecut
