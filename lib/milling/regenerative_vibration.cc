#include "milling/regenerative_vibration.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "base/units.h"
#include "milling/cut_schedule.h"
#include "milling/piece_rule.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Points of a piece beside its share of the cut: short pieces have these.
constexpr int kSparePoints = 4;
// Ends of pieces closer than this are one, rad.
constexpr double kSamePlace = 1e-9;

// A part of a tooth's way on which the force is a polynomial, and its columns.
struct Piece {
  double from_rad, to_rad;  // turn
  Eigen::Index first_point, points;
};

// A number of the tip's motion: direction * r, or direction * r', at an instant, less what it was at another.
struct Row {
  Eigen::RowVector3d direction;
  std::size_t now;
  bool is_velocity;
  bool is_compared;
  std::size_t before;
};

// A force: so much of a direction per sensed number, at a point.
struct Column {
  Eigen::Vector3d drive;
  Eigen::Index point;
};

// The linear response of rows to columns, periodic; its public functions are called in their order.
class Response {
 public:
  Response(double period_rad, double omega) : period_rad_(period_rad), omega_(omega) {}

  std::size_t instant(double turn_rad) {
    instants_.push_back(turn_rad);
    return instants_.size() - 1;
  }

  // Points on a part of a tooth's way, and what the force there depends on. Each column belongs to the row of
  // its number. The motion has kinks where any tooth enters or leaves, and so has the surface one delay
  // later: pieces end there.
  void add_part(const CutPiece& part, const Bite& bite, double points_per_rad,
                const std::vector<double>& kinks_rad) {
    const double start = part.from_rad + bite.behind_rad, end = part.to_rad + bite.behind_rad;
    std::vector<double> ends = {start, end};
    for (const double kink : kinks_rad) {
      for (const double place : {kink, kink + bite.delay_rad}) {
        for (double copy = -last_passed(start, period_rad_, place); place + copy * period_rad_ < end; ++copy)
          ends.push_back(place + copy * period_rad_);
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < kSamePlace; }),
               ends.end());
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
      const double from = ends[e], length = ends[e + 1] - from;
      const Piece piece{from, ends[e + 1], point_count_,
                        kSparePoints + static_cast<int>(std::ceil(points_per_rad * length))};
      rules_.emplace_back(length, static_cast<int>(piece.points));
      point_count_ += piece.points;
      for (Eigen::Index i = 0; i < piece.points; ++i) {
        const double along = (rules_.back().rule().node[i] + 1) / 2 * length;
        const std::size_t now = instant(from + along), before = instant(from + along - bite.delay_rad);
        const auto add = [&](const DirectionalFactors& factors, bool is_velocity) {
          for (Eigen::Index r = 0; r < factors.drive.cols(); ++r) {
            columns.push_back({factors.drive.col(r), piece.first_point + i});
            rows.push_back({factors.sense.row(r), now, is_velocity, !is_velocity, before});
          }
        };
        const double phi = from + along - bite.behind_rad;
        add(part.cutting(phi), false);
        if (part.damping) add(part.damping(phi), true);
      }
      pieces_.push_back(piece);
    }
  }

  double turn_of(std::size_t instant) const { return instants_[instant]; }

  // [rows x columns].
  Eigen::MatrixXd matrix(const ModesInCut& modes) {
    find_pieces();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows.size(), columns.size());
    Eigen::MatrixXcd states;  // [instants x points]
    for (Eigen::Index k = 0; k < modes.rate.size(); ++k) {
      // Modes of one pole (those of a round tool in x and in y) respond alike.
      if (k == 0 || modes.rate[k] != modes.rate[k - 1]) states = states_of(modes.rate[k]);
      Eigen::VectorXcd driven(columns.size());
      for (std::size_t c = 0; c < columns.size(); ++c)
        driven[c] = (columns[c].drive.transpose() * modes.drive.col(k)).value();
      Eigen::RowVectorXcd motion;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const Complex observed = 2.0 * (row.direction * modes.shape.col(k)).value();
        motion = states.row(row.now);
        if (row.is_velocity) motion = omega_ * (modes.rate[k] * motion + forces_.row(row.now));
        if (row.is_compared) motion -= states.row(row.before);
        for (std::size_t c = 0; c < columns.size(); ++c)
          result(i, c) += (observed * motion[columns[c].point] * driven[c]).real();
      }
    }
    return result;
  }

  std::vector<Row> rows;
  std::vector<Column> columns;

 private:
  // A passage of an instant through a piece.
  struct Inside {
    std::size_t instant, piece;
    Eigen::Index place;  // index among the places of the piece's rule
  };

  // Where each instant lies within pieces, and the force there.
  void find_pieces() {
    forces_ = Eigen::MatrixXd::Zero(instants_.size(), point_count_);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const Piece& piece = pieces_[p];
      std::vector<double> places;
      for (std::size_t i = 0; i < instants_.size(); ++i) {
        const double turn = instants_[i], last = last_passed(piece.from_rad, period_rad_, turn);
        for (double copy = last_passed(piece.to_rad, period_rad_, turn) + 1; copy <= last; ++copy) {
          const double into = turn - copy * period_rad_ - piece.from_rad;
          inside_.push_back({i, p, static_cast<Eigen::Index>(places.size())});
          places.push_back(std::clamp(2 * into / (piece.to_rad - piece.from_rad) - 1, -1.0, 1.0));
          forces_.row(i).segment(piece.first_point, piece.points) += rules_[p].force(places.back());
        }
      }
      places.push_back(1);
      rules_[p].set_places(Eigen::VectorXd::Map(places.data(), places.size()));
    }
  }

  // A mode's coordinate at each instant, per rate of being driven at each point: what pieces under way have
  // given it, and what is left of those that have ended, in this period and in all before.
  Eigen::MatrixXcd states_of(Complex rate) {
    Eigen::MatrixXcd states(instants_.size(), point_count_);
    std::vector<Eigen::MatrixXcd> responses;  // [pieces]
    for (PieceRule& rule : rules_) responses.push_back(rule.responses(rate));
    const Complex repeated = 1.0 / (1.0 - std::exp(rate * period_rad_));
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const Piece& piece = pieces_[p];
      const Eigen::RowVectorXcd at_end = repeated * responses[p].bottomRows(1);
      for (std::size_t i = 0; i < instants_.size(); ++i) {
        const double ended = last_passed(piece.to_rad, period_rad_, instants_[i]);
        states.row(i).segment(piece.first_point, piece.points) =
            std::exp(rate * (instants_[i] - piece.to_rad - ended * period_rad_)) * at_end;
      }
    }
    for (const Inside& in : inside_)
      states.row(in.instant).segment(pieces_[in.piece].first_point, pieces_[in.piece].points) +=
          responses[in.piece].row(in.place);
    return states;
  }

  double period_rad_, omega_;
  std::vector<double> instants_;
  std::vector<PieceRule> rules_;  // [pieces]
  std::vector<Piece> pieces_;
  Eigen::Index point_count_ = 0;
  std::vector<Inside> inside_;
  Eigen::MatrixXd forces_;  // [instants x points]
};

}  // namespace

RegenerativeVibration::RegenerativeVibration(const TipStructure& structure, const Cutter& cutter,
                                             const CuttingLoad& load, const ForcedVibration& forced,
                                             double revolutions_per_s, double depth_m, double points_per_rad,
                                             const std::vector<double>& turns_rad) {
  const double omega = kTwoPi * revolutions_per_s;
  Response response(forced.period_rad(), omega);
  const std::vector<Bite> all_bites = bites(cutter, load);
  std::vector<double> kinks;  // of straight teeth: an edge that lags enters and leaves by and by
  for (const Bite& bite : all_bites) {
    if (cutter.lag_rad_per_m == 0)
      kinks.insert(kinks.end(), {bite.behind_rad + bite.entry_rad, bite.behind_rad + bite.exit_rad});
  }
  for (const Bite& bite : all_bites) {
    // A tooth that is in cut there only, in the cut's own frame.
    Cutter biting = cutter;
    biting.feed_angle_rad = 0;
    biting.entry_rad = bite.entry_rad;
    biting.exit_rad = bite.exit_rad;
    for (const CutPiece& part : way_of_tooth(biting, revolutions_per_s, depth_m))
      response.add_part(part, bite, points_per_rad, kinks);
  }
  const auto sensed = static_cast<Eigen::Index>(response.rows.size());
  for (const double turn : turns_rad) {
    const std::size_t now = response.instant(turn);
    for (const int axis : {0, 1, 2})
      response.rows.push_back({Eigen::RowVector3d::Unit(axis), now, false, false, 0});
  }
  const Eigen::MatrixXd all = response.matrix(modes_in_cut(structure, cutter, revolutions_per_s));
  sensed_ = all.topRows(sensed);
  moved_ = all.bottomRows(all.rows() - sensed);

  // The motion per depth may depend on the depth.
  const double depth = cutter.changes_with_depth() ? depth_m : 1;
  Eigen::VectorXd of_forced(all.rows());
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    const Row& row = response.rows[i];
    const double turn = response.turn_of(row.now);
    Eigen::Vector3d motion =
        row.is_velocity ? omega * forced.slope(depth, turn) : forced.displacement(depth, turn);
    if (row.is_compared) motion -= forced.displacement(depth, response.turn_of(row.before));
    of_forced[i] = row.direction.dot(motion) / depth;
  }
  sensed_forced_ = of_forced.head(sensed);
  moved_forced_ = of_forced.tail(all.rows() - sensed);
}

Eigen::Matrix3Xd RegenerativeVibration::displacements(double depth_m) const {
  const Eigen::MatrixXd equation =
      Eigen::MatrixXd::Identity(sensed_.rows(), sensed_.cols()) - depth_m * sensed_;
  const Eigen::VectorXd d = equation.partialPivLu().solve(depth_m * sensed_forced_);
  const Eigen::VectorXd moved = depth_m * (moved_forced_ + moved_ * d);
  return Eigen::Matrix3Xd::Map(moved.data(), 3, moved.size() / 3);
}

}  // namespace stablecut::milling
