#include "milling/circle_lanes.h"

#include <algorithm>
#include <cmath>

#include "numerics/complex_lanes.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;
using numerics::ComplexLanes;
using numerics::kComplexLanes;
using numerics::kLanes;
using numerics::Lanes;
using numerics::load_complex;
using numerics::store_complex;

constexpr Eigen::Index kFactors = 4;  // of a group: a, b and their derivatives

// Entry by entry, terms[0] + sum over the groups of terms[1 + 2g] a_g + terms[2 + 2g] b_g, times `scale`;
// added to what is there or in its place.
template <int kEntries>
STABLECUT_INLINE void form_entries(const double* terms, Eigen::Index groups, const double* factors,
                                   const ComplexLanes& scale, bool add, double* to) {
  const Eigen::Index stride = 1 + 2 * groups;
  ComplexLanes sum[kEntries];
  for (int e = 0; e < kEntries; ++e) sum[e] = {Lanes{} + terms[e * stride], Lanes{}};
  for (Eigen::Index g = 0; g < groups; ++g) {
    const ComplexLanes a = load_complex(factors + kFactors * g * kComplexLanes);
    const ComplexLanes b = load_complex(factors + (kFactors * g + 1) * kComplexLanes);
    for (int e = 0; e < kEntries; ++e) {
      const double p = terms[e * stride + 1 + 2 * g], q = terms[e * stride + 2 + 2 * g];
      sum[e].re += p * a.re + q * b.re;
      sum[e].im += p * a.im + q * b.im;
    }
  }
  for (int e = 0; e < kEntries; ++e) {
    const ComplexLanes value = scale * sum[e];
    store_complex(add ? load_complex(to + e * kComplexLanes) + value : value, to + e * kComplexLanes);
  }
}

STABLECUT_WIDE void form_matrix(const double* terms, Eigen::Index entries, Eigen::Index groups,
                                const double* factors, const double* scales, bool add, double* matrix) {
  constexpr int kTogether = 4;
  const ComplexLanes scale = load_complex(scales);
  const Eigen::Index stride = 1 + 2 * groups;
  Eigen::Index e = 0;
  for (; e + kTogether <= entries; e += kTogether)
    form_entries<kTogether>(terms + e * stride, groups, factors, scale, add, matrix + e * kComplexLanes);
  for (; e < entries; ++e)
    form_entries<1>(terms + e * stride, groups, factors, scale, add, matrix + e * kComplexLanes);
}

// Row of a real matrix (entries `stride` apart) times a vector of blocks.
STABLECUT_INLINE ComplexLanes row_times(const double* row, Eigen::Index stride, Eigen::Index count,
                                        const double* x) {
  ComplexLanes sum{Lanes{}, Lanes{}};
  for (Eigen::Index j = 0; j < count; ++j) {
    const ComplexLanes entry = load_complex(x + j * kComplexLanes);
    sum.re += row[j * stride] * entry.re;
    sum.im += row[j * stride] * entry.im;
  }
  return sum;
}

struct Arrays {
  Eigen::Index size, modes;
  bool plain;
  const double *direct, *direct_before, *of_state, *of_state_before, *state_of;  // column by column
  const Eigen::Index* group_of;
  const double *factors, *before;
};

// l^H M r and l^H M' r over l^H r, M' by the angle: two blocks. work: 4 modes blocks.
STABLECUT_WIDE void quotients(const Arrays& of, const double* r, const double* l, double* work,
                              double* result) {
  const Eigen::Index n = of.size, m = of.modes;
  double *x = work, *dx = work + 2 * m * kComplexLanes;
  for (Eigen::Index k = 0; k < m; ++k) {
    const double* f = of.factors + kFactors * of.group_of[k] * kComplexLanes;
    const ComplexLanes a = load_complex(f), b = load_complex(f + kComplexLanes),
                       da = load_complex(f + 2 * kComplexLanes), db = load_complex(f + 3 * kComplexLanes);
    const ComplexLanes re = row_times(of.state_of + k, 2 * m, n, r);
    const ComplexLanes im = row_times(of.state_of + m + k, 2 * m, n, r);
    store_complex(a * re - b * im, x + k * kComplexLanes);
    store_complex(b * re + a * im, x + (m + k) * kComplexLanes);
    store_complex(da * re - db * im, dx + k * kComplexLanes);
    store_complex(db * re + da * im, dx + (m + k) * kComplexLanes);
  }
  const ComplexLanes before = load_complex(of.before);
  // Derivative of 1 / mu: -i / mu.
  const ComplexLanes turned{before.im, -before.re};
  ComplexLanes value{Lanes{}, Lanes{}}, slope = value, scale = value;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ComplexLanes left = load_complex(l + i * kComplexLanes);
    const ComplexLanes now = row_times(of.direct + i, n, n, r) + row_times(of.of_state + i, n, 2 * m, x);
    const ComplexLanes changed = row_times(of.of_state + i, n, 2 * m, dx);
    ComplexLanes past{-now.re, -now.im}, past_changed{-changed.re, -changed.im};
    if (!of.plain) {
      past = row_times(of.direct_before + i, n, n, r) + row_times(of.of_state_before + i, n, 2 * m, x);
      past_changed = row_times(of.of_state_before + i, n, 2 * m, dx);
    }
    value = value + conjugate_times(left, now + before * past);
    slope = slope + conjugate_times(left, changed + before * past_changed + turned * past);
    scale = scale + conjugate_times(left, load_complex(r + i * kComplexLanes));
  }
  store_complex(quotient(value, scale), result);
  store_complex(quotient(slope, scale), result + kComplexLanes);
}

void put(Complex value, Eigen::Index lane, double* block) {
  block[lane] = value.real();
  block[kLanes + lane] = value.imag();
}

// Of numbers whose squares neither overflow nor vanish.
Complex reciprocal(Complex z) { return std::conj(z) / std::norm(z); }

Complex get(const double* block, Eigen::Index lane) { return {block[lane], block[kLanes + lane]}; }

}  // namespace

CircleLanes::CircleLanes(const CircleOperator& of)
    : of_(of),
      size_(of.size()),
      modes_(of.growth.size()),
      groups_(0),
      factors_(0),
      before_(4),
      right_(2 * size_),
      left_(2 * size_),
      work_(8 * modes_ + 4),
      eigen_(size_) {
  for (Eigen::Index k = 0; k < modes_; ++k) {
    if (k == 0 || of.growth[k] != of.growth[k - 1]) growth_.push_back(of.growth[k]);
    group_of_.push_back(static_cast<Eigen::Index>(growth_.size()) - 1);
  }
  groups_ = static_cast<Eigen::Index>(growth_.size());
  factors_ = numerics::LaneArray(2 * kFactors * groups_);
  const auto terms = [&](const Eigen::MatrixXd& direct, const Eigen::MatrixXd& of_state) {
    std::vector<double> result(size_ * size_ * (1 + 2 * groups_), 0.0);
    double* to = result.data();
    for (Eigen::Index i = 0; i < size_; ++i) {
      for (Eigen::Index j = 0; j < size_; ++j, to += 1 + 2 * groups_) {
        to[0] = direct(i, j);
        for (Eigen::Index k = 0; k < modes_; ++k) {
          const double ur = of_state(i, k), ui = of_state(i, modes_ + k);
          const double br = of_.state_of(k, j), bi = of_.state_of(modes_ + k, j);
          to[1 + 2 * group_of_[k]] += ur * br + ui * bi;
          to[2 + 2 * group_of_[k]] += ui * br - ur * bi;
        }
      }
    }
    return result;
  };
  terms_ = terms(of.direct, of.of_state);
  if (!of.plain()) terms_before_ = terms(of.direct_before, of.of_state_before);
}

void CircleLanes::form(const Angles& angles) {
  double *before = before_.data(), *scale = before + kComplexLanes;
  for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
    const Complex mu = std::polar(1.0, angles[lane]), i_mu(-mu.imag(), mu.real());
    put(std::conj(mu), lane, before);
    put(of_.plain() ? 1.0 - std::conj(mu) : 1.0, lane, scale);
    for (Eigen::Index g = 0; g < groups_; ++g) {
      // (mu - free flight)^-1 of one mode is [a -b; b a].
      const Complex first = reciprocal(mu - growth_[g]), second = reciprocal(mu - std::conj(growth_[g]));
      const Complex half_i(0, 0.5);
      double* f = factors_.data() + kFactors * g * kComplexLanes;
      put((first + second) / 2.0, lane, f);
      put(-half_i * (first - second), lane, f + kComplexLanes);
      const Complex first_slope = -i_mu * first * first, second_slope = -i_mu * second * second;
      put((first_slope + second_slope) / 2.0, lane, f + 2 * kComplexLanes);
      put(-half_i * (first_slope - second_slope), lane, f + 3 * kComplexLanes);
    }
  }
  form_matrix(terms_.data(), size_ * size_, groups_, factors_.data(), scale, false, eigen_.matrix());
  if (!of_.plain())
    form_matrix(terms_before_.data(), size_ * size_, groups_, factors_.data(), before, true, eigen_.matrix());
  eigen_.reduce();
}

EigenvalueLanes CircleLanes::refined(const std::array<Complex, kPlaces>& shifts) {
  eigen_.vectors(shifts, right_.data(), left_.data());
  const Arrays arrays{size_,
                      modes_,
                      of_.plain(),
                      of_.direct.data(),
                      of_.direct_before.data(),
                      of_.of_state.data(),
                      of_.of_state_before.data(),
                      of_.state_of.data(),
                      group_of_.data(),
                      factors_.data(),
                      before_.data()};
  alignas(64) double result[2 * kComplexLanes];
  quotients(arrays, right_.data(), left_.data(), work_.data(), result);
  EigenvalueLanes lanes;
  for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
    lanes.value[lane] = get(result, lane);
    lanes.slope[lane] = get(result + kComplexLanes, lane);
  }
  return lanes;
}

Eigen::VectorXcd CircleLanes::right(std::size_t place) const {
  Eigen::VectorXcd vector(size_);
  for (Eigen::Index i = 0; i < size_; ++i)
    vector[i] = get(right_.data() + i * kComplexLanes, static_cast<Eigen::Index>(place));
  return vector;
}

}  // namespace stablecut::milling
