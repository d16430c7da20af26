#include "milling/chatter_spectrum.h"

#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "base/units.h"

namespace stablecut::milling {

SpectralLine largest_line(const Eigen::Matrix2Xd& motion, int period, double samples_per_s) {
  const Eigen::Index n = motion.cols(), periods = n / period;
  Eigen::Matrix2Xd mean = Eigen::Matrix2Xd::Zero(2, period);
  for (Eigen::Index p = 0; p < periods; ++p) mean += motion.middleCols(p * period, period);
  mean /= static_cast<double>(periods);
  Eigen::FFT<double> transform;
  Eigen::VectorXd power = Eigen::VectorXd::Zero(n / 2 + 1);
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    std::vector<double> signal(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double window = 0.5 - 0.5 * std::cos(kTwoPi * static_cast<double>(i) / static_cast<double>(n));
      signal[i] = window * (motion(axis, i) - mean(axis, i % period));
    }
    std::vector<std::complex<double>> lines;
    transform.fwd(lines, signal);
    for (Eigen::Index k = 0; k < power.size(); ++k) power[k] += std::norm(lines[k]);
  }
  Eigen::Index top = 0;
  if (power.size() < 3 || !(power.segment(1, power.size() - 2).maxCoeff(&top) > 0)) return {};
  ++top;
  // Of Hann's window in logarithms: a parabola nearly.
  const double before = std::log(power[top - 1]), at = std::log(power[top]), after = std::log(power[top + 1]);
  const double bend = 2 * at - before - after;
  const double offset = bend > 0 && std::isfinite(bend) ? (after - before) / (2 * bend) : 0;
  // The window's mean is a half, and half of a line's amplitude lies at the negative frequency.
  return {(static_cast<double>(top) + offset) * samples_per_s / static_cast<double>(n),
          4 * std::sqrt(power[top]) / static_cast<double>(n)};
}

}  // namespace stablecut::milling
