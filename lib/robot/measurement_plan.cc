#include "robot/measurement_plan.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kGain = 1e-9;  // least gain of the log determinant that an exchange is made for
constexpr double kRidge =
    1e-6;  // of a candidate's mean information, added while the first choices span too little
constexpr int kMostExchanges = 100000;
constexpr long long kMostLooks = 30'000'000;  // at stretches to turn round: some tenths of a second

using Information = std::vector<Eigen::MatrixXd>;

double log_determinant(const Eigen::MatrixXd& information) {
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

// The information A_s^T A_s of each candidate s on the unknowns of the columns of `a`, in units of `scale`.
Information information_of_each(const Eigen::MatrixXd& a, const Eigen::VectorXd& scale,
                                const std::vector<int>& sample, std::size_t candidates) {
  const Eigen::MatrixXd scaled = a * scale.cwiseInverse().asDiagonal();
  Information information(candidates, Eigen::MatrixXd::Zero(a.cols(), a.cols()));
  for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
    information[sample[i]] += scaled.row(i).transpose() * scaled.row(i);
  }
  return information;
}

struct Addition {
  double log_determinant = -std::numeric_limits<double>::infinity();
  int candidate = 0;
};

// The candidate that adds most to `base`, of those that are not taken.
Addition best_addition(const Information& information, const Eigen::MatrixXd& base,
                       const std::vector<bool>& taken) {
  Addition best;
  for (std::size_t k = 0; k < information.size(); ++k) {
    if (taken[k]) continue;
    const double value = log_determinant(base + information[k]);
    if (value > best.log_determinant + kGain) best = {value, static_cast<int>(k)};
  }
  return best;
}

// Greedy, then exchanges of one for another until none of the chosen gains by one.
std::vector<int> choose(const Information& information, const PlanOptions& options) {
  const Eigen::Index n = information.front().rows();
  std::vector<int> chosen;
  std::vector<bool> taken(information.size(), false);
  Eigen::MatrixXd sum = kRidge * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < options.count; ++i) {
    chosen.push_back(best_addition(information, sum, taken).candidate);
    taken[chosen.back()] = !options.repeats;
    sum += information[chosen.back()];
  }
  for (int exchanges = 0, idle = 0; idle < options.count && exchanges < kMostExchanges; ++exchanges) {
    int& one = chosen[exchanges % options.count];
    const Eigen::MatrixXd without = sum - information[one];
    const Addition best = best_addition(information, without, taken);
    ++idle;
    if (best.log_determinant > log_determinant(sum) + kGain) {
      taken[one] = false;
      one = best.candidate;
      taken[one] = !options.repeats;
      sum = without + information[one];
      idle = 0;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

// The largest turn of a joint between two candidates' poses.
double move_rad(const std::vector<LoadSample>& candidates, int from, int to) {
  return (candidates[from].angles - candidates[to].angles).cwiseAbs().maxCoeff();
}

// An order of short moves: always the nearest that is left, then stretches turned round while that gains
// [Croes1958].
double order_for_short_moves(const std::vector<LoadSample>& candidates, std::vector<int>& chosen) {
  const std::size_t n = chosen.size();
  for (std::size_t i = 1; i < n; ++i) {
    const auto nearest = std::min_element(chosen.begin() + i, chosen.end(), [&](int a, int b) {
      return move_rad(candidates, chosen[i - 1], a) < move_rad(candidates, chosen[i - 1], b);
    });
    std::rotate(chosen.begin() + i, nearest, nearest + 1);  // the rest keeps its order
  }
  long long looks = 0;
  for (bool gained = true; gained && looks < kMostLooks;) {
    gained = false;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      for (std::size_t k = i + 1; k < n; ++k, ++looks) {
        // chosen[i + 1 .. k] turned round: the moves at its two ends change.
        double change =
            move_rad(candidates, chosen[i], chosen[k]) - move_rad(candidates, chosen[i], chosen[i + 1]);
        if (k + 1 < n) {
          change += move_rad(candidates, chosen[i + 1], chosen[k + 1]) -
                    move_rad(candidates, chosen[k], chosen[k + 1]);
        }
        if (!(change < -kGain)) continue;
        std::reverse(chosen.begin() + i + 1, chosen.begin() + k + 1);
        gained = true;
      }
    }
  }
  double sum = 0;
  for (std::size_t i = 1; i < n; ++i) sum += move_rad(candidates, chosen[i - 1], chosen[i]);
  return sum;
}

Identifiability identifiability_of(const std::vector<int>& chosen, const std::vector<int>& sample,
                                   const Eigen::MatrixXd& a, const Eigen::MatrixXd& largest) {
  std::vector<Eigen::Index> rows;
  for (const int k : chosen) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (sample[i] == k) rows.push_back(i);
    }
  }
  return identifiability(a(rows, Eigen::all), largest(rows, Eigen::all), a.cols());
}

}  // namespace

MeasurementPlan plan_measurements(const Robot& robot, const std::vector<LoadSample>& candidates,
                                  const PlanOptions& options) {
  const ComplianceEquations equations =
      compliance_equations(robot, joint_springs(), candidates, options.components);
  if (equations.std.size() == 0)
    throw InvalidArgument("deviations: missing: expected one for every candidate");
  const Eigen::MatrixXd a = equations.std.cwiseInverse().asDiagonal() * equations.a;
  const Eigen::MatrixXd largest = equations.std.cwiseInverse().asDiagonal() * equations.largest;
  const Identifiability all = identifiability(a, largest, a.cols());
  if (all.rank == 0) throw NoAnswer("none of these poses and loads sees any joint");
  const Eigen::Index n = all.independent.size();
  const std::vector<Eigen::Index> columns(all.independent.begin(), all.independent.end());
  const Eigen::MatrixXd part = a(Eigen::all, columns);
  const Eigen::VectorXd scale = part.colwise().norm() / std::sqrt(static_cast<double>(candidates.size()));
  const Information information = information_of_each(part, scale, equations.sample, candidates.size());

  MeasurementPlan plan;
  if (!options.repeats && options.count > static_cast<int>(candidates.size())) {
    throw NoAnswer("too few poses and loads: " + std::to_string(candidates.size()) + " for " +
                   std::to_string(options.count) + " different measurements");
  }
  plan.chosen = choose(information, options);
  plan.identifiability = identifiability_of(plan.chosen, equations.sample, a, largest);
  if (plan.identifiability.rank < all.rank) {
    throw NoAnswer("too few measurements: " + std::to_string(options.count) + " cannot tell the " +
                   std::to_string(all.rank) + " joints apart that these poses and loads can identify");
  }
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for (const int k : plan.chosen) sum += information[k];
  const Eigen::MatrixXd inverse = sum.llt().solve(Eigen::MatrixXd::Identity(n, n));
  plan.compliance_std.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int joint = all.independent[i];
    if (all.visibility[joint] == Visibility::kVisible) {
      plan.compliance_std[joint] = std::sqrt(inverse(i, i)) / scale[i];
    }
  }
  // No design has a larger determinant root than (largest trace / n) times this one's [Kiefer1960].
  double trace = 0;
  for (const auto& m : information) trace = std::max(trace, (inverse * m).trace() * options.count);
  plan.efficiency = std::min(1.0, static_cast<double>(n) / trace);
  plan.moves_rad = order_for_short_moves(candidates, plan.chosen);
  return plan;
}

JointAngles std_with_discrepancy(const Robot& robot, const std::vector<LoadSample>& candidates,
                                 const PlanOptions& options, const MeasurementPlan& plan,
                                 const JointAngles& joint_compliance, const Discrepancy& discrepancy) {
  std::vector<LoadSample> measured;
  for (const int k : plan.chosen) measured.push_back(candidates[k]);
  const ComplianceEquations equations =
      compliance_equations(robot, joint_springs(), measured, options.components);
  const Eigen::VectorXd predicted = equations.a * joint_compliance;
  std::vector<double> squares(measured.size(), 0);
  for (std::size_t i = 0; i < equations.sample.size(); ++i)
    squares[equations.sample[i]] += predicted[i] * predicted[i];
  Eigen::VectorXd variance = equations.std.cwiseAbs2();
  for (Eigen::Index i = 0; i < variance.size(); ++i)
    variance[i] += discrepancy.variance(std::sqrt(squares[equations.sample[i]]));
  // Least squares with the gauges' deviations as weights, its errors those variances.
  const std::vector<int>& joints = plan.identifiability.independent;
  const Eigen::MatrixXd a = equations.std.cwiseInverse().asDiagonal() * equations.a(Eigen::all, joints);
  const Eigen::MatrixXd inverse = inverse_normal_matrix(a);
  const Eigen::VectorXd ratio = variance.cwiseQuotient(equations.std.cwiseAbs2());
  const Eigen::MatrixXd covariance = inverse * a.transpose() * ratio.asDiagonal() * a * inverse;
  JointAngles std = JointAngles::Constant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (std::isfinite(plan.compliance_std[joints[i]])) std[joints[i]] = std::sqrt(covariance(i, i));
  }
  return std;
}

}  // namespace stablecut::robot
