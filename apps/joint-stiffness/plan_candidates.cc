#include "plan_candidates.h"

#include <algorithm>

#include "base/units.h"
#include "pose_words.h"
#include "robot/given_poses.h"

namespace stablecut {
namespace {

// A weight that a workshop has, along each axis, and a dial gauge.
constexpr std::array<std::array<double, 3>, 3> kLoadsN = {{{600, 0, 0}, {0, 600, 0}, {0, 0, -600}}};
constexpr double kStdMm = 0.005;
// Of a deflection: what robots differ from six springs by where nothing is known of them.
constexpr double kRelativeDiscrepancy = 0.1;

}  // namespace

PlanCandidates plan_candidates(const robot::Robot& robot, const std::vector<robot::JointAngles>& poses,
                               const PlanRequest& request) {
  PlanCandidates candidates;
  std::vector<std::string> places;
  for (std::size_t p = 0; p < poses.size(); ++p) places.push_back("/poses/" + std::to_string(p));
  candidates.outside = outside_limits_text(robot, poses, places, "poses");
  std::vector<bool> allowed(poses.size(), true);
  for (const robot::OutsideLimits& pose : robot::poses_outside_limits(robot, poses))
    allowed[pose.pose] = false;
  const auto point = [&](const PlanRequest::Vector& mm) {
    return mm ? Eigen::Vector3d(Eigen::Vector3d(mm->data()) * 1e-3) : robot.tool.translation();
  };
  const auto loads = request.loads_n.empty() ? std::vector(kLoadsN.begin(), kLoadsN.end()) : request.loads_n;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (!allowed[p]) continue;
    for (const auto& load : loads) {
      robot::LoadSample sample;
      sample.angles = poses[p];
      sample.force_n = Eigen::Vector3d(load.data());
      sample.force_point = point(request.load_point_mm);
      sample.measuring_point = point(request.measuring_point_mm);
      sample.deflection_std_m = Eigen::Vector3d::Constant(metres_from_mm(request.std_mm.value_or(kStdMm)));
      candidates.samples.push_back(sample);
      candidates.pose.push_back(static_cast<int>(p));
    }
  }
  return candidates;
}

void add_model_error(const robot::Robot& robot, const robot::PlanOptions& options,
                     document::PlanDocument& document) {
  robot::JointAngles compliance = robot::JointAngles::Zero();
  for (int j = 0; j < robot::kJoints; ++j) {
    if (document.expected->stiffness[j]) compliance[j] = 1 / *document.expected->stiffness[j];
  }
  document.discrepancy = document.expected->errors.discrepancy;
  if (document.discrepancy.none()) document.discrepancy.relative = kRelativeDiscrepancy;
  document.std_with_discrepancy = robot::std_with_discrepancy(
      robot, document.candidates, options, document.plan, compliance, document.discrepancy);
}

}  // namespace stablecut
