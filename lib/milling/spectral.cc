#include "milling/spectral.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "numerics/exponential_moments.h"
#include "numerics/legendre.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Gauss points of a piece, alike for pieces of the same length.
struct Shape {
  double length_s;
  numerics::GaussRule rule;
  Eigen::MatrixXd transform;

  Shape(double length, int points)
      : length_s(length),
        rule(numerics::gauss_legendre(points)),
        transform(numerics::legendre_transform(rule)) {}
  // [points]: a mode's value at a place in [-1, 1] of the piece, per force value at the nodes.
  Eigen::RowVectorXcd response(Complex lambda, double place) const {
    const Eigen::VectorXcd moments =
        numerics::exponential_moments(lambda * (length_s / 2), place, rule.node.size());
    return (length_s / 2) * (moments.transpose() * transform);
  }
  // [points + 1 x points]: at the nodes and at the end.
  Eigen::MatrixXcd responses(Complex lambda) const {
    const Eigen::Index n = rule.node.size();
    Eigen::MatrixXcd moments(n + 1, n);
    for (Eigen::Index i = 0; i < n; ++i)
      moments.row(i) = numerics::exponential_moments(lambda * (length_s / 2), rule.node[i], n).transpose();
    moments.row(n) = numerics::exponential_moments(lambda * (length_s / 2), 1.0, n).transpose();
    return (length_s / 2) * moments * transform;
  }
};

// A piece with its place in time and its nodes.
struct TimedPiece {
  double start_s, end_s;
  std::size_t shape;
  std::size_t first_node, last_node;
};

constexpr double kSameLength = 1e-12;  // of the period
constexpr double kSameShare = 1e-6;    // pieces of one length have as many points, whatever the rounding
constexpr int kLeastPoints = 5;        // of a piece shorter than the longest

}  // namespace

Collocation collocate(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
                      int points) {
  const double angular_speed = kTwoPi * revolutions_per_s;
  const double period_s = schedule.period_rad / angular_speed;
  const Eigen::Index n = structure.modes();
  double longest = 0;
  for (const CutPiece& piece : schedule.pieces) longest = std::max(longest, piece.to_rad - piece.from_rad);

  Collocation result;
  std::vector<Shape> shapes;
  std::vector<TimedPiece> pieces;
  Eigen::MatrixXd sense(0, structure.directions());  // of each row
  std::vector<std::size_t> node_of_row;
  std::vector<bool> velocity;
  const auto add_rows = [&](DirectionalFactors factors, bool of_velocity, Collocation::Node& node) {
    if (structure.directions() == 1 && factors.sense.rows() > 1) {
      // One direction senses one displacement.
      factors.drive = factors.drive.col(structure.axes[0]).eval();
      factors.sense = factors.sense.row(structure.axes[0]).eval();
    }
    const Eigen::Index before = node.drive.cols(), count = factors.drive.cols();
    node.drive.conservativeResize(structure.directions(), before + count);
    node.drive.rightCols(count) = factors.drive(structure.axes, Eigen::all);
    sense.conservativeResize(sense.rows() + count, Eigen::NoChange);
    sense.bottomRows(count) = factors.sense(Eigen::all, structure.axes);
    node_of_row.insert(node_of_row.end(), count, result.nodes.size());
    velocity.insert(velocity.end(), count, of_velocity);
  };
  for (const CutPiece& piece : schedule.pieces) {
    const double share_of_longest = (piece.to_rad - piece.from_rad) / longest;
    const int own =
        share_of_longest > 1 - kSameLength
            ? points
            : std::min(points,
                       kLeastPoints + static_cast<int>(std::ceil(share_of_longest * points - kSameShare)));
    const double length_s = (piece.to_rad - piece.from_rad) / angular_speed;
    auto shape = std::find_if(shapes.begin(), shapes.end(), [&](const Shape& other) {
      return std::abs(other.length_s - length_s) < kSameLength * period_s && other.rule.node.size() == own;
    });
    if (shape == shapes.end()) shape = shapes.emplace(shapes.end(), length_s, own);
    const double start_s = piece.from_rad / angular_speed;
    const std::size_t first_node = result.nodes.size();
    for (Eigen::Index i = 0; i < own; ++i) {
      const double share = (shape->rule.node[i] + 1) / 2;
      const double turn = piece.from_rad + share * (piece.to_rad - piece.from_rad);
      Collocation::Node node{
          start_s + share * length_s, shape->rule.weight[i] / 2 * length_s, sense.rows(), {}};
      add_rows(piece.cutting(turn), false, node);
      if (piece.damping) add_rows(piece.damping(turn), true, node);
      result.nodes.push_back(std::move(node));
    }
    pieces.push_back({start_s, start_s + length_s, static_cast<std::size_t>(shape - shapes.begin()),
                      first_node, result.nodes.size()});
  }

  // What each row is compared with: the same node of the piece that left the surface.
  const Eigen::Index rows = sense.rows();
  result.left_by.assign(rows, -1);
  result.stored = result.left_by;
  for (std::size_t b = 0; b < pieces.size(); ++b) {
    const TimedPiece& left_by = pieces[schedule.pieces[b].left_by];
    if (left_by.last_node - left_by.first_node != pieces[b].last_node - pieces[b].first_node)
      throw InvalidArgument("a piece of the cut and the one that left its surface differ in length");
    const Eigen::Index own = result.nodes[pieces[b].first_node].first_row;
    const Eigen::Index other = result.nodes[left_by.first_node].first_row;
    const Eigen::Index end =
        pieces[b].last_node < result.nodes.size() ? result.nodes[pieces[b].last_node].first_row : rows;
    for (Eigen::Index row = own; row < end; ++row) {
      const std::size_t at = row;
      if (velocity[at]) continue;
      result.left_by[at] = other + row - own;
      if (schedule.pieces[b].left_before) result.stored[at] = result.stored_count++;
    }
  }

  Eigen::MatrixXd sensed_of_state(rows, 2 * n);
  Eigen::MatrixXd sensed_of_drive = Eigen::MatrixXd::Zero(rows, rows);
  result.final_of_drive.resize(2 * n, rows);
  result.final_of_state = structure.free_flight(period_s);

  std::vector<Eigen::MatrixXcd> responses;  // of the mode, [shapes]
  Eigen::VectorXcd observed(rows), driven(rows);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Complex lambda = structure.lambda[k];
    // What the rows sense of the mode, and how they drive it.
    observed = 2.0 * (sense * structure.psi_r.col(k));
    for (Eigen::Index row = 0; row < rows; ++row) {
      const std::size_t at = row;
      const Collocation::Node& node = result.nodes[node_of_row[at]];
      driven[row] = node.drive.col(row - node.first_row).transpose() * structure.psi_l.col(k);
      if (velocity[at]) observed[row] *= lambda;
      const Complex value = std::exp(lambda * node.time_s) * observed[row];
      sensed_of_state(row, k) = value.real();
      sensed_of_state(row, n + k) = -value.imag();
    }
    // Modes of one pole (a round tool's in x and in y) respond alike.
    if (k == 0 || lambda != structure.lambda[k - 1]) {
      responses.clear();
      for (const Shape& shape : shapes) responses.push_back(shape.responses(lambda));
    }
    for (const TimedPiece& source : pieces) {
      const Shape& shape = shapes[source.shape];
      const Eigen::MatrixXcd& response = responses[source.shape];
      const Eigen::Index count = shape.rule.node.size();
      const Eigen::Index first = result.nodes[source.first_node].first_row;
      const Eigen::Index last =
          source.last_node < result.nodes.size() ? result.nodes[source.last_node].first_row : rows;
      Eigen::RowVectorXcd at_node(count);
      for (std::size_t i = 0; i < result.nodes.size(); ++i) {
        const Collocation::Node& node = result.nodes[i];
        if (node.time_s <= source.start_s) continue;
        if (i >= source.first_node && i < source.last_node) {
          at_node = response.row(i - source.first_node);
        } else if (node.time_s >= source.end_s) {
          at_node = response.row(count) * std::exp(lambda * (node.time_s - source.end_s));
        } else {
          at_node = shape.response(lambda,
                                   2 * (node.time_s - source.start_s) / (source.end_s - source.start_s) - 1);
        }
        for (Eigen::Index row = node.first_row; row < node.first_row + node.drive.cols(); ++row) {
          for (Eigen::Index column = first; column < last; ++column) {
            const auto from = static_cast<Eigen::Index>(node_of_row[column] - source.first_node);
            sensed_of_drive(row, column) += (at_node[from] * observed[row] * driven[column]).real();
          }
        }
      }
      const Complex to_final = std::exp(lambda * (period_s - source.end_s));
      for (Eigen::Index column = first; column < last; ++column) {
        const auto from = static_cast<Eigen::Index>(node_of_row[column] - source.first_node);
        const Complex state = to_final * response(count, from) * driven[column];
        result.final_of_drive(k, column) = state.real();
        result.final_of_drive(n + k, column) = state.imag();
      }
    }
    // A force changes the velocity at once where the modes do not sum to rest.
    for (Eigen::Index row = 0; row < rows; ++row) {
      if (!velocity[row]) continue;
      const Collocation::Node& node = result.nodes[node_of_row[row]];
      for (Eigen::Index column = node.first_row; column < node.first_row + node.drive.cols(); ++column)
        sensed_of_drive(row, column) += (observed[row] / lambda * driven[column]).real();
    }
  }

  // Less what was left in this period.
  result.difference_of_state = sensed_of_state;
  result.difference_of_drive = sensed_of_drive;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::Index left_by = result.left_by[row];
    if (left_by < 0 || result.stored[row] >= 0) continue;
    result.difference_of_state.row(row) -= sensed_of_state.row(left_by);
    result.difference_of_drive.row(row) -= sensed_of_drive.row(left_by);
  }
  return result;
}

namespace {

// What each row senses, less what was left, of the state: [rows x state].
Eigen::MatrixXd differences(const Collocation& c, double depth_m, double scale) {
  const Eigen::Index states = c.final_of_state.rows(), rows = c.difference_of_drive.rows();
  // d = E q + depth W d - u_before  =>  d = (I - depth W)^-1 (E q - u_before).
  const Eigen::PartialPivLU<Eigen::MatrixXd> implicit(Eigen::MatrixXd::Identity(rows, rows) -
                                                      depth_m * c.difference_of_drive);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, states + c.stored_count);
  result.leftCols(states) = c.difference_of_state / scale;
  for (Eigen::Index row = 0; row < rows; ++row) {
    if (const Eigen::Index stored = c.stored[row]; stored >= 0) result(row, states + stored) = -1;
  }
  return implicit.solve(result);
}

Eigen::MatrixXd monodromy_of(const Collocation& c, double depth_m, double scale) {
  const Eigen::MatrixXd difference = differences(c, depth_m, scale);
  const Eigen::Index states = c.final_of_state.rows(), size = states + c.stored_count;
  Eigen::MatrixXd map(size, size);
  map.topRows(states).noalias() = (scale * depth_m) * c.final_of_drive * difference;
  map.topLeftCorner(states, states) += c.final_of_state;
  for (std::size_t at = 0; at < c.stored.size(); ++at) {
    if (c.stored[at] < 0) continue;
    // What the row before senses in this period: its difference, on what was left to it.
    auto target = map.row(states + c.stored[at]);
    Eigen::Index row = c.left_by[at];
    target = difference.row(row);
    while (c.stored[row] < 0) {
      row = c.left_by[row];
      target += difference.row(row);
    }
    target[states + c.stored[row]] += 1;
  }
  return map;
}

}  // namespace

SpectralMap::SpectralMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                         int points)
    : PeriodMap(structure,
                cutter.equal_pitch() ? cutter.tooth_period_s(revolutions_per_s) : 1 / revolutions_per_s,
                cutter.equal_pitch() ? 1 : cutter.teeth),
      cutter_(cutter),
      revolutions_per_s_(revolutions_per_s),
      points_(points) {
  if (cutter.lag_rad_per_m == 0)
    fixed_ = collocate(structure, cut_schedule(cutter, revolutions_per_s, 0), revolutions_per_s, points);
}

SpectralMap::SpectralMap(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
                         int points)
    : PeriodMap(structure, schedule.period_rad / (kTwoPi * revolutions_per_s), schedule.passes),
      revolutions_per_s_(revolutions_per_s),
      points_(points),
      fixed_(collocate(structure, schedule, revolutions_per_s, points)) {}

Collocation SpectralMap::of_helix(double depth_m) const {
  return collocate(structure(), cut_schedule(cutter_, revolutions_per_s_, depth_m), revolutions_per_s_,
                   points_);
}

Eigen::MatrixXd SpectralMap::monodromy(double depth_m) const {
  const double scale = structure().displacement_scale_m;
  return fixed_ ? monodromy_of(*fixed_, depth_m, scale) : monodromy_of(of_helix(depth_m), depth_m, scale);
}

std::vector<ForceImpulse> SpectralMap::forces(double depth_m, Complex, const Eigen::VectorXcd& state) const {
  const Collocation helical = fixed_ ? Collocation{} : of_helix(depth_m);
  const Collocation& c = fixed_ ? *fixed_ : helical;
  const Eigen::VectorXcd sensed = differences(c, depth_m, structure().displacement_scale_m) * state;
  std::vector<ForceImpulse> result;
  for (const Collocation::Node& node : c.nodes) {
    result.push_back(
        {node.time_s, node.weight_s * (node.drive * sensed.segment(node.first_row, node.drive.cols()))});
  }
  return result;
}

}  // namespace stablecut::milling
