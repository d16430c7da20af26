#include "modal/error_weights.h"

#include <cmath>

namespace stablecut::modal {

Eigen::VectorXd ErrorWeights::diagonal() const {
  if (common.size() == 0) return own;
  return own.array() * (1 - own.array() * common.array().abs2());
}

std::vector<ErrorWeights> error_weights(const FitData& data) {
  std::vector<ErrorWeights> weights;
  for (const Curve& curve : data.curves) {
    if (curve.shared.size() == 0) {
      weights.push_back({curve.weight, {}});
    } else {
      weights.push_back({(curve.weight.cwiseInverse() - curve.shared.cwiseAbs2()).cwiseInverse(), {}});
    }
  }
  // (D + u u^H)^-1 = D^-1 - D^-1 u u^H D^-1 / (1 + u^H D^-1 u).
  for (Eigen::Index reference = 0; reference < data.dofs; ++reference) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Ones(data.lines());
    for (std::size_t c = 0; c < weights.size(); ++c) {
      const Curve& curve = data.curves[c];
      if (curve.reference == reference && curve.shared.size() > 0)
        sum += weights[c].own.array() * curve.shared.array().abs2();
    }
    for (std::size_t c = 0; c < weights.size(); ++c) {
      const Curve& curve = data.curves[c];
      if (curve.reference == reference && curve.shared.size() > 0)
        weights[c].common = curve.shared.array() / sum.sqrt();
    }
  }
  return weights;
}

std::vector<std::pair<std::size_t, std::size_t>> correlated_pairs(const FitData& data) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t b = 0; b < data.curves.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const Curve &p = data.curves[a], &q = data.curves[b];
      if (p.reference == q.reference && p.shared.size() > 0 && q.shared.size() > 0) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

std::vector<Eigen::VectorXcd> weighted_errors(const FitData& data, const std::vector<ErrorWeights>& weights,
                                              std::vector<Eigen::VectorXcd> errors) {
  for (std::size_t c = 0; c < errors.size(); ++c) errors[c].array() *= weights[c].own.array();
  for (Eigen::Index reference = 0; reference < data.dofs; ++reference) {
    Eigen::ArrayXcd along = Eigen::ArrayXcd::Zero(data.lines());
    const auto is_of_it = [&](std::size_t c) {
      return data.curves[c].reference == reference && weights[c].common.size() > 0;
    };
    for (std::size_t c = 0; c < errors.size(); ++c)
      if (is_of_it(c)) along += weights[c].common.array().conjugate() * errors[c].array();
    for (std::size_t c = 0; c < errors.size(); ++c)
      if (is_of_it(c)) errors[c].array() -= weights[c].own.array() * weights[c].common.array() * along;
  }
  return errors;
}

}  // namespace stablecut::modal
