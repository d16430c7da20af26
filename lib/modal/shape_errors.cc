#include "modal/shape_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "modal/maximum_likelihood.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

// A vibration whose frequency or damping depends on its size A exp(-sigma t) to second order has a part that
// decays like exp(-3 sigma t).
constexpr double kSatelliteDecay = 3;
// A mode that makes less than this share of what is measured at its place, in every curve, may imitate what
// no mode has.
constexpr double kImitation = 0.1;
// Such a mode is one of these where its decay is this many times another's at its place, and both responses
// are so parallel (modal assurance criterion).
constexpr double kLeastDecay = 2, kParallel = 0.95;
// Exponent of the probability that chi-square falls by chance as much as a shape is said to need.
constexpr double kChanceGain = 6;

// Whether a mode may imitate: no curve shows it by more than a small share of what is there.
bool may_imitate(const FitData& data, const std::vector<dynamics::Mode>& modes, const dynamics::Mode& mode) {
  const Complex pole = mode.pole();
  FitData near;
  near.s =
      Complex(0, 1) * Eigen::Vector3cd(pole.imag() + pole.real(), pole.imag(), pole.imag() - pole.real());
  return std::all_of(data.curves.begin(), data.curves.end(), [&](const Curve& curve) {
    const double own = std::abs(mode.psi_r[curve.response] * mode.psi_l[curve.reference] / pole.real());
    return own <= kImitation * curve_of(modes, curve, near.s).norm() / std::sqrt(3);
  });
}

// A weak mode at the place of another, as a resonance's shape that is no mode's leaves it.
bool is_satellite(const FitData& data, const std::vector<dynamics::Mode>& modes, const dynamics::Mode& mode) {
  const Complex own = mode.pole();
  return may_imitate(data, modes, mode) &&
         std::any_of(modes.begin(), modes.end(), [&](const dynamics::Mode& other) {
           const Complex pole = other.pole();
           const double parallel = std::norm(mode.psi_r.dot(other.psi_r)) /
                                   (mode.psi_r.squaredNorm() * other.psi_r.squaredNorm());
           return own.real() < kLeastDecay * pole.real() && std::abs((own - pole).imag()) < -own.real() &&
                  parallel > kParallel;
         });
}

// Mode k with the residue psi_r psi_l^T as well, whose psi_r is parallel to its own: the change, in
// coordinates.
Eigen::VectorXd moved_residue(const ModeParameters& parameters, Eigen::Index k, const dynamics::Mode& mode,
                              const Eigen::VectorXcd& psi_r, const Eigen::VectorXcd& psi_l) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(parameters.modes() * parameters.coordinates_per_mode());
  const Complex along = mode.psi_r.dot(psi_r) / mode.psi_r.squaredNorm();
  for (Eigen::Index j = 0; j < psi_l.size(); ++j) {
    const Eigen::Index at = k * parameters.coordinates_per_mode() + parameters.left_at(j);
    change[at] = (along * psi_l[j]).real();
    change[at + 1] = (along * psi_l[j]).imag();
  }
  return change;
}

// What chi-square falls by chance for so many more parameters with a probability of exp(-kChanceGain) at most
// [Laurent2000]; it counts half of the usual one.
double chance_gain(double parameters) {
  return parameters / 2 + std::sqrt(parameters * kChanceGain) + kChanceGain;
}

// A change of all free parameters, in coordinates.
Eigen::VectorXd to_coordinates(const ModeParameters& parameters, const Eigen::VectorXd& x,
                               const Eigen::VectorXd& change) {
  const Eigen::Index size = parameters.coordinates_per_mode();
  Eigen::VectorXd result(parameters.modes() * size);
  for (Eigen::Index k = 0; k < parameters.modes(); ++k)
    result.segment(k * size, size) =
        parameters.slope(x, k) * change.segment(parameters.pole_at(k), parameters.per_mode());
  return result;
}

// What columns that are missing among the modes' would change of them.
struct Missing {
  double gain = 0;          // of chi-square
  Eigen::VectorXd adapted;  // the modes' parameters
  Eigen::VectorXd change;   // the columns' own, 0 where no curve has a slope
};

// Solution of a positive definite system in units of its diagonal; nothing where it is none.
std::optional<Eigen::VectorXd> solved(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * matrix * scale.asDiagonal());
  if (!scale.allFinite() || factor.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd solution = scale.cwiseProduct(factor.solve(scale.cwiseProduct(right)));
  return solution.allFinite() ? std::optional(std::move(solution)) : std::nullopt;
}

// The columns at these places, of which the first `own` parameters, the modes', know nothing.
std::optional<Missing> missing_columns(const NormalEquations& with, const Eigen::LLT<Eigen::MatrixXd>& base,
                                       Eigen::Index own, const std::vector<Eigen::Index>& columns) {
  // Directions without a curve have neither slope nor change.
  std::vector<Eigen::Index> at;
  std::copy_if(columns.begin(), columns.end(), std::back_inserter(at),
               [&](Eigen::Index p) { return with.matrix(p, p) > 0; });
  const Eigen::MatrixXd cross = with.matrix(Eigen::seqN(0, own), at);
  const Eigen::MatrixXd adapted = base.solve(cross);
  const Eigen::VectorXd slope = with.gradient(at) - adapted.transpose() * with.gradient.head(own);
  const auto change = solved(with.matrix(at, at) - cross.transpose() * adapted, -slope);
  if (!change) return std::nullopt;
  Missing missing{-change->dot(slope), -adapted * *change, Eigen::VectorXd::Zero(columns.size())};
  for (std::size_t c = 0, a = 0; c < columns.size() && a < at.size(); ++c)
    if (columns[c] == at[a])
      missing.change[static_cast<Eigen::Index>(c)] = (*change)[static_cast<Eigen::Index>(a++)];
  return missing;
}

// How the other modes would change without these, to first order; nothing where it cannot be told.
std::optional<Eigen::VectorXd> without_modes(const ModeParameters& parameters, const Eigen::VectorXd& x,
                                             const Eigen::MatrixXd& inverse,
                                             const std::vector<Eigen::Index>& removed) {
  std::vector<Eigen::Index> at;
  std::vector<double> by;
  for (const Eigen::Index s : removed) {
    const Eigen::VectorXd removal = parameters.removal(x, s);
    for (Eigen::Index i = 0; i < removal.size(); ++i) {
      at.push_back(parameters.pole_at(s) + parameters.per_mode() - removal.size() + i);
      by.push_back(removal[i]);
    }
  }
  const auto pulled = solved(inverse(at, at), Eigen::Map<const Eigen::VectorXd>(by.data(), by.size()));
  if (!pulled) return std::nullopt;
  Eigen::VectorXd change = inverse(Eigen::all, at) * *pulled;
  for (const Eigen::Index s : removed) change.segment(parameters.pole_at(s), parameters.per_mode()).setZero();
  return to_coordinates(parameters, x, change);
}

// Modes that may imitate something: without one of them, or all, the others would be elsewhere.
void add_imitations(const FitData& data, const ModeParameters& parameters, const Eigen::VectorXd& x,
                    const NormalEquations& normal, const std::vector<dynamics::Mode>& modes,
                    std::vector<Eigen::VectorXd>& errors) {
  std::vector<Eigen::Index> doubtful;
  for (Eigen::Index s = 0; s < parameters.modes(); ++s)
    if (data.in_band(modes[s].pole()) && may_imitate(data, modes, modes[s])) doubtful.push_back(s);
  if (doubtful.empty()) return;
  const Eigen::MatrixXd inverse = inverse_normal_matrix(normal);
  std::vector<std::vector<Eigen::Index>> removals;
  removals.reserve(doubtful.size() + 1);
  for (const Eigen::Index s : doubtful) removals.push_back({s});
  if (doubtful.size() > 1) removals.push_back(doubtful);
  for (const auto& removed : removals)
    if (auto change = without_modes(parameters, x, inverse, removed)) errors.push_back(std::move(*change));
}

// Curves of a damping force that does not grow with frequency (hysteretic), less those of the modes: the same
// pole, and at its mirror image what has no conjugate.
std::vector<Eigen::VectorXcd> hysteretic_changes(const FitData& data,
                                                 const std::vector<dynamics::Mode>& modes) {
  std::vector<Eigen::VectorXcd> changes;
  for (const Curve& curve : data.curves) {
    Eigen::VectorXcd change = Eigen::VectorXcd::Zero(data.lines());
    for (const dynamics::Mode& mode : modes) {
      if (!data.in_band(mode.pole())) continue;
      const Complex pole = mode.pole(), residue = mode.psi_r[curve.response] * mode.psi_l[curve.reference];
      change.array() -=
          residue / (data.s.array() + pole) + std::conj(residue) / (data.s.array() - std::conj(pole));
    }
    changes.push_back(std::move(change));
  }
  return changes;
}

// What the modes would be if that share of their damping were hysteretic which the curves ask for.
void add_hysteresis(const FitData& data, const ModeParameters& parameters, const Eigen::VectorXd& x,
                    const NormalEquations& normal, const std::vector<dynamics::Mode>& modes,
                    std::vector<Eigen::VectorXd>& errors) {
  // With curves less the change, and less twice of it, chi-square and its gradient tell all products.
  FitData less = data;
  const std::vector<Eigen::VectorXcd> changes = hysteretic_changes(data, modes);
  const auto take_off = [&] {
    for (std::size_t c = 0; c < changes.size(); ++c) less.curves[c].h -= changes[c];
  };
  const std::vector<bool> outside = out_of_band(data, modes);
  take_off();
  const NormalEquations once = Likelihood(less, parameters, outside).evaluate(x, true);
  take_off();
  const double twice = Likelihood(less, parameters, outside).evaluate(x, false).sum_of_squares;
  // Of residuals r = model - h and a change d of the model: J^T W d, d^T W d, r^T W d.
  const Eigen::VectorXd cross = once.gradient - normal.gradient;
  const double square = (twice + normal.sum_of_squares) / 2 - once.sum_of_squares,
               along = (once.sum_of_squares - normal.sum_of_squares - square) / 2;
  const Eigen::VectorXd adapted = inverse_normal_matrix(normal) * cross;
  const double slope = along - adapted.dot(normal.gradient), curvature = square - adapted.dot(cross);
  if (!(curvature > 0) || slope * slope / curvature < chance_gain(1)) return;
  errors.push_back(to_coordinates(parameters, x, adapted * (slope / curvature)));
}

// Satellites that were not worth a mode, but may be there: where one stands out, or all together do, each
// that is likelier than not.
void add_missing(const FitData& data, const ModeParameters& parameters,
                 const std::vector<dynamics::Mode>& modes, std::vector<Eigen::VectorXd>& errors) {
  std::vector<dynamics::Mode> more = modes;
  std::vector<std::size_t> of;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const Complex pole = modes[k].pole();
    if (!data.in_band(pole) || may_imitate(data, modes, modes[k])) continue;
    more.push_back(modes[k]);
    dynamics::set_pole(more.back(), Complex(kSatelliteDecay * pole.real(), pole.imag()));
    more.back().psi_l.setZero();
    of.push_back(k);
  }
  if (of.empty()) return;
  const ModeParameters extended(more, data.dofs, ModeModel::kNonsymmetric);
  const Eigen::VectorXd x = extended.pack(more);
  const NormalEquations with = Likelihood(data, extended, out_of_band(data, more)).evaluate(x, true);
  const Eigen::Index own = parameters.modes() * extended.per_mode(), width = 2 * data.dofs;
  const Eigen::LLT<Eigen::MatrixXd> base(with.matrix.topLeftCorner(own, own));
  if (base.info() != Eigen::Success) return;
  std::vector<std::optional<Missing>> satellites;
  std::vector<Eigen::Index> all;
  bool any = false;
  for (std::size_t i = 0; i < of.size(); ++i) {
    std::vector<Eigen::Index> columns(width);
    std::iota(columns.begin(), columns.end(),
              own + static_cast<Eigen::Index>(i + 1) * extended.per_mode() - width);
    satellites.push_back(missing_columns(with, base, own, columns));
    any =
        any || (satellites.back() && satellites.back()->gain > chance_gain(static_cast<double>(width)) +
                                                                   std::log(static_cast<double>(of.size())));
    all.insert(all.end(), columns.begin(), columns.end());
  }
  if (!any) {
    const auto together = missing_columns(with, base, own, all);
    if (!together || together->gain < chance_gain(static_cast<double>(all.size()))) return;
  }
  const std::vector<dynamics::Mode> unpacked = extended.unpack(x);
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (!satellites[i] || satellites[i]->gain < static_cast<double>(width) / 2) continue;
    errors.push_back(to_coordinates(parameters, x.head(own), satellites[i]->adapted));
    Eigen::VectorXcd left(data.dofs);
    for (Eigen::Index j = 0; j < left.size(); ++j)
      left[j] = {satellites[i]->change[2 * j], satellites[i]->change[2 * j + 1]};
    errors.push_back(moved_residue(parameters, static_cast<Eigen::Index>(of[i]), modes[of[i]],
                                   unpacked[modes.size() + i].psi_r, left));
  }
}

}  // namespace

std::vector<Eigen::VectorXd> shape_errors(const FitData& data, const ModeParameters& parameters,
                                          const Eigen::VectorXd& x, const NormalEquations& normal) {
  const std::vector<dynamics::Mode> modes = parameters.unpack(x);
  std::vector<Eigen::VectorXd> errors;
  add_missing(data, parameters, modes, errors);
  add_hysteresis(data, parameters, x, normal, modes, errors);
  // Weak modes are what they seem, unless some resonance shows that it has no mode's shape.
  if (!errors.empty() || std::any_of(modes.begin(), modes.end(), [&](const dynamics::Mode& mode) {
        return data.in_band(mode.pole()) && is_satellite(data, modes, mode);
      }))
    add_imitations(data, parameters, x, normal, modes, errors);
  return errors;
}

}  // namespace stablecut::modal
