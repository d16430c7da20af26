#include "milling/spectral.h"

#include <Eigen/LU>
#include <complex>
#include <cstddef>
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
  const auto points = static_cast<std::size_t>(points_per_arc);
  const Eigen::Index n = structure.modes();

  // Time counts from the first arc's start.
  std::vector<TimedArc> arcs;
  for (const EngagedArc& arc : engaged_arcs(cutter)) {
    const double origin = arcs.empty() ? arc.from_rad : arcs.front().arc.from_rad;
    arcs.push_back(
        {arc, (arc.from_rad - origin) / angular_speed, (arc.to_rad - arc.from_rad) / angular_speed});
  }
  std::vector<Eigen::MatrixXd> sense;     // of each node, [sensed x directions]
  std::vector<Eigen::Index> first = {0};  // of each node among all that is sensed
  for (const TimedArc& arc : arcs) {
    for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
      const double share = (rule.node[i] + 1) / 2;
      const double phase = arc.arc.from_rad + share * (arc.arc.to_rad - arc.arc.from_rad);
      DirectionalFactors factors = directional_factors(cutter, arc.arc, phase);
      if (structure.directions() == 1 && factors.sense.rows() > 1) {
        // One direction senses one displacement.
        factors.drive = factors.drive.col(structure.axes[0]).eval();
        factors.sense = factors.sense.row(structure.axes[0]).eval();
      }
      samples_.push_back({arc.start_s + share * arc.length_s, rule.weight[i] / 2 * arc.length_s,
                          factors.drive(structure.axes, Eigen::all)});
      sense.push_back(factors.sense(Eigen::all, structure.axes));
      first.push_back(first.back() + sense.back().rows());
    }
  }

  const Eigen::Index rows = first.back();
  sensed_of_state_.resize(rows, 2 * n);
  sensed_of_drive_ = Eigen::MatrixXd::Zero(rows, rows);
  final_state_of_drive_.resize(2 * n, rows);
  final_state_of_state_ = structure.free_flight(period_s());

  std::vector<Eigen::MatrixXcd> responses;  // of the mode, [arcs]
  for (Eigen::Index k = 0; k < n; ++k) {
    const Complex lambda = structure.lambda[k];
    // What the nodes sense of the mode, and how they drive it.
    Eigen::VectorXcd observed(rows), driven(rows);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      observed.segment(first[i], first[i + 1] - first[i]) = 2.0 * (sense[i] * structure.psi_r.col(k));
      driven.segment(first[i], first[i + 1] - first[i]) =
          samples_[i].drive.transpose() * structure.psi_l.col(k);
      const Complex growth = std::exp(lambda * samples_[i].time_s);
      const auto value = growth * observed.segment(first[i], first[i + 1] - first[i]);
      sensed_of_state_.col(k).segment(first[i], first[i + 1] - first[i]) = value.real();
      sensed_of_state_.col(n + k).segment(first[i], first[i + 1] - first[i]) = -value.imag();
    }
    // Modes of one pole (a round tool's in x and in y) respond alike.
    if (k == 0 || lambda != structure.lambda[k - 1]) {
      responses.clear();
      for (const TimedArc& arc : arcs)
        responses.push_back(mode_response(lambda, arc.length_s, rule, transform));
    }
    for (std::size_t b = 0; b < arcs.size(); ++b) {
      const Eigen::MatrixXcd& response = responses[b];
      const double end_s = arcs[b].start_s + arcs[b].length_s;
      const Complex to_final = std::exp(lambda * (period_s() - end_s));
      const std::size_t arc_first = b * points, arc_last = arc_first + points;
      for (std::size_t j = arc_first; j < arc_last; ++j) {
        const auto at_end = response(points_per_arc, static_cast<Eigen::Index>(j - arc_first));
        // Nodes of this arc respond inside it; those of later arcs see what is left of the state at its end.
        for (std::size_t i = arc_first; i < samples_.size(); ++i) {
          const Complex left = i < arc_last ? response(static_cast<Eigen::Index>(i - arc_first),
                                                       static_cast<Eigen::Index>(j - arc_first))
                                            : at_end * std::exp(lambda * (samples_[i].time_s - end_s));
          for (Eigen::Index column = first[j]; column < first[j + 1]; ++column) {
            for (Eigen::Index row = first[i]; row < first[i + 1]; ++row) {
              sensed_of_drive_(row, column) += (left * observed[row] * driven[column]).real();
            }
          }
        }
        for (Eigen::Index column = first[j]; column < first[j + 1]; ++column) {
          const Complex state = to_final * at_end * driven[column];
          final_state_of_drive_(k, column) = state.real();
          final_state_of_drive_(n + k, column) = state.imag();
        }
      }
    }
  }
}

Eigen::MatrixXd SpectralMap::monodromy(double depth_m) const {
  const Eigen::Index states = final_state_of_state_.rows();
  const Eigen::Index rows = sensed_of_drive_.rows();
  const double scale = structure().displacement_scale_m;

  // u = E q + depth W (u - u_delayed)  =>  u - u_delayed = (I - depth W)^-1 (E q - u_delayed).
  const Eigen::PartialPivLU<Eigen::MatrixXd> implicit(Eigen::MatrixXd::Identity(rows, rows) -
                                                      depth_m * sensed_of_drive_);
  Eigen::MatrixXd difference(rows, states + rows);
  difference.leftCols(states) = sensed_of_state_ / scale;
  difference.rightCols(rows) = -Eigen::MatrixXd::Identity(rows, rows);
  difference = implicit.solve(difference).eval();

  Eigen::MatrixXd map(states + rows, states + rows);
  map.topRows(states).noalias() = (scale * depth_m) * final_state_of_drive_ * difference;
  map.topLeftCorner(states, states) += final_state_of_state_;
  map.bottomRows(rows) = difference;
  map.bottomRightCorner(rows, rows).diagonal().array() += 1;
  return map;
}

}  // namespace stablecut
