#include "milling/collocation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "base/error.h"
#include "base/units.h"
#include "milling/arc_polynomials.h"
#include "milling/cut_schedule.h"
#include "milling/piece_rule.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Lengths of pieces that differ by less than this share of the period are equal.
constexpr double kSameLength = 1e-12;
// Kept off before the number of points is rounded up, so that pieces of one length have equally many.
constexpr double kRoundingShare = 1e-6;
// Points that a short piece has beside its share of the longest one's.
constexpr int kShortPiecePoints = 5;
// Nodes on a piece: so many more than there are polynomials, or than the fastest mode's radians in half of it
// times kNodesPerRadian.
constexpr int kSpareNodes = 4;
constexpr double kNodesPerRadian = 0.6;

// A piece with its place in time, its nodes and their rows.
struct PlacedPiece {
  double start_s, end_s;
  std::size_t rule;  // index
  std::size_t first_node, end_node;
  Eigen::Index first_row, end_row;
};

// A collocation in the making; its public functions are called in their order.
class Builder {
 public:
  Builder(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s)
      : structure_(structure),
        schedule_(schedule),
        angular_speed_(kTwoPi * revolutions_per_s),
        period_s_(schedule.period_rad / angular_speed_) {}

  // Gauss points on every piece, and what the force at them depends on.
  void place_nodes(int points) {
    double longest = 0;
    for (const CutPiece& piece : schedule_.pieces) longest = std::max(longest, length_of(piece));
    for (const CutPiece& piece : schedule_.pieces) {
      const double length_s = length_of(piece) / angular_speed_;
      const std::size_t at = rule_of(length_s, points_of(length_of(piece) / longest, points));
      PlacedPiece placed{piece.from_rad / angular_speed_, 0, at, result_.nodes.size(), 0, row_count(), 0};
      placed.end_s = placed.start_s + length_s;
      const numerics::GaussRule& rule = rules_[at].rule();
      for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
        const double share = (rule.node[i] + 1) / 2;
        const double turn = piece.from_rad + share * length_of(piece);
        result_.nodes.push_back(
            {placed.start_s + share * length_s, rule.weight[i] / 2 * length_s, row_count(), {}});
        add_rows(piece.cutting(turn), false);
        if (piece.damping) add_rows(piece.damping(turn), true);
      }
      placed.end_node = result_.nodes.size();
      add_arc(placed);
      placed.end_row = row_count();
      pieces_.push_back(placed);
    }
  }

  // Which row each displacement is compared with: that of the same node of the piece that cut the surface.
  void link_surfaces() {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const PlacedPiece &piece = pieces_[p], &before = pieces_[schedule_.pieces[p].cut_by];
      if (before.end_node - before.first_node != piece.end_node - piece.first_node)
        throw InvalidArgument("a piece of the cut and the one that cut its surface differ in length");
      for (Eigen::Index r = piece.first_row; r < piece.end_row; ++r) {
        SensedRow& row = result_.rows[r];
        if (row.is_velocity) continue;
        row.cut_by = before.first_row + r - piece.first_row;
        if (schedule_.pieces[p].in_period_before) row.remembered = result_.remembered_count++;
      }
    }
  }

  // What the rows sense of the structure, and where it is at the period's end: exact sums over the modes.
  void add_responses() {
    const Eigen::Index states = 2 * structure_.modes();
    result_.sensed_of_state.resize(row_count(), states);
    result_.sensed_of_drive = Eigen::MatrixXd::Zero(row_count(), row_count());
    result_.final_of_state = structure_.free_flight(period_s_);
    result_.final_of_drive.resize(states, row_count());
    std::vector<Eigen::MatrixXcd> responses;  // [rules]
    for (Eigen::Index k = 0; k < structure_.modes(); ++k) {
      const Complex lambda = structure_.lambda[k];
      // Modes of one pole (those of a round tool in x and in y) respond alike.
      if (k == 0 || lambda != structure_.lambda[k - 1]) {
        responses.clear();
        for (PieceRule& rule : rules_) responses.push_back(rule.responses(lambda));
      }
      set_mode(k);
      add_free_response(k);
      for (const PlacedPiece& source : pieces_) {
        add_forced_response(lambda, source, responses[source.rule]);
        set_final_response(k, source, responses[source.rule]);
      }
    }
    add_velocity_jumps();
  }

  // The rows sense a displacement less the one that their surface keeps. One that was left in this period is
  // a response as well; what was left in the period before is remembered by the state.
  Collocation subtract_left_in_period() {
    result_.difference_of_state = result_.sensed_of_state;
    result_.difference_of_drive = result_.sensed_of_drive;
    for (Eigen::Index r = 0; r < row_count(); ++r) {
      const SensedRow& row = result_.rows[r];
      if (row.cut_by < 0 || row.remembered >= 0) continue;
      result_.difference_of_state.row(r) -= result_.sensed_of_state.row(row.cut_by);
      result_.difference_of_drive.row(r) -= result_.sensed_of_drive.row(row.cut_by);
    }
    return std::move(result_);
  }

 private:
  static double length_of(const CutPiece& piece) { return piece.to_rad - piece.from_rad; }
  Eigen::Index row_count() const { return result_.rows.size(); }

  static int points_of(double share_of_longest, int points) {
    if (share_of_longest > 1 - kSameLength) return points;
    const double share = std::ceil(share_of_longest * points - kRoundingShare);
    return std::min(points, kShortPiecePoints + static_cast<int>(share));
  }

  std::size_t rule_of(double length_s, int points) {
    const auto known = std::find_if(rules_.begin(), rules_.end(), [&](const PieceRule& other) {
      return std::abs(other.length() - length_s) < kSameLength * period_s_ && other.points() == points;
    });
    if (known != rules_.end()) return known - rules_.begin();
    rules_.emplace_back(length_s, points);
    return rules_.size() - 1;
  }

  void add_arc(const PlacedPiece& placed) {
    CollocationArc arc;
    for (std::size_t node = placed.first_node; node < placed.end_node; ++node) {
      arc.nodes.push_back(node);
      arc.place.push_back(
          rules_[placed.rule].rule().node[static_cast<Eigen::Index>(node - placed.first_node)]);
    }
    result_.arcs.push_back(std::move(arc));
  }

  // Rows of the last node.
  void add_rows(DirectionalFactors factors, bool of_velocity) {
    if (factors.sense.rows() > 1) {
      // Each direction for itself: those in which the structure moves.
      factors.drive = factors.drive(Eigen::all, structure_.axes).eval();
      factors.sense = factors.sense(structure_.axes, Eigen::all).eval();
    }
    Eigen::MatrixXd& drive = result_.nodes.back().drive;
    const Eigen::Index before = drive.cols(), count = factors.drive.cols();
    drive.conservativeResize(structure_.directions(), before + count);
    drive.rightCols(count) = factors.drive(structure_.axes, Eigen::all);
    for (Eigen::Index i = 0; i < count; ++i)
      result_.rows.push_back(
          {result_.nodes.size() - 1, factors.sense(i, structure_.axes), of_velocity, -1, -1});
  }

  // How the rows observe the mode, and how their forces drive it.
  void set_mode(Eigen::Index k) {
    observed_.resize(row_count());
    driven_.resize(row_count());
    for (Eigen::Index r = 0; r < row_count(); ++r) {
      const SensedRow& row = result_.rows[r];
      const CollocationNode& node = result_.nodes[row.node];
      observed_[r] = 2.0 * (row.direction * structure_.psi_r.col(k)).value();
      if (row.is_velocity) observed_[r] *= structure_.lambda[k];
      driven_[r] = node.drive.col(r - node.first_row).transpose() * structure_.psi_l.col(k);
    }
  }

  void add_free_response(Eigen::Index k) {
    for (Eigen::Index r = 0; r < row_count(); ++r) {
      const double time_s = result_.nodes[result_.rows[r].node].time_s;
      const Complex value = std::exp(structure_.lambda[k] * time_s) * observed_[r];
      result_.sensed_of_state(r, k) = value.real();
      result_.sensed_of_state(r, structure_.modes() + k) = -value.imag();
    }
  }

  // What all nodes that come after a piece begins sense of the force on it. `response` is that of its rule.
  void add_forced_response(Complex lambda, const PlacedPiece& source, const Eigen::MatrixXcd& response) {
    const Eigen::Index count = response.cols();
    Eigen::RowVectorXcd at_node(count);
    for (std::size_t i = 0; i < result_.nodes.size(); ++i) {
      const CollocationNode& node = result_.nodes[i];
      if (node.time_s <= source.start_s) continue;
      if (i >= source.first_node && i < source.end_node) {
        at_node = response.row(i - source.first_node);
      } else if (node.time_s >= source.end_s) {
        at_node = response.row(count) * std::exp(lambda * (node.time_s - source.end_s));
      } else {
        // A node of another tooth's piece inside this one (unequal pitch).
        at_node = rules_[source.rule].response(lambda, place_in(source, node.time_s));
      }
      for (Eigen::Index row = node.first_row; row < node.end_row(); ++row) {
        for (Eigen::Index column = source.first_row; column < source.end_row; ++column)
          result_.sensed_of_drive(row, column) +=
              (at_node[point_of(column, source)] * observed_[row] * driven_[column]).real();
      }
    }
  }

  void set_final_response(Eigen::Index k, const PlacedPiece& source, const Eigen::MatrixXcd& response) {
    const Complex to_final = std::exp(structure_.lambda[k] * (period_s_ - source.end_s));
    for (Eigen::Index column = source.first_row; column < source.end_row; ++column) {
      const Complex state = to_final * response(response.cols(), point_of(column, source)) * driven_[column];
      result_.final_of_drive(k, column) = state.real();
      result_.final_of_drive(structure_.modes() + k, column) = state.imag();
    }
  }

  // r' = 2 Re sum psi_r (lambda q + psi_l f): the force of all pieces under way changes the velocity at once
  // unless 2 Re sum psi_r psi_l is zero, which it is for a structure with mass and seldom for measured modes.
  void add_velocity_jumps() {
    const Eigen::MatrixXd jump = 2 * (structure_.psi_r * structure_.psi_l.transpose()).real();
    for (std::size_t i = 0; i < result_.nodes.size(); ++i) {
      const CollocationNode& node = result_.nodes[i];
      if (!result_.rows[node.end_row() - 1].is_velocity) continue;
      for (const PlacedPiece& source : pieces_) {
        const bool own = i >= source.first_node && i < source.end_node;
        if (!own && (node.time_s <= source.start_s || node.time_s >= source.end_s)) continue;
        const Eigen::RowVectorXd force = rules_[source.rule].force(place_in(source, node.time_s));
        for (Eigen::Index column = source.first_row; column < source.end_row; ++column) {
          const CollocationNode& from = result_.nodes[result_.rows[column].node];
          const Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1> speed =
              force[point_of(column, source)] * jump * from.drive.col(column - from.first_row);
          for (Eigen::Index row = node.first_row; row < node.end_row(); ++row) {
            if (result_.rows[row].is_velocity)
              result_.sensed_of_drive(row, column) += result_.rows[row].direction * speed;
          }
        }
      }
    }
  }

  // In [-1, 1] from the piece's beginning to its end.
  static double place_in(const PlacedPiece& piece, double time_s) {
    return 2 * (time_s - piece.start_s) / (piece.end_s - piece.start_s) - 1;
  }

  Eigen::Index point_of(Eigen::Index row, const PlacedPiece& piece) const {
    return static_cast<Eigen::Index>(result_.rows[row].node - piece.first_node);
  }

  const TipStructure& structure_;
  const CutSchedule& schedule_;
  double angular_speed_, period_s_;
  std::vector<PieceRule> rules_;
  std::vector<PlacedPiece> pieces_;
  Eigen::VectorXcd observed_, driven_;  // [rows], of one mode
  Collocation result_;
};

}  // namespace

double half_turn_of(double rad_per_s, const CutSchedule& schedule, double revolutions_per_s) {
  double longest = 0;
  for (const CutPiece& piece : schedule.pieces) longest = std::max(longest, piece.to_rad - piece.from_rad);
  return rad_per_s * longest / (2 * kTwoPi * revolutions_per_s);
}

Collocation collocate(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
                      int points, Rows rows) {
  bool along = rows == Rows::kByPolynomial && schedule.passes == 1;
  for (std::size_t p = 0; p < schedule.pieces.size(); ++p)
    along = along && schedule.pieces[p].cut_by == p && schedule.pieces[p].in_period_before;
  int nodes = points;
  if (along) {
    const double fastest = structure.lambda.imag().cwiseAbs().maxCoeff();
    const double follow = kNodesPerRadian * half_turn_of(fastest, schedule, revolutions_per_s);
    nodes = std::max(points, static_cast<int>(follow)) + kSpareNodes;
  }
  Builder builder(structure, schedule, revolutions_per_s);
  builder.place_nodes(nodes);
  builder.link_surfaces();
  builder.add_responses();
  Collocation by_node = builder.subtract_left_in_period();
  return along ? along_arcs(by_node, points) : by_node;
}

}  // namespace stablecut::milling
