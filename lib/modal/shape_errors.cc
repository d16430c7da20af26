#include "modal/shape_errors.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

// A vibration whose frequency or damping depends on its size A exp(-sigma t) to second order has a part that
// decays like exp(-3 sigma t).
constexpr double kSatelliteDecay = 3;
// Of a mode that is taken for such a part: its decay over the other's, its residue over the other's, and how
// parallel both responses are (modal assurance criterion).
constexpr double kLeastDecay = 2, kMostDecay = 5, kMostResidue = 0.5, kParallel = 0.95;
// What chi-square may fall by chance, beyond its mean: a gain above g has a probability of order exp(-g), for
// each of the modes.
constexpr double kChanceGain = 6;

bool is_satellite(const dynamics::Mode& mode, const dynamics::Mode& of) {
  const Complex own = mode.pole(), pole = of.pole();
  const double decay = own.real() / pole.real();
  if (decay < kLeastDecay || decay > kMostDecay || std::abs(own.imag() - pole.imag()) > -pole.real())
    return false;
  const double residue = mode.psi_r.norm() * mode.psi_l.norm(), other = of.psi_r.norm() * of.psi_l.norm();
  const double parallel = std::abs(mode.psi_r.dot(of.psi_r)) / (mode.psi_r.norm() * of.psi_r.norm());
  return residue < kMostResidue * other && parallel * parallel > kParallel;
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

// What a satellite that is missing among the modes would change of them.
struct Missing {
  Eigen::VectorXd adapted;  // the modes' parameters
  Eigen::VectorXcd left;    // psi_l of the satellite
};

// Solution of a positive definite system in units of its diagonal; nothing where it is none.
std::optional<Eigen::VectorXd> solved(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * matrix * scale.asDiagonal());
  if (!scale.allFinite() || factor.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd solution = scale.cwiseProduct(factor.solve(scale.cwiseProduct(right)));
  return solution.allFinite() ? std::optional(std::move(solution)) : std::nullopt;
}

// The satellite whose psi_l has `width` parameters from `first` on, if chi-square asks for it by more than
// `chance` beyond its mean. The first `own` parameters are the modes'.
std::optional<Missing> missing_satellite(const NormalEquations& with, const Eigen::LLT<Eigen::MatrixXd>& base,
                                         Eigen::Index own, Eigen::Index first, Eigen::Index width,
                                         double chance) {
  // Directions without a curve have neither slope nor change.
  std::vector<Eigen::Index> at;
  for (Eigen::Index p = first; p < first + width; ++p)
    if (with.matrix(p, p) > 0) at.push_back(p);
  const Eigen::MatrixXd cross = with.matrix(Eigen::seqN(0, own), at);
  const Eigen::MatrixXd adapted = base.solve(cross);
  const Eigen::VectorXd slope = with.gradient(at) - adapted.transpose() * with.gradient.head(own);
  const auto change = solved(with.matrix(at, at) - cross.transpose() * adapted, -slope);
  if (!change || -change->dot(slope) < chance + static_cast<double>(at.size()) / 2) return std::nullopt;
  Missing missing{-adapted * *change, Eigen::VectorXcd::Zero(width / 2)};
  for (std::size_t a = 0; a < at.size(); ++a) {
    const Eigen::Index p = at[a] - first;
    const double value = (*change)[static_cast<Eigen::Index>(a)];
    missing.left[p / 2] += p % 2 == 0 ? Complex(value, 0) : Complex(0, value);
  }
  return missing;
}

// Satellites among the modes: without them the others would be elsewhere, and one's residue may be the
// other's.
void add_present(const FitData& data, const ModeParameters& parameters, const Eigen::VectorXd& x,
                 const NormalEquations& normal, const std::vector<dynamics::Mode>& modes,
                 std::vector<bool>& known, std::vector<Eigen::VectorXd>& errors) {
  const Eigen::MatrixXd inverse = inverse_normal_matrix(normal);
  for (Eigen::Index s = 0; s < parameters.modes(); ++s) {
    for (Eigen::Index k = 0; k < parameters.modes(); ++k) {
      const dynamics::Mode &satellite = modes[s], &mode = modes[k];
      if (!data.in_band(mode.pole()) || !is_satellite(satellite, mode)) continue;
      known[k] = known[s] = true;
      const Eigen::VectorXd removal = parameters.removal(x, s);
      const Eigen::Index first = parameters.pole_at(s) + parameters.per_mode() - removal.size();
      const auto pulled = solved(inverse.block(first, first, removal.size(), removal.size()), removal);
      if (!pulled) continue;
      Eigen::VectorXd change = inverse.middleCols(first, removal.size()) * *pulled;
      change.segment(parameters.pole_at(s), parameters.per_mode()).setZero();
      errors.push_back(to_coordinates(parameters, x, change));
      errors.push_back(moved_residue(parameters, k, mode, satellite.psi_r, satellite.psi_l));
    }
  }
}

// Satellites that were not worth a mode, but may be there.
void add_missing(const FitData& data, const ModeParameters& parameters,
                 const std::vector<dynamics::Mode>& modes, const std::vector<bool>& known,
                 std::vector<Eigen::VectorXd>& errors) {
  std::vector<dynamics::Mode> more = modes;
  std::vector<std::size_t> of;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const Complex pole = modes[k].pole();
    if (!data.in_band(pole) || known[k]) continue;
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
  const std::vector<dynamics::Mode> unpacked = extended.unpack(x);
  const double chance = kChanceGain + std::log(static_cast<double>(of.size()));
  for (std::size_t i = 0; i < of.size(); ++i) {
    const std::size_t at = modes.size() + i;
    const Eigen::Index first = extended.pole_at(static_cast<Eigen::Index>(at)) + extended.per_mode() - width;
    const auto missing = missing_satellite(with, base, own, first, width, chance);
    if (!missing) continue;
    errors.push_back(to_coordinates(parameters, x.head(own), missing->adapted));
    errors.push_back(moved_residue(parameters, static_cast<Eigen::Index>(of[i]), modes[of[i]],
                                   unpacked[at].psi_r, missing->left));
  }
}

}  // namespace

std::vector<Eigen::VectorXd> shape_errors(const FitData& data, const ModeParameters& parameters,
                                          const Eigen::VectorXd& x, const NormalEquations& normal) {
  const std::vector<dynamics::Mode> modes = parameters.unpack(x);
  std::vector<bool> known(modes.size(), false);
  std::vector<Eigen::VectorXd> errors;
  add_present(data, parameters, x, normal, modes, known, errors);
  add_missing(data, parameters, modes, known, errors);
  return errors;
}

}  // namespace stablecut::modal
