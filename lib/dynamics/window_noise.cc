#include "dynamics/window_noise.h"

#include <cmath>

namespace stablecut::dynamics {

ModalModel with_window_noise(ModalModel model, const FrequencyResponse& measured) {
  const Eigen::Index lines = measured.frequency_hz.size();
  const double decay_per_s = measured.window_decay_per_s;
  if (!(decay_per_s > 0) || model.covariance.size() == 0 || lines < 2) return model;
  const double distance_hz =
      (measured.frequency_hz.tail(lines - 1) - measured.frequency_hz.head(lines - 1)).minCoeff();
  // Noise where the window begins over its mean.
  const double turns = 2 * decay_per_s / distance_hz;
  const double at_begin = turns / -std::expm1(-turns);
  const Eigen::Index own = model.parameters_per_mode();
  Eigen::VectorXd factors(model.covariance.rows());
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    const double decay = -model.modes[k].pole().real();
    const double r = decay / (decay + decay_per_s);
    auto of_mode = factors.segment(static_cast<Eigen::Index>(k) * own, own);
    of_mode.setConstant(std::sqrt(at_begin * r * (2 - 2 * r + r * r)));
    of_mode.head(2).setConstant(std::sqrt(at_begin * r * (1 - 2 * r + 2 * r * r)));
  }
  model.covariance = factors.asDiagonal() * model.covariance * factors.asDiagonal();
  return model;
}

}  // namespace stablecut::dynamics
