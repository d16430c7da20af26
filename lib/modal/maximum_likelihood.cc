#include "modal/maximum_likelihood.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "modal/pole_sums.h"

namespace stablecut {
namespace {

using Complex = std::complex<double>;

// Bounds: of -Re lambda / Im lambda, and of Im lambda in units of the highest line. What stands for modes far
// above the band looks nearly the same from three times the band on, and would only be dear to follow through
// a cut.
constexpr double kLeastRatio = 1e-6, kLargestRatio = 3;
constexpr double kLeastRate = 1e-5, kLargestRate = 3;
// What holds for a mode outside the band when the data do not say: -Re / Im, and the deviations of the
// logarithms.
constexpr double kResidualDamping = 0.05;
constexpr double kResidualDampingDeviation = 0.5;
constexpr double kResidualPlaceDeviation = 1;
constexpr double kRidge =
    1e-13;  // of the diagonal, so that a mode without residue does not stop the factorization

// How the real parameter vector describes the modes:
//   log(-Re lambda / Im lambda), log(Im lambda), then Re and Im of psi_r without its pivot (which stays 1),
//   of psi_l.
class Parametrization {
 public:
  Parametrization(const std::vector<Mode>& modes, const FitData& data) : dofs_(data.dofs) {
    for (const Mode& mode : modes) {
      const double omega = mode.pole().imag();
      out_of_band_.push_back(omega < data.s[0].imag() || omega > data.s[data.lines() - 1].imag());
      Eigen::Index pivot = 0;
      mode.psi_r.cwiseAbs().maxCoeff(&pivot);
      pivot_.push_back(pivot);
    }
  }

  Eigen::Index modes() const { return static_cast<Eigen::Index>(pivot_.size()); }
  Eigen::Index per_mode() const { return 2 + 2 * (dofs_ - 1) + 2 * dofs_; }
  Eigen::Index size() const { return modes() * per_mode(); }
  Eigen::Index pivot(Eigen::Index k) const { return pivot_[static_cast<std::size_t>(k)]; }
  bool out_of_band(Eigen::Index k) const { return out_of_band_[static_cast<std::size_t>(k)]; }

  // Where the real part of a component stands; the imaginary part follows it.
  Eigen::Index pole_at(Eigen::Index k) const { return k * per_mode(); }
  Eigen::Index right_at(Eigen::Index k, Eigen::Index i) const {
    return pole_at(k) + 2 + 2 * (i < pivot(k) ? i : i - 1);
  }
  Eigen::Index left_at(Eigen::Index k, Eigen::Index j) const { return pole_at(k) + 2 * dofs_ + 2 * j; }

  Eigen::VectorXd pack(const std::vector<Mode>& modes) const {
    Eigen::VectorXd x(size());
    for (Eigen::Index k = 0; k < this->modes(); ++k) {
      const Mode& mode = modes[static_cast<std::size_t>(k)];
      const Complex lambda = mode.pole();
      x[pole_at(k)] = std::log(-lambda.real() / lambda.imag());
      x[pole_at(k) + 1] = std::log(lambda.imag());
      const Complex scale = mode.psi_r[pivot(k)];
      for (Eigen::Index i = 0; i < dofs_; ++i) {
        if (i != pivot(k)) put(x, right_at(k, i), mode.psi_r[i] / scale);
        put(x, left_at(k, i), mode.psi_l[i] * scale);
      }
    }
    return x;
  }

  std::vector<Mode> unpack(const double* x) const {
    std::vector<Mode> modes(pivot_.size());
    for (Eigen::Index k = 0; k < this->modes(); ++k) {
      Mode& mode = modes[static_cast<std::size_t>(k)];
      set_pole(mode, pole(x, k));
      mode.psi_r = Eigen::VectorXcd::Ones(dofs_);
      mode.psi_l.resize(dofs_);
      for (Eigen::Index i = 0; i < dofs_; ++i) {
        if (i != pivot(k)) mode.psi_r[i] = {x[right_at(k, i)], x[right_at(k, i) + 1]};
        mode.psi_l[i] = {x[left_at(k, i)], x[left_at(k, i) + 1]};
      }
    }
    return modes;
  }

  Complex pole(const double* x, Eigen::Index k) const {
    return std::exp(x[pole_at(k) + 1]) * Complex(-std::exp(x[pole_at(k)]), 1);
  }

 private:
  static void put(Eigen::VectorXd& x, Eigen::Index at, Complex value) {
    x[at] = value.real();
    x[at + 1] = value.imag();
  }

  Eigen::Index dofs_;
  std::vector<Eigen::Index> pivot_;
  std::vector<bool> out_of_band_;  // at the start
};

// A complex parameter of one curve: moving it by z changes the curve by z t g + conj(z t) g_conj.
struct Direction {
  Eigen::Index at;  // of its real part
  PoleSums::Function g;
  Complex t;
};

// chi-square, its half gradient J^T r and the Gauss-Newton matrix J^T J, where r is the weighted residual.
struct NormalEquations {
  double chi_square = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd matrix;
};

class Likelihood {
 public:
  Likelihood(const FitData& data, const Parametrization& parameters) : data_(data), parameters_(parameters) {}

  NormalEquations evaluate(const double* x, bool with_matrix) const {
    NormalEquations result;
    if (with_matrix) {
      result.gradient = Eigen::VectorXd::Zero(parameters_.size());
      result.matrix = Eigen::MatrixXd::Zero(parameters_.size(), parameters_.size());
    }
    const std::vector<Mode> modes = parameters_.unpack(x);
    Eigen::VectorXcd poles(parameters_.modes());
    for (Eigen::Index k = 0; k < poles.size(); ++k) poles[k] = parameters_.pole(x, k);
    const PoleValues values(data_.s, poles);
    for (const Curve& curve : data_.curves) {
      Eigen::VectorXcd residue(poles.size());
      for (Eigen::Index k = 0; k < poles.size(); ++k) {
        const Mode& mode = modes[static_cast<std::size_t>(k)];
        residue[k] = mode.psi_r[curve.response] * mode.psi_l[curve.reference];
      }
      Eigen::VectorXcd error = values.phi * residue - curve.h;
      error += values.phi_conj * residue.conjugate();
      result.chi_square += error.cwiseAbs2().dot(curve.weight);
      if (with_matrix) add_curve(values, curve, modes, residue, error, result);
    }
    if (with_matrix) to_logarithms(poles, result);
    add_priors(x, with_matrix, result);
    return result;
  }

 private:
  void add_curve(const PoleValues& values, const Curve& curve, const std::vector<Mode>& modes,
                 const Eigen::VectorXcd& residue, const Eigen::VectorXcd& error,
                 NormalEquations& result) const {
    const Eigen::VectorXcd weighted = curve.weight.cwiseProduct(error);
    const Eigen::VectorXcd first = values.phi.adjoint() * weighted;
    const Eigen::VectorXcd first_conj = values.phi_conj.adjoint() * weighted;
    std::vector<Direction> directions;
    for (Eigen::Index k = 0; k < parameters_.modes(); ++k) {
      const Mode& mode = modes[static_cast<std::size_t>(k)];
      directions.push_back({parameters_.pole_at(k), {k, false, 2}, residue[k]});
      directions.push_back(
          {parameters_.left_at(k, curve.reference), {k, false, 1}, mode.psi_r[curve.response]});
      if (curve.response != parameters_.pivot(k)) {
        directions.push_back(
            {parameters_.right_at(k, curve.response), {k, false, 1}, mode.psi_l[curve.reference]});
      }
    }
    for (const Direction& d : directions) {
      Complex along = first[d.g.pole], along_conj = first_conj[d.g.pole];
      if (d.g.order == 2) {
        along = values.phi.col(d.g.pole).array().square().matrix().dot(weighted);
        along_conj = values.phi_conj.col(d.g.pole).array().square().matrix().dot(weighted);
      }
      // Re(conj(t) T + t T'), and the same with i t.
      const Complex own = std::conj(d.t) * along, mirror = d.t * along_conj;
      result.gradient[d.at] += (own + mirror).real();
      result.gradient[d.at + 1] += (own - mirror).imag();
    }
    const PoleSums sums(values, curve.weight, true);
    for (std::size_t a = 0; a < directions.size(); ++a) {
      for (std::size_t b = a; b < directions.size(); ++b)
        add_pair(sums, directions[a], directions[b], result.matrix);
    }
  }

  // The 2x2 block of inner products of a's and b's columns; the columns of a direction are t g + conj(t) g'
  // and the same with i t.
  static void add_pair(const PoleSums& sums, const Direction& a, const Direction& b,
                       Eigen::MatrixXd& matrix) {
    const auto mirrored = [](PoleSums::Function g) {
      g.conjugate = true;
      return g;
    };
    const Complex same = std::conj(a.t) * b.t * sums.inner(a.g, b.g);
    const Complex same_conj = a.t * std::conj(b.t) * sums.inner(mirrored(a.g), mirrored(b.g));
    const Complex cross = std::conj(a.t) * std::conj(b.t) * sums.inner(a.g, mirrored(b.g));
    const Complex cross_conj = a.t * b.t * sums.inner(mirrored(a.g), b.g);
    const Complex i(0, 1);
    // t -> i t multiplies t by i and conj(t) by -i.
    const auto entry = [&](Complex fa, Complex fb) {
      return (std::conj(fa) * fb * same + fa * std::conj(fb) * same_conj +
              std::conj(fa) * std::conj(fb) * cross + fa * fb * cross_conj)
          .real();
    };
    const Eigen::Matrix2d block =
        (Eigen::Matrix2d() << entry(1, 1), entry(1, i), entry(i, 1), entry(i, i)).finished();
    matrix.block<2, 2>(a.at, b.at) += block;
    if (a.at != b.at) matrix.block<2, 2>(b.at, a.at) += block.transpose();
  }

  // d lambda / d log(-Re / Im) = Re lambda, d lambda / d log Im = lambda.
  void to_logarithms(const Eigen::VectorXcd& poles, NormalEquations& result) const {
    for (Eigen::Index k = 0; k < poles.size(); ++k) {
      const Eigen::Index at = parameters_.pole_at(k);
      const Eigen::Matrix2d chain =
          (Eigen::Matrix2d() << poles[k].real(), poles[k].real(), 0, poles[k].imag()).finished();
      result.gradient.segment<2>(at) = (chain.transpose() * result.gradient.segment<2>(at)).eval();
      result.matrix.middleRows<2>(at) = (chain.transpose() * result.matrix.middleRows<2>(at)).eval();
      result.matrix.middleCols<2>(at) = (result.matrix.middleCols<2>(at) * chain).eval();
    }
  }

  // Outside the band the data may not tell damping and distance: then a common damping and a place near the
  // band hold, so that the residual mode cannot chatter by itself. Where the data tell, they outweigh this.
  void add_priors(const double* x, bool with_matrix, NormalEquations& result) const {
    const double lo = data_.s[0].imag(), hi = data_.s[data_.lines() - 1].imag();
    const auto add = [&](Eigen::Index at, double expected, double deviation) {
      const double off = (x[at] - expected) / deviation;
      result.chi_square += off * off / 2;
      if (!with_matrix) return;
      result.gradient[at] += off / deviation / 2;
      result.matrix(at, at) += 1 / (2 * deviation * deviation);
    };
    for (Eigen::Index k = 0; k < parameters_.modes(); ++k) {
      if (!parameters_.out_of_band(k)) continue;
      const Eigen::Index at = parameters_.pole_at(k);
      add(at, std::log(kResidualDamping), kResidualDampingDeviation);
      const bool above = x[at + 1] > std::log(hi);
      add(at + 1, above ? std::log(1.5 * hi) : std::log(std::max(lo / 1.5, 1e-3 * hi)),
          kResidualPlaceDeviation);
    }
  }

  const FitData& data_;
  const Parametrization& parameters_;
};

Eigen::LLT<Eigen::MatrixXd> factorized(Eigen::MatrixXd matrix) {
  const double largest = matrix.diagonal().maxCoeff();
  for (double ridge = kRidge;; ridge *= 100) {
    Eigen::MatrixXd damped = matrix;
    damped.diagonal() +=
        ridge * (matrix.diagonal() + Eigen::VectorXd::Constant(matrix.rows(), 1e-6 * largest));
    Eigen::LLT<Eigen::MatrixXd> factor(damped);
    if (factor.info() == Eigen::Success || ridge > 1) return factor;
  }
}

// Least squares depend on the long residual r and its Jacobian J only through J^T J, J^T r and |r|^2. So the
// solver gets a short equivalent: with U^T U = J^T J the residual (U^-T J^T r, rest) and the Jacobian (U, 0).
class CompressedCost : public ceres::CostFunction {
 public:
  explicit CompressedCost(const Likelihood& likelihood, Eigen::Index size)
      : likelihood_(likelihood), size_(size) {
    set_num_residuals(static_cast<int>(size + 1));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(size));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd> residual(residuals, size_ + 1);
    const bool with_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    const NormalEquations normal = likelihood_.evaluate(parameters[0], with_jacobian);
    if (!std::isfinite(normal.chi_square)) return false;
    residual.setZero();
    if (with_jacobian) {
      const auto factor = factorized(normal.matrix);
      residual.head(size_) = factor.matrixL().solve(normal.gradient);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
          jacobians[0], size_ + 1, size_);
      jacobian.setZero();
      jacobian.topRows(size_) = Eigen::MatrixXd(factor.matrixU());
    }
    residual[size_] = std::sqrt(std::max(0.0, normal.chi_square - residual.head(size_).squaredNorm()));
    return true;
  }

 private:
  const Likelihood& likelihood_;
  Eigen::Index size_;
};

void add_statistics(const Parametrization& parameters, const Eigen::VectorXd& x,
                    const NormalEquations& normal, RefinedModes& result) {
  const Eigen::Index n = parameters.modes();
  const Eigen::MatrixXd covariance =
      factorized(normal.matrix).solve(Eigen::MatrixXd::Identity(parameters.size(), parameters.size()));
  result.removal_loss.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index first = parameters.left_at(k, 0);
    const Eigen::Index count = parameters.pole_at(k) + parameters.per_mode() - first;
    const Eigen::VectorXd left = x.segment(first, count);
    result.removal_loss[k] =
        left.dot(Eigen::MatrixXd(covariance.block(first, first, count, count)).llt().solve(left));
    // The weights are 1 / E|error|^2 of the complex value, so each part has half of that variance.
    const Complex lambda = parameters.pole(x.data(), k);
    const Eigen::Matrix2d pole = covariance.block<2, 2>(parameters.pole_at(k), parameters.pole_at(k)) / 2;
    const double zeta = -lambda.real() / std::abs(lambda);
    // With t = -Re / Im: log omega_n = log Im + log(1 + t^2) / 2 and log zeta = log t - log(1 + t^2) / 2.
    const Eigen::Vector2d of_frequency(zeta * zeta, 1);
    const Eigen::Vector2d of_damping(1 - zeta * zeta, 0);
    result.modes[static_cast<std::size_t>(k)].deviation = {
        hz_from_rad_per_s(std::abs(lambda)) * std::sqrt(of_frequency.dot(pole * of_frequency)),
        zeta * std::sqrt(of_damping.dot(pole * of_damping))};
  }
}

// The last steps brought next to nothing: along a direction that the data hardly see.
bool has_settled(const ceres::Solver::Summary& summary) {
  constexpr std::size_t kSteps = 20;
  constexpr double kNextToNothing = 1e-3;
  const auto& steps = summary.iterations;
  return summary.IsSolutionUsable() && steps.size() > kSteps &&
         steps[steps.size() - 1 - kSteps].cost - summary.final_cost < kNextToNothing * summary.final_cost;
}

}  // namespace

RefinedModes refine_modes(const FitData& data, const std::vector<Mode>& start, int iterations) {
  RefinedModes result;
  if (start.empty()) {
    result.chi_square = chi_square_of(data, start);
    result.converged = true;
    return result;
  }
  const Parametrization parameters(start, data);
  const Likelihood likelihood(data, parameters);
  Eigen::VectorXd x = parameters.pack(start);

  static const auto silent = FLAGS_minloglevel = google::GLOG_FATAL;  // a library that prints is a bug
  static_cast<void>(silent);
  ceres::Problem problem;
  problem.AddResidualBlock(new CompressedCost(likelihood, parameters.size()), nullptr, x.data());
  const double highest = data.s.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < parameters.modes(); ++k) {
    const auto bound = [&](Eigen::Index at, double least, double most) {
      x[at] = std::clamp(x[at], std::log(least), std::log(most));
      problem.SetParameterLowerBound(x.data(), static_cast<int>(at), std::log(least));
      problem.SetParameterUpperBound(x.data(), static_cast<int>(at), std::log(most));
    };
    bound(parameters.pole_at(k), kLeastRatio, kLargestRatio);
    bound(parameters.pole_at(k) + 1, kLeastRate * highest, kLargestRate * highest);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-9;
  options.gradient_tolerance = 0;
  options.parameter_tolerance = 1e-13;
  options.max_num_line_search_step_size_iterations = 0;  // at bounds: a step is cut, or made shorter
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  result.modes = parameters.unpack(x.data());
  for (std::size_t k = 0; k < start.size(); ++k) result.modes[k].out_of_band = start[k].out_of_band;
  result.converged = summary.termination_type == ceres::CONVERGENCE || has_settled(summary);
  const NormalEquations normal = likelihood.evaluate(x.data(), true);
  result.chi_square = normal.chi_square;
  add_statistics(parameters, x, normal, result);
  return result;
}

Eigen::VectorXcd curve_of(const std::vector<Mode>& modes, const Curve& curve, const Eigen::VectorXcd& s) {
  Eigen::VectorXcd h = Eigen::VectorXcd::Zero(s.size());
  for (const Mode& mode : modes) {
    const Complex residue = mode.psi_r[curve.response] * mode.psi_l[curve.reference];
    const PoleValues values(s, Eigen::VectorXcd::Constant(1, mode.pole()));
    h += residue * values.phi.col(0) + std::conj(residue) * values.phi_conj.col(0);
  }
  return h;
}

double chi_square_of(const FitData& data, const std::vector<Mode>& modes) {
  double sum = 0;
  for (const Curve& curve : data.curves) {
    sum += (curve_of(modes, curve, data.s) - curve.h).cwiseAbs2().dot(curve.weight);
  }
  return sum;
}

}  // namespace stablecut
