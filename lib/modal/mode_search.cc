#include "modal/mode_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "dynamics/noise.h"
#include "modal/mode_candidates.h"
#include "modal/vector_fitting.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kStartPairs = 30, kMostStartPairs = 120;
constexpr int kRelocations = 8;
constexpr int kRelocationsAfterPruning = 2;
// Of refinements: the first, of many candidates; those that only have to tell whether a mode pays; between
// changes of the weights; and the last.
constexpr Effort kFirst{24, 0.1}, kRemoval{40, 0.1}, kAddition{40, 0.1}, kBetween{60, 0.01}, kLast{240, 1e-5};
constexpr int kRescues = 3;
constexpr std::size_t kRemovalTrials = 4;
constexpr double kOtherNoise = 4;     // times a variance, from which on modes are weighed again
constexpr double kBeyondDoubt = 100;  // times the price
// Weights never claim less noise than these shares of the value, and than a part of that of the curve's RMS.
// Computed receptances have no noise at all, and rounding must not decide the number of modes; the coarse
// floor finds it, the fine one then takes what the numbers hold.
constexpr double kCoarseFloor = 1e-4;
constexpr double kFineFloor = 1e-7;
constexpr double kRmsShare = 0.01;
// Misfit over noise from which on the noise is not what limits the fit.
constexpr double kModelErrorFactor = 1.5;
// The same for a noise that is taken from the misfit itself, when that turns out not to be white.
constexpr double kLargestInflation = 1.6, kInflationOfFewLines = 30;
// Distance of two poles, of the smaller half width, below which they are at one place.
constexpr double kOnePole = 0.5;
// Where the model cannot reach the noise (a nonlinear joint, hysteretic damping, a leaking window), the
// residual is not made of modes. Above this relative error a mode has to take away the lesser share of the
// residual to be one, below it the larger.
constexpr double kModelErrorFloor = 0.045;
constexpr double kLesserShare = 0.05;
constexpr double kLargerShare = 0.3;
// A pole on a line and narrower than this many line spacings moves that line alone: a disturbed line, not a
// mode.
constexpr double kLeastHalfWidth = 0.02;
// Poles that may stand for a rigid body: up to so many times the first line, or so much damped; and where its
// own is looked for, in first lines.
constexpr double kRigidReach = 4, kRigidDamping = 0.3;
constexpr std::array kRigidPlaces = {0.5, 0.1, 0.02};

}  // namespace

ModeSearch::ModeSearch(FitData data, std::vector<Eigen::VectorXd> variance, std::optional<int> wanted_modes)
    : data_(std::move(data)),
      variance_(std::move(variance)),
      estimate_noise_(variance_.empty()),
      wanted_modes_(wanted_modes),
      floor_(kCoarseFloor) {
  floors_ = dynamics::floor_shapes(data_.s.imag());
  if (estimate_noise_) {
    for (const Curve& curve : data_.curves)
      variance_.push_back(dynamics::estimated_variance(data_.s.imag(), curve.h, curve.h.cwiseAbs(), floors_));
  }
  set_weights();
}

void ModeSearch::run(const Progress& progress) {
  progress_ = progress;
  find_modes();
  if (estimate_noise_) reweight();
  rescue();
  if (exceeds_noise() && !estimate_noise_) {
    // The variance that came with the data may be too small: see what the residual says of the noise.
    estimate_noise_ = true;
    reweight();
    rescue();
  }
  if (!exceeds_noise()) select();
  if (exceeds_noise()) {
    build_up();
  } else if (floor_matters()) {
    tighten();
  } else if (estimate_noise_) {
    const std::vector<Eigen::VectorXd> seen = variance_;
    settle_noise();
    if (!is_white() || is_crowded()) {
      variance_ = seen;
      build_up();
    }
  }
  current_ = refined(current_.modes, kLast);
}

// The first refinement may have been stopped, and a few modes may have been overlooked; if it is not that,
// there is no use in weighing modes against noise.
void ModeSearch::rescue() {
  if (exceeds_noise()) current_ = refined(current_.modes, kLast);
  for (int attempt = 0; attempt < kRescues && exceeds_noise() && add_mode(); ++attempt) {
  }
}

// ---- weights ----

void ModeSearch::set_weights() {
  double largest_rms = 0;
  for (const Curve& curve : data_.curves) largest_rms = std::max(largest_rms, curve.h.norm());
  largest_rms /= std::sqrt(static_cast<double>(data_.lines()));
  for (std::size_t e = 0; e < data_.curves.size(); ++e) {
    Curve& curve = data_.curves[e];
    // A curve of exact zeros is as sure as the largest one.
    const double own_rms = std::sqrt(curve.h.squaredNorm() / static_cast<double>(data_.lines()));
    const double rms = own_rms > 0 ? own_rms : largest_rms;
    const double of_rms = limited_by_model_ ? kModelErrorFloor : kRmsShare * floor_;
    curve.weight =
        (variance_[e].array() + floor_ * floor_ * curve.h.array().abs2() + std::pow(of_rms * rms, 2))
            .inverse();
  }
}

// Noise from what the model leaves.
void ModeSearch::reweight() {
  for (std::size_t e = 0; e < data_.curves.size(); ++e) {
    const Curve& curve = data_.curves[e];
    const Eigen::VectorXcd model = curve_of(current_.modes, curve, data_.s);
    variance_[e] = dynamics::estimated_variance(data_.s.imag(), model - curve.h, model.cwiseAbs(), floors_);
  }
  set_weights();
  current_ = refined(current_.modes, kBetween);
}

// The same once the modes are known, from all of the residual: the fewer the numbers that describe the noise,
// the surer the weights. What is left in some places only may be modes; if it is not, the noise is larger
// there.
void ModeSearch::settle_noise() {
  for (const bool local_allowed : {false, true}) {
    const double parameters = parameters_per_mode() * static_cast<double>(current_.modes.size());
    const double correction = data_.values() / std::max(data_.values() - parameters, 1.0);
    bool local = false, changed = false;
    for (std::size_t e = 0; e < data_.curves.size(); ++e) {
      const Curve& curve = data_.curves[e];
      const Eigen::VectorXcd model = curve_of(current_.modes, curve, data_.s);
      const dynamics::ResidualNoise noise =
          dynamics::residual_noise(model - curve.h, model.cwiseAbs(), floors_);
      const Eigen::VectorXd now = correction * (local_allowed && noise.is_local ? noise.local : noise.smooth);
      changed = changed || (now.array() > kOtherNoise * variance_[e].array()).any() ||
                (variance_[e].array() > kOtherNoise * now.array()).any();
      variance_[e] = now;
      local = local || noise.is_local;
    }
    set_weights();
    current_ = refined(current_.modes, kBetween);
    if (changed) select();
    if (!local) return;
  }
}

RefinedModes ModeSearch::refined(const std::vector<dynamics::Mode>& modes, const Effort& effort) const {
  return refine_modes(data_, modes, model_, effort);
}

void ModeSearch::change_model(ModeModel model) {
  model_ = model;
  current_ = refined(current_.modes, kLast);
  if (!exceeds_noise()) {
    select();  // each has its own price
    current_ = refined(current_.modes, kLast);
  }
  limited_by_model_ = limited_by_model_ || exceeds_noise();
}

bool ModeSearch::exceeds_noise() const { return current_.chi_square / complex_values() > kModelErrorFactor; }

// Whether a residual can be noise, as far as so many lines can tell.
bool ModeSearch::is_white() const {
  return inflation_of(current_) <
         kLargestInflation + kInflationOfFewLines / static_cast<double>(data_.lines());
}

// More modes at one pole than there are directions: they stand for something else.
bool ModeSearch::is_crowded() const {
  for (const dynamics::Mode& mode : current_.modes) {
    const Complex pole = mode.pole();
    const auto near =
        std::count_if(current_.modes.begin(), current_.modes.end(), [&](const dynamics::Mode& other) {
          return std::abs(other.pole() - pole) < kOnePole * std::min(-other.pole().real(), -pole.real());
        });
    if (near > data_.dofs) return true;
  }
  return false;
}

// Whether the floor, not the noise, decides some weights.
bool ModeSearch::floor_matters() const {
  double share = 0;
  for (const Curve& curve : data_.curves) share += floor_ * floor_ * curve.h.cwiseAbs2().dot(curve.weight);
  return share > 0.01 * complex_values();
}

// Nearly no noise: the same again with all that the numbers hold, unless the model cannot follow.
void ModeSearch::tighten() {
  const RefinedModes coarse = current_;
  const double coarse_floor = std::exchange(floor_, kFineFloor);
  set_weights();
  current_ = refined(current_.modes, kBetween);
  if (estimate_noise_) reweight();
  select();
  if (!exceeds_noise()) return;
  floor_ = coarse_floor;
  set_weights();
  current_ = coarse;
}

// The model error takes over: curves weigh by their size, and modes are found from the strongest on.
void ModeSearch::build_up() {
  limited_by_model_ = true;
  set_weights();
  current_ = refined({}, kFirst);
  select();
  // It may have been the way to the noise that failed, not the model.
  const RefinedModes strongest = current_;
  limited_by_model_ = false;
  set_weights();
  current_ = refined(strongest.modes, kLast);
  if (!exceeds_noise() && is_white()) {
    select();
    return;
  }
  limited_by_model_ = true;
  set_weights();
  current_ = strongest;
}

// |model - h| / |h|, root mean square over the curves.
double ModeSearch::relative_error(const std::vector<dynamics::Mode>& modes) const {
  double sum = 0, curves = 0;
  for (const Curve& curve : data_.curves) {
    if (curve.h.isZero(0)) continue;
    sum += (curve_of(modes, curve, data_.s) - curve.h).squaredNorm() / curve.h.squaredNorm();
    ++curves;
  }
  return std::sqrt(sum / curves);
}

// ---- the price of a mode ----

double ModeSearch::parameters_per_mode() const {
  std::vector<bool> right(data_.dofs), left(right.size());
  for (const Curve& curve : data_.curves) {
    right[curve.response] = true;
    left[curve.reference] = true;
  }
  const auto hidden =
      std::count(right.begin(), right.end(), false) + std::count(left.begin(), left.end(), false);
  const Eigen::Index all = ModeParameters::per_mode(model_, data_.dofs);
  // The symmetric models show by one vector what the other hides.
  return static_cast<double>(model_ == ModeModel::kNonsymmetric ? all - 2 * hidden : all);
}

double ModeSearch::reduced_chi_square() const {
  const double parameters = parameters_per_mode() * static_cast<double>(current_.modes.size());
  return current_.chi_square / std::max(complex_values() - parameters / 2, 1.0);
}

double ModeSearch::inflation() const {
  return limited_by_model_ ? inflation_of(current_) : std::max(1.0, reduced_chi_square());
}

double ModeSearch::inflation_of(const RefinedModes& modes) const {
  double length = 0, curves = 0;
  for (const Curve& curve : data_.curves) {
    if (curve.h.isZero(0)) continue;
    const Eigen::VectorXcd residual = curve_of(modes.modes, curve, data_.s) - curve.h;
    length += dynamics::correlation_length(curve.weight.cwiseSqrt().cwiseProduct(residual));
    ++curves;
  }
  return std::max(1.0, modes.chi_square / complex_values()) * length / curves;
}

// Chi-square that a mode must take away: half its real parameters times the log of the number of values
// (Schwarz), and the log of how many lines it could have stood on, since noise is searched on all of them; of
// what the residual with the mode tells: one that is not made of modes prices all of them higher.
double ModeSearch::price(const RefinedModes& with, const RefinedModes& without) const {
  const double information =
      (parameters_per_mode() / 2) * std::log(data_.values()) + std::log(static_cast<double>(data_.lines()));
  if (limited_by_model_) {
    const double share = relative_error(without.modes) > kModelErrorFloor ? kLesserShare : kLargerShare;
    return std::max(information, share * without.chi_square);
  }
  return information * inflation_of(with);
}

// ---- candidates ----

// Poles that matter, of that many to start from.
Eigen::VectorXcd ModeSearch::find_poles(Eigen::Index pairs) const {
  Eigen::VectorXcd poles = starting_poles(data_, pairs);
  for (int i = 0; i < kRelocations; ++i) poles = relocate_poles(data_, poles);
  while (poles.size() > 1) {
    const LinearResidues linear = linear_residues(data_, poles);
    const double spread = std::max(1.0, linear.chi_square / complex_values());
    const double least = spread * static_cast<double>(2 * data_.curves.size()) * std::log(data_.values());
    std::vector<Eigen::Index> order(poles.size());
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return linear.removal_loss[a] < linear.removal_loss[b];
    });
    const auto worthless = std::count_if(order.begin(), order.end(),
                                         [&](Eigen::Index k) { return linear.removal_loss[k] < least; });
    if (worthless == 0) break;
    const auto dropped = std::clamp<std::ptrdiff_t>(worthless / 2, 1, worthless);
    std::vector<Eigen::Index> kept(order.begin() + dropped, order.end());
    std::sort(kept.begin(), kept.end());
    poles = poles(kept).eval();
    for (int i = 0; i < kRelocationsAfterPruning; ++i) poles = relocate_poles(data_, poles);
  }
  return poles;
}

void ModeSearch::find_modes() {
  Eigen::VectorXcd poles;
  // From more poles where nearly all of them matter.
  for (Eigen::Index pairs = kStartPairs; pairs <= kMostStartPairs; pairs *= 2) {
    poles = find_poles(std::min(pairs, data_.lines() / 3));
    if (5 * poles.size() < 3 * pairs || 3 * pairs >= data_.lines()) break;
  }
  current_ = refined(modes_at(poles), kFirst);
  try_rigid_body();
}

// Modes at the poles, each the nearest of rank one.
std::vector<dynamics::Mode> ModeSearch::modes_at(const Eigen::VectorXcd& poles) const {
  const LinearResidues linear = linear_residues(data_, poles);
  std::vector<dynamics::Mode> modes;
  for (Eigen::Index k = 0; k < poles.size(); ++k)
    modes.push_back(rank_one_mode(data_, poles[k], linear.residue.row(k)));
  return modes;
}

// A suspended structure moves as a rigid body, 1 / (m omega^2), from far below the lines: exact data of it
// draw several poles to the first lines, from where none finds its way. One mode per direction there instead
// of these, and of the heavily damped ones that help them, when it does as well.
void ModeSearch::try_rigid_body() {
  const double lo = data_.s[0].imag();
  std::vector<Complex> kept;
  for (const dynamics::Mode& mode : current_.modes) {
    const Complex pole = mode.pole();
    if (std::abs(pole) > kRigidReach * lo && mode.damping_ratio < kRigidDamping) kept.push_back(pole);
  }
  const std::size_t dropped = current_.modes.size() - kept.size();
  const std::size_t bodies = data_.dofs;
  if (dropped <= bodies) return;
  for (const double place : kRigidPlaces) {
    Eigen::VectorXcd poles(kept.size() + bodies);
    std::copy(kept.begin(), kept.end(), poles.begin());
    for (std::size_t d = 0; d < bodies; ++d)
      poles[kept.size() + d] = place * (1 + 0.1 * static_cast<double>(d)) * lo * Complex(-0.05, 1);
    const RefinedModes trial = refined(modes_at(poles), kFirst);
    const double saved = static_cast<double>(dropped - bodies) * price(trial, trial);
    if (trial.chi_square < current_.chi_square + saved) {
      current_ = trial;
      return;
    }
  }
}

// ---- selection ----

void ModeSearch::select() {
  for (int round = 0; round < 60; ++round) {
    remove_modes();
    if (progress_) progress_(std::min(0.99, 0.5 + 0.01 * round));
    if (!add_mode()) break;
  }
}

// Takes modes away, the least important first, as long as that costs less than they must be worth.
void ModeSearch::remove_modes() {
  const std::size_t least = wanted_modes_ ? static_cast<std::size_t>(*wanted_modes_) : 0;
  while (current_.modes.size() > least) {
    std::vector<std::size_t> order(current_.modes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(!is_too_narrow(current_.modes[a]), loss(a)) <
             std::pair(!is_too_narrow(current_.modes[b]), loss(b));
    });
    bool removed = false;
    for (std::size_t attempt = 0; attempt < std::min<std::size_t>(kRemovalTrials, order.size()) && !removed;
         ++attempt) {
      removed = remove_if_worthless(order[attempt]);
    }
    if (!removed) return;
  }
}

bool ModeSearch::remove_if_worthless(std::size_t k) {
  // The second-order loss is a good guess: no trial where it says that the mode matters beyond doubt.
  const bool forced = wanted_modes_.has_value() || is_too_narrow(current_.modes[k]);
  if (!forced && loss(k) > kBeyondDoubt * price(current_, current_)) return false;
  std::vector<dynamics::Mode> fewer = current_.modes;
  fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
  RefinedModes trial = refined(fewer, kRemoval);
  if (!forced && trial.chi_square - current_.chi_square >= price(current_, trial)) return false;
  current_ = std::move(trial);
  return true;
}

bool ModeSearch::is_too_narrow(const dynamics::Mode& mode) const {
  const Complex pole = mode.pole();
  const bool on_lines = pole.imag() >= data_.s[0].imag() && pole.imag() <= data_.s[data_.lines() - 1].imag();
  return on_lines && -pole.real() < kLeastHalfWidth * data_.line_spacing();
}

// Tries a mode where the residual asks most for one. True when it pays.
bool ModeSearch::add_mode() {
  if (wanted_modes_ && static_cast<int>(current_.modes.size()) >= *wanted_modes_) return false;
  std::vector<dynamics::Mode> more = current_.modes;
  more.push_back(best_addition(data_, current_.modes));
  RefinedModes trial = refined(more, kAddition);
  const double least_gain = wanted_modes_ ? 0.0 : price(trial, current_);
  if (!(current_.chi_square - trial.chi_square > least_gain)) return false;
  if (std::any_of(trial.modes.begin(), trial.modes.end(),
                  [&](const dynamics::Mode& mode) { return is_too_narrow(mode); })) {
    return false;
  }
  current_ = std::move(trial);
  return true;
}

}  // namespace stablecut::modal
