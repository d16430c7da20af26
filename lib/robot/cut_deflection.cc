#include "robot/cut_deflection.h"

#include <cmath>

#include "robot/compliance_slope.h"

namespace stablecut::robot {
namespace {

// Of the walls' errors along the edge the one that is largest in size.
double largest_error(const Eigen::RowVector3d& yields, const CutLoad::Wall& wall) {
  const Eigen::RowVectorXd errors = (wall.left ? -1 : 1) * yields * wall.leaving_n;
  Eigen::Index at = 0;
  errors.cwiseAbs().maxCoeff(&at);
  return errors[at];
}

}  // namespace

CutDeflection cut_deflection(const RobotPose& pose, const StiffnessTask& task, const Elasticity& elasticity,
                             const ElasticityErrors& errors) {
  const CutLoad& cut = *task.cut;
  const Eigen::Matrix3d compliance = translational_compliance(pose, elasticity);
  CutDeflection result;
  result.frame = cut_frame(task.feed, pose.tool.linear().col(2));
  const Eigen::Matrix3d& frame = result.frame;
  // The row of a compliance in the cut's frame.
  const auto row = [&](const Eigen::Matrix3d& c, int axis) -> Eigen::RowVector3d {
    return frame.col(axis).transpose() * c * frame;
  };
  const auto value = [&](double length, const auto& of_compliance) {
    CutDeflection::Value one{of_compliance(compliance), {}};
    if (!errors.known()) return one;
    const Eigen::VectorXd slope = compliance_gradient(pose, elasticity.springs, compliance, of_compliance);
    one.std_m = std::sqrt(propagated(slope, errors) + errors.discrepancy.variance(length));
    return one;
  };
  using Compliance = const Eigen::Matrix3d&;
  const double mean_length = (compliance * frame * cut.mean_n).norm();
  const double most_length = largest_length(compliance * frame, cut.turning_n).length;
  for (int axis = 0; axis < 3; ++axis) {
    result.mean[axis] = value(mean_length, [&](Compliance c) { return row(c, axis).dot(cut.mean_n); });
    result.largest[axis] =
        value(most_length, [&](Compliance c) { return largest_component(row(c, axis), cut.turning_n); });
  }
  for (const CutLoad::Wall& wall : cut.walls) {
    CutDeflection::Wall one{wall.left, result.mean[1], {}};
    if (wall.left) one.mean_error.m = -one.mean_error.m;
    if (wall.leaving_n.cols() > 0)
      one.error = value(most_length, [&](Compliance c) { return largest_error(row(c, 1), wall); });
    result.walls.push_back(one);
  }
  return result;
}

}  // namespace stablecut::robot
