#include "receptance/assembly.h"

#include "base/error.h"
#include "base/units.h"

namespace stablecut::receptance {
namespace {

// The 4 x 4 receptance of directions that are not coupled: one block for each, or the same block twice.
template <typename InDirection>
Receptance<4> uncoupled(bool same, const InDirection& in_direction) {
  Receptance<4> both = Receptance<4>::Zero();
  both.topLeftCorner<2, 2>() = in_direction(0);
  if (same) {
    both.bottomRightCorner<2, 2>() = both.topLeftCorner<2, 2>();
  } else {
    both.bottomRightCorner<2, 2>() = in_direction(1);
  }
  return both;
}

// Kc^-1; zero for a rigid joint.
Receptance<2> joint_receptance(const std::optional<ToolJoint>& joint, double omega) {
  Receptance<2> result = Receptance<2>::Zero();
  if (joint) result.diagonal() = joint->stiffness(omega).cwiseInverse();
  return result;
}

}  // namespace

Receptance<2> Assembly::holder(int direction, Eigen::Index line) const {
  const HeldBy& by = held[direction];
  const double omega = rad_per_s_from_hz(frequency_hz[line]);
  if (by.end == HolderEnd::kFree) {
    if (by.segments.empty()) throw InvalidArgument("holder: a free end needs a segment");
    return free_chain(by.segments, theory, omega).r11;
  }
  Receptance<2> inner = Receptance<2>::Zero();
  if (by.end == HolderEnd::kGiven) {
    inner = given[line].block<2, 2>(2 * direction, 2 * direction);
  }
  return held_chain<2>(by.segments, theory, omega, inner);
}

JointPlane<2> Assembly::plane(int direction, Eigen::Index line) const {
  const double omega = rad_per_s_from_hz(frequency_hz[line]);
  return with_tip_mass<2>(joint_plane<2>(tool, theory, omega, holder(direction, line)), tip_mass_kg, omega);
}

Receptance<4> Assembly::tip(Eigen::Index line) const {
  const double omega = rad_per_s_from_hz(frequency_hz[line]);
  if (couples_directions) return with_mass<4>(along_tool(line, 0, 0), tip_mass_kg, omega);
  return uncoupled(axisymmetric, [&](int direction) -> Receptance<2> {
    if (const auto& joint = held[direction].joint) {
      return plane(direction, line).tip(joint->stiffness(omega));
    }
    return with_mass<2>(held_chain<2>(tool, theory, omega, holder(direction, line)), tip_mass_kg, omega);
  });
}

Receptance<4> Assembly::along_tool(Eigen::Index line, double response_m, double reference_m) const {
  const double omega = rad_per_s_from_hz(frequency_hz[line]);
  if (couples_directions) {
    Receptance<4> holder = held_chain<4>(held[0].segments, theory, omega, given[line]);
    holder.topLeftCorner<2, 2>() += joint_receptance(held[0].joint, omega);
    holder.bottomRightCorner<2, 2>() += joint_receptance(held[1].joint, omega);
    return receptance_along<4>(tool, theory, omega, holder, response_m, reference_m);
  }
  return uncoupled(axisymmetric, [&](int direction) -> Receptance<2> {
    const Receptance<2> held_by = holder(direction, line) + joint_receptance(held[direction].joint, omega);
    return receptance_along<2>(tool, theory, omega, held_by, response_m, reference_m);
  });
}

void Assembly::set_joints(const std::array<std::optional<ToolJoint>, 2>& joints) {
  for (std::size_t d = 0; d < 2; ++d) held[d].joint = joints[d];
  axisymmetric = axisymmetric && joints[0].value_or(ToolJoint{}) == joints[1].value_or(ToolJoint{});
}

}  // namespace stablecut::receptance
