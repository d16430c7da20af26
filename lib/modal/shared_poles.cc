#include "modal/shared_poles.h"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <vector>

namespace stablecut::modal {
namespace {

// README.md, "Shared poles".
constexpr double kAgreement = 5.991;  // of chi-square with two degrees of freedom
constexpr double kOnePlace = 0.5;     // of the smaller half width

bool have_common_direction(const dynamics::Mode& a, const dynamics::Mode& b) {
  for (Eigen::Index i = 0; i < a.psi_r.size(); ++i) {
    const bool in_a = a.psi_r[i] != 0.0 || a.psi_l[i] != 0.0, in_b = b.psi_r[i] != 0.0 || b.psi_l[i] != 0.0;
    if (in_a && in_b) return true;
  }
  return false;
}

struct Pair {
  std::size_t first, second;
  double chi_square;
};

// The difference of two modes' poles, in frequency and damping ratio.
Eigen::Vector2d difference_of(const dynamics::Mode& a, const dynamics::Mode& b) {
  return {a.frequency_hz - b.frequency_hz, a.damping_ratio - b.damping_ratio};
}

// The covariance of all parameters with the two of a pair's difference.
Eigen::MatrixX2d with_difference(const dynamics::ModalModel& model, std::size_t first, std::size_t second) {
  const Eigen::Index each = model.parameters_per_mode();
  return model.covariance.middleCols<2>(static_cast<Eigen::Index>(first) * each) -
         model.covariance.middleCols<2>(static_cast<Eigen::Index>(second) * each);
}

Eigen::Matrix2d variance_of_difference(const dynamics::ModalModel& model, std::size_t first,
                                       std::size_t second) {
  const Eigen::Index each = model.parameters_per_mode();
  const Eigen::MatrixX2d with = with_difference(model, first, second);
  return with.middleRows<2>(static_cast<Eigen::Index>(first) * each) -
         with.middleRows<2>(static_cast<Eigen::Index>(second) * each);
}

// Pairs that agree, the best first.
std::vector<Pair> agreeing_pairs(const dynamics::ModalModel& model) {
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < model.modes.size(); ++a) {
    for (std::size_t b = a + 1; b < model.modes.size(); ++b) {
      const dynamics::Mode &p = model.modes[a], &q = model.modes[b];
      if (p.out_of_band || q.out_of_band || have_common_direction(p, q)) continue;
      const double half_width = std::min(-p.pole().real(), -q.pole().real());
      if (std::abs(p.pole() - q.pole()) > kOnePlace * half_width) continue;
      const Eigen::Vector2d difference = difference_of(p, q);
      const double chi_square = difference.dot(variance_of_difference(model, a, b).inverse() * difference);
      if (chi_square < kAgreement) pairs.push_back({a, b, chi_square});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& p, const Pair& q) { return p.chi_square < q.chi_square; });
  return pairs;
}

// The most likely numbers, given that the two poles are one.
void make_equal(dynamics::ModalModel& model, std::size_t first, std::size_t second) {
  const Eigen::Index each = model.parameters_per_mode();
  const Eigen::MatrixX2d with = with_difference(model, first, second);
  const Eigen::Matrix2d inverse = variance_of_difference(model, first, second).inverse();
  const Eigen::VectorXd change = with * inverse * difference_of(model.modes[first], model.modes[second]);
  model.covariance -= (with * inverse * with.transpose()).eval();
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    dynamics::Mode& mode = model.modes[k];
    const auto own = change.segment(static_cast<Eigen::Index>(k) * each, each);
    mode.frequency_hz -= own[0];
    mode.damping_ratio -= own[1];
    for (Eigen::Index i = 0; i < mode.psi_r.size(); ++i) {
      mode.psi_r[i] -= std::complex<double>(own[2 + 2 * i], own[3 + 2 * i]);
      const Eigen::Index left = 2 + 2 * mode.psi_r.size() + 2 * i;
      mode.psi_l[i] -= std::complex<double>(own[left], own[left + 1]);
    }
  }
}

}  // namespace

int share_poles(dynamics::ModalModel& model) {
  // Modes with one pole have one label; the modes of a label have no direction in common.
  std::vector<std::size_t> label(model.modes.size());
  std::iota(label.begin(), label.end(), std::size_t{0});
  int shared = 0;
  for (const Pair& pair : agreeing_pairs(model)) {
    const std::size_t from = label[pair.second], to = label[pair.first];
    bool possible = from != to;
    for (std::size_t a = 0; a < label.size(); ++a) {
      for (std::size_t b = 0; b < label.size(); ++b) {
        if (label[a] == from && label[b] == to && have_common_direction(model.modes[a], model.modes[b]))
          possible = false;
      }
    }
    if (!possible) continue;
    make_equal(model, pair.first, pair.second);
    std::replace(label.begin(), label.end(), from, to);
    ++shared;
  }
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (label[k] != k) {
      model.modes[k].frequency_hz = model.modes[label[k]].frequency_hz;
      model.modes[k].damping_ratio = model.modes[label[k]].damping_ratio;
    }
    if (shared > 0) model.modes[k] = dynamics::normalised(model.modes[k]);
  }
  return shared;
}

}  // namespace stablecut::modal
