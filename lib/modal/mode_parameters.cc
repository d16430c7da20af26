#include "modal/mode_parameters.h"

#include <cmath>

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

// The phase of psi for which 2 i Im lambda psi psi^T is real: -45 degrees.
const Complex kPhase = std::polar(1.0, -0.7853981633974483);

// A symmetric mode's vector near both of a mode's vectors: their mean in the scale where they have equal
// norms.
Eigen::VectorXcd symmetric_vector(const dynamics::Mode& mode) {
  const dynamics::Mode balanced = dynamics::normalised(mode);
  return (balanced.psi_r + balanced.psi_l) / 2;
}

}  // namespace

ModeParameters::ModeParameters(const std::vector<dynamics::Mode>& modes, Eigen::Index dofs, ModeModel model)
    : dofs_(dofs), model_(model) {
  for (const dynamics::Mode& mode : modes) {
    Eigen::Index pivot = 0;
    const double largest = mode.psi_r.cwiseAbs().maxCoeff(&pivot);
    pivot_.push_back(pivot);
    const double residue = largest * mode.psi_l.norm();
    double unit = residue;  // of psi_l when psi_r's pivot is 1
    if (model == ModeModel::kSymmetric) unit = std::sqrt(residue);
    if (model == ModeModel::kProportional) unit = std::sqrt(residue * mode.pole().imag());
    unit_.push_back(unit > 0 ? unit : 1);
  }
}

Eigen::Index ModeParameters::per_mode(ModeModel model, Eigen::Index dofs) {
  switch (model) {
    case ModeModel::kNonsymmetric:
      return 2 + 2 * (dofs - 1) + 2 * dofs;
    case ModeModel::kSymmetric:
      return 2 + 2 * dofs;
    case ModeModel::kProportional:
      break;
  }
  return 2 + dofs;
}

Eigen::Index ModeParameters::right_offset(Eigen::Index k, Eigen::Index i) const {
  return 2 * (i < pivot_[k] ? i : i - 1);
}

Eigen::VectorXd ModeParameters::pack(const std::vector<dynamics::Mode>& modes) const {
  Eigen::VectorXd x(size());
  const auto put = [&](Eigen::Index at, Complex value) {
    x[at] = value.real();
    x[at + 1] = value.imag();
  };
  for (Eigen::Index k = 0; k < this->modes(); ++k) {
    const dynamics::Mode& mode = modes[k];
    const Complex lambda = mode.pole();
    const double unit = unit_[k];
    x[pole_at(k)] = std::log(-lambda.real() / lambda.imag());
    x[pole_at(k) + 1] = std::log(lambda.imag());
    const Eigen::Index first = vectors_at(k);
    if (model_ == ModeModel::kNonsymmetric) {
      const Eigen::Index pivot = pivot_[k];
      const Complex scale = mode.psi_r[pivot];
      for (Eigen::Index i = 0; i < dofs_; ++i) {
        if (i != pivot) put(first + right_offset(k, i), mode.psi_r[i] / scale);
        put(first + 2 * (dofs_ - 1) + 2 * i, mode.psi_l[i] * scale / unit);
      }
      continue;
    }
    const Eigen::VectorXcd psi = symmetric_vector(mode);
    Eigen::Index largest = 0;
    psi.cwiseAbs().maxCoeff(&largest);
    for (Eigen::Index i = 0; i < dofs_; ++i) {
      if (model_ == ModeModel::kSymmetric) {
        put(first + 2 * i, psi[i] / unit);
      } else {
        const double sign = (psi[i] * std::conj(psi[largest])).real() < 0 ? -1 : 1;
        x[first + i] = sign * std::abs(psi[i]) * std::sqrt(lambda.imag()) / unit;
      }
    }
  }
  return x;
}

std::vector<dynamics::Mode> ModeParameters::unpack(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  std::vector<dynamics::Mode> modes(pivot_.size());
  for (Eigen::Index k = 0; k < this->modes(); ++k) {
    dynamics::Mode& mode = modes[k];
    dynamics::set_pole(mode, pole(x, k));
    mode.psi_r = Eigen::VectorXcd::Ones(dofs_);
    mode.psi_l.resize(dofs_);
    const Eigen::Index first = vectors_at(k);
    const double unit = unit_[k];
    for (Eigen::Index i = 0; i < dofs_; ++i) {
      const auto complex_at = [&](Eigen::Index at) { return Complex(x[first + at], x[first + at + 1]); };
      switch (model_) {
        case ModeModel::kNonsymmetric:
          if (i != pivot_[k]) mode.psi_r[i] = complex_at(right_offset(k, i));
          mode.psi_l[i] = unit * complex_at(2 * (dofs_ - 1) + 2 * i);
          break;
        case ModeModel::kSymmetric:
          mode.psi_r[i] = mode.psi_l[i] = unit * complex_at(2 * i);
          break;
        case ModeModel::kProportional:
          mode.psi_r[i] = mode.psi_l[i] = kPhase * unit * x[first + i] * std::exp(-x[pole_at(k) + 1] / 2);
      }
    }
  }
  return modes;
}

Complex ModeParameters::pole(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const {
  return std::exp(x[pole_at(k) + 1]) * Complex(-std::exp(x[pole_at(k)]), 1);
}

Eigen::MatrixXd ModeParameters::slope(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const {
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(coordinates_per_mode(), per_mode());
  const Complex lambda = pole(x, k);
  const double unit = unit_[k];
  const Eigen::Matrix2d units = unit * Eigen::Matrix2d::Identity();
  slope.topLeftCorner<2, 2>() << lambda.real(), lambda.real(), 0, lambda.imag();
  const auto put = [&](Eigen::Index row, Eigen::Index column, Complex value) {
    slope(row, column) = value.real();
    slope(row + 1, column) = value.imag();
  };
  for (Eigen::Index i = 0; i < dofs_; ++i) {
    switch (model_) {
      case ModeModel::kNonsymmetric:
        if (i != pivot_[k]) slope.block<2, 2>(right_at(i), 2 + right_offset(k, i)).setIdentity();
        slope.block<2, 2>(left_at(i), 2 * dofs_ + 2 * i) = units;
        break;
      case ModeModel::kSymmetric:
        slope.block<2, 2>(right_at(i), 2 + 2 * i) = units;
        slope.block<2, 2>(left_at(i), 2 + 2 * i) = units;
        break;
      case ModeModel::kProportional: {
        const Complex turned = kPhase * unit * std::exp(-x[pole_at(k) + 1] / 2);
        for (const Eigen::Index row : {right_at(i), left_at(i)}) {
          put(row, 2 + i, turned);
          put(row, 1, -turned * x[vectors_at(k) + i] / 2.0);
        }
      }
    }
  }
  return slope;
}

Eigen::VectorXd ModeParameters::removal(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const {
  // The residue is linear in psi_l, and quadratic in psi.
  const bool linear = model_ == ModeModel::kNonsymmetric;
  const Eigen::Index count = linear ? 2 * dofs_ : per_mode() - 2;
  return -x.segment(pole_at(k) + per_mode() - count, count) / (linear ? 1 : 2);
}

}  // namespace stablecut::modal
