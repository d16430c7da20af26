// Modes that still ring where a record ends: README.md, "The end of a record".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/modal_model.h"

namespace stablecut::modal {

struct RingingModes {
  double record_s = 0;     ///< length of a record with such lines
  std::vector<double> hz;  ///< natural frequencies
  double share = 0;        ///< of its first size that a mode still has at the end: the largest
};

/// Modes in the band of a table, as it was fitted (through its window, with its covariance), whose vibration
/// is not over at the end of records that even lines as these come from, by more than their vectors are
/// uncertain; nothing for uneven lines, which no record has.
std::optional<RingingModes> ringing_at_end(const dynamics::ModalModel& table,
                                           const Eigen::VectorXd& frequency_hz);

}  // namespace stablecut::modal
