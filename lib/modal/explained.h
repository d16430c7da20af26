// Where modes explain too little of the curves for a table to be used: README.md, "Too little explained".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fit_data.h"

namespace stablecut::modal {

/// Lines of a curve that modes leave unexplained.
struct Unexplained {
  std::size_t curve = 0;        ///< index in the data
  double lo_hz = 0, hi_hz = 0;  ///< first and last line
  double error = 0;             ///< |model - h| / |h|, norms over these lines, beyond the noise
};

/// The curve and band (the whole, or an octave) of which modes leave most; nothing where they leave less than
/// `least` everywhere. Only lines that stand 10 dB clear of the noise that the curve itself shows count, and
/// only bands in which half of them do.
std::optional<Unexplained> most_unexplained(const FitData& data, const std::vector<dynamics::Mode>& modes,
                                            double least);

/// Whether modes are none of a structure's where a curve falls up to `up_to_hz` from the first line on: they
/// leave `least` of it (|model - h| / |h|, the median over lines that stand 10 dB clear of its noise), or, of
/// a driving point, give energy on most of the lower half of it as they do not in most of the band. `driving`
/// [curves].
bool leave_low_end(const FitData& data, const std::vector<dynamics::Mode>& modes,
                   const std::vector<bool>& driving, double up_to_hz, double least);

}  // namespace stablecut::modal
