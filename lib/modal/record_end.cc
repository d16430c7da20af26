#include "modal/record_end.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stablecut::modal {
namespace {

constexpr double kLeastShare = 0.05;  // of a vibration at the end that is said
constexpr double kEvenLines = 1.5;    // largest distance of lines over the mean: frequencies may be rounded
constexpr double kSignificant = 1;    // deviations of a mode's vectors

// Of a mode's residues, relative.
double deviation_of(const dynamics::ModalModel& table, std::size_t k) {
  const dynamics::Mode& mode = table.modes[k];
  const Eigen::VectorXd deviation = table.deviation(static_cast<Eigen::Index>(k));
  const Eigen::Index width = 2 * mode.psi_r.size();
  return std::hypot(deviation.segment(2, width).norm() / mode.psi_r.norm(),
                    deviation.segment(2 + width, width).norm() / mode.psi_l.norm());
}

}  // namespace

std::optional<RingingModes> ringing_at_end(const dynamics::ModalModel& table,
                                           const Eigen::VectorXd& frequency_hz) {
  const Eigen::Index lines = frequency_hz.size();
  const double spacing = (frequency_hz[lines - 1] - frequency_hz[0]) / static_cast<double>(lines - 1);
  const Eigen::VectorXd steps = frequency_hz.tail(lines - 1) - frequency_hz.head(lines - 1);
  if (steps.maxCoeff() > kEvenLines * spacing) return std::nullopt;
  RingingModes ringing;
  ringing.record_s = 1 / spacing;
  for (std::size_t k = 0; k < table.modes.size(); ++k) {
    const double share = std::exp(table.modes[k].pole().real() * ringing.record_s);
    if (table.modes[k].out_of_band || share < kLeastShare || share < kSignificant * deviation_of(table, k))
      continue;
    ringing.hz.push_back(table.modes[k].frequency_hz);
    ringing.share = std::max(ringing.share, share);
  }
  return ringing.hz.empty() ? std::nullopt : std::optional(std::move(ringing));
}

}  // namespace stablecut::modal
