// The search for the modes of one independent group of directions.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "dynamics/noise.h"
#include "modal/fit_data.h"
#include "modal/maximum_likelihood.h"

namespace stablecut::modal {

/// Candidates by vector fitting, then a balance of likelihood: a mode stays when taking it away costs more
/// than its parameters are worth, and is added where the residual asks for one.
class ModeSearch {
 public:
  /// `variance` [curves][lines] of the noise; empty: estimated from the curves and from what the model
  /// leaves. The weights of `data` are set here. With `wanted_modes` that many are kept, whatever they are
  /// worth.
  ModeSearch(FitData data, std::vector<Eigen::VectorXd> variance, std::optional<int> wanted_modes);

  void run(const Progress& progress);
  /// After a run: the modes that were found, in another model with the same weights.
  void change_model(ModeModel model);

  const FitData& data() const { return data_; }
  ModeModel model() const { return model_; }
  const RefinedModes& result() const { return current_; }
  /// The residual is larger than the noise, and not made of modes.
  bool limited_by_model() const { return limited_by_model_; }
  /// The weights come from an estimate of the noise: none was given, or the residual is larger than it by
  /// far.
  bool noise_estimated() const { return estimate_noise_; }
  /// Number of complex values fitted.
  double complex_values() const { return data_.values() / 2; }
  /// Free real parameters of one mode, of those that some curve shows.
  double parameters_per_mode() const;
  /// How many times less the residual tells than its length: 1 where it is the noise, which is white; more
  /// where it is larger than a noise that was given, or limited by a model error also where it is smooth over
  /// lines.
  double inflation() const;
  /// Sum of |model - h|^2 / variance over the number of values less the parameters: 1 when noise is left.
  double reduced_chi_square() const;

 private:
  void rescue();
  void set_weights();
  void reweight();
  void settle_noise();
  RefinedModes refined(const std::vector<dynamics::Mode>& modes, const Effort& effort) const;
  double inflation_of(const RefinedModes& modes) const;
  bool exceeds_noise() const;
  bool is_white() const;
  bool is_crowded() const;
  bool floor_matters() const;
  void tighten();
  void build_up();
  double relative_error(const std::vector<dynamics::Mode>& modes) const;
  double price(const RefinedModes& with, const RefinedModes& without) const;

  Eigen::VectorXcd find_poles(Eigen::Index pairs) const;
  void find_modes();
  std::vector<dynamics::Mode> modes_at(const Eigen::VectorXcd& poles) const;
  void try_rigid_body();
  void select();
  void remove_modes();
  bool remove_if_worthless(std::size_t k);
  bool add_mode();
  double loss(std::size_t k) const { return current_.removal_loss[k]; }
  bool is_too_narrow(const dynamics::Mode& mode) const;

  FitData data_;
  std::vector<Eigen::VectorXd> variance_;  // of the noise, per curve
  dynamics::NoiseShapes floors_;
  ModeModel model_ = ModeModel::kNonsymmetric;
  bool estimate_noise_;
  std::optional<int> wanted_modes_;
  Progress progress_;
  bool limited_by_model_ = false;
  double floor_;
  RefinedModes current_;
};

}  // namespace stablecut::modal
