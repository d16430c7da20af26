// Entries that may not fit together: one that comes late, or whose scale is off. README.md, "Entries that do
// not fit together".
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "modal/fit_data.h"

namespace stablecut::modal {

/// A mode with more damping is no structure's: it may imitate what is wrong.
inline constexpr double kMostDamping = 0.3;

/// What is wrong with one curve, or with one of two.
struct EntryMismatch {
  std::size_t curve = 0;               ///< index in the data
  std::optional<std::size_t> other{};  ///< it may be this curve as well: nothing tells the two apart
  double delay_s = 0;                  ///< by how much the response is late: H exp(i omega delay) has none
  double factor = 1;                   ///< how many times too large it is
  bool all = false;                    ///< all curves are, as far as can be told
  /// It may also be a cross entry between both directions that is 1 / factor times too large.
  bool or_cross = false;
};

/// The data without the mismatch; weights go with a factor.
FitData mended(FitData data, const EntryMismatch& mismatch);

/// Whether a factor is off by as much as a suggested one has to be, or a delay turns the highest line by that
/// (rad).
bool matters(const FitData& data, const EntryMismatch& mismatch);

/// The delay (s, of either sign, up to 6 ms) at which a function is largest. `highest` (rad/s) is that of the
/// curves behind it.
double best_delay(double highest, const std::function<double(double)>& value);

/// How many delays best_delay looks at.
double delays_tried(double highest);

/// Suggests what may be wrong, the likeliest first: delays from the phases of driving points (of which
/// `is_driving_point` [curves] tells) and of mirrored entries on the lines, scales from the residues that
/// each curve has by itself at common `poles` (rad/s).
std::vector<EntryMismatch> suggested_mismatches(const FitData& data, const Eigen::VectorXcd& poles,
                                                const std::vector<bool>& is_driving_point);

}  // namespace stablecut::modal
