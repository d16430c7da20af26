#include "dynamics/mode_comparison.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace stablecut::dynamics {
namespace {

constexpr double kLeastAssurance = 0.5;  // of a pair: more of one shape in the other than not
constexpr double kMostShift = 1.5;       // of a pair's frequencies, larger over smaller

using Index = Eigen::Index;

std::vector<std::size_t> in_band(const ModalModel& model) {
  std::vector<std::size_t> modes;
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    if (!model.modes[k].out_of_band) modes.push_back(k);
  }
  return modes;
}

Eigen::VectorXcd in_directions(const Eigen::VectorXcd& psi, const std::vector<Index>& rows) {
  return psi(rows);
}

// How much of one mode's ringing is in the other's: the square of the inner product over all time of their
// residues times exp(lambda t), each of unit norm. README.md, "Comparing tables".
double likeness(const Mode& a, const std::vector<Index>& rows_a, const Mode& b,
                const std::vector<Index>& rows_b) {
  const std::complex<double> sum = a.pole() + std::conj(b.pole());
  const double both = 4 * a.pole().real() * b.pole().real() / std::norm(sum);
  return both * modal_assurance(in_directions(a.psi_r, rows_a), in_directions(b.psi_r, rows_b)) *
         modal_assurance(in_directions(a.psi_l, rows_a), in_directions(b.psi_l, rows_b));
}

bool may_be_one(const Mode& a, const Mode& b, double assurance) {
  const double shift = a.frequency_hz / b.frequency_hz;
  return assurance >= kLeastAssurance && shift <= kMostShift && shift >= 1 / kMostShift;
}

ModePair pair_of(const ModalModel& first, std::size_t a, const ModalModel& second, std::size_t b,
                 double assurance) {
  const Mode &one = first.modes[a], &other = second.modes[b];
  ModePair pair{
      a,  b, assurance, other.frequency_hz - one.frequency_hz, other.damping_ratio - one.damping_ratio,
      {}, {}};
  if (first.covariance.size() == 0 && second.covariance.size() == 0) return pair;
  Eigen::Array2d variance = Eigen::Array2d::Zero();
  for (const auto& [model, mode] : {std::pair(&first, a), std::pair(&second, b)}) {
    if (model->covariance.size() > 0)
      variance += model->deviation(static_cast<Index>(mode)).head<2>().array().square();
  }
  pair.frequency_std_hz = std::sqrt(variance[0]);
  pair.damping_std = std::sqrt(variance[1]);
  return pair;
}

// The likeliest pair, then the likeliest of what is left, and so on.
void find_pairs(const ModalModel& first, const ModalModel& second, Eigen::MatrixXd like,
                ModeComparison& result) {
  while (like.size() > 0) {
    Index a = 0, b = 0;
    if (!(like.maxCoeff(&a, &b) > 0)) break;
    result.pairs.push_back(pair_of(first, result.first[a], second, result.second[b], result.assurance(a, b)));
    like.row(a).setZero();
    like.col(b).setZero();
  }
  std::sort(result.pairs.begin(), result.pairs.end(),
            [](const ModePair& a, const ModePair& b) { return a.first < b.first; });
  const auto paired = [&](std::size_t mode, std::size_t ModePair::*of) {
    return std::any_of(result.pairs.begin(), result.pairs.end(),
                       [&](const ModePair& pair) { return pair.*of == mode; });
  };
  for (const std::size_t mode : result.first) {
    if (!paired(mode, &ModePair::first)) result.first_alone.push_back(mode);
  }
  for (const std::size_t mode : result.second) {
    if (!paired(mode, &ModePair::second)) result.second_alone.push_back(mode);
  }
}

}  // namespace

double modal_assurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  const double norms = a.squaredNorm() * b.squaredNorm();
  return norms > 0 ? std::min(1.0, std::norm(a.dot(b)) / norms) : 0;
}

double phase_collinearity(const Eigen::VectorXcd& psi) {
  const double square = psi.squaredNorm();
  return std::min(1.0, std::norm(psi.conjugate().dot(psi)) / (square * square));
}

double complexity(const Eigen::VectorXcd& psi) {
  const double c = std::sqrt(phase_collinearity(psi));
  return std::sqrt((1 - c) / (1 + c));
}

ModeComparison compare_modes(const ModalModel& first, const ModalModel& second) {
  ModeComparison result;
  std::vector<Index> rows_first, rows_second;
  for (std::size_t i = 0; i < first.dofs.size(); ++i) {
    const Index row = second.dof(first.dofs[i]);
    if (row < 0) continue;
    result.dofs.push_back(first.dofs[i]);
    rows_first.push_back(static_cast<Index>(i));
    rows_second.push_back(row);
  }
  if (result.dofs.empty())
    throw InvalidArgument("no direction in common: expected modes in the same directions");
  result.first = in_band(first);
  result.second = in_band(second);
  result.assurance.resize(static_cast<Index>(result.first.size()), static_cast<Index>(result.second.size()));
  Eigen::MatrixXd like = Eigen::MatrixXd::Zero(result.assurance.rows(), result.assurance.cols());
  for (Index a = 0; a < like.rows(); ++a) {
    const Mode& one = first.modes[result.first[a]];
    for (Index b = 0; b < like.cols(); ++b) {
      const Mode& other = second.modes[result.second[b]];
      result.assurance(a, b) =
          modal_assurance(in_directions(one.psi_r, rows_first), in_directions(other.psi_r, rows_second));
      if (may_be_one(one, other, result.assurance(a, b)))
        like(a, b) = likeness(one, rows_first, other, rows_second);
    }
  }
  find_pairs(first, second, like, result);
  return result;
}

}  // namespace stablecut::dynamics
