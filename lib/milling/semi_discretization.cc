#include "milling/semi_discretization.h"

#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

#include "milling/cut_schedule.h"

namespace stablecut::milling {

SemiDiscretizationMap::SemiDiscretizationMap(const TipStructure& structure, const Cutter& cutter,
                                             double revolutions_per_s, int intervals)
    : PeriodMap(structure, cutter.tooth_period_s(revolutions_per_s), 1), interval_s_(period_s() / intervals) {
  const double step = cutter.mean_pitch_rad() / intervals;
  for (int i = 0; i < intervals; ++i) {
    // The cutter's coefficients do not depend on the depth here.
    const Eigen::Matrix3d mean = mean_directional_coefficients(cutter, i * step, (i + 1) * step, 0);
    if (mean.isZero(0)) {
      mean_coefficient_.emplace_back();
      continue;
    }
    mean_coefficient_.push_back(mean(structure.axes, structure.axes));
    ++intervals_in_cut_;
  }
}

Eigen::MatrixXd SemiDiscretizationMap::monodromy(double depth_m) const {
  const Eigen::Index d = structure().directions();
  const Eigen::Index states = 2 * structure().modes();
  const Eigen::Index size = states + d * intervals_in_cut_;
  const double scale = structure().displacement_scale_m;
  const Eigen::MatrixXd displacement = structure().displacement_of_state();
  const Eigen::MatrixXd rate_of_force = structure().state_rate_of_force();
  const Eigen::MatrixXd flight = structure().free_flight(interval_s_);

  // Lambda in real form, [Re -Im; Im Re].
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(states, states);
  const Eigen::Index n = structure().modes();
  rate.topLeftCorner(n, n).diagonal() = rate.bottomRightCorner(n, n).diagonal() = structure().lambda.real();
  rate.bottomLeftCorner(n, n).diagonal() = structure().lambda.imag();
  rate.topRightCorner(n, n).diagonal() = -structure().lambda.imag();

  // The state now, and the new mean displacements, as functions of the state at the period's start.
  Eigen::MatrixXd now = Eigen::MatrixXd::Zero(states, size);
  now.leftCols(states).setIdentity();
  Eigen::MatrixXd map(size, size);
  Eigen::Index row = states;
  for (const Eigen::MatrixXd& coefficient : mean_coefficient_) {
    if (coefficient.size() == 0) {
      now = (flight * now).eval();
      continue;
    }
    // [RobotMillingThesis, eq. 6-35]: P = exp(A_i dt) and R = (P - I) A_i^-1 B_i, both from the exponential
    // of [A_i B_i; 0 0] dt [VanLoan1978].
    const Eigen::MatrixXd force = depth_m * rate_of_force * coefficient;
    Eigen::MatrixXd augmented = Eigen::MatrixXd::Zero(states + d, states + d);
    augmented.topLeftCorner(states, states) = interval_s_ * (rate + force * displacement);
    augmented.topRightCorner(states, d) = -interval_s_ * scale * force;
    const Eigen::MatrixXd step = augmented.exp();
    Eigen::MatrixXd next = step.topLeftCorner(states, states) * now;
    next.middleCols(row, d) += step.topRightCorner(states, d);
    map.middleRows(row, d) = displacement * (now + next) / (2 * scale);
    now = std::move(next);
    row += d;
  }
  map.topRows(states) = now;
  return map;
}

std::vector<ForceImpulse> SemiDiscretizationMap::forces(double, std::complex<double> multiplier,
                                                        const Eigen::VectorXcd& state) const {
  // A displacement is mu times the one of the period before, u, so that the force is that of (mu - 1) u.
  std::vector<ForceImpulse> result;
  Eigen::Index row = 2 * structure().modes();
  for (std::size_t i = 0; i < mean_coefficient_.size(); ++i) {
    const Eigen::MatrixXd& coefficient = mean_coefficient_[i];
    if (coefficient.size() == 0) continue;
    result.push_back({(static_cast<double>(i) + 0.5) * interval_s_,
                      (multiplier - 1.0) * (coefficient * state.segment(row, coefficient.cols()))});
    row += coefficient.cols();
  }
  return result;
}

}  // namespace stablecut::milling
