#include "milling/spectral.h"

#include <Eigen/LU>
#include <complex>
#include <vector>

#include "base/units.h"
#include "milling/exponential_moments.h"

namespace stablecut {
namespace {

using Complex = std::complex<double>;

struct TimedArc {
  EngagedArc arc;
  double start_s;
  double length_s;
};

// Coefficients of P_0 ... P_{n-1} from values at n Gauss nodes (exact: the products have degree below 2n).
Eigen::MatrixXd legendre_from_nodes(const GaussRule& rule) {
  const Eigen::Index n = rule.node.size();
  Eigen::MatrixXd transform(n, n);
  for (Eigen::Index i = 0; i < n; ++i) transform.col(i) = rule.weight[i] * legendre_values(rule.node[i], n);
  for (Eigen::Index j = 0; j < n; ++j) transform.row(j) *= static_cast<double>(2 * j + 1) / 2;
  return transform;
}

// [points + 1 x points]: a mode's value at the nodes and at the arc's end, per force value at the nodes.
Eigen::MatrixXcd mode_response(Complex lambda, double length_s, const GaussRule& rule,
                               const Eigen::MatrixXd& transform) {
  const Eigen::Index n = rule.node.size();
  const Complex z = lambda * (length_s / 2);
  Eigen::MatrixXcd moments(n + 1, n);
  for (Eigen::Index i = 0; i < n; ++i) moments.row(i) = exponential_moments(z, rule.node[i], n).transpose();
  moments.row(n) = exponential_moments(z, 1.0, n).transpose();
  return (length_s / 2) * moments * transform;
}

}  // namespace

SpectralMap::SpectralMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                         int points_per_arc)
    : PeriodMap(structure, cutter.tooth_period_s(revolutions_per_s)) {
  const double angular_speed = kTwoPi * revolutions_per_s;
  const GaussRule rule = gauss_legendre(points_per_arc);
  const Eigen::MatrixXd transform = legendre_from_nodes(rule);
  const Eigen::Index points = rule.node.size();
  const Eigen::Index d = structure.directions();
  const Eigen::Index n = structure.modes();

  // Time counts from the first arc's start.
  std::vector<TimedArc> arcs;
  for (const EngagedArc& arc : engaged_arcs(cutter)) {
    const double origin = arcs.empty() ? arc.from_rad : arcs.front().arc.from_rad;
    arcs.push_back({arc, (arc.from_rad - origin) / angular_speed, (arc.to_rad - arc.from_rad) / angular_speed});
  }
  for (const TimedArc& arc : arcs) {
    for (Eigen::Index i = 0; i < points; ++i) {
      const double share = (rule.node[i] + 1) / 2;
      const double phase = arc.arc.from_rad + share * (arc.arc.to_rad - arc.arc.from_rad);
      samples_.push_back({arc.start_s + share * arc.length_s, rule.weight[i] / 2 * arc.length_s,
                          structure.restrict(directional_coefficients(cutter, arc.arc, phase))});
    }
  }

  const Eigen::Index rows = d * static_cast<Eigen::Index>(samples_.size());
  displacement_of_state_.resize(rows, 2 * n);
  displacement_of_force_ = Eigen::MatrixXd::Zero(rows, rows);
  final_state_of_force_.resize(2 * n, rows);
  final_state_of_state_ = structure.free_flight(period_s());

  for (Eigen::Index k = 0; k < n; ++k) {
    const Complex lambda = structure.lambda[k];
    const Eigen::VectorXcd psi_r = structure.psi_r.col(k);
    const Eigen::MatrixXcd residue = psi_r * structure.psi_l.col(k).transpose();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Eigen::VectorXcd value = 2.0 * std::exp(lambda * samples_[i].time_s) * psi_r;
      displacement_of_state_.block(static_cast<Eigen::Index>(i) * d, k, d, 1) = value.real();
      displacement_of_state_.block(static_cast<Eigen::Index>(i) * d, n + k, d, 1) = -value.imag();
    }
    for (std::size_t b = 0; b < arcs.size(); ++b) {
      const Eigen::MatrixXcd response = mode_response(lambda, arcs[b].length_s, rule, transform);
      const double end_s = arcs[b].start_s + arcs[b].length_s;
      const Complex to_final = std::exp(lambda * (period_s() - end_s));
      const Eigen::Index first_row = static_cast<Eigen::Index>(b) * points;
      for (Eigen::Index j = 0; j < points; ++j) {
        const Eigen::Index column = (first_row + j) * d;
        for (Eigen::Index i = 0; i < points; ++i) {
          displacement_of_force_.block((first_row + i) * d, column, d, d) += 2 * (response(i, j) * residue).real();
        }
        // Later arcs see what is left of the state at this arc's end.
        for (auto later = static_cast<std::size_t>(first_row + points); later < samples_.size(); ++later) {
          const Complex left = response(points, j) * std::exp(lambda * (samples_[later].time_s - end_s));
          displacement_of_force_.block(static_cast<Eigen::Index>(later) * d, column, d, d) +=
              2 * (left * residue).real();
        }
        const Eigen::VectorXcd state = to_final * response(points, j) * structure.psi_l.col(k);
        final_state_of_force_.block(k, column, 1, d) = state.real().transpose();
        final_state_of_force_.block(n + k, column, 1, d) = state.imag().transpose();
      }
    }
  }
}

Eigen::MatrixXd SpectralMap::monodromy(double depth_m) const {
  const Eigen::Index d = structure().directions();
  const Eigen::Index states = final_state_of_state_.rows();
  const Eigen::Index rows = displacement_of_force_.rows();
  const double scale = structure().displacement_scale_m;

  // Columns times the force per displacement difference, depth * A at each node.
  const auto times_force = [&](const Eigen::MatrixXd& matrix) {
    Eigen::MatrixXd result(matrix.rows(), rows);
    for (Eigen::Index i = 0; i < rows / d; ++i) {
      result.middleCols(i * d, d).noalias() =
          matrix.middleCols(i * d, d) * (depth_m * samples_[static_cast<std::size_t>(i)].coefficient);
    }
    return result;
  };
  // r = E q + W F (r - r_delayed)  =>  r - r_delayed = (I - W F)^-1 (E q - r_delayed).
  const Eigen::PartialPivLU<Eigen::MatrixXd> implicit(Eigen::MatrixXd::Identity(rows, rows) -
                                                      times_force(displacement_of_force_));
  Eigen::MatrixXd difference(rows, states + rows);
  difference.leftCols(states) = displacement_of_state_ / scale;
  difference.rightCols(rows) = -Eigen::MatrixXd::Identity(rows, rows);
  difference = implicit.solve(difference).eval();

  Eigen::MatrixXd map(states + rows, states + rows);
  map.topRows(states).noalias() = (scale * times_force(final_state_of_force_)) * difference;
  map.topLeftCorner(states, states) += final_state_of_state_;
  map.bottomRows(rows) = difference;
  map.bottomRightCorner(rows, rows) += Eigen::MatrixXd::Identity(rows, rows);
  return map;
}

}  // namespace stablecut
