// The values of fit-modes' own options.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.h"

namespace stablecut {

/// The decay of an exponential window, 1/s, above 0: as such or as a time constant, 0.2s. Nothing for another
/// text.
std::optional<double> parse_decay(std::string_view text);

/// Adds the bands of `--exclude LO:HI,...`, Hz. Throws WrongUsage.
void add_bands(const std::string& text, std::vector<Range>& bands);

/// Takes off what is known to be wrong with an entry, or with all of them.
struct Correction {
  std::string option, text;  ///< as it was given
  std::string entry;         ///< response and reference, as xy; empty: all
  double delay_ms = 0;       ///< by how much the response is late
  double factor = 1;         ///< that the values are multiplied by
};

/// What `--delay [XY=]MS` or `--scale [XY=]FACTOR` says; `option` is which of them. Throws WrongUsage.
Correction parse_correction(const std::string& option, const std::string& text);

/// A file of one direction of the force.
struct TapFile {
  std::string reference;  ///< the direction, with its sign
  std::string path;
};

/// Adds the files of `--taps X=FILE,...`. Throws WrongUsage.
void add_taps(const std::string& text, std::vector<TapFile>& files);

}  // namespace stablecut
