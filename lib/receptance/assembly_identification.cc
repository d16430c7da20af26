#include "receptance/assembly_identification.h"

#include "base/parallel.h"
#include "base/units.h"

namespace stablecut::receptance {
namespace {

JointData data_in_direction(const Assembly& assembly, int direction,
                            const dynamics::FrequencyResponseEntry& entry) {
  JointData data;
  data.omega_rad_per_s = kTwoPi * assembly.frequency_hz;
  for (Eigen::Index i = 0; i < data.omega_rad_per_s.size(); ++i)
    data.plane.push_back(assembly.plane(direction, i));
  data.tip = entry.h;
  data.variance = dynamics::weighing_variance(entry, assembly.frequency_hz);
  return data;
}

bool same_measurement(const dynamics::FrequencyResponseEntry& a, const dynamics::FrequencyResponseEntry& b) {
  return a.h == b.h && dynamics::same_values(dynamics::known_variance(a), dynamics::known_variance(b));
}

}  // namespace

MeasuredTip tip_entries(const dynamics::FrequencyResponse& measured) {
  MeasuredTip tip{};
  for (std::size_t d = 0; d < 2; ++d) {
    dynamics::FrequencyResponseEntry wanted;
    wanted.response = wanted.reference = kCoordinates[2 * d];
    for (const auto& entry : measured.entries) {
      if (tip[d] == nullptr && entry.same_places(wanted)) tip[d] = &entry;
    }
  }
  return tip;
}

IdentifiedJoints identify_joints(const Assembly& assembly, const MeasuredTip& tip, const JointBounds& bounds,
                                 JointObjective objective, int threads) {
  IdentifiedJoints joints;
  joints.one_for_both =
      assembly.axisymmetric && tip[0] != nullptr && tip[1] != nullptr && same_measurement(*tip[0], *tip[1]);
  parallel_for(2, threads, [&](std::size_t d) {
    if (tip[d] == nullptr || (d == 1 && joints.one_for_both)) return;
    joints.estimate[d] =
        identify_joint(data_in_direction(assembly, static_cast<int>(d), *tip[d]), bounds, objective);
  });
  if (joints.one_for_both) joints.estimate[1] = joints.estimate[0];
  return joints;
}

}  // namespace stablecut::receptance
