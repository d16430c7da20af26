#include "milling/tooth_arcs.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <utility>

#include "base/units.h"
#include "milling/cut_schedule.h"
#include "numerics/exponential_moments.h"
#include "numerics/legendre.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;
using numerics::GaussRule;

// Polynomials of the force beside those of what it depends on: the directional factors times these.
constexpr int kForcePolynomials = 8;
// Gauss points of a whole arc beside the force's polynomials, or so many for each radian that the fastest
// mode turns in half of it; and of a part of an arc beside its share of these.
constexpr int kSparePoints = 2, kPointsOfPart = 4;
constexpr double kPointsPerRadianOfArc = 0.6;
// Offsets that differ by less than this share of the period are one.
constexpr double kSameOffset = 1e-12;

// Places along an arc at which it senses motions.
struct Sensor {
  Eigen::VectorXd place;
  Eigen::MatrixXd weighted;            // [polynomials x places] times the quadrature's weights
  std::vector<Eigen::MatrixXd> sense;  // [kinds][places x directions]
};

// Where an arc senses the force of one that began `offset_s` before it, both of one length: while that force
// acts (`during`), and after it has ended.
struct Overlap {
  double offset_s;
  Sensor during, after;
  Eigen::Index first;        // of the places of `during` among those of all overlaps
  Eigen::MatrixXd response;  // [rows of an arc x rows of an arc]
};

class Builder {
 public:
  Builder(const TipStructure& structure, const CutSchedule& arcs, double revolutions_per_s, int polynomials)
      : structure_(structure),
        arcs_(arcs),
        angular_speed_(kTwoPi * revolutions_per_s),
        period_s_(arcs.period_rad / angular_speed_),
        length_s_((arcs.pieces[0].to_rad - arcs.pieces[0].from_rad) / angular_speed_),
        count_(polynomials),
        forces_(polynomials + kForcePolynomials),
        kinds_(arcs.pieces[0].damping ? 2 : 1),
        rows_(kinds_ * polynomials) {
    const double radians = structure.lambda.imag().cwiseAbs().maxCoeff() * length_s_ / 2;
    points_ = std::max(forces_, static_cast<Eigen::Index>(kPointsPerRadianOfArc * radians)) + kSparePoints;
    rule_ = numerics::gauss_legendre(points_);
    whole_ = sensor(rule_);
    const auto periods = static_cast<int>(std::ceil(length_s_ / period_s_ - kSameOffset));
    first_tail_ = 1 + periods;
  }

  PeriodForce operator()() {
    set_drives();
    find_overlaps();
    set_responses();
    assemble();
    add_nodes();
    return std::move(result_);
  }

 private:
  std::size_t teeth() const { return arcs_.pieces.size(); }
  double start_s(std::size_t tooth) const { return arcs_.pieces[tooth].from_rad / angular_speed_; }

  // The factors of each kind at a place along any arc.
  DirectionalFactors factors(double place, Eigen::Index kind) const {
    const CutPiece& arc = arcs_.pieces[0];
    const double turn = arc.from_rad + (place + 1) / 2 * (arc.to_rad - arc.from_rad);
    return kind == 0 ? arc.cutting(turn) : arc.damping(turn);
  }
  Eigen::VectorXd drive(double place, Eigen::Index kind) const {
    return factors(place, kind).drive(structure_.axes, 0);
  }
  // Rows of velocities are multiplied by a time, so that they have the size of displacements.
  double unit_of(Eigen::Index kind) const { return kind == 0 ? 1 : length_s_ / 2; }
  Sensor sensor(const GaussRule& rule) const {
    const Eigen::Index places = rule.node.size();
    Sensor result{rule.node, Eigen::MatrixXd(count_, places),
                  std::vector<Eigen::MatrixXd>(kinds_, Eigen::MatrixXd(places, structure_.directions()))};
    for (Eigen::Index i = 0; i < places; ++i) {
      result.weighted.col(i) = rule.weight[i] * numerics::orthonormal_legendre(rule.node[i], count_);
      for (Eigen::Index kind = 0; kind < kinds_; ++kind)
        result.sense[kind].row(i) = factors(rule.node[i], kind).sense(0, structure_.axes);
    }
    return result;
  }
  // [places x modes]: how each mode is observed.
  Eigen::MatrixXcd observed(const Sensor& at, Eigen::Index kind) const {
    const Eigen::MatrixXcd displacement = 2 * at.sense[kind] * structure_.psi_r;
    return kind == 0 ? displacement : unit_of(kind) * displacement * structure_.lambda.asDiagonal();
  }
  // [rows x modes]: what the rows of an arc sense of modes that are left to themselves, of size 1 where the
  // place is minus `beyond`.
  Eigen::MatrixXcd sensed_free(const Sensor& at, double beyond) const {
    Eigen::MatrixXcd result(rows_, structure_.modes());
    const Eigen::VectorXd time_s = length_s_ / 2 * (at.place.array() + beyond);
    const Eigen::MatrixXcd size = (time_s * structure_.lambda.transpose()).array().exp();
    for (Eigen::Index kind = 0; kind < kinds_; ++kind)
      result.middleRows(kind * count_, count_) = at.weighted * observed(at, kind).cwiseProduct(size);
    return result;
  }

  // Legendre coefficients of the force in each direction, of each row: [directions][forces x rows].
  void set_drives() {
    drives_.assign(structure_.directions(), Eigen::MatrixXd::Zero(forces_, rows_));
    for (Eigen::Index i = 0; i < points_; ++i) {
      const double place = rule_.node[i];
      Eigen::VectorXd to = rule_.weight[i] * numerics::legendre_values(place, forces_);
      for (Eigen::Index m = 0; m < forces_; ++m) to[m] *= static_cast<double>(m) + 0.5;
      const Eigen::VectorXd basis = numerics::orthonormal_legendre(place, count_);
      for (Eigen::Index kind = 0; kind < kinds_; ++kind) {
        const Eigen::VectorXd factor = drive(place, kind) / unit_of(kind);
        for (Eigen::Index b = 0; b < structure_.directions(); ++b)
          drives_[b].middleCols(kind * count_, count_) += (factor[b] * to) * basis.transpose();
      }
    }
  }

  // A part of an arc.
  Sensor part(double from, double to) const {
    if (to - from <= 0) return sensor({});
    const double share = std::sqrt((to - from) / 2) * static_cast<double>(points_);
    GaussRule rule =
        numerics::gauss_legendre(std::min(points_, static_cast<Eigen::Index>(share) + kPointsOfPart));
    rule.node = (from + to) / 2 + (to - from) / 2 * rule.node.array();
    rule.weight *= (to - from) / 2;
    return sensor(rule);
  }

  // Whole periods from the first with which an arc that began so much earlier is felt.
  int first_felt(double offset_s) const {
    return static_cast<int>(std::floor(-(length_s_ + offset_s) / period_s_ + kSameOffset)) + 1;
  }
  bool ended(double offset_s) const { return offset_s > length_s_ - kSameOffset * period_s_; }

  std::vector<Overlap>::const_iterator overlap(double offset_s) const {
    return std::find_if(overlaps_.begin(), overlaps_.end(), [&](const Overlap& other) {
      return std::abs(other.offset_s - offset_s) < kSameOffset * period_s_;
    });
  }

  void find_overlaps() {
    for (std::size_t to = 0; to < teeth(); ++to) {
      for (std::size_t from = 0; from < teeth(); ++from) {
        const double apart = start_s(to) - start_s(from);
        for (int n = first_felt(apart); n < first_tail_; ++n) {
          const double offset = apart + n * period_s_;
          if (ended(offset) || overlap(offset) != overlaps_.end()) continue;
          const double shift = 2 * offset / length_s_;
          overlaps_.push_back({offset,
                               part(std::max(-1.0, -1 - shift), std::min(1.0, 1 - shift)),
                               part(1 - shift, 1),
                               places_,
                               {}});
          places_ += overlaps_.back().during.place.size();
        }
      }
    }
  }

  // What is felt at all places of overlaps, of the force's polynomials in each direction: [kinds x
  // directions][places x forces].
  std::vector<Eigen::MatrixXd> felt_during() {
    Eigen::VectorXd along(places_ + 1);  // the forcing arc; at last its end
    std::vector<Eigen::MatrixXcd> observed_at(kinds_, Eigen::MatrixXcd(places_, structure_.modes()));
    for (const Overlap& o : overlaps_) {
      along.segment(o.first, o.during.place.size()) = o.during.place.array() + 2 * o.offset_s / length_s_;
      for (Eigen::Index kind = 0; kind < kinds_; ++kind)
        observed_at[kind].middleRows(o.first, o.during.place.size()) = observed(o.during, kind);
    }
    along[places_] = 1;
    std::vector<numerics::ExponentialMoments> rules;
    Eigen::Index most = 0;
    for (const Complex& lambda : structure_.lambda) {
      rules.emplace_back(lambda * (length_s_ / 2), forces_);
      most = std::max(most, rules.back().legendre_count());
    }
    Eigen::MatrixXd legendre(places_ + 1, most);
    for (Eigen::Index i = 0; i <= places_; ++i)
      legendre.row(i) = numerics::legendre_values(along[i], most).transpose();

    const Eigen::Index directions = structure_.directions();
    std::vector<Eigen::MatrixXd> felt(kinds_ * directions, Eigen::MatrixXd::Zero(places_, forces_));
    ended_drive_.setZero(structure_.modes(), rows_);
    Eigen::MatrixXd re, im;
    for (Eigen::Index k = 0; k < structure_.modes(); ++k) {
      if (k == 0 || structure_.lambda[k] != structure_.lambda[k - 1]) {
        const Eigen::MatrixXcd moments = (length_s_ / 2) * rules[k].at(along, legendre);
        re = moments.real();
        im = moments.imag();
      }
      for (Eigen::Index b = 0; b < directions; ++b) {
        const Complex driven = structure_.psi_l(b, k);
        ended_drive_.row(k) +=
            driven * (re.row(places_) * drives_[b] + Complex(0, 1) * (im.row(places_) * drives_[b]));
        for (Eigen::Index kind = 0; kind < kinds_; ++kind) {
          const Eigen::ArrayXcd factor = driven * observed_at[kind].col(k).array();
          const Eigen::ArrayXd factor_re = factor.real(), factor_im = factor.imag();
          Eigen::MatrixXd& sum = felt[kind * directions + b];
          for (Eigen::Index m = 0; m < forces_; ++m)
            sum.col(m).array() +=
                factor_re * re.col(m).head(places_).array() - factor_im * im.col(m).head(places_).array();
        }
      }
    }
    return felt;
  }

  // What each arc feels of another in every overlap, and of what has ended.
  void set_responses() {
    const std::vector<Eigen::MatrixXd> felt = felt_during();
    ended_sense_ = sensed_free(whole_, 1);
    for (Overlap& o : overlaps_) {
      const Eigen::Index here = o.during.place.size();
      o.response = (sensed_free(o.after, 2 * o.offset_s / length_s_ - 1) * ended_drive_).real();
      for (Eigen::Index kind = 0; kind < kinds_; ++kind) {
        for (Eigen::Index b = 0; b < structure_.directions(); ++b)
          o.response.middleRows(kind * count_, count_) +=
              (o.during.weighted * felt[kind * structure_.directions() + b].middleRows(o.first, here)) *
              drives_[b];
      }
      if (kinds_ > 1) add_velocity_jumps(o);
    }
  }

  // r' has jumps of 2 Re(Psi_R Psi_L^T) f while a force acts.
  void add_velocity_jumps(Overlap& overlap) const {
    const Eigen::MatrixXd jump = 2 * (structure_.psi_r * structure_.psi_l.transpose()).real();
    const Sensor& at = overlap.during;
    for (Eigen::Index i = 0; i < at.place.size(); ++i) {
      const double along = at.place[i] + 2 * overlap.offset_s / length_s_;  // the forcing arc
      const Eigen::VectorXd basis = numerics::orthonormal_legendre(along, count_);
      for (Eigen::Index kind = 0; kind < kinds_; ++kind)
        overlap.response.block(count_, kind * count_, count_, count_) +=
            (unit_of(1) / unit_of(kind) * at.sense[1].row(i) * jump * drive(along, kind)).value() *
            at.weighted.col(i) * basis.transpose();
    }
  }

  // Adds what an arc feels with a delay to its rows, and less the displacement to those of the next tooth,
  // whose surface it left.
  template <typename Felt>
  void add(std::map<int, Eigen::MatrixXd>& parts, int delay, std::size_t tooth, Eigen::Index column,
           Eigen::Index columns, const Felt& felt) const {
    const auto part = [&](int of) -> Eigen::MatrixXd& {
      Eigen::MatrixXd& matrix = parts[of];
      if (matrix.size() == 0) matrix.setZero(static_cast<Eigen::Index>(teeth()) * rows_, columns);
      return matrix;
    };
    part(delay).block(static_cast<Eigen::Index>(tooth) * rows_, column, rows_, felt.cols()) += felt;
    const std::size_t next = (tooth + 1) % teeth();
    part(delay + (arcs_.pieces[next].in_period_before ? 1 : 0))
        .block(static_cast<Eigen::Index>(next) * rows_, column, count_, felt.cols()) -= felt.topRows(count_);
  }

  void assemble() {
    const Eigen::Index modes = structure_.modes(), size = static_cast<Eigen::Index>(teeth()) * rows_;
    std::map<int, Eigen::MatrixXd> direct, of_state;  // by delay
    CircleOperator& force = result_.whole;
    force.growth = (structure_.lambda * period_s_).array().exp();
    force.state_of.resize(2 * modes, size);
    for (std::size_t to = 0; to < teeth(); ++to) {
      for (std::size_t from = 0; from < teeth(); ++from) {
        const double apart = start_s(to) - start_s(from);
        for (int n = first_felt(apart); n < first_tail_; ++n) {
          const double offset = apart + n * period_s_;
          if (ended(offset)) {
            const Eigen::VectorXcd decay = (structure_.lambda * (offset - length_s_)).array().exp();
            add(direct, n, to, static_cast<Eigen::Index>(from) * rows_, size,
                Eigen::MatrixXd((ended_sense_ * decay.asDiagonal() * ended_drive_).real()));
          } else {
            add(direct, n, to, static_cast<Eigen::Index>(from) * rows_, size, overlap(offset)->response);
          }
        }
      }
      // Of all periods before these: the state at the period's end is that of every arc in it, ended.
      const double since = start_s(to) + (first_tail_ - 1) * period_s_ - length_s_;
      const Eigen::VectorXcd sensed_decay = (structure_.lambda * since).array().exp();
      const Eigen::VectorXcd driven_decay = (structure_.lambda * (period_s_ - start_s(to))).array().exp();
      const Eigen::MatrixXcd sensed = ended_sense_ * sensed_decay.asDiagonal();
      const Eigen::MatrixXcd driven = driven_decay.asDiagonal() * ended_drive_;
      Eigen::MatrixXd felt(rows_, 2 * modes);
      felt << sensed.real(), -sensed.imag();
      add(of_state, first_tail_ - 1, to, 0, 2 * modes, felt);
      force.state_of.middleCols(static_cast<Eigen::Index>(to) * rows_, rows_) << driven.real(), driven.imag();
    }
    for (auto& [delay, matrix] : of_state) {
      if (direct[delay].size() == 0) direct[delay].setZero(size, size);
    }
    for (auto& [delay, matrix] : direct) force.parts.push_back({delay, std::move(matrix), of_state[delay]});
  }

  void add_nodes() {
    const auto numbers = static_cast<Eigen::Index>(teeth()) * points_ * kinds_;
    result_.lift.setZero(numbers, static_cast<Eigen::Index>(teeth()) * rows_);
    for (std::size_t tooth = 0; tooth < teeth(); ++tooth) {
      const auto first = static_cast<Eigen::Index>(tooth) * rows_;
      result_.whole.arc_length.push_back(length_s_);
      for (Eigen::Index kind = 0; kind < kinds_; ++kind)
        for (Eigen::Index degree = 0; degree < count_; ++degree)
          result_.whole.polynomials.push_back({tooth, degree});
      for (Eigen::Index i = 0; i < points_; ++i) {
        const double place = rule_.node[i];
        const auto row = static_cast<Eigen::Index>(result_.nodes.size()) * kinds_;
        CollocationNode node{start_s(tooth) + (place + 1) / 2 * length_s_, rule_.weight[i] / 2 * length_s_,
                             row, Eigen::MatrixXd(structure_.directions(), kinds_)};
        for (Eigen::Index kind = 0; kind < kinds_; ++kind) {
          node.drive.col(kind) = drive(place, kind);
          result_.lift.block(row + kind, first + kind * count_, 1, count_) =
              numerics::orthonormal_legendre(place, count_).transpose() / unit_of(kind);
        }
        result_.nodes.push_back(std::move(node));
      }
    }
  }

  const TipStructure& structure_;
  const CutSchedule& arcs_;
  double angular_speed_, period_s_, length_s_;
  Eigen::Index count_, forces_, kinds_, rows_, points_ = 0;  // rows: of one arc
  int first_tail_ = 0;  // periods from which all arcs have ended that are felt
  GaussRule rule_;      // of a whole arc
  Sensor whole_;
  Eigen::Index places_ = 0;  // of all overlaps while the forces act
  std::vector<Eigen::MatrixXd> drives_;
  std::vector<Overlap> overlaps_;
  // [rows x modes], [modes x rows]: what an arc senses from its beginning of a mode of size 1; the size of a
  // mode at the end of an arc.
  Eigen::MatrixXcd ended_sense_, ended_drive_;
  PeriodForce result_;
};

}  // namespace

PeriodForce tooth_arc_force(const TipStructure& structure, const CutSchedule& arcs, double revolutions_per_s,
                            int polynomials) {
  return Builder(structure, arcs, revolutions_per_s, polynomials)();
}

}  // namespace stablecut::milling
