#include "receptance/assembly.h"

#include "base/error.h"

namespace stablecut {

Eigen::Matrix2cd tip_receptance(const std::vector<BeamSegment>& tool, const HeldTool& held, BeamTheory theory,
                                double omega) {
  if (tool.empty() || held.holder.empty())
    throw InvalidArgument("assembly: no segment: expected at least one");
  // From the inner end of the holder outwards to the tip.
  Eigen::Matrix2cd holder = held.holder_fixed ? fixed_free_receptance(held.holder.back(), theory, omega)
                                              : free_free_receptances(held.holder.back(), theory, omega).r11;
  for (std::size_t i = held.holder.size() - 1; i-- > 0;) {
    holder = held_receptance(held.holder[i], theory, omega, holder);
  }
  if (held.joint) holder += held.joint->receptance(omega);
  for (std::size_t i = tool.size(); i-- > 0;) holder = held_receptance(tool[i], theory, omega, holder);
  return holder;
}

}  // namespace stablecut
