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
  const double* state_of;  // column by column, as the parts'
  const Eigen::Index* group_of;
  const double *factors, *scales;
};

struct PartArrays {
  const double *direct, *of_state;  // of_state: none where nothing is felt of the state
};

// x = G B r and its derivative by the angle: 2 modes blocks each.
STABLECUT_WIDE void states_of(const Arrays& of, const double* r, double* x, double* dx) {
  const Eigen::Index n = of.size, m = of.modes;
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
}

// Adds l^H M r and l^H M' r of a part, M' by the angle, to two blocks.
STABLECUT_WIDE void add_quotients(const Arrays& of, const PartArrays& part, const double* scales,
                                  const double* r, const double* l, const double* x, const double* dx,
                                  double* sums) {
  const Eigen::Index n = of.size, m = of.modes;
  const ComplexLanes scale = load_complex(scales), scale_slope = load_complex(scales + kComplexLanes);
  ComplexLanes value = load_complex(sums), slope = load_complex(sums + kComplexLanes);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ComplexLanes left = load_complex(l + i * kComplexLanes);
    ComplexLanes now = row_times(part.direct + i, n, n, r), changed{Lanes{}, Lanes{}};
    if (part.of_state != nullptr) {
      now = now + row_times(part.of_state + i, n, 2 * m, x);
      changed = row_times(part.of_state + i, n, 2 * m, dx);
    }
    value = value + conjugate_times(left, scale * now);
    slope = slope + conjugate_times(left, scale * changed + scale_slope * now);
  }
  store_complex(value, sums);
  store_complex(slope, sums + kComplexLanes);
}

// The sums over l^H r.
STABLECUT_WIDE void divide(const double* r, const double* l, Eigen::Index n, double* sums) {
  ComplexLanes scale{Lanes{}, Lanes{}};
  for (Eigen::Index i = 0; i < n; ++i)
    scale = scale + conjugate_times(load_complex(l + i * kComplexLanes), load_complex(r + i * kComplexLanes));
  for (int k = 0; k < 2; ++k)
    store_complex(quotient(load_complex(sums + k * kComplexLanes), scale), sums + k * kComplexLanes);
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
      scales_(4 * static_cast<std::ptrdiff_t>(of.parts.size())),
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
  for (const CircleOperator::Part& part : of.parts) {
    const bool of_state = part.of_state.cols() > 0;
    const Eigen::Index stride = of_state ? 1 + 2 * groups_ : 1;
    terms_.emplace_back(size_ * size_ * stride, 0.0);
    double* to = terms_.back().data();
    for (Eigen::Index i = 0; i < size_; ++i) {
      for (Eigen::Index j = 0; j < size_; ++j, to += stride) {
        to[0] = part.direct(i, j);
        for (Eigen::Index k = 0; of_state && k < modes_; ++k) {
          const double ur = part.of_state(i, k), ui = part.of_state(i, modes_ + k);
          const double br = of.state_of(k, j), bi = of.state_of(modes_ + k, j);
          to[1 + 2 * group_of_[k]] += ur * br + ui * bi;
          to[2 + 2 * group_of_[k]] += ui * br - ur * bi;
        }
      }
    }
  }
}

void CircleLanes::form(const Angles& angles) {
  for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
    const Complex mu = std::polar(1.0, angles[lane]), i_mu(-mu.imag(), mu.real());
    for (std::size_t p = 0; p < of_.parts.size(); ++p) {
      const int delay = of_.parts[p].delay;
      const Complex delayed = std::polar(1.0, -delay * angles[lane]);
      Complex scale = delayed, slope = delayed * Complex(0, -delay);
      if (of_.plain) {
        // Times 1 - 1 / mu, whose derivative is i / mu.
        slope = slope * (1.0 - std::conj(mu)) + delayed * Complex(mu.imag(), mu.real());
        scale *= 1.0 - std::conj(mu);
      }
      put(scale, lane, scales_.data() + 2 * p * kComplexLanes);
      put(slope, lane, scales_.data() + (2 * p + 1) * kComplexLanes);
    }
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
  for (std::size_t p = 0; p < of_.parts.size(); ++p)
    form_matrix(terms_[p].data(), size_ * size_, of_.parts[p].of_state.cols() > 0 ? groups_ : 0,
                factors_.data(), scales_.data() + 2 * p * kComplexLanes, p > 0, eigen_.matrix());
  eigen_.reduce();
}

EigenvalueLanes CircleLanes::refined(const std::array<Complex, kPlaces>& shifts) {
  eigen_.vectors(shifts, right_.data(), left_.data());
  const Arrays arrays{size_, modes_, of_.state_of.data(), group_of_.data(), factors_.data(), scales_.data()};
  double *x = work_.data(), *dx = x + 2 * modes_ * kComplexLanes;
  states_of(arrays, right_.data(), x, dx);
  alignas(64) double result[2 * kComplexLanes] = {};
  for (std::size_t p = 0; p < of_.parts.size(); ++p) {
    const CircleOperator::Part& part = of_.parts[p];
    add_quotients(arrays, {part.direct.data(), part.of_state.cols() > 0 ? part.of_state.data() : nullptr},
                  scales_.data() + 2 * p * kComplexLanes, right_.data(), left_.data(), x, dx, result);
  }
  divide(right_.data(), left_.data(), size_, result);
  EigenvalueLanes lanes;
  for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
    lanes.value[lane] = get(result, lane);
    lanes.slope[lane] = get(result + kComplexLanes, lane);
  }
  return lanes;
}

std::array<Complex, CircleLanes::kPlaces> CircleLanes::quotients(const CircleOperator& other) {
  const Arrays arrays{size_,           modes_,        other.state_of.data(), group_of_.data(),
                      factors_.data(), scales_.data()};
  double *x = work_.data(), *dx = x + 2 * modes_ * kComplexLanes;
  states_of(arrays, right_.data(), x, dx);
  alignas(64) double result[2 * kComplexLanes] = {};
  add_quotients(arrays, {other.parts[0].direct.data(), other.parts[0].of_state.data()}, scales_.data(),
                right_.data(), left_.data(), x, dx, result);
  divide(right_.data(), left_.data(), size_, result);
  std::array<Complex, kPlaces> values;
  for (Eigen::Index lane = 0; lane < kLanes; ++lane) values[lane] = get(result, lane);
  return values;
}

Eigen::VectorXcd CircleLanes::vector(const numerics::LaneArray& of, std::size_t place) const {
  Eigen::VectorXcd vector(size_);
  for (Eigen::Index i = 0; i < size_; ++i)
    vector[i] = get(of.data() + i * kComplexLanes, static_cast<Eigen::Index>(place));
  return vector;
}

}  // namespace stablecut::milling
