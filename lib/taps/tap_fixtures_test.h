// Records of hits on a known structure.
#pragma once

#include <cmath>
#include <complex>
#include <random>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "base/units.h"
#include "dynamics/synthesis.h"
#include "numerics/random.h"
#include "taps/record.h"
#include "taps/tap_campaign.h"

namespace stablecut::taps::fixtures {

struct Blow {
  double at_s, force_n;
};

/// Pulses of half a sine wave, 1 ms wide.
inline Eigen::VectorXd force_of(const std::vector<Blow>& blows, double rate, Eigen::Index samples) {
  constexpr double kWidth = 1e-3;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(samples);
  for (Eigen::Index i = 0; i < samples; ++i) {
    for (const Blow& blow : blows) {
      const double within = static_cast<double>(i) / rate - blow.at_s;
      if (within > 0 && within < kWidth) force[i] += blow.force_n * std::sin(kPi * within / kWidth);
    }
  }
  return force;
}

/// Gaussian pulses of 0.4 ms deviation: nothing above half of 10 kHz.
inline Eigen::VectorXd smooth_force_of(const std::vector<Blow>& blows, double rate, Eigen::Index samples) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(samples);
  for (Eigen::Index i = 0; i < samples; ++i) {
    for (const Blow& blow : blows) {
      const double off = (static_cast<double>(i) / rate - blow.at_s) / 4e-4;
      force[i] += blow.force_n * std::exp(-off * off / 2);
    }
  }
  return force;
}

/// Adds normal noise of this deviation.
inline void add_noise(Eigen::VectorXd& signal, double deviation, std::mt19937_64& generator) {
  for (double& value : signal) value += deviation * numerics::unit_normal(generator);
}

/// Two modes in x and y that a record of a second or two lets ring out.
inline dynamics::ModalModel structure() {
  using Complex = std::complex<double>;
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  const auto mode = [](double frequency_hz, double damping_ratio, Eigen::Vector2cd psi) {
    dynamics::Mode result;
    result.frequency_hz = frequency_hz;
    result.damping_ratio = damping_ratio;
    result.psi_r = psi;
    result.psi_l = psi;
    return dynamics::normalised(result);
  };
  // psi^2 = 1 / (2 i m w): real modes of 10 and 4 kg.
  model.modes = {mode(82, 0.02, Complex(1, -1) * Eigen::Vector2cd(7e-3, 3e-3)),
                 mode(310, 0.012, Complex(1, -1) * Eigen::Vector2cd(-2.5e-3, 5.5e-3))};
  return model;
}

/// What the structure's accelerometers show of `force` along `reference` (a row of the model), exactly as far
/// as the force has no content above half the rate: `samples` of a longer record, in which it comes to rest.
/// The force, and what the response would be, are taken through exp(-decay t), so that the responses are
/// those of a record that repeats after the longer time, damped by that much.
inline std::vector<Eigen::VectorXd> accelerations(const dynamics::ModalModel& model, Eigen::Index reference,
                                                  const Eigen::VectorXd& force, double rate,
                                                  double decay_per_s) {
  Eigen::Index length = 1;
  while (length < 2 * force.size()) length *= 2;
  const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(length, 0, static_cast<double>(length - 1)) / rate;
  Eigen::VectorXd damped = Eigen::VectorXd::Zero(length);
  damped.head(force.size()) = force.array() * (-decay_per_s * time.head(force.size())).exp();
  Eigen::FFT<double> transform;
  Eigen::VectorXcd spectrum;
  transform.fwd(spectrum, damped);
  std::vector<Eigen::VectorXcd> answers(model.dofs.size(), Eigen::VectorXcd::Zero(length));
  for (Eigen::Index k = 0; k <= length / 2; ++k) {
    const std::complex<double> s(decay_per_s,
                                 kTwoPi * rate * static_cast<double>(k) / static_cast<double>(length));
    const Eigen::VectorXcd column = dynamics::receptance_at(model, s).col(reference);
    for (std::size_t c = 0; c < answers.size(); ++c) {
      const std::complex<double> value = s * s * column[static_cast<Eigen::Index>(c)] * spectrum[k];
      answers[c][k] = k == 0 || k == length / 2 ? value.real() : value;
      if (k > 0 && k < length / 2) answers[c][length - k] = std::conj(value);
    }
  }
  std::vector<Eigen::VectorXd> result;
  for (const Eigen::VectorXcd& answer : answers) {
    Eigen::VectorXcd signal;
    transform.inv(signal, answer);
    result.emplace_back((signal.real().array() * (decay_per_s * time).exp()).matrix().head(force.size()));
  }
  return result;
}

inline constexpr double kRate = 10240;  // samples a second

/// What the structure shows of blows along x, without noise.
inline Record exact_record(const std::vector<Blow>& blows, double seconds, double decay_per_s) {
  const auto samples = static_cast<Eigen::Index>(seconds * kRate);
  Record record{kRate, smooth_force_of(blows, kRate, samples), {}};
  record.responses = accelerations(structure(), 0, record.force, kRate, decay_per_s);
  return record;
}

inline TapColumn column_of(Record record) { return {"x", {"x", "y"}, {std::move(record)}}; }

/// Accelerance of the structure on the campaign's lines, s = i omega + decay.
inline std::complex<double> accelerance(const dynamics::FrequencyResponse& frf, Eigen::Index line,
                                        Eigen::Index row) {
  const std::complex<double> s(frf.window_decay_per_s, kTwoPi * frf.frequency_hz[line]);
  return s * s * dynamics::receptance_at(structure(), s)(row, 0);
}

}  // namespace stablecut::taps::fixtures
