// Speed of the receptance room on one core, and how often the search for a joint misses the best one: random
// joints on random tools and holders, over seeds. README.md names its rows.
//
//   receptance_benchmark [JOINTS]     JOINTS: in each row (200)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "base/seconds_benchmark.h"
#include "numerics/random.h"
#include "receptance/joint_search.h"
#include "receptance/receptance_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::receptance;
using namespace stablecut::receptance::fixtures;

namespace {

double sink = 0;

void print_time(const std::string& what, double time, int count) {
  std::printf("  %-72s %8.2f us\n", what.c_str(), 1e6 * time / count);
}

void time_segments() {
  constexpr int kCount = 20000;
  for (const BeamTheory theory : kBoth) {
    const char* name = theory == BeamTheory::kTimoshenko ? "Timoshenko" : "Euler-Bernoulli";
    for (const double hz : {100.0, 8000.0}) {
      const double time = least_seconds([&] {
        for (int i = 0; i < kCount; ++i) {
          const double omega = rad_per_s_from_hz(hz + 1e-3 * i);
          sink += std::abs(fixed_free_receptance(bar(118.92), theory, omega)(0, 0));
        }
      });
      print_time(std::string("a held segment, ") + name + (hz < 1000 ? ", power series" : ", cos and cosh"),
                 time, kCount);
    }
  }
  const BeamChain tool = {bar(25), bar(25), bar(25), bar(43.92)};
  const double time = least_seconds([&] {
    for (int i = 0; i < kCount; ++i) {
      const double omega = rad_per_s_from_hz(100 + 0.2 * i);
      const Receptance<2> holder = fixed_free_receptance(bar(50.9), BeamTheory::kTimoshenko, omega);
      sink += std::abs(joint_plane<2>(tool, BeamTheory::kTimoshenko, omega, holder)
                           .tip(published_joint().stiffness(omega))(0, 0));
    }
  });
  print_time("a line: four segments, a joint, a holder of one segment, Timoshenko", time, kCount);
}

// ---- the search for a joint ----

struct Trial {
  JointData data;
  ToolJoint joint;
};

Eigen::VectorXcd tip_with(const JointData& data, const ToolJoint& joint) {
  Eigen::VectorXcd tip(data.omega_rad_per_s.size());
  for (Eigen::Index i = 0; i < tip.size(); ++i)
    tip[i] = data.plane[i].tip(joint.stiffness(data.omega_rad_per_s[i]))(0, 0);
  return tip;
}

// A stepped tool of 60 to 200 mm on a stub of 20 to 120 mm, 1000 lines of a random band, and a joint over six
// decades of stiffness and of damping.
Trial random_trial(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double from, double to) { return numerics::uniform(random, from, to); };
  BeamChain tool = {bar(uniform(20, 80)), bar(uniform(20, 60)), bar(uniform(20, 60))};
  for (BeamSegment& segment : tool) {
    segment.outer_diameter_m = uniform(0.006, 0.02);
    segment.loss_factor = std::pow(10, uniform(-3, -1.5));
  }
  BeamSegment stub = bar(uniform(20, 120));
  stub.outer_diameter_m = uniform(0.015, 0.06);
  stub.loss_factor = tool[0].loss_factor;
  Trial trial;
  const double from = uniform(20, 500);
  trial.data.omega_rad_per_s = Eigen::VectorXd::LinSpaced(1000, rad_per_s_from_hz(from),
                                                          rad_per_s_from_hz(from + uniform(1500, 8000)));
  for (const double omega : trial.data.omega_rad_per_s) {
    trial.data.plane.push_back(joint_plane<2>(tool, BeamTheory::kTimoshenko, omega,
                                              fixed_free_receptance(stub, BeamTheory::kTimoshenko, omega)));
  }
  const double k1 = std::pow(10, uniform(4, 10)), k2 = std::pow(10, uniform(1, 7));
  trial.joint = {k1, std::pow(10, uniform(-4, -0.5)) * k1 / 6000, k2,
                 std::pow(10, uniform(-4, -0.5)) * k2 / 6000};
  trial.data.tip = tip_with(trial.data, trial.joint);
  return trial;
}

void add_noise(Trial& trial, double floor, double share, std::uint64_t seed) {
  std::mt19937_64 random(seed + 1000000);
  const double size = trial.data.tip.norm() / std::sqrt(static_cast<double>(trial.data.tip.size()));
  for (auto& value : trial.data.tip)
    value += (floor * size + share * std::abs(value)) * numerics::unit_complex_normal(random);
}

// The least objective from the true joint and from 60 random joints, on all lines, with the weights of an
// unknown noise.
double least_objective(const Trial& trial, const JointBounds& bounds, JointObjective objective,
                       std::uint64_t seed) {
  TipLines lines;
  for (Eigen::Index i = 0; i < trial.data.tip.size(); ++i) {
    lines.emplace_back(trial.data.plane[i], trial.data.omega_rad_per_s[i], trial.data.tip[i]);
  }
  std::mt19937_64 random(seed + 2000000);
  double least = converged_joint(lines, trial.joint, bounds, objective).cost;
  for (int start = 0; start < 60; ++start) {
    JointValues values{};
    for (std::size_t i = 0; i < 4; ++i) {
      const double from = std::log(std::max(bounds.least[i], 1e-9 * bounds.most[i])),
                   to = std::log(bounds.most[i]);
      values[i] = std::exp(numerics::uniform(random, from, to));
    }
    least = std::min(least, converged_joint(lines, joint_of(values), bounds, objective).cost);
  }
  return std::sqrt(least);
}

struct Row {
  const char* what;
  double floor, share;  // noise over the root mean square of the tip, and over the value
  JointObjective objective;
  bool narrow;  // bounds that the true joint may lie outside of
};

// The relative error of a joint's tip, as the objective weighs it.
double error_of(const Trial& trial, const ToolJoint& joint, const Row& row) {
  Eigen::VectorXcd model = tip_with(trial.data, joint), measured = trial.data.tip;
  if (row.objective == JointObjective::kAmplitude)
    return (model.cwiseAbs() - measured.cwiseAbs()).norm() / measured.norm();
  if (row.share == 0) return (model - measured).norm() / measured.norm();
  return (model - measured).cwiseQuotient(measured).norm() / std::sqrt(static_cast<double>(measured.size()));
}

void count_missed(const Row& row, int joints) {
  JointBounds bounds;
  if (row.narrow) bounds = {{1e5, 0, 1e2, 0}, {1e8, 1e2, 1e5, 1}};
  int missed = 0;
  double worst = 0, time = 0;
  for (int n = 0; n < joints; ++n) {
    const auto seed = static_cast<std::uint64_t>(n + 1);
    Trial trial = random_trial(seed);
    add_noise(trial, row.floor, row.share, seed);
    // A noise that is known to be the same on all lines, so that no misfit is taken for another noise.
    if (row.narrow)
      trial.data.variance = Eigen::VectorXd::Constant(trial.data.tip.size(), trial.data.tip.squaredNorm());
    JointEstimate estimate;
    time += seconds([&] { estimate = identify_joint(trial.data, bounds, row.objective); });
    const double error = error_of(trial, estimate.joint, row);
    // Where no bound holds it back the true joint is the measure, else the best of many searches.
    const double least = row.narrow
                             ? least_objective(trial, bounds, row.objective, seed) / trial.data.tip.norm()
                             : error_of(trial, trial.joint, row);
    if (error > 1.001 * least + 1e-6) {
      ++missed;
      worst = std::max(worst, error / (least + 1e-6));
    }
  }
  std::printf("  %-40s %3d of %d missed", row.what, missed, joints);
  if (missed > 0) std::printf(" (by up to %.3g)", worst);
  std::printf(" %6.1f ms each\n", 1e3 * time / joints);
}

}  // namespace

int main(int argc, char** argv) {
  const int joints = argc > 1 ? std::atoi(argv[1]) : 200;
  std::printf("receptances, one core:\n");
  time_segments();
  std::printf("joints found, 1000 lines, seeds 1 to %d (a miss leaves a larger error than the best joint):\n",
              joints);
  constexpr JointObjective kComplex = JointObjective::kComplex, kAmplitude = JointObjective::kAmplitude;
  for (const Row& row :
       {Row{"no noise", 0, 0, kComplex, false}, Row{"no noise, amplitudes", 0, 0, kAmplitude, false},
        Row{"noise 40 dB below the RMS", 0.01, 0, kComplex, false},
        Row{"noise 20 dB below the RMS", 0.1, 0, kComplex, false},
        Row{"noise of 5 % of the value", 0, 0.05, kComplex, false},
        Row{"narrow bounds, 40 dB", 0.01, 0, kComplex, true}}) {
    count_missed(row, joints);
  }
  return sink > 0 ? 0 : 1;
}
