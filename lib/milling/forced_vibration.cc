#include "milling/forced_vibration.h"

#include <Eigen/Geometry>
#include <cmath>
#include <complex>

#include "base/units.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

}  // namespace

ModesInCut modes_in_cut(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s) {
  const double omega = kTwoPi * revolutions_per_s;
  const Eigen::Matrix3d feed =
      Eigen::AngleAxisd(cutter.feed_angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::MatrixXd into_cut = feed.transpose()(Eigen::all, structure.axes);
  return {structure.lambda / omega, into_cut * structure.psi_r, into_cut * structure.psi_l / omega};
}

ForcedVibration::ForcedVibration(const TipStructure& structure, const Cutter& cutter, const ForceCycle& force,
                                 double revolutions_per_s)
    : period_rad_(force.period_rad), lag_rad_per_m_(cutter.lag_rad_per_m) {
  const ModesInCut modes = modes_in_cut(structure, cutter, revolutions_per_s);
  shape_ = modes.shape;
  rate_ = modes.rate;
  const auto receptance = [&](Complex s) -> Eigen::Matrix3cd {
    const Eigen::VectorXcd own = (s - rate_.array()).inverse(),
                           other = (s - rate_.array().conjugate()).inverse();
    return shape_ * own.asDiagonal() * modes.drive.transpose() +
           shape_.conjugate() * other.asDiagonal() * modes.drive.adjoint();
  };
  for (const TurningArc<4>& arc : force.arcs) {
    TurningArc<3> driven{arc.from_rad, arc.to_rad, {}};
    for (int m = 0; m < 3; ++m)
      driven.harmonics.col(m) = receptance(Complex(0, m)) * arc.harmonics.col(m).head<3>();
    driven_.push_back(driven);
    driven_slope_.push_back(driven.slope());
    // A mode follows the arc's harmonics from its beginning, less what it would have had then, and swings
    // freely from its end with what it has.
    for (const double turn : {arc.from_rad, arc.to_rad}) {
      Eigen::VectorXcd state = Eigen::VectorXcd::Zero(structure.modes());
      for (int m = -2; m <= 2; ++m) {
        Eigen::Vector3cd part = arc.harmonics.col(std::abs(m)).head<3>();
        if (m < 0) part = part.conjugate().eval();
        state.array() += (modes.drive.transpose() * part).array() * std::polar(1.0, m * turn) /
                         (Complex(0, m) - rate_.array());
      }
      if (turn == arc.from_rad) state = -state;
      breaks_.push_back({turn, state});
    }
  }
  mean_ = receptance(0).real() * force.mean().head<3>();
}

ForcedVibration::Free ForcedVibration::free_at(double turn_rad) const {
  Free free{Eigen::VectorXcd::Zero(rate_.size()), Eigen::VectorXcd::Zero(rate_.size())};
  for (const Break& at : breaks_) {
    const double since = turn_rad - at.turn_rad, periods = last_passed(at.turn_rad, period_rad_, turn_rad);
    free.state.array() += at.jump.array() * (rate_ * (since - periods * period_rad_)).array().exp();
    free.jumped += periods * at.jump;
  }
  free.state.array() /= 1.0 - (rate_ * period_rad_).array().exp();
  return free;
}

// Calls visit(turn, free motion) at turns at equal distances over a period.
template <typename Visit>
void ForcedVibration::walk(double from_rad, int count, const Visit& visit) const {
  const double step = period_rad_ / count;
  const Eigen::VectorXcd growth = (rate_ * step).array().exp();
  Free free = free_at(from_rad);
  for (int i = 0; i < count; ++i) {
    const double turn = from_rad + i * step, end = from_rad + (i + 1) * step;
    visit(turn, free);
    free.state = free.state.cwiseProduct(growth);
    for (const Break& at : breaks_) {
      const double since = end - at.turn_rad, periods = last_passed(at.turn_rad, period_rad_, end);
      if (periods == last_passed(at.turn_rad, period_rad_, turn)) continue;
      free.state.array() += at.jump.array() * (rate_ * (since - periods * period_rad_)).array().exp();
      free.jumped += at.jump;
    }
  }
}

Eigen::Matrix3Xd ForcedVibration::per_depth(double from_rad, int count) const {
  Eigen::Matrix3Xd result(3, count);
  Eigen::Index i = 0;
  walk(from_rad, count, [&](double turn, const Free& free) {
    result.col(i++) = sum_at(driven_, period_rad_, turn) + 2 * (shape_ * free.state).real();
  });
  return result;
}

// Of that, but for a constant.
Eigen::Matrix3Xd ForcedVibration::integrals(double from_rad, int count) const {
  Eigen::Matrix3Xd result(3, count);
  Eigen::Index i = 0;
  walk(from_rad, count, [&](double turn, const Free& free) {
    result.col(i++) = integral_to(driven_, period_rad_, turn) +
                      2 * (shape_ * (free.state - free.jumped).cwiseQuotient(rate_)).real();
  });
  return result;
}

Eigen::Matrix3Xd ForcedVibration::over_depth(double depth_m, double from_rad, int count) const {
  const double lag = lag_rad_per_m_ * depth_m;
  if (std::abs(lag) < kStraight) return depth_m * per_depth(from_rad, count);
  return (integrals(from_rad, count) - integrals(from_rad - lag, count)) / lag_rad_per_m_;
}

Eigen::Vector3d ForcedVibration::displacement(double depth_m, double turn_rad) const {
  return over_depth(depth_m, turn_rad, 1);
}

Eigen::Vector3d ForcedVibration::slope(double depth_m, double turn_rad) const {
  const double lag = lag_rad_per_m_ * depth_m;
  if (std::abs(lag) >= kStraight)
    return (per_depth(turn_rad, 1) - per_depth(turn_rad - lag, 1)) / lag_rad_per_m_;
  const Eigen::VectorXcd state = free_at(turn_rad).state;
  return depth_m *
         (sum_at(driven_slope_, period_rad_, turn_rad) + 2 * (shape_ * rate_.cwiseProduct(state)).real());
}

Eigen::Matrix3Xd ForcedVibration::displacements(double depth_m, int count) const {
  return over_depth(depth_m, 0, count);
}

}  // namespace stablecut::milling
