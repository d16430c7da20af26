#include "robot/elastic_models.h"

#include <algorithm>
#include <cmath>

#include "numerics/distributions.h"
#include "robot/least_squares.h"
#include "robot/normal_equations.h"

namespace stablecut::robot {
namespace {

constexpr double kByChance =
    0.05;  // tail of the t test over the blocks that the richer model predicts better
constexpr double kMoreThanNoise = 1e-3;  // tail of the F test between nested models
constexpr double kExplained = 1e-6;      // of the measured values: what the normal equations' rounding leaves
constexpr ElasticModel kModels[] = {ElasticModel::kJointsOnly, ElasticModel::kBase, ElasticModel::kThreeAxis};

// The equations' rows divided by their deviations, and what follows from them.
struct Normal {
  NormalEquations equations;
  Eigen::MatrixXd root;                         // triangular factor of (A, b), in columns of length 1
  Eigen::RowVectorXd largest;                   // lengths that the columns could have, in the same units
  std::vector<std::vector<Eigen::Index>> rows;  // of each block
};

Eigen::RowVectorXd lengths_of_largest(const ComplianceEquations& equations) {
  if (equations.std.size() == 0) return equations.largest.colwise().norm();
  return (equations.std.cwiseInverse().asDiagonal() * equations.largest).colwise().norm();
}

NormalEquations weighted(const ComplianceEquations& equations) {
  const std::vector<bool> not_negative(equations.a.cols(), true);
  if (equations.std.size() == 0) return {equations.a, equations.b, not_negative};
  return {equations.std.cwiseInverse().asDiagonal() * equations.a, equations.b.cwiseQuotient(equations.std),
          not_negative};
}

Normal normal_of(const ComplianceEquations& equations, const SampleGroups& blocks) {
  Normal result{weighted(equations), {}, {}, {}};
  const Eigen::MatrixXd& a = result.equations.a();
  result.largest = lengths_of_largest(equations).cwiseQuotient(result.equations.lengths().transpose());
  Eigen::MatrixXd both(a.rows(), a.cols() + 1);
  both << a, result.equations.b();
  result.root = triangular_factor(both);
  result.rows.resize(blocks.count);
  for (std::size_t i = 0; i < equations.sample.size(); ++i)
    result.rows[blocks.of_sample[equations.sample[i]]].push_back(static_cast<Eigen::Index>(i));
  return result;
}

double rms_of_deflections(const ComplianceEquations& equations, const Eigen::VectorXd& error) {
  double sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    if (equations.rotation[i]) continue;
    const double metres = error[i] * (equations.std.size() > 0 ? equations.std[i] : 1);
    sum += metres * metres;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

// Mean square error of each block.
Eigen::VectorXd block_squares(const Normal& normal, const Eigen::VectorXd& error) {
  Eigen::VectorXd squares(normal.rows.size());
  for (std::size_t k = 0; k < normal.rows.size(); ++k)
    squares[k] = error(normal.rows[k]).squaredNorm() / static_cast<double>(normal.rows[k].size());
  return squares;
}

// Whether the richer model is to be preferred: it predicts the blocks better on the whole, and either their
// scatter or the sum of squares (by the tail of its F test) says that this is more than chance.
bool better_model(const Eigen::VectorXd& richer, const Eigen::VectorXd& simpler, double noise_tail) {
  const Eigen::VectorXd gain = simpler - richer;
  return gain.mean() > 0 && (noise_tail < kMoreThanNoise || numerics::mean_above_zero(gain, kByChance));
}

// What the seen columns of the first `count` springs leave of the sum of squares, bounds aside.
struct Remainder {
  double squares = 0;
  int seen = 0;
};

Remainder left_by(const Normal& normal, Eigen::Index count) {
  const Identifiability seen =
      identifiability(normal.root.leftCols(count), normal.largest.leftCols(count), kJoints);
  Eigen::MatrixXd both(normal.root.rows(), seen.rank + 1);
  both << normal.root(Eigen::all, seen.independent), normal.root.rightCols<1>();
  return {std::pow(triangular_factor(both)(seen.rank, seen.rank), 2), seen.rank};
}

// Probability that noise makes the richer of two nested models fit as much better; 1 where both are exact or
// too few rows are left.
double noise_tail(const Remainder& simpler, const Remainder& richer, const Normal& normal) {
  const double freedom = static_cast<double>(normal.equations.b().size() - richer.seen),
               more = richer.seen - simpler.seen;
  if (!(freedom > 0) || !(more > 0) ||
      !(std::sqrt(simpler.squares) > kExplained * normal.equations.b().norm()))
    return 1;
  const double f = (simpler.squares - richer.squares) / more / (richer.squares / freedom);
  return f > 0 ? numerics::f_tail(f, more, freedom) : 1;
}

}  // namespace

ModelChoice compare_models(const Robot& robot, const ComplianceEquations& equations,
                           const SampleGroups& blocks) {
  const Normal normal = normal_of(equations, blocks);
  ModelChoice choice;
  Eigen::VectorXd best;  // mean square error of each block
  Remainder best_left, joints_left;
  for (const ElasticModel model : kModels) {
    const auto count = static_cast<Eigen::Index>(springs_of(robot, model).size());
    ModelTrial trial{model, static_cast<int>(count), 0, std::nullopt};
    trial.residual_rms_m = rms_of_deflections(equations, normal.equations.residual(count));
    const Remainder left = left_by(normal, count);
    if (model == ElasticModel::kJointsOnly) joints_left = best_left = left;
    choice.joints_suffice_tail = noise_tail(joints_left, left, normal);
    if (blocks.count > 1) {
      const Eigen::VectorXd error = normal.equations.left_out(count, normal.rows);
      trial.block_rms_m = rms_of_deflections(equations, error);
      const Eigen::VectorXd squares = block_squares(normal, error);
      const bool explained =
          best.size() > 0 && best.mean() * static_cast<double>(normal.equations.b().size()) <
                                 std::pow(kExplained, 2) * normal.equations.b().squaredNorm();
      if (best.size() == 0 ||
          (!explained && better_model(squares, best, noise_tail(best_left, left, normal)))) {
        best = squares;
        best_left = left;
        choice.best = model;
      }
    }
    choice.trials.push_back(trial);
  }
  return choice;
}

}  // namespace stablecut::robot
