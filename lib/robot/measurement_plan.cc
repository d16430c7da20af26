#include "robot/measurement_plan.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"

namespace stablecut::robot {
namespace {

constexpr double kGain = 1e-9;   // least gain of the log determinant that an exchange is made for
constexpr double kRidge = 1e-6;  // of the candidates' mean information: the first few span too little
constexpr int kMostExchanges = 100000;

double log_determinant(const Eigen::MatrixXd& information) {
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
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
  if (all.rank == 0) throw NoAnswer("no joint is seen by any of the candidates");
  const Eigen::Index n = all.independent.size();
  std::vector<Eigen::Index> columns(all.independent.begin(), all.independent.end());

  // Information of each candidate, in units of the columns' lengths.
  const Eigen::MatrixXd part = a(Eigen::all, columns);
  const Eigen::VectorXd scale = part.colwise().norm() / std::sqrt(static_cast<double>(candidates.size()));
  const Eigen::MatrixXd scaled = part * scale.cwiseInverse().asDiagonal();
  std::vector<Eigen::MatrixXd> information(candidates.size(), Eigen::MatrixXd::Zero(n, n));
  for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
    information[equations.sample[i]] += scaled.row(i).transpose() * scaled.row(i);
  }

  // Greedy, then exchanges of one for another.
  MeasurementPlan plan;
  Eigen::MatrixXd sum = kRidge * Eigen::MatrixXd::Identity(n, n);
  const auto best_addition = [&](const Eigen::MatrixXd& base) {
    std::pair<double, int> best{-std::numeric_limits<double>::infinity(), 0};
    for (std::size_t k = 0; k < information.size(); ++k) {
      const double value = log_determinant(base + information[k]);
      if (value > best.first + kGain) best = {value, static_cast<int>(k)};
    }
    return best;
  };
  for (int i = 0; i < count; ++i) {
    const int k = best_addition(sum).second;
    plan.chosen.push_back(k);
    sum += information[k];
  }
  for (int exchanges = 0, idle = 0; idle < count && exchanges < kMostExchanges; ++exchanges) {
    const std::size_t i = exchanges % count;
    const Eigen::MatrixXd without = sum - information[plan.chosen[i]];
    const auto [value, k] = best_addition(without);
    ++idle;
    if (value > log_determinant(sum) + kGain) {
      sum = without + information[k];
      plan.chosen[i] = k;
      idle = 0;
    }
  }
  std::sort(plan.chosen.begin(), plan.chosen.end());

  std::vector<Eigen::Index> rows;
  for (const int k : plan.chosen) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (equations.sample[i] == k) rows.push_back(i);
    }
  }
  plan.identifiability = identifiability(a(rows, Eigen::all), largest(rows, Eigen::all));
  if (plan.identifiability.rank < all.rank) {
    throw NoAnswer("too few samples: " + std::to_string(count) + " cannot tell the " +
                   std::to_string(all.rank) + " joints apart that the candidates see: expected more");
  }
  sum.setZero();
  for (const int k : plan.chosen) sum += information[k];
  const Eigen::MatrixXd inverse = sum.llt().solve(Eigen::MatrixXd::Identity(n, n));
  plan.compliance_std.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int joint = all.independent[i];
    if (all.visibility[joint] == Visibility::kVisible) {
      plan.compliance_std[joint] = std::sqrt(inverse(i, i)) / scale[i];
    }
  }
  // Kiefer and Wolfowitz: no design has a larger determinant root than (largest trace / n) times this one's.
  double trace = 0;
  for (const auto& m : information) trace = std::max(trace, (inverse * m).trace() * count);
  plan.efficiency = std::min(1.0, static_cast<double>(n) / trace);
  return plan;
}

}  // namespace stablecut::robot
