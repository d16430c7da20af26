// How near fits come to the Cramer-Rao bound, how often they find the right number of modes, and how often
// their 95 % intervals cover the true value: over seeds, without a variance in the data.
//
//   fit_benchmark TABLE [SEEDS]     TABLE: the modal table of the 15-mode case
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>

#include "base/parallel.h"
#include "base/seconds_benchmark.h"
#include "base/units.h"
#include "document/kinds/modal_table_json.h"
#include "dynamics/synthesis.h"
#include "modal/fit.h"
#include "modal/fit_data.h"
#include "modal/fitted_table.h"
#include "numerics/random.h"

using namespace stablecut;
using Complex = std::complex<double>;

namespace {

// Random vectors; modes of equal static compliance.
dynamics::Mode random_mode(double frequency_hz, double damping_ratio, std::mt19937_64& random) {
  dynamics::Mode mode;
  mode.frequency_hz = frequency_hz;
  mode.damping_ratio = damping_ratio;
  const double scale = std::sqrt(kTwoPi * frequency_hz * 1e-7);
  mode.psi_r =
      scale * Eigen::Vector2cd(numerics::unit_complex_normal(random), numerics::unit_complex_normal(random));
  mode.psi_l =
      scale * Eigen::Vector2cd(numerics::unit_complex_normal(random), numerics::unit_complex_normal(random));
  return dynamics::normalised(mode);
}

// Two close pairs and two heavily damped modes among others.
dynamics::ModalModel hard_case(std::uint64_t seed) {
  constexpr double kPoles[][2] = {{120, 0.01},  {121.8, 0.012}, {260, 0.12}, {430, 0.03},
                                  {640, 0.008}, {648, 0.01},    {905, 0.2},  {1400, 0.02}};
  std::mt19937_64 random(seed);
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  for (const auto& pole : kPoles) model.modes.push_back(random_mode(pole[0], pole[1], random));
  return model;
}

// 1 to 30 modes anywhere, damped by 0.3 to 20 %.
dynamics::ModalModel any_case(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  const double count = 1 + std::floor(30 * numerics::uniform(random, 0, 1));
  for (int k = 0; k < count; ++k) {
    const double frequency_hz = 20 * std::pow(90, numerics::uniform(random, 0, 1));
    model.modes.push_back(
        random_mode(frequency_hz, 0.003 * std::pow(67, numerics::uniform(random, 0, 1)), random));
  }
  std::sort(model.modes.begin(), model.modes.end(),
            [](const dynamics::Mode& a, const dynamics::Mode& b) { return a.frequency_hz < b.frequency_hz; });
  return model;
}

struct Case {
  const char* name;
  std::function<dynamics::ModalModel(std::uint64_t)> truth;  // by seed
  Eigen::VectorXd lines_hz;
  std::optional<double> relative_db, floor_db;
};

// Of one run.
struct Outcome {
  bool resolvable = false;  // every bound below a fifth of its half width
  std::size_t modes = 0, wanted = 0;
  std::vector<double> error;  // |pole error| / bound, by true mode
  std::size_t inside = 0, parameters = 0;
  double seconds = 0;
};

// The curves of exact receptances, weighted by the noise's true variance.
modal::FitData exact_data(const dynamics::ModalModel& truth, const Case& c,
                          const dynamics::FrequencyResponse& noisy) {
  modal::FitData data;
  data.s = Complex(0, kTwoPi) * c.lines_hz.cast<Complex>();
  data.dofs = 2;
  const dynamics::FrequencyResponse exact = dynamics::synthesize(truth, c.lines_hz);
  for (std::size_t e = 0; e < exact.entries.size(); ++e) {
    data.curves.push_back({truth.dof(exact.entries[e].response), truth.dof(exact.entries[e].reference),
                           exact.entries[e].h, noisy.entries[e].variance.cwiseInverse()});
  }
  return data;
}

Eigen::VectorXd parameters_of(const dynamics::Mode& mode) {
  Eigen::VectorXd p(10);
  p << mode.frequency_hz, mode.damping_ratio, mode.psi_r[0].real(), mode.psi_r[0].imag(),
      mode.psi_r[1].real(), mode.psi_r[1].imag(), mode.psi_l[0].real(), mode.psi_l[0].imag(),
      mode.psi_l[1].real(), mode.psi_l[1].imag();
  return p;
}

Outcome run(const Case& c, std::uint64_t seed) {
  const dynamics::ModalModel truth = c.truth(seed);
  dynamics::FrequencyResponse measured = dynamics::synthesize(truth, c.lines_hz);
  dynamics::add_noise(measured, {c.relative_db, c.floor_db, seed});
  const modal::FittedTable bound =
      modal::fitted_table(exact_data(truth, c, measured), truth.modes, modal::ModeModel::kNonsymmetric);
  for (auto& entry : measured.entries) entry.variance.resize(0);
  Outcome outcome;
  modal::ModalFit fit;
  outcome.seconds = seconds([&] { fit = modal::fit_modes(measured); });
  outcome.modes = fit.model.modes.size();
  outcome.wanted = truth.modes.size();
  outcome.resolvable = true;
  std::vector<bool> taken(fit.model.modes.size());
  for (std::size_t k = 0; k < truth.modes.size(); ++k) {
    const dynamics::Mode mode = dynamics::normalised(truth.modes[k]);
    const Complex lambda = mode.pole();
    // Frequency and damping move the pole at right angles.
    const Eigen::Index at = 10 * k;
    const double pole_bound =
        std::abs(lambda) *
        std::sqrt(bound.covariance(at, at) / std::pow(mode.frequency_hz, 2) +
                  bound.covariance(at + 1, at + 1) / (1 - std::pow(mode.damping_ratio, 2)));
    outcome.resolvable = outcome.resolvable && pole_bound < -lambda.real() / 5;
    std::size_t nearest = 0;
    double distance = 1e300;
    for (std::size_t i = 0; i < fit.model.modes.size(); ++i) {
      const double d = std::abs(fit.model.modes[i].pole() - lambda);
      if (!taken[i] && d < distance) {
        distance = d;
        nearest = i;
      }
    }
    outcome.error.push_back(distance / pole_bound);
    if (distance > 1e299) continue;
    taken[nearest] = true;
    if (outcome.modes != outcome.wanted) continue;
    const Eigen::VectorXd off = (parameters_of(fit.model.modes[nearest]) - parameters_of(mode)).cwiseAbs();
    const Eigen::VectorXd deviation = fit.model.deviation(nearest);
    outcome.parameters += 10;
    outcome.inside += static_cast<std::size_t>((off.array() <= 1.959964 * deviation.array()).count());
  }
  return outcome;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  std::ifstream file(argv[1]);
  const document::Source source{argv[1], std::string(std::istreambuf_iterator<char>(file), {})};
  const dynamics::ModalModel thesis = document::modal_table_from_json(document::parse_json(source), source);
  const std::size_t seeds = argc > 2 ? std::atoi(argv[2]) : 50;
  const Eigen::VectorXd thesis_lines = Eigen::VectorXd::LinSpaced(3993, 2, 1000);
  const Eigen::VectorXd hard_lines = Eigen::VectorXd::LinSpaced(2048, 1, 2000);
  const auto of_thesis = [&](std::uint64_t) { return thesis; };
  const Case cases[] = {{"15 modes, noise 40 dB below |H|", of_thesis, thesis_lines, 40.0, {}},
                        {"15 modes, 30 dB below |H|", of_thesis, thesis_lines, 30.0, {}},
                        {"15 modes, floor 40 dB below RMS", of_thesis, thesis_lines, {}, 40.0},
                        {"8 modes, floor 40 dB below RMS", hard_case, hard_lines, {}, 40.0},
                        {"8 modes, floor 30 dB below RMS", hard_case, hard_lines, {}, 30.0},
                        {"8 modes, noise 40 dB below |H|", hard_case, hard_lines, 40.0, {}},
                        {"1 to 30 modes, floor 40 dB", any_case, hard_lines, {}, 40.0},
                        {"1 to 30 modes, 40 dB below |H|", any_case, hard_lines, 40.0, {}}};
  std::printf("fit-modes over %zu seeds, no variance given\n", seeds);
  std::printf("  %-34s %10s %10s %16s %9s %8s\n", "", "resolvable", "right", "worst RMS/bound", "inside",
              "s a fit");
  std::size_t inside = 0, parameters = 0;
  for (const Case& c : cases) {
    std::vector<Outcome> outcomes(seeds);
    parallel_for(seeds, 2, [&](std::size_t i) { outcomes[i] = run(c, i + 1); }, {});
    std::size_t resolvable = 0, right = 0, in = 0, of = 0;
    double seconds = 0;
    Eigen::VectorXd square = Eigen::VectorXd::Zero(30);
    for (std::size_t i = 0; i < seeds; ++i) {
      const Outcome& o = outcomes[i];
      resolvable += o.resolvable;
      right += o.resolvable && o.modes == o.wanted;
      in += o.inside;
      of += o.parameters;
      seconds += o.seconds;
      for (std::size_t k = 0; k < o.error.size() && o.resolvable; ++k) square[k] += o.error[k] * o.error[k];
    }
    Eigen::Index worst = 0;
    const double rms =
        std::sqrt(square.maxCoeff(&worst) / static_cast<double>(std::max<std::size_t>(1, resolvable)));
    std::printf("  %-34s %10zu %10zu %9.2f (%2ld) %8.1f%% %8.3f\n", c.name, resolvable, right, rms,
                static_cast<long>(worst + 1),
                100.0 * static_cast<double>(in) / static_cast<double>(std::max<std::size_t>(1, of)),
                seconds / static_cast<double>(seeds));
    std::fflush(stdout);
    inside += in;
    parameters += of;
  }
  std::printf("  all: %.2f %% of %zu parameters inside their 95 %% intervals\n",
              100.0 * static_cast<double>(inside) / static_cast<double>(parameters), parameters);
}
