#include "milling/simulated_growth.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "base/units.h"
#include "milling/period.h"
#include "numerics/random.h"

namespace stablecut::milling {
namespace {

constexpr double kStepsPerWave = 16;
constexpr int kLeastSteps = 48, kMostSteps = 40000;  // of a pitch
constexpr double kFirstDiscs = 4, kDiscsPerRadian = 0.6;
constexpr double kSettledGrowth = 1e-3;  // change of the growth by twice the steps
constexpr int kMostDoublings = 4;
constexpr double kResidual = 1e-7;
constexpr int kMostVectors = 300, kVectorsAtOnce = 10;
constexpr unsigned kSeed = 1;

// A state as a vector: modes as displacements, and what the surface keeps.
class StateVector {
 public:
  StateVector(const SimulatedCut& cut, double scale_m)
      : with_passing_(cut.grid().shift == 0), scale_m_(scale_m) {}

  Eigen::VectorXd of(const SimulatedCut::State& state) const {
    const Eigen::Index modes = state.modes.size();
    Eigen::VectorXd v(2 * modes + size(state));
    v.head(modes) = scale_m_ * state.modes.real();
    v.segment(modes, modes) = scale_m_ * state.modes.imag();
    Eigen::Index at = 2 * modes;
    for (const std::vector<double>* part : parts(state)) {
      v.segment(at, part->size()) = Eigen::Map<const Eigen::VectorXd>(part->data(), part->size());
      at += part->size();
    }
    return v;
  }
  void put(const Eigen::VectorXd& v, SimulatedCut::State& state) const {
    const Eigen::Index modes = state.modes.size();
    state.modes.real() = v.head(modes) / scale_m_;
    state.modes.imag() = v.segment(modes, modes) / scale_m_;
    Eigen::Index at = 2 * modes;
    for (const std::vector<double>* part : parts(state)) {
      Eigen::Map<Eigen::VectorXd>(const_cast<double*>(part->data()), part->size()) =
          v.segment(at, part->size());
      at += part->size();
    }
  }

 private:
  std::vector<const std::vector<double>*> parts(const SimulatedCut::State& state) const {
    if (!with_passing_) return {&state.surface};
    return {&state.surface, &state.passing, &state.one_back, &state.two_back};
  }
  Eigen::Index size(const SimulatedCut::State& state) const {
    Eigen::Index sum = 0;
    for (const auto* part : parts(state)) sum += part->size();
    return sum;
  }
  bool with_passing_;
  double scale_m_;
};

}  // namespace

SimulatedGrowth growth_of(const SimulatedCut& cut, double displacement_scale_m) {
  const StateVector form(cut, displacement_scale_m);
  SimulatedCut::State state = cut.no_deviation();
  Eigen::VectorXd v = form.of(state);
  std::mt19937_64 generator(kSeed);
  for (double& value : v) value = numerics::uniform(generator, -1, 1);
  const int most = std::min<int>(kMostVectors, static_cast<int>(v.size()));
  std::vector<Eigen::VectorXd> basis = {v.normalized()};
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most + 1, most);
  SimulatedGrowth result;
  result.passes = cut.cycle() * cut.grid().passes;
  for (int m = 0; m < most; ++m) {
    form.put(basis[m], state);
    state.period = 0;
    for (int period = 0; period < cut.cycle(); ++period) cut.advance_deviation(state);
    v = form.of(state);
    const double size = v.norm();
    for (int again = 0; again < 2; ++again) {
      for (int i = 0; i <= m; ++i) {
        const double share = basis[i].dot(v);
        h(i, m) += share;
        v -= share * basis[i];
      }
    }
    h(m + 1, m) = v.norm();
    const bool whole = m + 1 == most || h(m + 1, m) <= 1e-14 * size;
    if (whole || (m + 1) % kVectorsAtOnce == 0) {
      const Eigen::EigenSolver<Eigen::MatrixXd> solver(h.topLeftCorner(m + 1, m + 1));
      Eigen::Index leading = 0;
      const double radius = solver.eigenvalues().cwiseAbs().maxCoeff(&leading);
      result.multiplier = solver.eigenvalues()[leading];
      result.per_tooth = std::pow(radius, 1.0 / result.passes);
      const Eigen::VectorXcd last = solver.eigenvectors().col(leading);
      if (h(m + 1, m) * std::abs(last[m]) <= kResidual * radius * last.norm()) return result;
      if (whole) break;
    }
    basis.push_back(v / h(m + 1, m));
  }
  if (most == v.size()) return result;
  throw NoAnswer("the growth of the simulated deviations does not settle", Remedy::kModes);
}

SimulatedGrowth simulated_growth(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                                 double revolutions_per_s, double depth_m) {
  const double omega = kTwoPi * revolutions_per_s;
  const double fastest = structure.modes() > 0 ? structure.lambda.imag().maxCoeff() / omega : 0;
  SimulationSteps steps;
  const double waves = fastest * cutter.mean_pitch_rad() / kTwoPi;
  if (kStepsPerWave * waves > kMostSteps)
    throw no_answer_at(revolutions_per_s, "the fastest mode turns too often to be simulated");
  steps.per_pitch = std::max(kLeastSteps, static_cast<int>(std::ceil(kStepsPerWave * waves)));
  steps.discs = static_cast<int>(std::ceil(kFirstDiscs + kDiscsPerRadian * (fastest + 2) *
                                                             std::abs(cutter.lag_rad_per_m) * depth_m / 2));
  steps.in_cut = true;
  const auto growth = [&] {
    SimulatedGrowth found =
        growth_of(SimulatedCut(structure, cutter, load, revolutions_per_s, depth_m, steps),
                  structure.displacement_scale_m);
    found.steps = steps;
    return found;
  };
  SimulatedGrowth before = growth();
  for (int doubling = 0;; ++doubling) {
    steps.per_pitch *= 2;
    steps.discs += (steps.discs + 1) / 2;
    SimulatedGrowth found = growth();
    const double change = found.per_tooth - before.per_tooth;
    found.error = std::abs(change) / found.per_tooth;
    if (found.error < kSettledGrowth || doubling == kMostDoublings) {
      // The error falls with the square of the step.
      found.per_tooth += change / 3;
      return found;
    }
    before = found;
  }
}

}  // namespace stablecut::milling
