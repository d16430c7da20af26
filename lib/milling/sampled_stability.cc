#include "milling/sampled_stability.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/parallel.h"
#include "milling/limits.h"
#include "numerics/order_statistics.h"
#include "numerics/random.h"

namespace stablecut::milling {
namespace {

// Frequencies, damping ratios and Kt are kept above this share of their means, damping ratios also below this
// value.
constexpr double kLeastOfMean = 0.01, kMostDamping = 0.99;
constexpr double kLow = 0.025, kHigh = 0.975;  // quantiles

// A matrix R with R R^T the covariance, so that R z has it when z is standard normal. Negative eigenvalues
// are rounding.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& covariance) {
  if (covariance.size() == 0) return covariance;
  // Of the correlations: frequencies and mode vectors differ by many powers of ten.
  const Eigen::VectorXd scale = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd inverse = (scale.array() > 0).select(scale.cwiseInverse(), 0.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * covariance *
                                                              inverse.asDiagonal());
  return scale.asDiagonal() * solver.eigenvectors() *
         solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

// The model with a change added to its parameters, in the order of its covariance.
dynamics::ModalModel moved(dynamics::ModalModel model, const Eigen::VectorXd& by) {
  Eigen::Index at = 0;
  for (dynamics::Mode& mode : model.modes) {
    mode.frequency_hz = std::max(mode.frequency_hz + by[at], kLeastOfMean * mode.frequency_hz);
    mode.damping_ratio =
        std::clamp(mode.damping_ratio + by[at + 1], kLeastOfMean * mode.damping_ratio, kMostDamping);
    at += 2;
    for (Eigen::VectorXcd* vector : {&mode.psi_r, &mode.psi_l}) {
      for (auto& component : *vector) {
        component += std::complex<double>(by[at], by[at + 1]);
        at += 2;
      }
    }
  }
  return model;
}

}  // namespace

void set_coefficients(Cutter& cutter, double kt_by_n_per_m2, double kr_by_n_per_m2) {
  cutter.kt_n_per_m2 = std::max(cutter.kt_n_per_m2 + kt_by_n_per_m2, kLeastOfMean * cutter.kt_n_per_m2);
  cutter.kr_n_per_m2 = std::max(cutter.kr_n_per_m2 + kr_by_n_per_m2, 0.0);
}

std::vector<SampledCut> sampled_cuts(const dynamics::ModalModel& model, const Cutter& cutter,
                                     const CoefficientDeviations& deviations, int count, unsigned seed) {
  const Eigen::MatrixXd root = root_of(model.covariance);
  std::mt19937_64 generator(seed);
  const auto normal = [&] { return numerics::unit_normal(generator); };
  std::vector<SampledCut> samples;
  while (static_cast<int>(samples.size()) < count) {
    Eigen::VectorXd z(root.cols());
    for (double& value : z) value = normal();
    const Eigen::VectorXd by = root * z;
    const double along = normal(), across = normal(), together = deviations.correlation;
    const double kt = deviations.kt_n_per_m2 * along;
    const double kr =
        deviations.kr_n_per_m2 * (together * along + std::sqrt(1 - together * together) * across);
    for (const double side : {1.0, -1.0}) {
      SampledCut sample{tip_structure(by.size() > 0 ? moved(model, side * by) : model, cutter.is_axial()),
                        cutter};
      set_coefficients(sample.cutter, side * kt, side * kr);
      samples.push_back(std::move(sample));
    }
  }
  samples.resize(count);
  return samples;
}

SampledStability sampled_stability(const std::vector<SampledCut>& samples,
                                   const std::vector<double>& revolutions_per_s,
                                   const std::vector<double>& depths_m, const std::vector<int>& points,
                                   bool with_grid, int threads, const Progress& progress) {
  const std::size_t speeds = revolutions_per_s.size();
  SampledStability result;
  if (with_grid) result.stable_share = Eigen::MatrixXd::Zero(depths_m.size(), speeds);
  result.limit_95_m.resize(speeds);
  parallel_for(
      speeds, threads,
      [&](std::size_t s) {
        std::vector<double> limits;
        for (const SampledCut& sample : samples) {
          const auto boundaries =
              crossings_at(sample.structure, sample.cutter, revolutions_per_s[s], depths_m.back(), points[s]);
          limits.push_back(boundaries.empty() ? std::numeric_limits<double>::infinity()
                                              : boundaries[0].depth_m);
          for (std::size_t i = 0; with_grid && i < depths_m.size(); ++i) {
            if (stable_between(boundaries, depths_m[i])) result.stable_share(i, s) += 1;
          }
        }
        std::sort(limits.begin(), limits.end());
        result.limit_95_m[s] = {numerics::quantile(limits, kLow), numerics::quantile(limits, kHigh)};
      },
      progress);
  result.stable_share /= static_cast<double>(samples.size());
  return result;
}

}  // namespace stablecut::milling
