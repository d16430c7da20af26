#include "milling/simulated_growth.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
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
constexpr double kResidual = 1e-7, kPeriodic = 1e-9, kNothingLeft = 1e-14;
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
    for (const auto* part : parts(state)) {
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
    for (auto* part : parts(state)) {
      Eigen::Map<Eigen::VectorXd>(part->data(), part->size()) = v.segment(at, part->size());
      at += part->size();
    }
  }

 private:
  // Of a state, or of one that may be changed.
  template <typename State>
  auto parts(State& state) const -> std::vector<decltype(&state.surface)> {
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

// Arnoldi's method for the map of deviations over a cycle: after m steps the map of the basis is the basis
// times `hessenberg`, [m + 1 x m] [Arnoldi1951].
class Krylov {
 public:
  Krylov(const SimulatedCut& cut, const StateVector& form, const Eigen::VectorXd& start)
      : cut_(cut), form_(form), state_(cut.no_deviation()), basis_{start.normalized()} {
    most = std::min<int>(kMostVectors, static_cast<int>(start.size()));
    hessenberg = Eigen::MatrixXd::Zero(most + 1, most);
  }

  // Whether more steps can be made.
  bool step() {
    const int m = steps++;
    form_.put(basis_[m], state_);
    state_.period = 0;
    for (int period = 0; period < cut_.cycle(); ++period) cut_.advance_deviation(state_);
    Eigen::VectorXd v = form_.of(state_);
    const double size = v.norm();
    for (int again = 0; again < 2; ++again) {
      for (int i = 0; i <= m; ++i) {
        const double share = basis_[i].dot(v);
        hessenberg(i, m) += share;
        v -= share * basis_[i];
      }
    }
    hessenberg(m + 1, m) = v.norm();
    whole = hessenberg(m + 1, m) <= kNothingLeft * size || steps == v.size();
    if (whole || steps == most) return false;
    basis_.push_back(v / hessenberg(m + 1, m));
    return true;
  }

  Eigen::VectorXd vector(const Eigen::VectorXd& shares) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(basis_[0].size());
    for (Eigen::Index i = 0; i < shares.size(); ++i) sum += shares[i] * basis_[i];
    return sum;
  }

  int steps = 0, most = 0;
  bool whole = false;  // the basis holds all that the start reaches
  Eigen::MatrixXd hessenberg;

 private:
  const SimulatedCut& cut_;
  const StateVector& form_;
  SimulatedCut::State state_;
  std::vector<Eigen::VectorXd> basis_;
};

}  // namespace

SimulatedGrowth growth_of(const SimulatedCut& cut, double displacement_scale_m) {
  const StateVector form(cut, displacement_scale_m);
  Eigen::VectorXd start = form.of(cut.no_deviation());
  std::mt19937_64 generator(kSeed);
  for (double& value : start) value = numerics::uniform(generator, -1, 1);
  Krylov krylov(cut, form, start);
  SimulatedGrowth result;
  result.passes = cut.cycle() * cut.grid().passes;
  for (bool more = true; more;) {
    more = krylov.step();
    const int m = krylov.steps;
    if (more && m % kVectorsAtOnce != 0) continue;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(krylov.hessenberg.topLeftCorner(m, m));
    Eigen::Index leading = 0;
    const double radius = solver.eigenvalues().cwiseAbs().maxCoeff(&leading);
    result.multiplier = solver.eigenvalues()[leading];
    result.per_tooth = std::pow(radius, 1.0 / result.passes);
    // Of several close to each other one value is seen first, with their spread as its residual: as long as
    // that reaches beyond the largest value, a larger one may be among them.
    bool settled = true;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::VectorXcd vector = solver.eigenvectors().col(i);
      const double residual = krylov.hessenberg(m, m - 1) * std::abs(vector[m - 1]) / vector.norm();
      settled = settled && (residual <= kResidual * radius ||
                            (i != leading && std::abs(solver.eigenvalues()[i]) + residual < radius));
    }
    if (krylov.whole || settled) return result;
  }
  throw NoAnswer("the growth of simulated deviations does not settle", Remedy::kModes);
}

SimulatedCut::State periodic_state(const SimulatedCut& cut, double displacement_scale_m) {
  const StateVector form(cut, displacement_scale_m);
  // A cycle maps a deviation d from the rigid tool's state to M d + b: the one sought is its own image.
  SimulatedCut::State state = cut.at_rest();
  for (int period = 0; period < cut.cycle(); ++period) cut.advance_in_contact(state);
  const Eigen::VectorXd b = form.of(state) - form.of(cut.at_rest_later());
  state = cut.at_rest();
  if (b.isZero(0)) return state;
  Krylov krylov(cut, form, b);
  Eigen::VectorXd shares;
  for (bool more = true; more;) {
    more = krylov.step();
    const int m = krylov.steps;
    if (more && m % kVectorsAtOnce != 0) continue;
    Eigen::MatrixXd left = -krylov.hessenberg.topLeftCorner(m + 1, m);
    left.topRows(m) += Eigen::MatrixXd::Identity(m, m);
    const Eigen::VectorXd right = b.norm() * Eigen::VectorXd::Unit(m + 1, 0);
    shares = left.householderQr().solve(right);
    if ((left * shares - right).norm() <= kPeriodic * b.norm()) break;
  }
  const long period = state.period;
  form.put(form.of(state) + krylov.vector(shares), state);
  state.period = period;
  return state;
}

SimulatedGrowth simulated_growth(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                                 double revolutions_per_s, double depth_m) {
  const double omega = kTwoPi * revolutions_per_s;
  const double fastest = structure.modes() > 0 ? structure.lambda.imag().maxCoeff() / omega : 0;
  SimulationSteps steps;
  const double waves = fastest * cutter.mean_pitch_rad() / kTwoPi;
  if (kStepsPerWave * waves > kMostSteps)
    throw no_answer_at(revolutions_per_s, "the fastest mode turns too often to be simulated");
  steps.longest_rad =
      longest_step_rad(cutter, std::max(kLeastSteps, static_cast<int>(std::ceil(kStepsPerWave * waves))));
  steps.discs = static_cast<int>(std::ceil(kFirstDiscs + kDiscsPerRadian * (fastest + 2) *
                                                             cutter.largest_lag_rad_per_m() * depth_m / 2));
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
    steps.longest_rad /= 2;
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
