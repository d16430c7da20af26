// Functions of the cutter's turn that are short Fourier series on arcs and zero elsewhere.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <vector>

namespace stablecut::milling {

/// An edge that lags by less at the top of the cut is straight, rad.
inline constexpr double kStraight = 1e-7;

/// On [from_rad, to_rad], with columns m = 0, 1, 2:
/// Re(column 0) + 2 Re(sum of column m * exp(i m turn)).
template <int kRows>
struct TurningArc {
  using Values = Eigen::Matrix<double, kRows, 1>;
  using Harmonics = Eigen::Matrix<std::complex<double>, kRows, 3>;

  double from_rad = 0, to_rad = 0;
  Harmonics harmonics;

  Values at(double turn_rad) const {
    return harmonics.col(0).real() + 2 * (harmonics.col(1) * std::polar(1.0, turn_rad) +
                                          harmonics.col(2) * std::polar(1.0, 2 * turn_rad))
                                             .real();
  }
  /// The rate of change per turn of it, on the same arc.
  TurningArc slope() const {
    TurningArc result{from_rad, to_rad, Harmonics::Zero()};
    for (int m = 1; m < 3; ++m) result.harmonics.col(m) = std::complex<double>(0, m) * harmonics.col(m);
    return result;
  }
  /// The integral from the beginning to a turn.
  Values integral_to(double turn_rad) const {
    const auto factor = [&](int m) {
      return (std::polar(1.0, m * turn_rad) - std::polar(1.0, m * from_rad)) / std::complex<double>(0, m);
    };
    return harmonics.col(0).real() * (turn_rad - from_rad) +
           2 * (harmonics.col(1) * factor(1) + harmonics.col(2) * factor(2)).real();
  }
};

/// The number of the last period in which a place was passed before a turn; 0 in the period of the place
/// itself. Whether an arc is under way must be asked by this for both its ends, and so must what happens
/// there: another formula rounds differently.
inline double last_passed(double place_rad, double period_rad, double turn_rad) {
  return std::floor((turn_rad - place_rad) / period_rad);
}

/// The sum over the arcs, each repeated every `period_rad`, at a turn; where arcs begin or end there, those
/// that are under way at `beside_rad`.
template <int kRows>
Eigen::Matrix<double, kRows, 1> sum_at(const std::vector<TurningArc<kRows>>& arcs, double period_rad,
                                       double turn_rad, double beside_rad) {
  Eigen::Matrix<double, kRows, 1> sum = Eigen::Matrix<double, kRows, 1>::Zero();
  for (const auto& arc : arcs) {
    const double last = last_passed(arc.from_rad, period_rad, beside_rad);
    for (double copy = last_passed(arc.to_rad, period_rad, beside_rad) + 1; copy <= last; ++copy)
      sum += arc.at(turn_rad - copy * period_rad);
  }
  return sum;
}
/// After what begins or ends there.
template <int kRows>
Eigen::Matrix<double, kRows, 1> sum_at(const std::vector<TurningArc<kRows>>& arcs, double period_rad,
                                       double turn_rad) {
  return sum_at(arcs, period_rad, turn_rad, turn_rad);
}

/// Its integral from turn 0 to any turn, of either sign.
template <int kRows>
Eigen::Matrix<double, kRows, 1> integral_to(const std::vector<TurningArc<kRows>>& arcs, double period_rad,
                                            double turn_rad) {
  const auto until = [&](const TurningArc<kRows>& arc, double turn) {
    const double ended = last_passed(arc.to_rad, period_rad, turn),
                 last = last_passed(arc.from_rad, period_rad, turn);
    Eigen::Matrix<double, kRows, 1> sum = ended * arc.integral_to(arc.to_rad);
    for (double copy = ended + 1; copy <= last; ++copy) sum += arc.integral_to(turn - copy * period_rad);
    return sum;
  };
  Eigen::Matrix<double, kRows, 1> sum = Eigen::Matrix<double, kRows, 1>::Zero();
  for (const auto& arc : arcs) sum += until(arc, turn_rad) - until(arc, 0);
  return sum;
}

}  // namespace stablecut::milling
