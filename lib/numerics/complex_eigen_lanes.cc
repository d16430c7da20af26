#include "numerics/complex_eigen_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/complex_lanes.h"
#include "numerics/francis_qr.h"

namespace stablecut::numerics {
namespace {

using Complex = std::complex<double>;

// A pivot of inverse iteration is not smaller than this share of the matrix's norm: the vector is the same,
// and finite.
constexpr double kLeastPivot = 1e-15;
// Norms below it are zero: their squares would underflow.
constexpr double kLeastNorm = 1e-140;

// Householder reduction. Reflection k is I - f v v^H with v in column k of `reflectors` (blocks i n + k, i >
// k) and f in `factors`. w holds n blocks.
STABLECUT_WIDE void reduce_to_hessenberg(double* h, Eigen::Index n, double* reflectors, double* factors,
                                         double* w) {
  const auto at = [&](Eigen::Index i, Eigen::Index j)
                      STABLECUT_INLINE_LAMBDA { return h + (i * n + j) * kComplexLanes; };
  for (Eigen::Index k = 0; k + 2 < n; ++k) {
    Lanes square{};
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const ComplexLanes x = load_complex(at(i, k));
      store_complex(x, reflectors + (i * n + k) * kComplexLanes);
      square += square_of(x);
    }
    const ComplexLanes first = load_complex(at(k + 1, k));
    const Lanes norm = square_root(square), size = square_root(square_of(first));
    const Lanes zero{}, one = zero + 1.0;
    const Lanes by_size = size > kLeastNorm ? 1.0 / (size > kLeastNorm ? size : one) : zero;
    const ComplexLanes phase{size > kLeastNorm ? first.re * by_size : one, first.im * by_size};
    const ComplexLanes pivot = first + norm * phase;
    store_complex(pivot, reflectors + ((k + 1) * n + k) * kComplexLanes);
    const Lanes product = norm * (norm + size);
    const Lanes factor = norm > kLeastNorm ? 1.0 / (norm > kLeastNorm ? product : one) : zero;
    store_lanes(factor, factors + k * kLanes);
    // w = v^H H, then H - f v w; and from the right, H - f (H v) v^H.
    for (Eigen::Index j = k; j < n; ++j) store_complex({zero, zero}, w + j * kComplexLanes);
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const ComplexLanes v = load_complex(reflectors + (i * n + k) * kComplexLanes);
      for (Eigen::Index j = k; j < n; ++j)
        store_complex(load_complex(w + j * kComplexLanes) + conjugate_times(v, load_complex(at(i, j))),
                      w + j * kComplexLanes);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      ComplexLanes sum{zero, zero};
      if (i > k) {
        const ComplexLanes v = factor * load_complex(reflectors + (i * n + k) * kComplexLanes);
        for (Eigen::Index j = k; j < n; ++j) {
          const ComplexLanes entry = load_complex(at(i, j)) - v * load_complex(w + j * kComplexLanes);
          store_complex(entry, at(i, j));
          if (j > k) sum = sum + entry * load_complex(reflectors + (j * n + k) * kComplexLanes);
        }
      } else {
        for (Eigen::Index j = k + 1; j < n; ++j)
          sum = sum + load_complex(at(i, j)) * load_complex(reflectors + (j * n + k) * kComplexLanes);
      }
      sum = factor * sum;
      for (Eigen::Index j = k + 1; j < n; ++j)
        store_complex(load_complex(at(i, j)) -
                          conjugate_times(load_complex(reflectors + (j * n + k) * kComplexLanes), sum),
                      at(i, j));
    }
  }
}

struct Rotation {
  Lanes c;
  ComplexLanes s;
};

// The unitary [c s; -conj(s) c] that takes (x, y) to (r, 0); the identity where both are nothing.
STABLECUT_INLINE Rotation rotation_of(const ComplexLanes& x, const ComplexLanes& y) {
  const Lanes zero{}, one = zero + 1.0;
  const Lanes xx = square_of(x), yy = square_of(y), all = xx + yy;
  const Lanes usable = all > kLeastNorm * kLeastNorm ? one : zero;
  const Lanes has_x = xx > kLeastNorm * kLeastNorm ? one : zero;
  const Lanes inverse = 1.0 / square_root(usable > 0.5 ? all : one);
  const Lanes by_x = 1.0 / square_root(has_x > 0.5 ? xx : one);
  const ComplexLanes phase{has_x > 0.5 ? x.re * by_x : one, has_x * x.im * by_x};
  Rotation r;
  r.c = usable > 0.5 ? square_root(xx) * inverse : one;
  r.s = usable * inverse * (phase * conjugate(y));
  return r;
}

// One sweep with a shift on each lane's block [low, high] (none where high <= low), over the rows and columns
// from `first` to `last`. `rotations` holds 3 n lanes.
STABLECUT_WIDE void sweep(double* h, Eigen::Index n, Eigen::Index first, Eigen::Index last,
                          const double* lows, const double* highs, const double* shifts, double* rotations) {
  const Lanes low = load_lanes(lows), high = load_lanes(highs);
  const ComplexLanes shift = load_complex(shifts);
  const Lanes zero{}, one = zero + 1.0;
  const auto at = [&](Eigen::Index i, Eigen::Index j)
                      STABLECUT_INLINE_LAMBDA { return h + (i * n + j) * kComplexLanes; };
  // H - shift = Q R from above, then R Q + shift, a column behind.
  for (Eigen::Index k = first; k <= last; ++k) {
    const Lanes here = zero + static_cast<double>(k);
    const Lanes inside = (here >= low ? one : zero) * (here <= high ? one : zero);
    store_complex(load_complex(at(k, k)) - inside * shift, at(k, k));
  }
  for (Eigen::Index k = first; k < last; ++k) {
    const Lanes here = zero + static_cast<double>(k);
    const Lanes active = (here >= low ? one : zero) * (here < high ? one : zero);
    Rotation r = rotation_of(load_complex(at(k, k)), load_complex(at(k + 1, k)));
    r.c = active > 0.5 ? r.c : one;
    r.s = active * r.s;
    store_lanes(r.c, rotations + 3 * k * kLanes);
    store_complex(r.s, rotations + (3 * k + 1) * kLanes);
    for (Eigen::Index j = k; j <= last; ++j) {
      const ComplexLanes a = load_complex(at(k, j)), b = load_complex(at(k + 1, j));
      store_complex(r.c * a + r.s * b, at(k, j));
      store_complex(r.c * b - conjugate_times(r.s, a), at(k + 1, j));
    }
  }
  // Row by row, all rotations of columns: rows reach to the subdiagonal.
  for (Eigen::Index i = first; i <= last; ++i) {
    const Eigen::Index begin = std::max(first, i - 1);
    if (begin >= last) {
      continue;
    }
    ComplexLanes a = load_complex(at(i, begin));
    for (Eigen::Index k = begin; k < last; ++k) {
      const Lanes c = load_lanes(rotations + 3 * k * kLanes);
      const ComplexLanes s = load_complex(rotations + (3 * k + 1) * kLanes);
      const ComplexLanes b = load_complex(at(i, k + 1));
      store_complex(c * a + conjugate_times(s, b), at(i, k));
      a = c * b - s * a;
    }
    store_complex(a, at(i, last));
  }
  for (Eigen::Index k = first; k <= last; ++k) {
    const Lanes here = zero + static_cast<double>(k);
    const Lanes inside = (here >= low ? one : zero) * (here <= high ? one : zero);
    store_complex(load_complex(at(k, k)) + inside * shift, at(k, k));
  }
}

// Largest sums of a row's parts in absolute value, into kLanes numbers.
STABLECUT_WIDE void row_norms(const double* h, Eigen::Index n, double* norms) {
  Lanes most{};
  for (Eigen::Index i = 0; i < n; ++i) {
    Lanes sum{};
    for (Eigen::Index j = 0; j < 2 * n; ++j) sum += absolute(load_lanes(h + (2 * i * n + j) * kLanes));
    most = largest(most, sum);
  }
  store_lanes(most, norms);
}

// Rotations that make H - shift upper triangular: R in `r` (n x n blocks), the rotations in `rotations`.
STABLECUT_WIDE void triangular_form(const double* h, Eigen::Index n, const double* shifts,
                                    const double* norms, double* r, double* rotations) {
  const ComplexLanes shift = load_complex(shifts);
  const auto at = [&](Eigen::Index i, Eigen::Index j)
                      STABLECUT_INLINE_LAMBDA { return r + (i * n + j) * kComplexLanes; };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = std::max<Eigen::Index>(i - 1, 0); j < n; ++j)
      store_complex(load_complex(h + (i * n + j) * kComplexLanes), at(i, j));
    store_complex(load_complex(at(i, i)) - shift, at(i, i));
  }
  const Lanes least = kLeastPivot * load_lanes(norms) + kLeastNorm;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k + 1 < n) {
      const Rotation q = rotation_of(load_complex(at(k, k)), load_complex(at(k + 1, k)));
      store_lanes(q.c, rotations + 3 * k * kLanes);
      store_complex(q.s, rotations + (3 * k + 1) * kLanes);
      for (Eigen::Index j = k; j < n; ++j) {
        const ComplexLanes a = load_complex(at(k, j)), b = load_complex(at(k + 1, j));
        store_complex(q.c * a + q.s * b, at(k, j));
        store_complex(q.c * b - conjugate_times(q.s, a), at(k + 1, j));
      }
    }
    // Kept as its reciprocal.
    ComplexLanes pivot = load_complex(at(k, k));
    const Lanes small = square_of(pivot) < least * least ? Lanes{} + 1.0 : Lanes{};
    pivot.re = small > 0.5 ? least : pivot.re;
    pivot.im = small > 0.5 ? Lanes{} : pivot.im;
    store_complex(quotient({Lanes{} + 1.0, Lanes{}}, pivot), at(k, k));
  }
}

// Divides a vector by its size.
STABLECUT_INLINE void normalise(double* x, Eigen::Index n) {
  Lanes square{};
  for (Eigen::Index i = 0; i < n; ++i) square += square_of(load_complex(x + i * kComplexLanes));
  const Lanes by = 1.0 / square_root(largest(square, Lanes{} + 1e-300));
  for (Eigen::Index i = 0; i < n; ++i)
    store_complex(by * load_complex(x + i * kComplexLanes), x + i * kComplexLanes);
}

// Inverse iteration with Q R: the right vector solves R x = Q^H x, the left one R^H w = y, y = Q w.
STABLECUT_WIDE void inverse_iteration(const double* r, const double* rotations, Eigen::Index n, double* right,
                                      double* left) {
  const auto at = [&](Eigen::Index i, Eigen::Index j)
                      STABLECUT_INLINE_LAMBDA { return load_complex(r + (i * n + j) * kComplexLanes); };
  const auto rotation = [&](Eigen::Index k) STABLECUT_INLINE_LAMBDA {
    return Rotation{load_lanes(rotations + 3 * k * kLanes), load_complex(rotations + (3 * k + 1) * kLanes)};
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    store_complex({Lanes{} + 1.0, Lanes{}}, right + i * kComplexLanes);
    store_complex({Lanes{} + 1.0, Lanes{}}, left + i * kComplexLanes);
  }
  for (int step = 0; step < 2; ++step) {
    for (Eigen::Index k = 0; step > 0 && k + 1 < n; ++k) {
      const Rotation q = rotation(k);
      double* own = right + k * kComplexLanes;
      const ComplexLanes a = load_complex(own), b = load_complex(own + kComplexLanes);
      store_complex(q.c * a + q.s * b, own);
      store_complex(q.c * b - conjugate_times(q.s, a), own + kComplexLanes);
    }
    for (Eigen::Index i = n - 1; i >= 0; --i) {
      ComplexLanes sum = load_complex(right + i * kComplexLanes);
      for (Eigen::Index j = i + 1; j < n; ++j) sum = sum - at(i, j) * load_complex(right + j * kComplexLanes);
      store_complex(sum * at(i, i), right + i * kComplexLanes);
    }
    normalise(right, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const ComplexLanes value = conjugate_times(at(i, i), load_complex(left + i * kComplexLanes));
      store_complex(value, left + i * kComplexLanes);
      for (Eigen::Index j = i + 1; j < n; ++j) {
        double* other = left + j * kComplexLanes;
        store_complex(load_complex(other) - conjugate_times(at(i, j), value), other);
      }
    }
    for (Eigen::Index k = n - 2; k >= 0; --k) {
      const Rotation q = rotation(k);
      double* own = left + k * kComplexLanes;
      const ComplexLanes a = load_complex(own), b = load_complex(own + kComplexLanes);
      store_complex(q.c * a - q.s * b, own);
      store_complex(q.c * b + conjugate_times(q.s, a), own + kComplexLanes);
    }
    normalise(left, n);
  }
}

// From the Hessenberg form's basis to the matrix's: the reflections from the last to the first.
STABLECUT_WIDE void reflect_back(const double* reflectors, const double* factors, Eigen::Index n, double* x) {
  for (Eigen::Index k = n - 3; k >= 0; --k) {
    ComplexLanes sum{Lanes{}, Lanes{}};
    for (Eigen::Index i = k + 1; i < n; ++i)
      sum = sum + conjugate_times(load_complex(reflectors + (i * n + k) * kComplexLanes),
                                  load_complex(x + i * kComplexLanes));
    sum = load_lanes(factors + k * kLanes) * sum;
    for (Eigen::Index i = k + 1; i < n; ++i)
      store_complex(
          load_complex(x + i * kComplexLanes) - sum * load_complex(reflectors + (i * n + k) * kComplexLanes),
          x + i * kComplexLanes);
  }
}

// The QR iteration of the lanes in step.
class Iteration {
 public:
  Iteration(double* h, Eigen::Index n, const std::array<double, kLanes>& norms, double accuracy)
      : h_(h), n_(n), norms_(norms), accuracy_(accuracy) {}

  std::array<std::vector<Complex>, kLanes> run(double* rotations) {
    high_.fill(n_ - 1);
    for (;;) {
      Eigen::Index first = n_, last = -1;
      alignas(64) double low[kLanes], high[kLanes], shift[kComplexLanes];
      for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
        const Eigen::Index begin = deflate(lane);
        low[lane] = static_cast<double>(begin);
        high[lane] = static_cast<double>(high_[lane]);
        const Complex s = high_[lane] < 0 ? 0.0 : shift_of(lane);
        shift[lane] = s.real();
        shift[kLanes + lane] = s.imag();
        if (high_[lane] < 0) continue;
        first = std::min(first, begin);
        last = std::max(last, high_[lane]);
      }
      if (last < 0) return found_;
      sweep(h_, n_, first, last, low, high, shift, rotations);
    }
  }

 private:
  Complex at(Eigen::Index i, Eigen::Index j, Eigen::Index lane) const {
    const double* block = h_ + (i * n_ + j) * kComplexLanes + lane;
    return {block[0], block[kLanes]};
  }
  static double size(const Complex& z) { return std::abs(z.real()) + std::abs(z.imag()); }

  // Takes off what has converged at the block's end; where the block that is left begins.
  Eigen::Index deflate(Eigen::Index lane) {
    Eigen::Index& high = high_[lane];
    while (high >= 0) {
      Eigen::Index low = high;
      while (low > 0 && size(at(low, low - 1, lane)) > accuracy_ * norms_[lane]) --low;
      if (low < high) {
        if (++sweeps_[lane] <= kPatience) return low;
        found_[lane].assign(n_, std::numeric_limits<double>::quiet_NaN());
        high = -1;
        return 0;
      }
      found_[lane].push_back(at(high, high, lane));
      high -= 1;
      sweeps_[lane] = 0;
    }
    return 0;
  }

  // The eigenvalue of the last two rows that is nearer to the last entry [Wilkinson1965]; now and then
  // another.
  Complex shift_of(Eigen::Index lane) const {
    const Eigen::Index j = high_[lane], i = j - 1;
    const Complex d = at(j, j, lane), below = at(j, i, lane);
    if (sweeps_[lane] % kStuck == 0) return d + size(below);
    const Complex half = (at(i, i, lane) - d) / 2.0, product = at(i, j, lane) * below;
    const Complex root = root_of(half * half + product);
    const Complex larger = std::norm(half + root) > std::norm(half - root) ? half + root : half - root;
    const double square = std::norm(larger);
    return square < kLeastNorm * kLeastNorm ? d : d - product * std::conj(larger) / square;
  }

  // Of numbers whose squares are finite.
  static Complex root_of(const Complex& z) {
    const double size = std::sqrt(std::norm(z));
    const double re = std::sqrt((size + std::abs(z.real())) / 2);
    if (re == 0) return 0;
    const double im = z.imag() / (2 * re);
    return z.real() >= 0 ? Complex(re, im) : Complex(std::abs(im), std::copysign(re, z.imag()));
  }

  double* h_;
  Eigen::Index n_;
  const std::array<double, kLanes>& norms_;
  double accuracy_;
  std::array<Eigen::Index, kLanes> high_{};
  std::array<int, kLanes> sweeps_{};
  std::array<std::vector<Complex>, kLanes> found_;
};

}  // namespace

ComplexEigenLanes::ComplexEigenLanes(Eigen::Index size)
    : n_(size),
      h_(2 * size * size),
      reflectors_(2 * size * size),
      factors_(size),
      work_(2 * size * size),
      rotations_(3 * size) {}

void ComplexEigenLanes::reduce() {
  row_norms(h_.data(), n_, norm_.data());
  reduce_to_hessenberg(h_.data(), n_, reflectors_.data(), factors_.data(), work_.data());
}

std::array<std::vector<Complex>, kLanes> ComplexEigenLanes::values(double accuracy) {
  std::copy(h_.data(), h_.data() + n_ * n_ * kComplexLanes, work_.data());
  // What the reduction left below the subdiagonal is not looked at.
  return Iteration(work_.data(), n_, norm_, accuracy).run(rotations_.data());
}

void ComplexEigenLanes::triangular(const std::array<Complex, kLanes>& shifts) {
  alignas(64) double split[kComplexLanes];
  for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
    split[lane] = shifts[lane].real();
    split[kLanes + lane] = shifts[lane].imag();
  }
  triangular_form(h_.data(), n_, split, norm_.data(), work_.data(), rotations_.data());
}

void ComplexEigenLanes::vectors(const std::array<Complex, kLanes>& shifts, double* right, double* left) {
  triangular(shifts);
  inverse_iteration(work_.data(), rotations_.data(), n_, right, left);
  reflect_back(reflectors_.data(), factors_.data(), n_, right);
  reflect_back(reflectors_.data(), factors_.data(), n_, left);
}

std::array<Complex, kLanes> ComplexEigenLanes::determinant_phases(Complex shift) {
  std::array<Complex, kLanes> phases;
  phases.fill(shift);
  triangular(phases);
  phases.fill(1.0);
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double* reciprocal = work_.data() + (i * n_ + i) * kComplexLanes;
    for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
      const Complex phase = phases[lane] * Complex(reciprocal[lane], -reciprocal[kLanes + lane]);
      phases[lane] = phase / std::sqrt(std::norm(phase));
    }
  }
  return phases;
}

}  // namespace stablecut::numerics
