#include "robot/force_cone.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace stablecut::robot {
namespace {

constexpr int kMostRootSteps = 100;  // Newton's with bisection: a guard, some eight are needed
constexpr double kRootStep = 1e-15;  // relative step

// The unit vector w [2] that maximizes w^T G w + 2 b^T w [More1983]: with the multiplier mu not below the
// larger eigenvalue of G, (mu - G) w = b.
// Where b is square to that eigenvalue's vector w and its mirror image tie; b is held away from there by
// `smoothing` of the eigenvalue, which adds `added` to the maximum.
struct CircleMaximum {
  Eigen::Vector2d w;
  double added = 0;
};

CircleMaximum best_of_circle(const Eigen::Matrix2d& g, const Eigen::Vector2d& b, double smoothing) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(g);
  const Eigen::Matrix2d axes = eigen.eigenvectors().rowwise().reverse();  // the larger eigenvalue first
  const double gap = eigen.eigenvalues()[1] - eigen.eigenvalues()[0];
  Eigen::Vector2d beta = axes.transpose() * b;
  const double first = beta[0];
  if (smoothing > 0) beta[0] = std::copysign(std::hypot(first, smoothing * eigen.eigenvalues()[1]), first);
  // In units of excess = mu - larger eigenvalue, w = (beta_1 / excess, beta_2 / (excess + gap)) has length 1.
  const auto point = [&](double excess) {
    return Eigen::Vector2d(beta[0] / excess, beta[1] / (excess + gap));
  };
  double low = std::abs(beta[0]), high = beta.norm();
  if (!(high > 0)) return {axes.col(0)};
  if (low == 0 && std::abs(beta[1]) < gap) {  // no first component: it takes what is left of the length
    const double second = beta[1] / gap;
    return {axes * Eigen::Vector2d(std::sqrt(1 - second * second), second)};
  }
  // 1 - 1 / |w| falls with the excess, and Newton's steps on 1 / |w| hardly overshoot.
  double excess = low > 0 ? low : high - gap;
  for (int step = 0; step < kMostRootSteps && high - low > kRootStep * high; ++step) {
    const Eigen::Vector2d w = point(excess);
    const double length = w.norm();
    (length > 1 ? low : high) = excess;
    const double slope = w[0] * w[0] / excess + w[1] * w[1] / (excess + gap);  // -d |w|^2 / 2
    double next = excess + (length - 1) * length * length / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - excess) <= kRootStep * next) break;
    excess = next;
  }
  const Eigen::Vector2d w = point(excess).normalized();
  return {axes * w, 2 * (beta[0] - first) * w[0]};
}

}  // namespace

LargestDeflection largest_over_turn(const Eigen::Matrix3d& compliance, const Eigen::Vector3d& along,
                                    const Eigen::Vector3d& axis, double radius_n, double smoothing) {
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = axis.unitOrthogonal();
  plane.col(1) = axis.cross(plane.col(0));
  const Eigen::Matrix<double, 3, 2> turned = radius_n * compliance * plane;
  const Eigen::Vector3d fixed = compliance * along;
  const CircleMaximum best =
      best_of_circle(turned.transpose() * turned, turned.transpose() * fixed, smoothing);
  return {std::sqrt((fixed + turned * best.w).squaredNorm() + best.added), along + radius_n * plane * best.w};
}

LargestDeflection largest_over_cone(const Eigen::Matrix3d& compliance, const Eigen::Vector3d& force_n,
                                    double angle_rad, double smoothing) {
  const double size = force_n.norm();
  const Eigen::Vector3d axis = force_n / size;
  // Over the whole sphere the direction that yields most is best; in a cone without it an edge is.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(compliance);
  const Eigen::Vector3d softest = eigen.eigenvectors().col(2);
  const double across = softest.dot(axis);
  if (std::abs(across) >= std::cos(angle_rad))
    return {size * eigen.eigenvalues()[2], std::copysign(size, across) * softest};
  return largest_over_turn(compliance, size * std::cos(angle_rad) * axis, axis, size * std::sin(angle_rad),
                           smoothing);
}

}  // namespace stablecut::robot
