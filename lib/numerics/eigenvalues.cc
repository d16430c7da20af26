#include "numerics/eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "numerics/francis_qr.h"
#include "numerics/lanes.h"

namespace stablecut::numerics {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// I - (1, q, r)^T (x, y, z), which takes three rows or columns (or two, with q and z unused) to new ones.
struct Reflection {
  double x, y, z, q, r;
};

STABLECUT_INLINE void reflect_rows(double* __restrict row0, double* __restrict row1, double* __restrict row2,
                                   Eigen::Index count, const Reflection& t) {
  if (row2 != nullptr) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double sum = row0[j] + t.q * row1[j] + t.r * row2[j];
      row0[j] -= sum * t.x;
      row1[j] -= sum * t.y;
      row2[j] -= sum * t.z;
    }
  } else {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double sum = row0[j] + t.q * row1[j];
      row0[j] -= sum * t.x;
      row1[j] -= sum * t.y;
    }
  }
}

STABLECUT_INLINE void reflect_columns(double* entry, Eigen::Index stride, Eigen::Index count, bool three,
                                      const Reflection& t) {
  if (three) {
    for (Eigen::Index i = 0; i < count; ++i, entry += stride) {
      const double sum = t.x * entry[0] + t.y * entry[1] + t.z * entry[2];
      entry[0] -= sum;
      entry[1] -= sum * t.q;
      entry[2] -= sum * t.r;
    }
  } else {
    for (Eigen::Index i = 0; i < count; ++i, entry += stride) {
      const double sum = t.x * entry[0] + t.y * entry[1];
      entry[0] -= sum;
      entry[1] -= sum * t.q;
    }
  }
}

// A Hessenberg matrix under QR sweeps on its active block [low, high].
class HessenbergQr {
 public:
  explicit HessenbergQr(RowMatrix h) : h_(std::move(h)), n_(h_.rows()), norm_(h_.cwiseAbs().sum()) {}

  // False when a block does not converge.
  bool run(Eigen::VectorXcd& values) {
    values.resize(n_);
    Eigen::Index high = n_ - 1;
    int sweeps = 0;
    while (high >= 0) {
      const Eigen::Index low = find_split(high);
      if (low == high) {
        values[high] = h_(high, high);
        high -= 1;
        sweeps = 0;
      } else if (low == high - 1) {
        std::tie(values[high - 1], values[high]) = block_eigenvalues(
            h_(high - 1, high - 1), h_(high - 1, high) * h_(high, high - 1), h_(high, high));
        high -= 2;
        sweeps = 0;
      } else {
        if (++sweeps > kPatience) return false;
        sweep(low, high, sweeps);
      }
    }
    return true;
  }

 private:
  // The start of the lowest unreduced block that ends at `high`.
  Eigen::Index find_split(Eigen::Index high) {
    for (Eigen::Index l = high; l > 0; --l) {
      double size = std::abs(h_(l - 1, l - 1)) + std::abs(h_(l, l));
      if (size == 0) size = norm_;
      if (std::abs(h_(l, l - 1)) <= kRounding * size) {
        h_(l, l - 1) = 0;
        return l;
      }
    }
    return 0;
  }

  void sweep(Eigen::Index low, Eigen::Index high, int sweeps) {
    const auto [sum, product] = shifts_of(h_(high - 1, high - 1), h_(high - 1, high), h_(high, high - 1),
                                          h_(high, high), h_(high - 1, high - 2), sweeps);
    // First column of (H - s1)(H - s2), as low in the block as two small subdiagonals allow.
    double p = 0, q = 0, r = 0;
    Eigen::Index start = high - 2;
    for (;; --start) {
      const double a = h_(start, start), b = h_(start + 1, start + 1);
      p = (a * (a - sum) + product) / h_(start + 1, start) + h_(start, start + 1);
      q = a + b - sum;
      r = h_(start + 2, start + 1);
      const double size = std::abs(p) + std::abs(q) + std::abs(r);
      p /= size;
      q /= size;
      r /= size;
      if (start == low) break;
      const double left = std::abs(h_(start, start - 1)) * (std::abs(q) + std::abs(r));
      const double right = std::abs(p) * (std::abs(h_(start - 1, start - 1)) + std::abs(a) + std::abs(b));
      if (left <= kRounding * right) break;
    }
    // Chase the bulge: reflections I - (1, q, r) (x, y, z)^T of rows and columns k, k+1, k+2.
    for (Eigen::Index k = start; k < high; ++k) {
      const bool three = k + 2 <= high;
      double size = 1;
      if (k > start) {
        p = h_(k, k - 1);
        q = h_(k + 1, k - 1);
        r = three ? h_(k + 2, k - 1) : 0.0;
        size = std::abs(p) + std::abs(q) + std::abs(r);
        if (size == 0) continue;
        const double inverse = 1 / size;
        p *= inverse;
        q *= inverse;
        r *= inverse;
      }
      const double norm = std::copysign(std::sqrt(p * p + q * q + r * r), p);
      if (norm == 0) continue;
      if (k > start) {
        h_(k, k - 1) = -norm * size;
        h_(k + 1, k - 1) = 0;
        if (three) h_(k + 2, k - 1) = 0;
      } else if (k > low) {
        h_(k, k - 1) = -h_(k, k - 1);
      }
      p += norm;
      const double by_norm = 1 / norm, by_p = 1 / p;
      const double x = p * by_norm, y = q * by_norm, z = r * by_norm;
      q *= by_p;
      r *= by_p;
      reflect_rows(&h_(k, k), &h_(k + 1, k), three ? &h_(k + 2, k) : nullptr, high - k + 1, {x, y, z, q, r});
      const Eigen::Index last = std::min(high, k + 3);
      reflect_columns(&h_(low, k), n_, last - low + 1, three, {x, y, z, q, r});
    }
  }

  RowMatrix h_;
  Eigen::Index n_;
  double norm_;
};

void check_finite(const Eigen::MatrixXd& matrix) {
  if (!matrix.allFinite()) throw InvalidArgument("the period's map is not finite");
}

Eigen::VectorXcd hessenberg_eigenvalues(const RowMatrix& hessenberg) {
  Eigen::VectorXcd values;
  return HessenbergQr(hessenberg).run(values) ? values : eigenvalues(hessenberg);
}

// Norm of what is not reduced yet, over the norm of what is, at which the largest modulus is looked for, and
// over that modulus, at which it is ignored.
constexpr double kTried = 0.1, kIgnored = 0.4;
constexpr Eigen::Index kNextStop = 2;  // columns between a stop and the next
constexpr double kAgreement = 1e-11;   // of two stops, at which both are right
constexpr double kUnsettled = 1e-3;    // from which on values cannot be followed
constexpr int kNewtonSteps = 3;
constexpr double kWorthStopping = 0.75;  // share of the rows from which on the whole costs as little

// Deterministic whatever the vectors' width: sums in lanes. Columns begin at whole lanes and are filled up
// with zeros to whole lanes, so that loops need no ends.
STABLECUT_INLINE double dot(const double* a, const double* b, Eigen::Index from, Eigen::Index to) {
  Lanes sum{};
  for (Eigen::Index i = from; i < to; i += kLanes) sum += load_lanes(a + i) * load_lanes(b + i);
  return sum_of(sum);
}
STABLECUT_INLINE void add(double factor, const double* from, double* to, Eigen::Index first,
                          Eigen::Index last) {
  for (Eigen::Index i = first; i < last; i += kLanes)
    store_lanes(load_lanes(to + i) + factor * load_lanes(from + i), to + i);
}

// Q A Q with the reflection Q = I - 2 v v^T / v^T v on the rows and columns from `begin` of the matrix of n
// columns at `a`, each of `stride` numbers; v is zero before `begin`. Columns before `first` need no rows
// reflected. `work` holds `stride` numbers.
STABLECUT_WIDE void reflect(double* a, Eigen::Index n, Eigen::Index stride, const double* v,
                            Eigen::Index begin, Eigen::Index first, double* work) {
  const Eigen::Index from = begin / kLanes * kLanes;
  const double size = dot(v, v, from, stride);
  if (size == 0) return;
  for (Eigen::Index c = first; c < n; ++c) {
    double* column = a + c * stride;
    add(-2 / size * dot(v, column, from, stride), v, column, from, stride);
  }
  std::fill(work, work + stride, 0.0);
  for (Eigen::Index c = begin; c < n; ++c) add(v[c], a + c * stride, work, 0, stride);
  for (Eigen::Index c = begin; c < n; ++c) add(-2 / size * v[c], work, a + c * stride, 0, stride);
}

// A matrix on its way to Hessenberg form: columns of `stride` numbers, the rows below n zero.
class Reduction {
 public:
  explicit Reduction(const Eigen::MatrixXd& matrix)
      : n_(matrix.rows()),
        a_(Eigen::MatrixXd::Zero((n_ + kLanes - 1) / kLanes * kLanes, n_)),
        v_(Eigen::VectorXd::Zero(a_.rows())),
        work_(a_.rows()) {
    a_.topRows(n_) = matrix;
    // The basis begins with a vector that has a part of everything.
    v_.head(n_).setOnes();
    v_[0] += std::sqrt(static_cast<double>(n_));
    reflect(a_.data(), n_, a_.rows(), v_.data(), 0, 0, work_.data());
  }

  // Column k to one entry below its diagonal.
  void reduce_column(Eigen::Index k) {
    const Eigen::Index count = n_ - k - 1;
    auto column = a_.col(k).segment(k + 1, count);
    if (column.tail(count - 1).isZero(0)) return;
    v_.setZero();
    v_.segment(k + 1, count) = column;
    const double norm = std::copysign(column.norm(), column[0]);
    v_[k + 1] += norm;
    reflect(a_.data(), n_, a_.rows(), v_.data(), k + 1, k + 1, work_.data());
    column.setZero();
    column[0] = -norm;
  }

  // The leading block, and the norm of what follows on the diagonal.
  auto reduced(Eigen::Index size) const { return a_.topLeftCorner(size, size); }
  double norm_left(Eigen::Index size) const { return a_.block(size, size, n_ - size, n_ - size).norm(); }

 private:
  Eigen::Index n_;
  Eigen::MatrixXd a_;
  Eigen::VectorXd v_, work_;
};

// An eigenvalue of the leading Hessenberg block of that size, from one nearby: Newton's method on what is
// left of the first equation when the others are solved from the last (Hyman). Not finite where a subdiagonal
// is zero.
std::complex<double> followed(const Eigen::Ref<const Eigen::MatrixXd>& h, std::complex<double> value) {
  const Eigen::Index size = h.rows();
  Eigen::VectorXcd x(size), slope(size);  // the vector, and its derivative by the eigenvalue
  for (int step = 0; step < kNewtonSteps; ++step) {
    x.setZero();
    slope.setZero();
    x[size - 1] = 1;
    std::complex<double> rest, rest_slope;
    for (Eigen::Index row = size - 1; row >= 0; --row) {
      rest = -value * x[row];
      rest_slope = -x[row] - value * slope[row];
      for (Eigen::Index c = row; c < size; ++c) {
        rest += h(row, c) * x[c];
        rest_slope += h(row, c) * slope[c];
      }
      if (row == 0) break;
      x[row - 1] = -rest / h(row, row - 1);
      slope[row - 1] = -rest_slope / h(row, row - 1);
    }
    const std::complex<double> change = rest / rest_slope;
    value -= change;
    if (std::abs(change) <= kRounding * std::abs(value)) break;
  }
  return value;
}

}  // namespace

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  check_finite(matrix);
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

Eigen::VectorXcd leading_eigenvalues(Eigen::MatrixXd a, Eigen::Index states) {
  check_finite(a);
  const Eigen::Index n = a.rows(), rest = n - states;
  if (n == 1) return a.cast<std::complex<double>>();
  const double out = a.topRightCorner(states, rest).norm(), back = a.bottomLeftCorner(rest, states).norm();
  if (out > 0 && back > 0) {
    const double ratio = std::sqrt(back / out);
    a.topRightCorner(states, rest) *= ratio;
    a.bottomLeftCorner(rest, states) /= ratio;
  }
  Reduction reduction(a);
  std::vector<std::complex<double>> found;  // the largest and its rivals, of the stop before
  Eigen::Index stopped = 0;
  for (Eigen::Index size = 1; size + 1 < n; ++size) {
    reduction.reduce_column(size - 1);
    // Before the basis holds as much as the states the rest is not small.
    if (size < states || static_cast<double>(size) > kWorthStopping * static_cast<double>(n) ||
        size < stopped + kNextStop)
      continue;
    // Follow the largest and its rivals; where they still move much, or there are none, look at all again.
    double change = found.empty() ? kUnsettled : 0;
    for (auto& value : found) {
      const auto now = followed(reduction.reduced(size), value);
      const double moved = std::abs(now - value) / std::max(1.0, std::abs(now));
      change = std::max(change, std::isfinite(moved) ? moved : kUnsettled);
      value = now;
    }
    // All of the block once more: where two meet, both values that were followed may have gone to one of
    // them.
    if (change <= kAgreement) return hessenberg_eigenvalues(reduction.reduced(size));
    stopped = size;
    if (change < kUnsettled) continue;
    found.clear();
    const double left = reduction.norm_left(size);
    if (left > kTried * reduction.reduced(size).norm()) continue;
    const Eigen::VectorXcd values = hessenberg_eigenvalues(reduction.reduced(size));
    const double largest = values.cwiseAbs().maxCoeff();
    if (left > kIgnored * largest) continue;
    for (const auto& value : values) {
      if (value.imag() >= 0 && std::abs(value) >= kLeading * largest) found.push_back(value);
    }
  }
  return hessenberg_eigenvalues(reduction.reduced(n));
}

}  // namespace stablecut::numerics
