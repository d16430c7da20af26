#include "modal/fit.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/units.h"
#include "modal/fit_data.h"
#include "modal/maximum_likelihood.h"
#include "modal/noise.h"
#include "modal/pole_sums.h"
#include "modal/vector_fitting.h"

namespace stablecut {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kStartPairs = 30;
constexpr int kRelocations = 12;
constexpr int kRelocationsAfterPruning = 4;
constexpr int kTrialSteps = 12;       // of a refinement that only has to tell whether a mode pays
constexpr int kFinalSteps = 60;
constexpr double kBeyondDoubt = 100;  // times the price
constexpr Eigen::Index kLeastLines = 8;
// Weights never claim less noise than these shares of the value, and than a part of that of the curve's RMS. Computed
// receptances have no noise at all, and rounding must not decide the number of modes; the coarse floor finds it, the
// fine one then takes what the numbers hold.
constexpr double kCoarseFloor = 1e-4;
constexpr double kFineFloor = 1e-7;
constexpr double kRmsShare = 0.01;
// Misfit over noise from which on the noise is not what limits the fit.
constexpr double kModelErrorFactor = 2;
// Where the model cannot reach the noise (a nonlinear joint, hysteretic damping, a leaking window), the residual is not
// made of modes. Above this relative error a mode has to take away the lesser share of the residual to be one, below
// it the larger.
constexpr double kModelErrorFloor = 0.045;
constexpr double kLesserShare = 0.05;
constexpr double kLargerShare = 0.3;
// A mode narrower than this many line spacings cannot be told from one disturbed line.
constexpr double kLeastHalfWidth = 0.2;

// The fit of one independent group of directions.
class GroupFit {
 public:
  GroupFit(FitData data, std::vector<Eigen::VectorXd> variance) : data_(std::move(data)), variance_(std::move(variance)) {
    estimate_noise_ = variance_.empty();
    if (estimate_noise_) {
      for (const Curve& curve : data_.curves) variance_.push_back(estimated_variance(curve.h));
    }
    set_weights();
  }

  void run(const FitOptions& options) {
    options_ = &options;
    find_modes();
    if (estimate_noise_) reweight();
    select();
    if (exceeds_noise()) {
      build_up();
    } else if (floor_matters()) {
      tighten();
    }
    current_ = refine_modes(data_, current_.modes, 4 * kFinalSteps);
  }

  const FitData& data() const { return data_; }
  const RefinedModes& result() const { return current_; }
  bool limited_by_model() const { return limited_by_model_; }
  double complex_values() const { return data_.values() / 2; }

 private:
  // ---- weights ----

  void set_weights() {
    for (std::size_t e = 0; e < data_.curves.size(); ++e) {
      Curve& curve = data_.curves[e];
      const double rms = std::sqrt(curve.h.squaredNorm() / static_cast<double>(data_.lines()));
      const double of_rms = limited_by_model_ ? kModelErrorFloor : kRmsShare * floor_;
      curve.weight =
          (variance_[e].array() + floor_ * floor_ * curve.h.array().abs2() + std::pow(of_rms * rms, 2)).inverse();
    }
  }

  // Noise from what the model leaves.
  void reweight() {
    for (std::size_t e = 0; e < data_.curves.size(); ++e) {
      const Curve& curve = data_.curves[e];
      variance_[e] = estimated_variance(curve_of(current_.modes, curve, data_.s) - curve.h);
    }
    set_weights();
    current_ = refine_modes(data_, current_.modes, kFinalSteps);
  }

  bool exceeds_noise() const { return current_.chi_square / complex_values() > kModelErrorFactor; }

  // Whether the floor, not the noise, decides some weights.
  bool floor_matters() const {
    double share = 0;
    for (const Curve& curve : data_.curves) share += floor_ * floor_ * curve.h.cwiseAbs2().dot(curve.weight);
    return share > 0.01 * complex_values();
  }

  // Nearly no noise: the same again with all that the numbers hold, unless the model cannot follow.
  void tighten() {
    const RefinedModes coarse = current_;
    const double coarse_floor = std::exchange(floor_, kFineFloor);
    set_weights();
    current_ = refine_modes(data_, current_.modes, kFinalSteps);
    if (estimate_noise_) reweight();
    select();
    if (!exceeds_noise()) return;
    floor_ = coarse_floor;
    set_weights();
    current_ = coarse;
  }

  // The model error takes over: curves weigh by their size, and modes are found from the strongest on.
  void build_up() {
    limited_by_model_ = true;
    set_weights();
    current_ = refine_modes(data_, {}, 0);
    select();
  }

  // |model - h| / |h|, root mean square over the curves.
  double relative_error(const std::vector<Mode>& modes) const {
    double sum = 0;
    for (const Curve& curve : data_.curves) {
      sum += (curve_of(modes, curve, data_.s) - curve.h).squaredNorm() / curve.h.squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(data_.curves.size()));
  }

  // ---- the price of a mode ----

  // Chi-square that a mode must take away: half its real parameters times the log of the number of values (Schwarz). A
  // residual that is larger than the noise, or smooth over lines, holds less information than its length.
  double price(const RefinedModes& without) const {
    const double parameters = 2.0 + 2.0 * static_cast<double>(2 * data_.dofs - 1);
    const double information = (parameters / 2) * std::log(data_.values());
    if (limited_by_model_) {
      const double share = relative_error(without.modes) > kModelErrorFloor ? kLesserShare : kLargerShare;
      return std::max(information, share * without.chi_square);
    }
    const double spread = std::max(1.0, without.chi_square / complex_values());
    double length = 0;
    for (const Curve& curve : data_.curves) {
      const Eigen::VectorXcd residual = curve_of(without.modes, curve, data_.s) - curve.h;
      length += correlation_length(curve.weight.cwiseSqrt().cwiseProduct(residual));
    }
    return information * spread * length / static_cast<double>(data_.curves.size());
  }

  // ---- candidates ----

  void find_modes() {
    const Eigen::Index pairs = std::min(kStartPairs, data_.lines() / 3);
    Eigen::VectorXcd poles = starting_poles(data_, pairs);
    for (int i = 0; i < kRelocations; ++i) poles = relocate_poles(data_, poles);
    while (poles.size() > 1) {
      const LinearResidues linear = linear_residues(data_, poles);
      const double spread = std::max(1.0, linear.chi_square / complex_values());
      const double least = spread * static_cast<double>(2 * data_.curves.size()) * std::log(data_.values());
      std::vector<Eigen::Index> order(static_cast<std::size_t>(poles.size()));
      std::iota(order.begin(), order.end(), Eigen::Index{0});
      std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return linear.removal_loss[a] < linear.removal_loss[b];
      });
      const auto worthless = std::count_if(order.begin(), order.end(), [&](Eigen::Index k) {
        return linear.removal_loss[k] < least;
      });
      if (worthless == 0) break;
      const auto dropped = std::clamp<std::ptrdiff_t>(worthless / 3, 1, worthless);
      std::vector<Eigen::Index> kept(order.begin() + dropped, order.end());
      std::sort(kept.begin(), kept.end());
      poles = poles(kept).eval();
      for (int i = 0; i < kRelocationsAfterPruning; ++i) poles = relocate_poles(data_, poles);
    }
    const LinearResidues linear = linear_residues(data_, poles);
    std::vector<Mode> modes;
    for (Eigen::Index k = 0; k < poles.size(); ++k) modes.push_back(rank_one(poles[k], linear.residue.row(k)));
    current_ = refine_modes(data_, modes, kFinalSteps);
  }

  // The mode whose residue is nearest to the curves' residues; a missing curve counts as its mirror image, or as zero.
  Mode rank_one(Complex pole, const Eigen::RowVectorXcd& residue) const {
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(data_.dofs, data_.dofs);
    for (std::size_t e = 0; e < data_.curves.size(); ++e) {
      const Curve& curve = data_.curves[e];
      const Complex value = residue[static_cast<Eigen::Index>(e)];
      matrix(curve.response, curve.reference) = value;
      const bool mirror_missing = std::none_of(data_.curves.begin(), data_.curves.end(), [&](const Curve& other) {
        return other.response == curve.reference && other.reference == curve.response;
      });
      if (mirror_missing) matrix(curve.reference, curve.response) = value;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
    Mode mode;
    set_pole(mode, pole);
    mode.psi_r = svd.matrixU().col(0);
    mode.psi_l = svd.singularValues()[0] * svd.matrixV().col(0).conjugate();
    return mode;
  }

  // ---- selection ----

  void select() {
    for (int round = 0; round < 60; ++round) {
      remove_modes();
      report(0.5 + 0.01 * round);
      if (!add_mode()) break;
    }
  }

  bool has_wanted_count() const {
    return options_->modes && static_cast<int>(current_.modes.size()) <= *options_->modes;
  }

  // Takes modes away, the least important first, as long as that costs less than they must be worth.
  void remove_modes() {
    while (current_.modes.size() > 1 && !has_wanted_count()) {
      std::vector<std::size_t> order(current_.modes.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(!is_too_narrow(current_.modes[a]), loss(a)) < std::pair(!is_too_narrow(current_.modes[b]), loss(b));
      });
      bool removed = false;
      for (std::size_t attempt = 0; attempt < std::min<std::size_t>(3, order.size()) && !removed; ++attempt) {
        removed = remove_if_worthless(order[attempt]);
      }
      if (!removed) return;
    }
  }

  bool remove_if_worthless(std::size_t k) {
    // The second-order loss is a good guess: no trial where it says that the mode matters beyond doubt.
    const bool forced = options_->modes.has_value() || is_too_narrow(current_.modes[k]);
    if (!forced && loss(k) > kBeyondDoubt * price(current_)) return false;
    std::vector<Mode> fewer = current_.modes;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    RefinedModes trial = refine_modes(data_, fewer, kTrialSteps);
    if (!forced && trial.chi_square - current_.chi_square >= price(trial)) return false;
    current_ = std::move(trial);
    return true;
  }

  double loss(std::size_t k) const { return current_.removal_loss[static_cast<Eigen::Index>(k)]; }

  bool is_too_narrow(const Mode& mode) const {
    const double spacing = (data_.s[data_.lines() - 1] - data_.s[0]).imag() / static_cast<double>(data_.lines() - 1);
    return -mode.pole().real() < kLeastHalfWidth * spacing;
  }

  // Tries a mode where the residual asks most for one. True when it pays.
  bool add_mode() {
    if (options_->modes && static_cast<int>(current_.modes.size()) >= *options_->modes) return false;
    const Mode candidate = best_addition();
    std::vector<Mode> more = current_.modes;
    more.push_back(candidate);
    RefinedModes trial = refine_modes(data_, more, 2 * kTrialSteps);
    if (!(current_.chi_square - trial.chi_square > price(current_))) return false;
    if (std::any_of(trial.modes.begin(), trial.modes.end(), [&](const Mode& mode) { return is_too_narrow(mode); })) {
      return false;
    }
    current_ = std::move(trial);
    return true;
  }

  Mode best_addition() const {
    std::vector<Eigen::VectorXcd> residual;
    for (const Curve& curve : data_.curves) residual.push_back(curve.h - curve_of(current_.modes, curve, data_.s));
    const double hi = data_.s[data_.lines() - 1].imag();
    const double spacing = (data_.s[data_.lines() - 1] - data_.s[0]).imag() / static_cast<double>(data_.lines() - 1);
    const double lo = std::max(data_.s[0].imag(), spacing);
    double best_gain = -1;
    Mode best;
    for (const double zeta : {0.004, 0.02, 0.08, 0.3}) {
      for (double omega = lo; omega <= hi; omega += std::max(zeta * omega, spacing / 2)) {
        const Complex pole = omega * Complex(-zeta, std::sqrt(1 - zeta * zeta));
        const PoleValues values(data_.s, Eigen::VectorXcd::Constant(1, pole));
        Eigen::RowVectorXcd residue(static_cast<Eigen::Index>(data_.curves.size()));
        double gain = 0;
        for (std::size_t e = 0; e < data_.curves.size(); ++e) {
          gain += single_pole_gain(values, data_.curves[e].weight, residual[e], residue[static_cast<Eigen::Index>(e)]);
        }
        if (gain > best_gain) {
          best_gain = gain;
          best = rank_one(pole, residue);
        }
      }
    }
    return best;
  }

  // How much of the weighted residual one pole takes away, and its residue.
  static double single_pole_gain(const PoleValues& values, const Eigen::VectorXd& weight, const Eigen::VectorXcd& residual,
                                 Complex& residue) {
    Eigen::Matrix2d gram = Eigen::Matrix2d::Zero();
    Eigen::Vector2d projection = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
      const Complex sum = values.phi(i, 0) + values.phi_conj(i, 0);
      const Complex difference = Complex(0, 1) * (values.phi(i, 0) - values.phi_conj(i, 0));
      gram(0, 0) += weight[i] * std::norm(sum);
      gram(1, 1) += weight[i] * std::norm(difference);
      gram(0, 1) += weight[i] * (std::conj(sum) * difference).real();
      projection[0] += weight[i] * (std::conj(sum) * residual[i]).real();
      projection[1] += weight[i] * (std::conj(difference) * residual[i]).real();
    }
    gram(1, 0) = gram(0, 1);
    const Eigen::Vector2d solution = gram.inverse() * projection;
    residue = {solution[0], solution[1]};
    return solution.allFinite() ? solution.dot(projection) : 0.0;
  }

  void report(double share) const {
    if (options_->progress) options_->progress(std::min(share, 0.99));
  }

  FitData data_;
  std::vector<Eigen::VectorXd> variance_;  // of the noise, per curve
  bool estimate_noise_ = false;
  bool limited_by_model_ = false;
  double floor_ = kCoarseFloor;
  const FitOptions* options_ = nullptr;
  RefinedModes current_;
};

FitData group_data(const FrequencyResponse& measured, const DirectionGroup& group, const std::vector<std::string>& dofs) {
  FitData data;
  data.s = Complex(0, kTwoPi) * measured.frequency_hz.cast<Complex>();
  data.dofs = static_cast<Eigen::Index>(dofs.size());
  const auto index = [&](const std::string& name) { return std::find(dofs.begin(), dofs.end(), name) - dofs.begin(); };
  for (const std::size_t e : group.entries) {
    const auto& entry = measured.entries[e];
    data.curves.push_back({index(entry.response), index(entry.reference), entry.h, {}});
  }
  return data;
}

std::vector<std::string> group_directions(const FrequencyResponse& measured, const DirectionGroup& group,
                                          const std::vector<std::string>& all) {
  std::vector<std::string> names;
  for (const std::string& name : all) {
    const bool used = std::any_of(group.entries.begin(), group.entries.end(), [&](std::size_t e) {
      return measured.entries[e].response == name || measured.entries[e].reference == name;
    });
    if (used) names.push_back(name);
  }
  return names;
}

// Known variances of the group's curves; empty when any is unknown.
std::vector<Eigen::VectorXd> known_variances(const FrequencyResponse& measured, const DirectionGroup& group) {
  std::vector<Eigen::VectorXd> result;
  for (const std::size_t e : group.entries) {
    const auto& entry = measured.entries[e];
    if (entry.variance.size() > 0) {
      result.push_back(entry.variance);
    } else if (entry.coherence.size() > 0) {
      // Var H1 = (1 - coherence) / (2 averages coherence) |H|^2 for each part (Bendat and Piersol).
      const Eigen::ArrayXd coherence = entry.coherence.array().max(1e-6);
      result.push_back((1 - coherence) / (coherence * entry.averages.value_or(1)) * entry.h.array().abs2());
    } else {
      return {};
    }
  }
  return result;
}

}  // namespace

ModalFit fit_modes(const FrequencyResponse& measured, const FitOptions& options) {
  if (measured.quantity != Quantity::kReceptance) throw InvalidArgument("expected a receptance");
  if (measured.frequency_hz.size() < kLeastLines || measured.frequency_hz[0] < 0) {
    throw InvalidArgument("expected at least " + std::to_string(kLeastLines) + " lines to fit modes to, not " +
                          std::to_string(measured.frequency_hz.size()));
  }
  const std::vector<DirectionGroup> groups = independent_groups(measured);
  if (groups.empty()) throw NoAnswer("all entries are zero: there is no mode to find");

  ModalFit fit;
  fit.model.dofs = direction_names(measured);
  fit.variance_given = true;
  fit.converged = true;
  double chi_square = 0, values = 0, error_square = 0, square = 0;
  for (const DirectionGroup& group : groups) {
    const std::vector<std::string> directions = group_directions(measured, group, fit.model.dofs);
    std::vector<Eigen::VectorXd> variance = known_variances(measured, group);
    fit.variance_given = fit.variance_given && !variance.empty();
    GroupFit part(group_data(measured, group, directions), std::move(variance));
    part.run(options);
    fit.converged = fit.converged && part.result().converged;
    fit.limited_by_model = fit.limited_by_model || part.limited_by_model();
    chi_square += part.result().chi_square;
    values += part.complex_values();
    for (const Curve& curve : part.data().curves) {
      const Eigen::VectorXcd error = curve_of(part.result().modes, curve, part.data().s) - curve.h;
      error_square += error.squaredNorm();
      square += curve.h.squaredNorm();
      fit.curves.push_back({directions[static_cast<std::size_t>(curve.response)],
                            directions[static_cast<std::size_t>(curve.reference)], error.norm() / curve.h.norm(),
                            error.cwiseAbs2().dot(curve.weight) / static_cast<double>(error.size())});
    }
    for (const Mode& mode : part.result().modes) {
      // Into all directions: exact zeros where the group does not reach.
      Mode whole = mode;
      whole.psi_r = whole.psi_l = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(fit.model.dofs.size()));
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const Eigen::Index row = fit.model.dof(directions[i]);
        whole.psi_r[row] = mode.psi_r[static_cast<Eigen::Index>(i)];
        whole.psi_l[row] = mode.psi_l[static_cast<Eigen::Index>(i)];
      }
      whole.out_of_band = mode.frequency_hz < measured.frequency_hz[0] ||
                          mode.frequency_hz > measured.frequency_hz[measured.frequency_hz.size() - 1];
      // Where the model error limits the fit, the weights are not the noise: no standard deviation is known.
      if (part.limited_by_model()) whole.deviation.reset();
      fit.model.modes.push_back(normalised(whole));
    }
  }
  std::stable_sort(fit.model.modes.begin(), fit.model.modes.end(),
                   [](const Mode& a, const Mode& b) { return a.frequency_hz < b.frequency_hz; });
  fit.relative_error = std::sqrt(error_square / square);
  fit.reduced_chi_square = chi_square / values;
  if (fit.model.modes.empty()) throw NoAnswer("no mode stands out of the noise");
  return fit;
}

}  // namespace stablecut
