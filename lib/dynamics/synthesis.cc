#include "dynamics/synthesis.h"

#include <cmath>
#include <random>

#include "base/units.h"
#include "numerics/random.h"

namespace stablecut::dynamics {
Eigen::MatrixXcd receptance_at(const ModalModel& model, std::complex<double> s) {
  const Eigen::Index n = model.dofs.size();
  Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero(n, n);
  for (const Mode& mode : model.modes) {
    const std::complex<double> lambda = mode.pole();
    const Eigen::MatrixXcd residue = mode.residue();
    h += residue / (s - lambda) + residue.conjugate() / (s - std::conj(lambda));
  }
  return h;
}

FrequencyResponse synthesize(const ModalModel& model, const Eigen::VectorXd& frequency_hz) {
  FrequencyResponse frf;
  frf.frequency_hz = frequency_hz;
  for (const auto& response : model.dofs) {
    for (const auto& reference : model.dofs) {
      FrequencyResponseEntry entry;
      entry.response = response;
      entry.reference = reference;
      entry.h.resize(frequency_hz.size());
      frf.entries.push_back(std::move(entry));
    }
  }
  const Eigen::Index n = model.dofs.size();
  for (Eigen::Index line = 0; line < frequency_hz.size(); ++line) {
    const Eigen::MatrixXcd h = receptance_at(model, {0, rad_per_s_from_hz(frequency_hz[line])});
    for (Eigen::Index e = 0; e < n * n; ++e) {
      frf.entries[e].h[line] = h(e / n, e % n);
    }
  }
  return frf;
}

void add_noise(FrequencyResponse& frf, const NoiseLevel& level) {
  std::mt19937_64 generator(level.seed);
  const auto ratio = [](double db) { return std::pow(10.0, -db / 20); };
  for (auto& entry : frf.entries) {
    const auto lines = entry.h.size();
    entry.variance = Eigen::VectorXd::Zero(lines);
    if (level.relative_db) entry.variance += std::pow(ratio(*level.relative_db), 2) * entry.h.cwiseAbs2();
    if (level.floor_db && lines > 0) {
      const double mean_square = entry.h.squaredNorm() / static_cast<double>(lines);
      entry.variance.array() += std::pow(ratio(*level.floor_db), 2) * mean_square;
    }
    for (Eigen::Index line = 0; line < lines; ++line) {
      entry.h[line] += std::sqrt(entry.variance[line]) * numerics::unit_complex_normal(generator);
    }
  }
}

}  // namespace stablecut::dynamics
