#include "milling/force_identification.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "milling/cutting_force.h"
#include "numerics/distributions.h"

namespace stablecut::milling {
namespace {

constexpr double kNoRank = 1e-9;    // of the largest singular value, columns of length 1
constexpr double kInvolved = 1e-6;  // share of a coefficient in what cannot be seen
constexpr double kPlainly = 0.01;   // probability by chance
constexpr double kQuantile = 0.975;

// Components of the force and coefficients of each group.
struct Group {
  std::vector<int> axes, coefficients;
};
const std::array<Group, 2> kGroups = {Group{{0, 1}, {0, 1, 2, 3}}, Group{{2}, {4, 5}}};

// The mean force [3] for each coefficient at 1.
Eigen::Matrix<double, 3, kCoefficients> unit_forces(const MeasuredForce& measured) {
  Eigen::Matrix<double, 3, kCoefficients> result;
  for (int c = 0; c < kCoefficients; ++c) {
    Cutter cutter = measured.cutter;
    CuttingLoad load;
    load.feed_per_tooth_m = measured.feed_per_tooth_m;
    load.runout_m = measured.runout_m;
    const auto one_if = [&](Coefficient which) { return c == static_cast<int>(which) ? 1.0 : 0.0; };
    cutter.kt_n_per_m2 = one_if(Coefficient::kKt);
    cutter.kr_n_per_m2 = one_if(Coefficient::kKr);
    load.kte_n_per_m = one_if(Coefficient::kKte);
    load.kre_n_per_m = one_if(Coefficient::kKre);
    cutter.ka_n_per_m2 = one_if(Coefficient::kKa);
    load.kae_n_per_m = one_if(Coefficient::kKae);
    result.col(c) = measured.depth_m * force_cycle(cutter, load, measured.depth_m).mean().head<3>();
  }
  return result;
}

// The equations of a group: weighted rows, and what is known of each.
struct Equations {
  Eigen::MatrixXd design;  // [rows x coefficients that are sought]
  Eigen::VectorXd force;
  std::vector<int> sought;     // coefficients
  std::vector<int> axis;       // [rows]
  std::vector<double> feed_m;  // [rows]
  bool stated = false;
};

Equations equations_of(const Group& group, const std::vector<MeasuredForce>& forces,
                       const std::array<std::optional<double>, kCoefficients>& held) {
  Equations result;
  for (const int c : group.coefficients) {
    if (!held[c]) result.sought.push_back(c);
  }
  std::vector<Eigen::RowVectorXd> rows;
  std::vector<double> right, weight;
  bool all_stated = true;
  for (const MeasuredForce& measured : forces) {
    const Eigen::Matrix<double, 3, kCoefficients> unit = unit_forces(measured);
    for (const int axis : group.axes) {
      if (!measured.force_n[axis]) continue;
      double force = *measured.force_n[axis];
      for (const int c : group.coefficients) {
        if (held[c]) force -= unit(axis, c) * *held[c];
      }
      rows.push_back(unit.row(axis)(result.sought));
      right.push_back(force);
      all_stated = all_stated && measured.std_n[axis].has_value();
      weight.push_back(measured.std_n[axis] ? 1 / *measured.std_n[axis] : 1);
      result.axis.push_back(axis);
      result.feed_m.push_back(measured.feed_per_tooth_m);
    }
  }
  result.stated = all_stated && !rows.empty();
  result.design.resize(rows.size(), result.sought.size());
  result.force.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double w = result.stated ? weight[i] : 1;
    result.design.row(i) = w * rows[i];
    result.force[i] = w * right[i];
  }
  return result;
}

struct Solution {
  Eigen::VectorXd value, residual;
  Eigen::MatrixXd spread;  // the covariance for rows of variance 1
  std::vector<bool> seen;
  int rank = 0;
};

Solution solve(const Eigen::MatrixXd& design, const Eigen::VectorXd& force) {
  const Eigen::Index n = design.cols();
  Solution result{Eigen::VectorXd::Zero(n), force, Eigen::MatrixXd::Zero(n, n), std::vector<bool>(n), 0};
  const Eigen::VectorXd length = design.colwise().norm();
  if (design.rows() == 0 || n == 0 || !(length.maxCoeff() > 0)) return result;
  const Eigen::VectorXd scale = (length.array() > 0).select(length.cwiseInverse(), 0.0);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(design * scale.asDiagonal(),
                                              Eigen::ComputeThinU | Eigen::ComputeFullV);
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < svd.singularValues().size(); ++i) {
    if (!(svd.singularValues()[i] > kNoRank * svd.singularValues()[0])) continue;
    inverse[i] = 1 / svd.singularValues()[i];
    ++result.rank;
  }
  const Eigen::Index k = svd.singularValues().size();
  const Eigen::MatrixXd v = svd.matrixV();
  result.value = scale.asDiagonal() *
                 (v.leftCols(k) * (inverse.head(k).asDiagonal() * (svd.matrixU().transpose() * force)));
  result.residual = force - design * result.value;
  result.spread =
      scale.asDiagonal() * v * inverse.cwiseAbs2().asDiagonal() * v.transpose() * scale.asDiagonal();
  for (Eigen::Index c = 0; c < n; ++c) {
    double unseen = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (inverse[i] == 0) unseen = std::max(unseen, std::abs(v(c, i)));
    }
    result.seen[c] = unseen < kInvolved;
  }
  return result;
}

// Whether forces that also depend on the square of the feed fit plainly better.
bool bends(const Equations& equations, const Solution& straight, int dof) {
  const double largest = *std::max_element(equations.feed_m.begin(), equations.feed_m.end());
  Eigen::MatrixXd design = equations.design;
  for (std::size_t j = 0; j < equations.sought.size(); ++j) {
    const int c = equations.sought[j];
    if (c == static_cast<int>(Coefficient::kKte) || c == static_cast<int>(Coefficient::kKre) ||
        c == static_cast<int>(Coefficient::kKae))
      continue;
    design.conservativeResize(Eigen::NoChange, design.cols() + 1);
    for (Eigen::Index i = 0; i < design.rows(); ++i)
      design(i, design.cols() - 1) = equations.design(i, j) * equations.feed_m[i] / largest;
  }
  const Solution bent = solve(design, equations.force);
  const int more = bent.rank - straight.rank, left = dof - more;
  if (more < 1 || left < 1) return false;
  const double gain = straight.residual.squaredNorm() - bent.residual.squaredNorm();
  const double noise = bent.residual.squaredNorm() / left;
  // Residuals at the rounding of the forces are no noise to compare with.
  if (!(straight.residual.norm() > 1e-9 * equations.force.norm())) return false;
  return noise == 0 || numerics::f_tail(gain / more / noise, more, left) < kPlainly;
}

bool scatters_unevenly(const Equations& equations, const Solution& solution) {
  std::array<double, 2> squares{};
  std::array<int, 2> count{};
  for (Eigen::Index i = 0; i < solution.residual.size(); ++i) {
    squares[equations.axis[i]] += solution.residual[i] * solution.residual[i];
    ++count[equations.axis[i]];
  }
  // Half of the coefficients is on the account of each.
  const std::array<double, 2> dof = {count[0] - solution.rank / 2.0, count[1] - solution.rank / 2.0};
  if (dof[0] < 1 || dof[1] < 1 || squares[0] <= 0 || squares[1] <= 0) return false;
  const double ratio = squares[0] / dof[0] / (squares[1] / dof[1]);
  return numerics::f_tail(ratio, dof[0], dof[1]) < kPlainly / 2 ||
         numerics::f_tail(1 / ratio, dof[1], dof[0]) < kPlainly / 2;
}

}  // namespace

ForceIdentification identify_coefficients(const std::vector<MeasuredForce>& forces,
                                          const std::array<std::optional<double>, kCoefficients>& held) {
  ForceIdentification result;
  for (std::size_t g = 0; g < kGroups.size(); ++g) {
    const Group& group = kGroups[g];
    const Equations equations = equations_of(group, forces, held);
    const Solution solution = solve(equations.design, equations.force);
    ForceResidual& residual = result.residual[g];
    residual.measured = static_cast<int>(equations.force.size());
    residual.degrees_of_freedom = residual.measured - solution.rank;
    const int dof = residual.degrees_of_freedom;
    double variance = 1, freedom = std::numeric_limits<double>::infinity();
    const double squares = solution.residual.squaredNorm();
    if (equations.stated && dof > 0) {
      residual.chi_square_per_dof = squares / dof;
      residual.deviations_contradicted = numerics::chi_square_tail(squares, dof) < kPlainly;
    }
    if (!equations.stated || residual.deviations_contradicted) {
      variance = dof > 0 ? squares / dof : 0;
      freedom = dof;
    }
    result.deviations_known[g] = residual.measured > 0 && (equations.stated || dof > 0);
    for (const int c : group.coefficients) {
      result.verdict[c] = CoefficientVerdict::kHeld;
      if (held[c]) result.value[c] = *held[c];
    }
    for (std::size_t j = 0; j < equations.sought.size(); ++j) {
      const int c = equations.sought[j];
      result.verdict[c] = residual.measured == 0 ? CoefficientVerdict::kUnmeasured
                          : solution.seen[j]     ? CoefficientVerdict::kIdentified
                                                 : CoefficientVerdict::kInseparable;
      if (result.verdict[c] != CoefficientVerdict::kIdentified) continue;
      result.value[c] = solution.value[j];
      if (!result.deviations_known[g]) continue;
      for (std::size_t i = 0; i < equations.sought.size(); ++i) {
        if (solution.seen[i]) result.covariance(c, equations.sought[i]) = variance * solution.spread(j, i);
      }
      result.half_interval_95[c] =
          numerics::student_t_quantile(kQuantile, freedom) * std::sqrt(result.covariance(c, c));
    }
    if (residual.measured == 0) continue;
    double left = 0, all = 0;
    std::size_t row = 0;
    for (const MeasuredForce& measured : forces) {
      for (const int axis : group.axes) {
        if (!measured.force_n[axis]) continue;
        const double size = equations.stated ? *measured.std_n[axis] : 1;
        left += std::pow(size * solution.residual[row++], 2);
        all += std::pow(*measured.force_n[axis], 2);
      }
    }
    residual.rms_n = std::sqrt(left / residual.measured);
    residual.force_rms_n = std::sqrt(all / residual.measured);
    residual.not_linear = !equations.sought.empty() && bends(equations, solution, dof);
    residual.uneven = g == 0 && !equations.stated && scatters_unevenly(equations, solution);
  }
  return result;
}

}  // namespace stablecut::milling
