#include "robot/measurement_plan.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"

namespace stablecut::robot {
namespace {

constexpr double kGain = 1e-9;  // least gain of the log determinant that an exchange is made for
constexpr double kRidge =
    1e-6;  // of a candidate's mean information, added while the first choices span too little
constexpr int kMostExchanges = 100000;

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

// The candidate that adds most to `base`.
Addition best_addition(const Information& information, const Eigen::MatrixXd& base) {
  Addition best;
  for (std::size_t k = 0; k < information.size(); ++k) {
    const double value = log_determinant(base + information[k]);
    if (value > best.log_determinant + kGain) best = {value, static_cast<int>(k)};
  }
  return best;
}

// Greedy, then exchanges of one for another until none of the chosen gains by one.
std::vector<int> choose(const Information& information, int count) {
  const Eigen::Index n = information.front().rows();
  std::vector<int> chosen;
  Eigen::MatrixXd sum = kRidge * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < count; ++i) {
    chosen.push_back(best_addition(information, sum).candidate);
    sum += information[chosen.back()];
  }
  for (int exchanges = 0, idle = 0; idle < count && exchanges < kMostExchanges; ++exchanges) {
    int& one = chosen[exchanges % count];
    const Eigen::MatrixXd without = sum - information[one];
    const Addition best = best_addition(information, without);
    ++idle;
    if (best.log_determinant > log_determinant(sum) + kGain) {
      one = best.candidate;
      sum = without + information[one];
      idle = 0;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Identifiability identifiability_of(const std::vector<int>& chosen, const std::vector<int>& sample,
                                   const Eigen::MatrixXd& a, const Eigen::MatrixXd& largest) {
  std::vector<Eigen::Index> rows;
  for (const int k : chosen) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (sample[i] == k) rows.push_back(i);
    }
  }
  return identifiability(a(rows, Eigen::all), largest(rows, Eigen::all));
}

}  // namespace

MeasurementPlan plan_measurements(const Robot& robot, const std::vector<LoadSample>& candidates,
                                  const std::array<bool, 3>& components, int count) {
  const ComplianceEquations equations = compliance_equations(robot, candidates, components);
  if (equations.std.size() == 0)
    throw InvalidArgument("deviations: missing: expected one for every candidate");
  const Eigen::MatrixXd a = equations.std.cwiseInverse().asDiagonal() * equations.a;
  const Eigen::MatrixXd largest = equations.std.cwiseInverse().asDiagonal() * equations.largest;
  const Identifiability all = identifiability(a, largest);
  if (all.rank == 0) throw NoAnswer("none of these poses and loads sees any joint");
  const Eigen::Index n = all.independent.size();
  const std::vector<Eigen::Index> columns(all.independent.begin(), all.independent.end());
  const Eigen::MatrixXd part = a(Eigen::all, columns);
  const Eigen::VectorXd scale = part.colwise().norm() / std::sqrt(static_cast<double>(candidates.size()));
  const Information information = information_of_each(part, scale, equations.sample, candidates.size());

  MeasurementPlan plan;
  plan.chosen = choose(information, count);
  plan.identifiability = identifiability_of(plan.chosen, equations.sample, a, largest);
  if (plan.identifiability.rank < all.rank) {
    throw NoAnswer("too few measurements: " + std::to_string(count) + " cannot tell the " +
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
  for (const auto& m : information) trace = std::max(trace, (inverse * m).trace() * count);
  plan.efficiency = std::min(1.0, static_cast<double>(n) / trace);
  return plan;
}

}  // namespace stablecut::robot
