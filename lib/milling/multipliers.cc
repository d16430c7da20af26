#include "milling/multipliers.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/error.h"

namespace stablecut {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kPatience = 60;  // sweeps for one eigenvalue

// I - (1, q, r)^T (x, y, z), which takes three rows or columns (or two, with q and z unused) to new ones.
struct Reflection {
  double x, y, z, q, r;
};

// Elementwise, so that wide vectors give the same bits.
void reflect_rows(double* __restrict row0, double* __restrict row1, double* __restrict row2,
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

void reflect_columns(double* entry, Eigen::Index stride, Eigen::Index count, bool three,
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
        two_values(high, values);
        high -= 2;
        sweeps = 0;
      } else {
        if (++sweeps > kPatience) return false;
        sweep(low, high, sweeps % 10 == 0);
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
      if (std::abs(h_(l, l - 1)) <= kEpsilon * size) {
        h_(l, l - 1) = 0;
        return l;
      }
    }
    return 0;
  }

  void two_values(Eigen::Index high, Eigen::VectorXcd& values) const {
    const double a = h_(high - 1, high - 1), d = h_(high, high);
    const double bc = h_(high - 1, high) * h_(high, high - 1);
    const double half = (a - d) / 2;
    const double discriminant = half * half + bc;
    const double root = std::sqrt(std::abs(discriminant));
    if (discriminant < 0) {
      values[high - 1] = {d + half, root};
      values[high] = {d + half, -root};
    } else {
      const double larger = half + std::copysign(root, half);  // no cancellation
      values[high - 1] = d + larger;
      values[high] = larger == 0 ? d : d - bc / larger;
    }
  }

  void sweep(Eigen::Index low, Eigen::Index high, bool exceptional) {
    // Sum and product of the two shifts: the eigenvalues of the last 2x2 block, or something else when stuck.
    double sum = h_(high - 1, high - 1) + h_(high, high);
    double product = h_(high - 1, high - 1) * h_(high, high) - h_(high - 1, high) * h_(high, high - 1);
    if (exceptional) {
      const double size = std::abs(h_(high, high - 1)) + std::abs(h_(high - 1, high - 2));
      sum = 1.5 * size;
      product = size * size;
    }
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
      if (left <= kEpsilon * right) break;
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
        p /= size;
        q /= size;
        r /= size;
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
      const double x = p / norm, y = q / norm, z = r / norm;
      q /= p;
      r /= p;
      reflect_rows(&h_(k, k), &h_(k + 1, k), three ? &h_(k + 2, k) : nullptr, high - k + 1, {x, y, z, q, r});
      const Eigen::Index last = std::min(high, k + 3);
      reflect_columns(&h_(low, k), n_, last - low + 1, three, {x, y, z, q, r});
    }
  }

  RowMatrix h_;
  Eigen::Index n_;
  double norm_;
};

}  // namespace

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  if (!matrix.allFinite())
    throw InvalidArgument("the period's map is not finite: expected modes and depths of a usual size");
  if (matrix.rows() == 1) return matrix.cast<std::complex<double>>();
  const RowMatrix hessenberg = Eigen::HessenbergDecomposition<Eigen::MatrixXd>(matrix).matrixH();
  Eigen::VectorXcd values;
  if (HessenbergQr(hessenberg).run(values)) return values;
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

}  // namespace stablecut
