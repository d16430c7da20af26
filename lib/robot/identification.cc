#include "robot/identification.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "numerics/distributions.h"

namespace stablecut::robot {
namespace {

constexpr double kConfidence = 0.975;  // two-sided 95 %
constexpr double kOutlier = 6.3e-5;    // probability: that of 4 deviations of a normal variable
constexpr double kHuber = 2;           // deviations of a sample from where it counts less
constexpr double kImplausible = 1e-3;  // chi-square tail
constexpr int kMostReweightings = 100;

// (A^T A)^-1, by scaled columns: their sizes differ by orders of magnitude.
Eigen::MatrixXd inverse_normal(const Eigen::MatrixXd& a) {
  const Eigen::Index n = a.cols();
  const Eigen::VectorXd per_scale = a.colwise().norm().cwiseInverse();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a * per_scale.asDiagonal());
  const Eigen::MatrixXd root = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse = root.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  return per_scale.asDiagonal() * (inverse * inverse.transpose()) * per_scale.asDiagonal();
}

// Least squares, with the unknowns marked in `bounded` not below 0: the best of the faces whose own solution
// keeps that. With at most six unknowns they are tried all.
Eigen::VectorXd not_negative(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                             const std::vector<bool>& bounded) {
  const Eigen::Index n = a.cols();
  Eigen::VectorXd best = Eigen::VectorXd::Zero(n);
  double least = std::numeric_limits<double>::infinity();
  for (int face = 0; face < 1 << n; ++face) {
    std::vector<Eigen::Index> free;
    bool allowed = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (face >> i & 1)
        free.push_back(i);
      else
        allowed = allowed && bounded[i];
    }
    if (!allowed) continue;
    const Eigen::MatrixXd part = a(Eigen::all, free);
    Eigen::VectorXd solution(part.cols());
    if (!free.empty()) {
      const Eigen::VectorXd scale = part.colwise().norm();
      solution = (part * scale.cwiseInverse().asDiagonal()).householderQr().solve(b).cwiseQuotient(scale);
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
      allowed = allowed && (!bounded[free[i]] || solution[i] >= 0);
    }
    const double sum = (part * solution - b).squaredNorm();
    if (!allowed || !(sum < least)) continue;
    least = sum;
    best.setZero();
    for (std::size_t i = 0; i < free.size(); ++i) best[free[i]] = solution[i];
  }
  return best;
}

// Rows of one sample: they come one after another.
struct Block {
  int sample;
  Eigen::Index first, count;
};

std::vector<Block> blocks_of(const std::vector<int>& sample) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (blocks.empty() || blocks.back().sample != sample[i])
      blocks.push_back({sample[i], static_cast<Eigen::Index>(i), 0});
    ++blocks.back().count;
  }
  return blocks;
}

class Fit {
 public:
  Fit(const ComplianceEquations& equations, const IdentificationOptions& options)
      : equations_(equations), options_(options), blocks_(blocks_of(equations.sample)) {
    stated_ = equations.std.size() > 0;
    rows_ = equations.a.rows();
    std_ = stated_ ? equations.std : Eigen::VectorXd::Ones(rows_);
    weight_ = Eigen::VectorXd::Ones(rows_);
  }

  Identification run() {
    Identification result;
    const bool mixed = !stated_ && std::find(equations_.rotation.begin(), equations_.rotation.end(), true) !=
                                       equations_.rotation.end();
    // Rows per unit of deviation; deviations of deflections against rotations settle with the residuals.
    find_columns();
    estimate();
    for (int i = 0; i < kMostReweightings && a_.cols() > 0 && (mixed || options_.huber); ++i) {
      const Eigen::VectorXd before = solution_;
      if (mixed) balance_rotations();
      if (options_.huber) reweight();
      estimate();
      if ((solution_ - before).norm() <= 1e-12 * solution_.norm()) break;
    }
    report(result);
    return result;
  }

 private:
  void find_columns() {
    seen_ = identifiability(std_.cwiseInverse().asDiagonal() * equations_.a,
                            std_.cwiseInverse().asDiagonal() * equations_.largest);
    std::vector<Eigen::Index> columns(seen_.independent.begin(), seen_.independent.end());
    a_ = equations_.a(Eigen::all, columns);
    // Of joints that cannot be told apart only a mixture is estimated, which may have any sign.
    bounded_.clear();
    for (const int joint : seen_.independent) {
      bounded_.push_back(seen_.visibility[joint] == Visibility::kVisible);
    }
  }

  void estimate() {
    if (a_.cols() == 0) return;
    const Eigen::VectorXd whiten = weight_.cwiseSqrt().cwiseQuotient(std_);
    solution_ = not_negative(whiten.asDiagonal() * a_, whiten.cwiseProduct(equations_.b), bounded_);
    residual_ = equations_.b - a_ * solution_;
  }

  // Rows over their deviations, with the robust weights.
  Eigen::MatrixXd weighted_rows(const Eigen::MatrixXd& a) const {
    return weight_.cwiseSqrt().cwiseQuotient(std_).asDiagonal() * a;
  }

  double squares(bool rotation, double& freedom) const {
    const Eigen::MatrixXd normal = inverse_normal(weighted_rows(a_));
    double sum = 0;
    freedom = 0;
    for (Eigen::Index i = 0; i < rows_; ++i) {
      if (equations_.rotation[i] != rotation) continue;
      const double per_std = 1 / std_[i];
      sum += weight_[i] * residual_[i] * residual_[i];
      freedom += 1 - weight_[i] * per_std * per_std * (a_.row(i) * normal * a_.row(i).transpose()).value();
    }
    return sum;
  }

  void balance_rotations() {
    if (a_.cols() == 0) return;
    double freedom[2], std[2];
    for (const bool rotation : {false, true}) {
      const double sum = squares(rotation, freedom[rotation]);
      std[rotation] = freedom[rotation] > 1e-9 ? std::sqrt(sum / freedom[rotation]) : 0;
    }
    // Without residuals (exact data) or without freedom there is nothing to settle.
    const double b_size = equations_.b.cwiseAbs().maxCoeff();
    if (!(std[0] > 1e-12 * b_size) || !(std[1] > 1e-12 * b_size)) return;
    for (Eigen::Index i = 0; i < rows_; ++i) std_[i] = std[equations_.rotation[i]];
  }

  // RMS of a sample's residuals over their deviations.
  double deviations_of(const Block& block, double unit) const {
    const Eigen::VectorXd z =
        residual_.segment(block.first, block.count).cwiseQuotient(std_.segment(block.first, block.count));
    return z.norm() / (std::sqrt(static_cast<double>(block.count)) * unit);
  }

  // The deviation that std_ stands for: 1 where it is stated, else from the middle of the residuals.
  double robust_unit() const {
    if (stated_) return 1;
    std::vector<double> z(rows_);
    for (Eigen::Index i = 0; i < rows_; ++i) z[i] = std::abs(residual_[i]) / std_[i];
    std::nth_element(z.begin(), z.begin() + rows_ / 2, z.end());
    return z[rows_ / 2] / 0.6745;
  }

  void reweight() {
    const double unit = robust_unit();
    if (!(unit > 0)) return;
    for (const Block& block : blocks_) {
      const double z = deviations_of(block, unit);
      weight_.segment(block.first, block.count).setConstant(z > kHuber ? kHuber / z : 1);
    }
  }

  void report(Identification& result) {
    result.rank = seen_.rank;
    result.low.fill(std::numeric_limits<double>::quiet_NaN());
    result.high = result.low;
    const auto n = a_.cols();
    for (int j = 0; j < kJoints; ++j) {
      switch (seen_.visibility[j]) {
        case Visibility::kVisible:
          result.verdict[j] = JointVerdict::kIdentified;
          break;
        case Visibility::kUnseen:
          result.verdict[j] = JointVerdict::kUnseen;
          break;
        case Visibility::kInseparable:
          result.verdict[j] = JointVerdict::kInseparable;
          break;
      }
    }
    if (n == 0) return;
    // With the deviations that rotations have settled to.
    result.condition_number = identifiability(std_.cwiseInverse().asDiagonal() * equations_.a,
                                              std_.cwiseInverse().asDiagonal() * equations_.largest)
                                  .condition_number;
    const double freedom = static_cast<double>(rows_ - n);
    const Eigen::VectorXd z = residual_.cwiseQuotient(std_);
    // With the robust loss a sample counts by its influence w z, and the less its influence changes with z,
    // the less it says (Huber's asymptotic covariance); without, both are as in least squares.
    const double influence = weight_.cwiseProduct(z).squaredNorm();
    double scale = 1;
    if (stated_) {
      result.degrees_of_freedom = std::numeric_limits<double>::infinity();
      result.deviations_known = true;
      if (freedom > 0) {
        result.chi_square_per_dof = influence / freedom;
        result.chi_square_tail = numerics::chi_square_tail(influence, freedom);
        if (result.chi_square_tail < kImplausible) {
          scale = influence / freedom;
          result.degrees_of_freedom = freedom;
        }
      }
    } else if (freedom > 0) {
      result.degrees_of_freedom = freedom;
      result.deviations_known = true;
      scale = influence / freedom;
    }
    const Eigen::MatrixXd covariance =
        scale / std::pow(mean_slope(), 2) * inverse_normal(std_.cwiseInverse().asDiagonal() * a_);

    for (Eigen::Index i = 0; i < n; ++i) {
      const int joint = seen_.independent[i];
      result.compliance[joint] = solution_[i];
      if (seen_.visibility[joint] != Visibility::kVisible) continue;
      for (Eigen::Index k = 0; k < n; ++k) {
        const int other = seen_.independent[k];
        if (seen_.visibility[other] == Visibility::kVisible) {
          result.covariance(joint, other) = covariance(i, k);
        }
      }
    }
    for (int joint = 0; joint < kJoints; ++joint) {
      if (!result.identified(joint)) {
        result.compliance[joint] = 0;
        continue;
      }
      double half = 0;
      if (result.deviations_known) {
        half = numerics::student_t_quantile(kConfidence, result.degrees_of_freedom) *
               std::sqrt(result.covariance(joint, joint));
        result.low[joint] = result.compliance[joint] - half;
        result.high[joint] = result.compliance[joint] + half;
      }
      if (!(result.compliance[joint] > half)) result.verdict[joint] = JointVerdict::kUncertain;
    }
    residuals(result);
    // What a sample does to its own prediction: by the joints that are free to move, not those held at 0.
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (solution_[i] != 0) active.push_back(i);
    }
    if (active.empty()) return;
    const Eigen::MatrixXd rows = weighted_rows(a_(Eigen::all, active));
    cross_validate(rows, result);
    list_outliers(rows, result);
  }

  // Mean derivative of the influence: a sample beyond the threshold keeps it across its residual only.
  double mean_slope() const {
    double sum = 0;
    for (const Block& block : blocks_) {
      const double weight = weight_[block.first], count = static_cast<double>(block.count);
      sum += weight < 1 ? weight * (count - 1) : count;
    }
    return sum / static_cast<double>(rows_);
  }

  void residuals(Identification& result) const {
    double sum[2] = {0, 0};
    int count[2] = {0, 0};
    for (Eigen::Index i = 0; i < rows_; ++i) {
      const bool rotation = equations_.rotation[i];
      sum[rotation] += residual_[i] * residual_[i];
      ++count[rotation];
    }
    if (count[0] > 0) result.residual_rms_m = std::sqrt(sum[0] / count[0]);
    if (count[1] > 0) result.residual_rms_rad = std::sqrt(sum[1] / count[1]);
  }

  // Each sample from all others: its residual grows by (1 - H_ii)^-1, H the hat matrix's block of the sample.
  // Robust weights and joints held at 0 stay as all samples have them.
  void cross_validate(const Eigen::MatrixXd& weighted, Identification& result) const {
    const Eigen::MatrixXd normal = inverse_normal(weighted);
    double sum = 0;
    int count = 0;
    for (const Block& block : blocks_) {
      const auto rows = Eigen::seqN(block.first, block.count);
      const Eigen::VectorXd whiten = weight_(rows).cwiseSqrt().cwiseQuotient(std_(rows));
      const Eigen::MatrixXd a = weighted(rows, Eigen::all);
      const Eigen::MatrixXd left =
          Eigen::MatrixXd::Identity(block.count, block.count) - a * normal * a.transpose();
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(left, Eigen::ComputeThinU | Eigen::ComputeThinV);
      if (svd.singularValues()[block.count - 1] < 1e-9) {
        ++result.samples_not_predicted;
        continue;
      }
      const Eigen::VectorXd error =
          svd.solve(Eigen::VectorXd(whiten.cwiseProduct(residual_(rows)))).cwiseQuotient(whiten);
      for (Eigen::Index i = 0; i < block.count; ++i) {
        if (equations_.rotation[block.first + i]) continue;
        sum += error[i] * error[i];
        ++count;
      }
    }
    if (count > 0) result.cross_validation_rms_m = std::sqrt(sum / count);
  }

  // Each sample against what the others say: r^T (1 - H_ii)^-1 r, over the variance that is left without it.
  // A single bad component shows in its own row.
  void list_outliers(const Eigen::MatrixXd& a, Identification& result) const {
    if (!result.deviations_known) return;
    const Eigen::MatrixXd normal = inverse_normal(a);
    const bool variance_known = stated_ && result.chi_square_tail >= kImplausible;
    const double robust = options_.huber ? robust_unit() : 0;
    const Eigen::VectorXd whiten = weight_.cwiseSqrt().cwiseQuotient(std_);
    const Eigen::VectorXd r = whiten.cwiseProduct(residual_);
    const double sum = r.squaredNorm(), freedom = static_cast<double>(rows_ - a.cols());
    // Exact samples have rounding for residuals, and no outliers.
    const double rounding = 1e-12 * whiten.cwiseProduct(equations_.b).cwiseAbs().maxCoeff();
    const auto judge = [&](double square, double count) {  // mean square in variances, and its tail
      double variance = 1, left = std::numeric_limits<double>::infinity();
      if (robust > 0) {
        variance = robust * robust;
      } else if (!variance_known) {
        left = freedom - count;
        variance = left > 0 ? std::max(sum - square, 0.0) / left : sum / freedom;
      }
      const double ratio = square / count / std::max(variance, rounding * rounding);
      return std::pair{ratio, left > 0 ? numerics::f_tail(ratio, count, left) : 1};
    };
    for (const Block& block : blocks_) {
      const auto rows = Eigen::seqN(block.first, block.count);
      const Eigen::MatrixXd part = a(rows, Eigen::all);
      const Eigen::MatrixXd left =
          Eigen::MatrixXd::Identity(block.count, block.count) - part * normal * part.transpose();
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(left, Eigen::ComputeThinU | Eigen::ComputeThinV);
      if (svd.singularValues()[block.count - 1] < 1e-9) continue;  // nothing else says anything about it
      const Eigen::VectorXd own = r(rows);
      // With the robust loss the weights have spared the fit, and the residual counts in full.
      const double weight = weight_[block.first];
      auto worst = judge(own.dot(svd.solve(own)) / weight, static_cast<double>(block.count));
      for (Eigen::Index i = 0; i < block.count; ++i) {
        const auto row = judge(own[i] * own[i] / left(i, i) / weight, 1);
        if (row.second < worst.second) worst = row;
      }
      // As many chances as comparisons.
      if (!(worst.second * static_cast<double>(block.count + 1) < kOutlier) || !(own.norm() > rounding))
        continue;
      Outlier outlier{block.sample, 0, std::sqrt(worst.first), weight};
      for (Eigen::Index i = block.first; i < block.first + block.count; ++i) {
        if (!equations_.rotation[i]) outlier.residual_m = std::hypot(outlier.residual_m, residual_[i]);
      }
      result.outliers.push_back(outlier);
    }
    std::stable_sort(result.outliers.begin(), result.outliers.end(),
                     [](const Outlier& x, const Outlier& y) { return x.deviations > y.deviations; });
  }

  const ComplianceEquations& equations_;
  const IdentificationOptions& options_;
  std::vector<Block> blocks_;
  bool stated_ = false;
  Eigen::Index rows_ = 0;
  Eigen::VectorXd std_,
      weight_;  // deviation (up to a common factor when not stated) and robust weight of each row
  Identifiability seen_;
  std::vector<bool> bounded_;
  Eigen::MatrixXd a_;  // columns of the independent joints
  Eigen::VectorXd solution_, residual_;
};

}  // namespace

Identification identify_stiffness(const Robot& robot, const std::vector<LoadSample>& samples,
                                  const IdentificationOptions& options) {
  const ComplianceEquations equations = compliance_equations(robot, samples, options.components);
  Identification result = Fit(equations, options).run();
  if (std::none_of(result.verdict.begin(), result.verdict.end(),
                   [](JointVerdict v) { return v == JointVerdict::kIdentified; })) {
    std::string why;
    for (int j = 0; j < kJoints; ++j) {
      const JointVerdict verdict = result.verdict[j];
      why += (j > 0 ? ", " : " ") + robot.joints[j].name +
             (verdict == JointVerdict::kUnseen        ? " is not seen by the loads and measurements"
              : verdict == JointVerdict::kInseparable ? " cannot be told from others"
                                                      : " is too uncertain to be told from rigid");
    }
    // A load never does negative work on a robot.
    double work = 0;
    for (const LoadSample& sample : samples) {
      if (sample.force_point == sample.measuring_point) work += sample.force_n.dot(sample.deflection_m);
    }
    if (work < 0) {
      why +=
          "; the deflections point against the loads: expected the robot's movement under the load, not its "
          "return";
    }
    throw NoAnswer("no joint can be identified:" + why);
  }
  return result;
}

}  // namespace stablecut::robot
