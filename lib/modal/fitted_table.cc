#include "modal/fitted_table.h"

#include <complex>

#include "modal/likelihood.h"
#include "modal/shape_errors.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr double kUnknownAverages = 5.5;  // behind a measurement that does not say how many

// Directions that responded in some curve, and directions in which a force was applied.
struct Seen {
  std::vector<bool> right, left;

  explicit Seen(const FitData& data) : right(data.dofs), left(right.size()) {
    for (const Curve& curve : data.curves) {
      right[curve.response] = true;
      left[curve.reference] = true;
    }
  }
  bool all() const {
    return std::find(right.begin(), right.end(), false) == right.end() &&
           std::find(left.begin(), left.end(), false) == left.end();
  }
};

// The direction that had both response and force, and in which the mode is largest; -1 without one.
Eigen::Index known_direction(const Seen& seen, const dynamics::Mode& mode) {
  Eigen::Index best = -1;
  double largest = 0;
  for (std::size_t i = 0; i < seen.right.size(); ++i) {
    const Eigen::Index at = i;
    const double size = std::abs(mode.psi_r[at] * mode.psi_l[at]);
    if (!seen.right[i] || !seen.left[i] || size <= largest) continue;
    largest = size;
    best = at;
  }
  return best;
}

// Fills in the components that no curve shows: psi_l = ratio psi_r, with the ratio of a known direction.
// Returns the Jacobian of the coordinates with respect to those before.
Eigen::MatrixXd complete_by_reciprocity(const Seen& seen, const ModeParameters& parameters,
                                        dynamics::Mode& mode) {
  Eigen::MatrixXd slope =
      Eigen::MatrixXd::Identity(parameters.coordinates_per_mode(), parameters.coordinates_per_mode());
  const Eigen::Index known = known_direction(seen, mode);
  const Complex ratio = known < 0 ? Complex(0) : mode.psi_l[known] / mode.psi_r[known];
  // z -> f z as a real matrix.
  const auto times = [](Complex f) {
    return (Eigen::Matrix2d() << f.real(), -f.imag(), f.imag(), f.real()).finished();
  };
  for (Eigen::Index i = 0; i < mode.psi_r.size(); ++i) {
    const bool right = seen.right[i], left = seen.left[i];
    if (right && left) continue;
    // value = source * factor, where the factor is the ratio or its inverse.
    const Eigen::Index to = right ? parameters.left_at(i) : parameters.right_at(i);
    const Eigen::Index from = right ? parameters.right_at(i) : parameters.left_at(i);
    Complex& value = right ? mode.psi_l[i] : mode.psi_r[i];
    const Complex source = right ? mode.psi_r[i] : mode.psi_l[i];
    slope.middleRows<2>(to).setZero();
    value = 0;
    if (known < 0) continue;
    const Complex factor = right ? ratio : 1.0 / ratio;
    value = source * factor;
    const double sign = right ? 1 : -1;
    slope.block<2, 2>(to, from) = times(factor);
    slope.block<2, 2>(to, parameters.left_at(known)) += times(sign * value / mode.psi_l[known]);
    slope.block<2, 2>(to, parameters.right_at(known)) += times(-sign * value / mode.psi_r[known]);
  }
  return slope;
}

// Noise of the force makes the quotient of spectra too small by its share of one average's power: the
// relative variance that the curves of a reference share, times the averages. One change of all coordinates
// for each reference, of one standard deviation.
std::vector<Eigen::VectorXd> scale_shifts(const FitData& data, const ModeParameters& parameters,
                                          const std::vector<dynamics::Mode>& modes) {
  std::vector<Eigen::VectorXd> shifts;
  for (Eigen::Index reference = 0; reference < data.dofs; ++reference) {
    const auto curve = std::find_if(data.curves.begin(), data.curves.end(), [&](const Curve& c) {
      return c.reference == reference && c.shared.size() > 0;
    });
    if (curve == data.curves.end()) continue;
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(parameters.modes() * parameters.coordinates_per_mode());
    for (Eigen::Index k = 0; k < parameters.modes(); ++k) {
      const Complex pole = modes[k].pole();
      const Eigen::VectorXd distance = (data.s.imag().array() - pole.imag()).abs();
      Eigen::Index line = 0;
      distance.minCoeff(&line);
      const double relative = kUnknownAverages * std::norm(curve->shared[line] / curve->h[line]);
      const Complex change = relative * modes[k].psi_l[reference];
      const Eigen::Index at = k * parameters.coordinates_per_mode() + parameters.left_at(reference);
      shift[at] = change.real();
      shift[at + 1] = change.imag();
    }
    shifts.push_back(shift);
  }
  return shifts;
}

}  // namespace

FittedTable fitted_table(const FitData& data, const std::vector<dynamics::Mode>& modes, ModeModel model,
                         bool of_noise) {
  FittedTable table;
  if (modes.empty()) return table;
  const ModeParameters parameters(modes, data.dofs, model);
  const Eigen::VectorXd x = parameters.pack(modes);
  const Seen seen(data);
  table.by_reciprocity = !seen.all();
  const Eigen::Index size = parameters.coordinates_per_mode();
  Eigen::MatrixXd to_table = Eigen::MatrixXd::Zero(parameters.modes() * size, parameters.modes() * size);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(parameters.modes() * size, parameters.size());
  const std::vector<dynamics::Mode> fitted = parameters.unpack(x);
  for (Eigen::Index k = 0; k < parameters.modes(); ++k) {
    dynamics::Mode mode = fitted[k];
    const Eigen::MatrixXd completion = complete_by_reciprocity(seen, parameters, mode);
    to_table.block(k * size, k * size, size, size) = dynamics::normalisation_slope(mode) * completion;
    slope.block(k * size, parameters.pole_at(k), size, parameters.per_mode()) =
        to_table.block(k * size, k * size, size, size) * parameters.slope(x, k);
    table.modes.push_back(dynamics::normalised(mode));
    table.modes.back().out_of_band = modes[k].out_of_band;
  }
  // The weights are 1 / E|error|^2 of the complex value, so each part has half of that variance.
  const Likelihood likelihood(data, parameters, out_of_band(data, modes));
  const NormalEquations normal = likelihood.evaluate(x, true);
  Eigen::MatrixXd inverse = inverse_normal_matrix(normal);
  for (Eigen::Index k = 0; k < parameters.modes(); ++k)
    if (data.holds(modes[k].pole())) inverse.diagonal().segment<2>(parameters.pole_at(k)).setZero();
  table.covariance = slope * (inverse / 2) * slope.transpose();
  std::vector<Eigen::VectorXd> shifts = scale_shifts(data, parameters, fitted);
  if (of_noise && model == ModeModel::kNonsymmetric && data.independent_lines) {
    for (Eigen::VectorXd& error : shape_errors(data, parameters, x, normal))
      shifts.push_back(std::move(error));
  }
  for (const Eigen::VectorXd& shift : shifts) {
    const Eigen::VectorXd change = to_table * shift;
    table.covariance += change * change.transpose();
  }
  return table;
}

}  // namespace stablecut::modal
