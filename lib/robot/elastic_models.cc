#include "robot/elastic_models.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/distributions.h"
#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kBetter = 0.95;  // of the t distribution over the blocks: the richer model predicts better
constexpr double kMoreThanNoise = 1e-3;  // tail of the F test between nested models
constexpr double kExplained = 1e-6;      // of the measured values: what the normal equations' rounding leaves
constexpr ElasticModel kModels[] = {ElasticModel::kJointsOnly, ElasticModel::kBase, ElasticModel::kThreeAxis};

// The equations' rows divided by their deviations, columns of length 1, and what follows from them.
struct Normal {
  Eigen::MatrixXd a, matrix;                    // A and A^T A
  Eigen::VectorXd b, right;                     // and A^T b
  Eigen::MatrixXd root;                         // triangular factor of (A, b)
  Eigen::RowVectorXd largest;                   // lengths that the columns could have, in the same units
  std::vector<std::vector<Eigen::Index>> rows;  // of each block
};

Eigen::RowVectorXd lengths_of_largest(const ComplianceEquations& equations) {
  if (equations.std.size() == 0) return equations.largest.colwise().norm();
  return (equations.std.cwiseInverse().asDiagonal() * equations.largest).colwise().norm();
}

Normal normal_of(const ComplianceEquations& equations, const SampleGroups& blocks) {
  Normal result;
  result.a = equations.a;
  result.b = equations.b;
  if (equations.std.size() > 0) {
    result.a = equations.std.cwiseInverse().asDiagonal() * result.a;
    result.b = result.b.cwiseQuotient(equations.std);
  }
  const Eigen::VectorXd norms = result.a.colwise().norm();
  const Eigen::VectorXd length = (norms.array() > 0).select(norms, 1.0);
  result.a *= length.cwiseInverse().asDiagonal();
  result.largest = lengths_of_largest(equations).cwiseQuotient(length.transpose());
  Eigen::MatrixXd both(result.a.rows(), result.a.cols() + 1);
  both << result.a, result.b;
  result.root = triangular_factor(both);
  result.matrix.noalias() = result.a.transpose() * result.a;
  result.right = result.a.transpose() * result.b;
  result.rows.resize(blocks.count);
  for (std::size_t i = 0; i < equations.sample.size(); ++i)
    result.rows[blocks.of_sample[equations.sample[i]]].push_back(static_cast<Eigen::Index>(i));
  return result;
}

// The compliances, none below 0, that the normal matrix and right side of a least-squares problem give.
Eigen::VectorXd fitted(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return bounded_normal_solution(matrix, right, std::vector<bool>(right.size(), true));
}

// Errors of each block's rows, predicted from the other blocks.
Eigen::VectorXd block_errors(const Normal& normal, const std::vector<Eigen::Index>& columns) {
  Eigen::VectorXd error = normal.b;
  for (const std::vector<Eigen::Index>& rows : normal.rows) {
    const Eigen::MatrixXd part = normal.a(rows, columns);
    const Eigen::VectorXd own = normal.b(rows);
    const Eigen::VectorXd solution = fitted(normal.matrix(columns, columns) - part.transpose() * part,
                                            normal.right(columns) - part.transpose() * own);
    error(rows) = own - part * solution;
  }
  return error;
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
  const auto count = static_cast<double>(gain.size());
  const double mean = gain.mean();
  const double spread = std::sqrt((gain.array() - mean).square().sum() / (count - 1) / count);
  return mean > 0 &&
         (noise_tail < kMoreThanNoise || mean > numerics::student_t_quantile(kBetter, count - 1) * spread);
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
  const double freedom = static_cast<double>(normal.b.size() - richer.seen),
               more = richer.seen - simpler.seen;
  if (!(freedom > 0) || !(more > 0) || !(std::sqrt(simpler.squares) > kExplained * normal.b.norm())) return 1;
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
    std::vector<Eigen::Index> columns(count);
    std::iota(columns.begin(), columns.end(), 0);
    ModelTrial trial{model, static_cast<int>(count), 0, std::nullopt};
    trial.residual_rms_m = rms_of_deflections(
        equations,
        normal.b - normal.a.leftCols(count) * fitted(normal.matrix(columns, columns), normal.right(columns)));
    const Remainder left = left_by(normal, count);
    if (model == ElasticModel::kJointsOnly) joints_left = best_left = left;
    choice.joints_suffice_tail = noise_tail(joints_left, left, normal);
    if (blocks.count > 1) {
      const Eigen::VectorXd error = block_errors(normal, columns);
      trial.block_rms_m = rms_of_deflections(equations, error);
      const Eigen::VectorXd squares = block_squares(normal, error);
      const bool explained = best.size() > 0 && best.mean() * static_cast<double>(normal.b.size()) <
                                                    std::pow(kExplained, 2) * normal.b.squaredNorm();
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
