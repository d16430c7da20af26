#include "modal/pole_shift.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "modal/likelihood.h"
#include "modal/maximum_likelihood.h"
#include "numerics/levenberg_marquardt.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;
using Modes = std::vector<dynamics::Mode>;

constexpr double kMostShift = 0.05;    // logarithm of a factor
constexpr double kParallel = 0.8;      // modal assurance criterion of a doubled mode's vectors
constexpr double kMostUnlike = 2;      // ratio of their damping
constexpr double kShare = 0.8;         // of what a second mode explains, that a shift has to
constexpr double kNumbersOfShift = 4;  // that a shift has to be worth
constexpr double kLeastShift = 0.05;   // of a half width, where no mode is doubled
constexpr Effort kBetween{60, 0.01};

// The curves whose poles are shifted against those of the others.
struct Side {
  Eigen::Index direction;
  bool of_force;

  const Eigen::VectorXcd& own(const dynamics::Mode& mode) const { return of_force ? mode.psi_l : mode.psi_r; }
  Eigen::VectorXcd& own(dynamics::Mode& mode) const { return of_force ? mode.psi_l : mode.psi_r; }
  const Eigen::VectorXcd& common(const dynamics::Mode& mode) const {
    return of_force ? mode.psi_r : mode.psi_l;
  }
  // The mode as the other curves show it, and as these do.
  dynamics::Mode part(dynamics::Mode mode, bool shifted) const {
    const Complex value = own(mode)[direction];
    if (shifted) own(mode).setZero();
    own(mode)[direction] = shifted ? value : 0.0;
    return mode;
  }
};

// Modes of which some have shifted poles in some curves: each of these stands as two, one for each part of
// the curves, whose parameters are functions of the mode's and of its shift.
class ShiftedModes {
 public:
  // `shift_of` [modes]: which shift a mode has, -1 for none.
  ShiftedModes(const FitData& data, const Side& side, const Modes& modes, std::vector<Eigen::Index> shift_of,
               Eigen::Index shifts)
      : side_(side),
        shift_of_(std::move(shift_of)),
        shifts_(shifts),
        dofs_(data.dofs),
        own_(with_pivots(modes), data.dofs, ModeModel::kNonsymmetric),
        doubled_(parts_of(modes), data.dofs, ModeModel::kNonsymmetric),
        likelihood_(data, doubled_, out_of_band(data, parts_of(modes))) {}

  Eigen::VectorXd pack(const Modes& modes, const Eigen::VectorXd& shifts) const {
    Eigen::VectorXd u(own_.size() + shifts_);
    u << own_.pack(modes), shifts;
    return u;
  }

  NormalEquations evaluate(const Eigen::VectorXd& u, bool with_matrix) const {
    Eigen::VectorXd x(doubled_.size());
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(with_matrix ? x.size() : 0, u.size());
    Eigen::Index at = 0;
    for (Eigen::Index k = 0; k < own_.modes(); ++k) at += expand(u, k, at, x, with_matrix ? &slope : nullptr);
    NormalEquations result = likelihood_.evaluate(x, with_matrix);
    if (!with_matrix) return result;
    result.gradient = (slope.transpose() * result.gradient).eval();
    result.matrix = (slope.transpose() * result.matrix * slope).eval();
    return result;
  }

  Eigen::Index modes_parameters() const { return own_.size(); }

 private:
  // Of a shifted response psi_r's pivot is another direction's.
  Modes with_pivots(Modes modes) const {
    for (std::size_t k = 0; k < modes.size() && !side_.of_force; ++k)
      if (shift_of_[k] >= 0) modes[k] = side_.part(modes[k], false);
    return modes;
  }
  Modes parts_of(const Modes& modes) const {
    Modes parts;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      if (shift_of_[k] < 0 || side_.of_force) {
        parts.insert(parts.end(), shift_of_[k] < 0 ? 1 : 2, modes[k]);
      } else {
        parts.push_back(side_.part(modes[k], false));
        parts.push_back(side_.part(modes[k], true));
      }
    }
    return parts;
  }

  // The parameters of mode k, or of its two parts, which start at mode `to` of the doubled ones, and their
  // slope. Returns how many modes it stands as.
  Eigen::Index expand(const Eigen::VectorXd& u, Eigen::Index k, Eigen::Index to, Eigen::VectorXd& x,
                      Eigen::MatrixXd* slope) const {
    const Eigen::Index each = own_.per_mode(), from = own_.pole_at(k), first = doubled_.pole_at(to);
    const Eigen::Index parts = shift_of_[k] < 0 ? 1 : 2;
    for (Eigen::Index part = 0; part < parts; ++part) {
      x.segment(first + part * each, each) = u.segment(from, each);
      if (slope) slope->block(first + part * each, from, each, each).setIdentity();
    }
    if (parts == 1) return 1;
    const Eigen::Index shift = own_.size() + shift_of_[k];
    x[first + each + 1] += u[shift];
    if (slope) (*slope)(first + each + 1, shift) = 1;
    const auto clear = [&](Eigen::Index at) {
      x.segment<2>(at).setZero();
      if (slope) slope->middleRows<2>(at).setZero();
    };
    if (side_.of_force) {
      for (Eigen::Index i = 0; i < dofs_; ++i)
        clear(doubled_.left_in_x(i == side_.direction ? to : to + 1, i));
      return 2;
    }
    clear(doubled_.right_in_x(to, side_.direction));
    expand_response(u, k, to + 1, x, slope);
    return 2;
  }

  // The part of the shifted response: psi_r is 1 in its direction alone, psi_l is the mode's times its psi_r
  // there.
  void expand_response(const Eigen::VectorXd& u, Eigen::Index k, Eigen::Index to, Eigen::VectorXd& x,
                       Eigen::MatrixXd* slope) const {
    const Eigen::Index vectors = doubled_.vectors_at(to), count = own_.per_mode() - 2;
    const Eigen::Index right = own_.right_in_x(k, side_.direction);
    x.segment(vectors, count).setZero();
    if (slope) slope->middleRows(vectors, count).setZero();
    const auto times = [](Complex f) {
      return (Eigen::Matrix2d() << f.real(), -f.imag(), f.imag(), f.real()).finished();
    };
    const double units = own_.unit(k) / doubled_.unit(to);
    const Complex response(u[right], u[right + 1]);
    for (Eigen::Index i = 0; i < dofs_; ++i) {
      const Eigen::Index left = own_.left_in_x(k, i), at = doubled_.left_in_x(to, i);
      const Complex force(u[left], u[left + 1]);
      x[at] = units * (response * force).real();
      x[at + 1] = units * (response * force).imag();
      if (!slope) continue;
      slope->block<2, 2>(at, left) = times(units * response);
      slope->block<2, 2>(at, right) = times(units * force);
    }
  }

  Side side_;
  std::vector<Eigen::Index> shift_of_;
  Eigen::Index shifts_, dofs_;
  ModeParameters own_, doubled_;
  Likelihood likelihood_;
};

// A pair of modes as one with a shift.
struct Merged {
  dynamics::Mode mode;
  double shift = 0;
};

Merged merged(const Side& side, const dynamics::Mode& a, const dynamics::Mode& b) {
  const Eigen::MatrixXcd residue = a.psi_r * a.psi_l.transpose() + b.psi_r * b.psi_l.transpose();
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(residue, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const double size = std::sqrt(svd.singularValues()[0]);
  Merged result;
  result.mode.psi_r = size * svd.matrixU().col(0);
  result.mode.psi_l = size * svd.matrixV().col(0).conjugate();
  // Each part of the curves has the pole between both that it shows most.
  const auto pole_of = [&](bool shifted) {
    const auto weight = [&](const dynamics::Mode& mode) {
      const dynamics::Mode part = side.part(mode, shifted);
      return part.psi_r.norm() * part.psi_l.norm();
    };
    const double of_a = weight(a), of_b = weight(b);
    return (of_a * a.pole() + of_b * b.pole()) / (of_a + of_b);
  };
  const Complex pole = pole_of(false);
  result.shift = std::log(pole_of(true).imag() / pole.imag());
  dynamics::set_pole(result.mode, pole);
  return result;
}

double assurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  return std::norm(a.dot(b)) / (a.squaredNorm() * b.squaredNorm());
}

struct Refined {
  double chi_square = 0;
  Eigen::VectorXd shifts, deviations;  // logarithms
  Eigen::VectorXd u;
};

class Judgement {
 public:
  Judgement(const GroupFit& fit, const Side& side)
      : fit_(fit), side_(side), inflation_(fit.inflation()), log_values_(std::log(fit.data.values())) {}

  std::optional<PoleShift> shift() {
    merge_pairs();
    if (shifts_.empty() && score() < log_values_) return std::nullopt;
    return shifts_.empty() ? of_single_modes() : of_pairs();
  }
  double gain() const { return gain_; }

 private:
  // In the usual units, in which a number is worth log N.
  double worth(double chi_square) const { return 2 * chi_square / inflation_; }

  bool can_shift(const dynamics::Mode& mode) const {
    return fit_.data.in_band(mode.pole()) && side_.own(mode)[side_.direction] != 0.0 &&
           side_.part(mode, false).psi_r.norm() > 0 && side_.part(mode, false).psi_l.norm() > 0;
  }

  // Pairs that one mode may stand behind, the nearest first; places of both.
  std::vector<std::pair<std::size_t, std::size_t>> pairs() const {
    const Modes& modes = fit_.modes();
    struct Pair {
      double apart;
      std::size_t first, second;
    };
    std::vector<Pair> found;
    for (std::size_t a = 0; a < modes.size(); ++a) {
      for (std::size_t b = a + 1; b < modes.size(); ++b) {
        if (!can_shift(modes[a]) || !can_shift(modes[b])) continue;
        const double apart = std::abs(std::log(modes[a].pole().imag() / modes[b].pole().imag()));
        const double unlike = std::abs(std::log(modes[a].damping_ratio / modes[b].damping_ratio));
        if (apart < kMostShift && unlike < std::log(kMostUnlike) &&
            assurance(side_.common(modes[a]), side_.common(modes[b])) > kParallel)
          found.push_back({apart, a, b});
      }
    }
    std::sort(found.begin(), found.end(), [](const Pair& p, const Pair& q) { return p.apart < q.apart; });
    std::vector<std::pair<std::size_t, std::size_t>> result;
    for (const Pair& pair : found) result.emplace_back(pair.first, pair.second);
    return result;
  }

  // Modes of the fit that are pairs are one each, where a shift explains most of what two do.
  void merge_pairs() {
    modes_ = fit_.modes();
    chi_square_ = fit_.refined.chi_square;
    std::vector<bool> gone(modes_.size()), one(modes_.size());
    for (const auto& [a, b] : pairs()) {
      if (gone[a] || gone[b] || one[a] || one[b]) continue;
      const Merged both = merged(side_, fit_.modes()[a], fit_.modes()[b]);
      Modes trial = fit_.modes();
      trial[a] = both.mode;
      trial.erase(trial.begin() + static_cast<std::ptrdiff_t>(b));
      std::vector<Eigen::Index> shift_of(trial.size(), -1);
      shift_of[a] = 0;
      const Refined with = refined(trial, shift_of, Eigen::VectorXd::Constant(1, both.shift));
      const double without = fit_.refine(trial, kBetween).chi_square;
      const double by_shift = without - with.chi_square, by_mode = without - fit_.refined.chi_square;
      if (by_shift < kShare * by_mode || worth(by_shift) < kNumbersOfShift * log_values_) continue;
      modes_[a] = both.mode;
      one[a] = gone[b] = true;
      shifts_.push_back(with.shifts[0]);
    }
    Modes left;
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      if (gone[k]) continue;
      left.push_back(modes_[k]);
      doubled_.push_back(one[k]);
    }
    modes_ = std::move(left);
  }

  // What chi-square would fall by a shift of all modes, to second order.
  double score() const {
    const ShiftedModes model(fit_.data, side_, modes_, all_of_one(), 1);
    const NormalEquations at = model.evaluate(model.pack(modes_, Eigen::VectorXd::Zero(1)), true);
    const Eigen::Index own = model.modes_parameters();
    NormalEquations modes{0, at.gradient.head(own), at.matrix.topLeftCorner(own, own)};
    const Eigen::VectorXd cross = at.matrix.col(own).head(own);
    const Eigen::VectorXd adapted = inverse_normal_matrix(modes) * cross;
    const double slope = at.gradient[own] - adapted.dot(modes.gradient);
    const double curvature = at.matrix(own, own) - adapted.dot(cross);
    return curvature > 0 ? worth(slope * slope / curvature) : 0;
  }

  std::vector<Eigen::Index> all_of_one() const {
    std::vector<Eigen::Index> shift_of;
    for (const dynamics::Mode& mode : modes_) shift_of.push_back(can_shift(mode) ? 0 : -1);
    return shift_of;
  }

  std::optional<PoleShift> of_single_modes() {
    const Refined all = refined(modes_, all_of_one(), Eigen::VectorXd::Zero(1));
    gain_ = worth(chi_square_ - all.chi_square);
    std::vector<double> damping;
    for (const dynamics::Mode& mode : modes_)
      if (can_shift(mode)) damping.push_back(mode.damping_ratio);
    const double least = *std::min_element(damping.begin(), damping.end());
    if (gain_ < kNumbersOfShift * log_values_ || std::abs(all.shifts[0]) < kLeastShift * least)
      return std::nullopt;
    return told(all, true);
  }

  std::optional<PoleShift> of_pairs() {
    std::vector<Eigen::Index> each(modes_.size(), -1);
    Eigen::Index count = 0;
    for (std::size_t k = 0; k < modes_.size(); ++k)
      if (doubled_[k]) each[k] = count++;
    const Refined own = refined(modes_, each, Eigen::Map<const Eigen::VectorXd>(shifts_.data(), count));
    const double mean = own.shifts.dot(own.deviations.array().square().inverse().matrix()) /
                        own.deviations.array().square().inverse().sum();
    const Refined all = refined(modes_, all_of_one(), Eigen::VectorXd::Constant(1, mean));
    const double saved = static_cast<double>(count) * fit_.parameters_per_mode() * log_values_;
    const double of_all = saved - worth(all.chi_square - chi_square_) - log_values_;
    const double of_each =
        saved - worth(own.chi_square - chi_square_) - static_cast<double>(count) * log_values_;
    gain_ = std::max(of_all, of_each);
    return of_all >= of_each ? told(all, true) : told(own, false);
  }

  PoleShift told(const Refined& fit, bool in_all) const {
    return {.direction = side_.direction,
            .of_force = side_.of_force,
            .least = std::exp(fit.shifts.minCoeff()),
            .most = std::exp(fit.shifts.maxCoeff()),
            .deviation = fit.deviations.maxCoeff(),
            .doubled = shifts_.size(),
            .in_all = in_all};
  }

  Refined refined(const Modes& modes, const std::vector<Eigen::Index>& shift_of,
                  const Eigen::VectorXd& start) const {
    const ShiftedModes model(fit_.data, side_, modes, shift_of, start.size());
    const double unbounded = std::numeric_limits<double>::infinity();
    const Eigen::VectorXd u = model.pack(modes, start.cwiseMax(-kMostShift).cwiseMin(kMostShift));
    Eigen::VectorXd lower = Eigen::VectorXd::Constant(u.size(), -unbounded), upper = -lower;
    lower.tail(start.size()).setConstant(-kMostShift);
    upper.tail(start.size()).setConstant(kMostShift);
    const numerics::LeastSquares least = numerics::levenberg_marquardt(
        [&](const Eigen::VectorXd& x, bool with_matrix) { return model.evaluate(x, with_matrix); }, u, lower,
        upper, {kBetween.iterations, kBetween.tolerance / fit_.complex_values()});
    const Eigen::VectorXd variance = inverse_normal_matrix(least.at).diagonal() * inflation_ / 2;
    return {least.at.sum_of_squares, least.x.tail(start.size()), variance.tail(start.size()).cwiseSqrt(),
            least.x};
  }

  const GroupFit& fit_;
  Side side_;
  double inflation_, log_values_, chi_square_ = 0, gain_ = 0;
  Modes modes_;
  std::vector<bool> doubled_;   // [modes]
  std::vector<double> shifts_;  // of pairs that are one mode
};

}  // namespace

std::optional<PoleShift> pole_shift(const GroupFit& fit) {
  const FitData& data = fit.data;
  if (fit.model != ModeModel::kNonsymmetric || data.poles_fixed || data.dofs < 2 || fit.modes().empty() ||
      static_cast<Eigen::Index>(data.curves.size()) != data.dofs * data.dofs)
    return std::nullopt;
  std::optional<PoleShift> best;
  double most = 0;
  for (const bool of_force : {true, false}) {
    // Of two directions either may be the one that is shifted.
    for (Eigen::Index direction = data.dofs == 2 ? 1 : 0; direction < data.dofs; ++direction) {
      Judgement judgement(fit, {direction, of_force});
      const std::optional<PoleShift> shift = judgement.shift();
      if (!shift || judgement.gain() <= most) continue;
      best = shift;
      most = judgement.gain();
    }
  }
  return best;
}

}  // namespace stablecut::modal
