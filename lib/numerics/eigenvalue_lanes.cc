#include "numerics/eigenvalue_lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "base/error.h"
#include "numerics/eigenvalues.h"
#include "numerics/francis_qr.h"
#include "numerics/lane_array.h"
#include "numerics/lanes.h"

namespace stablecut::numerics {
namespace {

constexpr double kLargestNorm = 1e120;
// Of a reflected vector; a smaller one is left as it is, nothing beside the rest.
constexpr double kLeastSquare = 1e-280;
constexpr int kRoundsBetween = 4;

// n x n matrices in lanes, row by row, with two rows and columns of zeros after them; the column before the
// first is the last of the row above, and one of zeros comes before all.
struct LaneMatrix {
  explicit LaneMatrix(Eigen::Index size)
      : n(size),
        stride((size + 2) * kLanes),
        lanes((size + 2) * (size + 2) + 1),
        data(lanes.data() + kLanes) {}
  Eigen::Index entries() const { return (n + 2) * (n + 2); }
  double* row(Eigen::Index i) { return data + i * stride; }
  double at(Eigen::Index i, Eigen::Index j, Eigen::Index lane) const {
    return data[i * stride + j * kLanes + lane];
  }

  Eigen::Index n, stride;
  LaneArray lanes;
  double* data;
};

// Householder reduction of all lanes to Hessenberg form. v and w hold n lanes.
STABLECUT_WIDE void reduce_to_hessenberg(double* h, Eigen::Index n, Eigen::Index stride, double* v,
                                         double* w) {
  for (Eigen::Index k = 0; k + 2 < n; ++k) {
    Lanes square{};
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const Lanes x = load_lanes(h + i * stride + k * kLanes);
      store_lanes(x, v + i * kLanes);
      square += x * x;
    }
    const Lanes first = load_lanes(v + (k + 1) * kLanes);
    const Lanes norm = with_sign(square_root(square), first);
    const Lanes pivot = first + norm;
    store_lanes(pivot, v + (k + 1) * kLanes);
    // I - v v^T / (norm pivot); nothing where the column is zero.
    const Lanes product = norm * pivot;
    const Lanes factor = product == 0.0 ? Lanes{} : 1.0 / product;
    for (Eigen::Index j = k; j < n; ++j) store_lanes(Lanes{}, w + j * kLanes);
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const Lanes x = load_lanes(v + i * kLanes);
      const double* row = h + i * stride;
      for (Eigen::Index j = k; j < n; ++j)
        store_lanes(load_lanes(w + j * kLanes) + x * load_lanes(row + j * kLanes), w + j * kLanes);
    }
    // Each row from the left and then from the right, while it is near.
    for (Eigen::Index i = 0; i < n; ++i) {
      double* row = h + i * stride;
      Lanes sum{};
      if (i > k) {
        const Lanes x = factor * load_lanes(v + i * kLanes);
        store_lanes(load_lanes(row + k * kLanes) - x * load_lanes(w + k * kLanes), row + k * kLanes);
        for (Eigen::Index j = k + 1; j < n; ++j) {
          const Lanes entry = load_lanes(row + j * kLanes) - x * load_lanes(w + j * kLanes);
          store_lanes(entry, row + j * kLanes);
          sum += entry * load_lanes(v + j * kLanes);
        }
      } else {
        for (Eigen::Index j = k + 1; j < n; ++j)
          sum += load_lanes(row + j * kLanes) * load_lanes(v + j * kLanes);
      }
      sum *= factor;
      for (Eigen::Index j = k + 1; j < n; ++j)
        store_lanes(load_lanes(row + j * kLanes) - sum * load_lanes(v + j * kLanes), row + j * kLanes);
    }
  }
}

// Sums of the entries' absolute values, into kLanes numbers.
STABLECUT_WIDE void absolute_sums(const double* h, Eigen::Index entries, double* sums) {
  Lanes sum{};
  for (Eigen::Index i = 0; i < entries; ++i) sum += absolute(load_lanes(h + i * kLanes));
  store_lanes(sum, sums);
}

// The reflections I - (1, q, r)^T (x, y, z) of columns k, k + 1 and k + 2 for k = from ... last - 1, in turn,
// on rows one below the other: five lanes each in `reflections`. Each step waits for the one before, so that
// several rows go on together.
template <int kRows>
STABLECUT_INLINE void reflect_rows(double* row, Eigen::Index stride, Eigen::Index from, Eigen::Index last,
                                   const double* reflections) {
  Lanes u0[kRows], u1[kRows];
  for (int i = 0; i < kRows; ++i) {
    u0[i] = load_lanes(row + i * stride + from * kLanes);
    u1[i] = load_lanes(row + i * stride + (from + 1) * kLanes);
  }
  for (Eigen::Index k = from; k < last; ++k) {
    const double* t = reflections + 5 * kLanes * k;
    const Lanes x = load_lanes(t), y = load_lanes(t + kLanes), z = load_lanes(t + 2 * kLanes),
                q = load_lanes(t + 3 * kLanes), r = load_lanes(t + 4 * kLanes);
    for (int i = 0; i < kRows; ++i) {
      double* entry = row + i * stride + k * kLanes;
      const Lanes u2 = load_lanes(entry + 2 * kLanes);
      const Lanes sum = x * u0[i] + y * u1[i] + z * u2;
      store_lanes(u0[i] - sum, entry);
      u0[i] = u1[i] - sum * q;
      u1[i] = u2 - sum * r;
    }
  }
  for (int i = 0; i < kRows; ++i) {
    store_lanes(u0[i], row + i * stride + last * kLanes);
    store_lanes(u1[i], row + i * stride + (last + 1) * kLanes);
  }
}

// One double-shift sweep of each lane's block [low, high] (inactive where high < low), from the sums and
// products of its shifts, over the rows and columns from `first` to `last`. `reflections` holds 5 n lanes.
STABLECUT_WIDE void sweep(double* h, Eigen::Index stride, Eigen::Index first, Eigen::Index last,
                          const double* lows, const double* highs, const double* shift_sums,
                          const double* shift_products, double* reflections) {
  const Lanes low = load_lanes(lows), high = load_lanes(highs);
  const Lanes shift_sum = load_lanes(shift_sums), shift_product = load_lanes(shift_products);
  const auto at = [&](Eigen::Index i, Eigen::Index j)
                      STABLECUT_INLINE_LAMBDA { return h + i * stride + j * kLanes; };
  // Masks as numbers, 1 or 0: kept as such between statements they would be taken apart.
  const Lanes zero{}, one = Lanes{} + 1.0;
  for (Eigen::Index k = first; k < last; ++k) {
    const Lanes here = Lanes{} + static_cast<double>(k);
    const Lanes starts = here == low ? one : zero;
    const Lanes before_end = here < high ? one : zero, deep = here + 2.0 <= high ? one : zero;
    // Where the block begins: first column of (H - s1)(H - s2); after it what the bulge left below column
    // k - 1.
    const Lanes a = load_lanes(at(k, k)), b = load_lanes(at(k + 1, k + 1)), below = load_lanes(at(k + 1, k));
    const Lanes safe = below == 0.0 ? one : below;
    const Lanes left0 = load_lanes(at(k, k - 1)), left1 = load_lanes(at(k + 1, k - 1)),
                left2 = load_lanes(at(k + 2, k - 1));
    Lanes p = starts > 0.5 ? (a * (a - shift_sum) + shift_product) / safe + load_lanes(at(k, k + 1)) : left0;
    Lanes q = starts > 0.5 ? a + b - shift_sum : left1;
    Lanes r = deep * (starts > 0.5 ? load_lanes(at(k + 2, k + 1)) : left2);
    const Lanes square = p * p + q * q + r * r;
    const Lanes inside = (square > kLeastSquare ? before_end : zero) * (here >= low ? one : zero);
    p = inside > 0.5 ? p : one;
    const Lanes norm = with_sign(inside > 0.5 ? square_root(square) : one, p);
    const Lanes chases = inside * (one - starts);
    store_lanes(chases > 0.5 ? -norm : left0, at(k, k - 1));
    store_lanes((one - chases) * left1, at(k + 1, k - 1));
    store_lanes((one - chases * deep) * left2, at(k + 2, k - 1));
    p += norm;
    const Lanes inverse = one / (norm * p);  // divisions take long: one for both
    const Lanes by_norm = inverse * inside, by_p = inverse * norm;
    const Lanes x = p * p * by_norm, y = q * p * by_norm, z = r * p * by_norm;
    q *= by_p * inside;
    r *= by_p * inside;
    double *row0 = at(k, 0), *row1 = at(k + 1, 0), *row2 = at(k + 2, 0);
    for (Eigen::Index j = k * kLanes; j <= last * kLanes; j += kLanes) {
      const Lanes u0 = load_lanes(row0 + j), u1 = load_lanes(row1 + j), u2 = load_lanes(row2 + j);
      const Lanes sum = u0 + q * u1 + r * u2;
      store_lanes(u0 - sum * x, row0 + j);
      store_lanes(u1 - sum * y, row1 + j);
      store_lanes(u2 - sum * z, row2 + j);
    }
    // Of the columns, now only in rows that are reflected again.
    for (Eigen::Index i = k + 1; i <= std::min(last, k + 3); ++i) {
      double* entry = at(i, k);
      const Lanes u0 = load_lanes(entry), u1 = load_lanes(entry + kLanes),
                  u2 = load_lanes(entry + 2 * kLanes);
      const Lanes sum = x * u0 + y * u1 + z * u2;
      store_lanes(u0 - sum, entry);
      store_lanes(u1 - sum * q, entry + kLanes);
      store_lanes(u2 - sum * r, entry + 2 * kLanes);
    }
    double* t = reflections + 5 * kLanes * k;
    store_lanes(x, t);
    store_lanes(y, t + kLanes);
    store_lanes(z, t + 2 * kLanes);
    store_lanes(q, t + 3 * kLanes);
    store_lanes(r, t + 4 * kLanes);
  }
  // The other rows once for all, from their own diagonal on, while they are near.
  constexpr int kTogether = 4;
  Eigen::Index i = first;
  for (; i + kTogether < last; i += kTogether) {
    const Eigen::Index common = i + kTogether - 1;
    for (Eigen::Index own = i; own < common; ++own)
      reflect_rows<1>(h + own * stride, stride, own, common, reflections);
    reflect_rows<kTogether>(h + i * stride, stride, common, last, reflections);
  }
  for (; i < last; ++i) reflect_rows<1>(h + i * stride, stride, i, last, reflections);
}

// Whether a subdiagonal entry is as good as zero between two diagonal ones: of their size, or nothing at all
// beside the matrix.
constexpr double kNothing = 1e-100;
STABLECUT_INLINE bool is_split(double below, double size, double norm) {
  return std::abs(below) <= std::max(kRounding * size, kNothing * norm);
}

// The start of the lowest unreduced block that ends at `highs` in each lane.
STABLECUT_WIDE void find_splits(const double* h, Eigen::Index stride, Eigen::Index last, const double* highs,
                                const double* norms, double* lows) {
  const Lanes high = load_lanes(highs), nothing = kNothing * load_lanes(norms);
  Lanes low{}, before = absolute(load_lanes(h));
  for (Eigen::Index l = 1; l <= last; ++l) {
    const double* row = h + l * stride + l * kLanes;
    const Lanes here = absolute(load_lanes(row)), limit = kRounding * (before + here);
    const Lanes least = limit > nothing ? limit : nothing;
    const Lanes place = Lanes{} + static_cast<double>(l);
    const Lanes split = absolute(load_lanes(row - kLanes)) <= least ? place : Lanes{};
    low = place <= high ? (split > low ? split : low) : low;
    before = here;
  }
  store_lanes(low, lows);
}

// The QR iteration of one lane: its active block, and what has been found.
struct LaneProgress {
  Eigen::Index low = 0, high = 0;
  int sweeps = 0;
  bool stuck = false;
  std::vector<std::complex<double>> found;
};

class LaneQr {
 public:
  // `norms` of the matrices: sums of absolute values.
  LaneQr(LaneMatrix& h, const std::array<double, kLanes>& norms)
      : h_(h), reflections_(5 * h.n), norm_(norms) {
    for (LaneProgress& own : progress_) {
      own.high = h.n - 1;
      own.found.reserve(h.n);
    }
  }

  // The eigenvalues of each lane; none where a block does not converge.
  const std::array<LaneProgress, kLanes>& run() {
    Eigen::Index first = 0, last = h_.n - 1;
    alignas(64) double low[kLanes], high[kLanes], sum[kLanes], product[kLanes];
    std::fill(high, high + kLanes, static_cast<double>(last));
    for (int round = 0;; ++round) {
      // All of the block now and then; its end, where it converges, every time.
      const bool all = round % kRoundsBetween == 0;
      if (all) find_splits(h_.data, h_.stride, last, high, norm_.data(), low);
      first = h_.n;
      last = -1;
      for (Eigen::Index lane = 0; lane < kLanes; ++lane) {
        LaneProgress& own = progress_[lane];
        own.low =
            all ? static_cast<Eigen::Index>(low[lane]) : find_split(own.high, lane, own.high - 2, own.low);
        deflate(own, lane);
        low[lane] = static_cast<double>(own.low);
        high[lane] = static_cast<double>(own.high);
        sum[lane] = product[lane] = 0;
        if (own.high < 0) continue;
        first = std::min(first, own.low);
        last = std::max(last, own.high);
        const ShiftPair pair = shifts(own, lane);
        sum[lane] = pair.sum;
        product[lane] = pair.product;
      }
      if (last < 0) break;
      sweep(h_.data, h_.stride, first, last, low, high, sum, product, reflections_.data());
    }
    return progress_;
  }

 private:
  // Takes off what has converged at the end of the active block.
  void deflate(LaneProgress& own, Eigen::Index lane) {
    while (own.high >= 0) {
      if (own.low == own.high) {
        own.found.emplace_back(h_.at(own.high, own.high, lane), 0.0);
        own.high -= 1;
      } else if (own.low == own.high - 1) {
        two_values(own, lane);
        own.high -= 2;
      } else {
        break;
      }
      own.low = find_split(own.high, lane, 0, 0);
      own.sweeps = 0;
    }
    if (own.high >= 0 && ++own.sweeps > kPatience) {
      own.stuck = true;
      own.high = -1;
    }
    if (own.high < 0) own.low = 0;
  }

  // The start of the block that ends at `high`, looked for down to `least`; `otherwise` if it is not there.
  Eigen::Index find_split(Eigen::Index high, Eigen::Index lane, Eigen::Index least, Eigen::Index otherwise) {
    for (Eigen::Index l = high; l > std::max<Eigen::Index>(least, 0); --l) {
      const double size = std::abs(h_.at(l - 1, l - 1, lane)) + std::abs(h_.at(l, l, lane));
      if (is_split(h_.at(l, l - 1, lane), size, norm_[lane])) return l;
    }
    return otherwise;
  }

  void two_values(LaneProgress& own, Eigen::Index lane) {
    const Eigen::Index i = own.high - 1, j = own.high;
    const auto [first, second] =
        block_eigenvalues(h_.at(i, i, lane), h_.at(i, j, lane) * h_.at(j, i, lane), h_.at(j, j, lane));
    own.found.push_back(first);
    own.found.push_back(second);
  }

  ShiftPair shifts(const LaneProgress& own, Eigen::Index lane) const {
    const Eigen::Index i = own.high - 1, j = own.high;
    return shifts_of(h_.at(i, i, lane), h_.at(i, j, lane), h_.at(j, i, lane), h_.at(j, j, lane),
                     h_.at(i, i - 1, lane), own.sweeps);
  }

  LaneMatrix& h_;
  LaneArray reflections_;
  std::array<LaneProgress, kLanes> progress_;
  std::array<double, kLanes> norm_;
};

}  // namespace

std::vector<Eigen::VectorXcd> eigenvalues_of_each(const std::vector<Eigen::MatrixXd>& matrices,
                                                  std::size_t* alone) {
  if (alone != nullptr) *alone = 0;
  std::vector<Eigen::VectorXcd> result;
  if (matrices.empty()) return result;
  const Eigen::Index n = matrices.front().rows();
  LaneArray work(2 * n);
  for (std::size_t first = 0; first < matrices.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, matrices.size() - first);
    LaneMatrix h(n);
    std::array<const double*, kLanes> from{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // Lanes without a matrix repeat the last.
      from[lane] = matrices[first + std::min(lane, count - 1)].data();
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      double* to = h.row(i);
      for (Eigen::Index j = 0; j < n; ++j)
        for (const double* lane : from) *to++ = lane[j * n + i];
    }
    std::array<double, kLanes> sums{};
    absolute_sums(h.data, h.entries(), sums.data());
    if (!std::all_of(sums.begin(), sums.end(), [](double sum) { return sum < kLargestNorm; })) {
      // Squares would not be finite, or the matrices are not.
      for (std::size_t lane = 0; lane < count; ++lane) result.push_back(eigenvalues(matrices[first + lane]));
      if (alone != nullptr) *alone += count;
      continue;
    }
    reduce_to_hessenberg(h.data, n, h.stride, work.data(), work.data() + n * kLanes);
    LaneQr qr(h, sums);
    const auto& lanes = qr.run();
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto& found = lanes[lane].found;
      if (alone != nullptr && lanes[lane].stuck) ++*alone;
      result.push_back(lanes[lane].stuck
                           ? eigenvalues(matrices[first + lane])
                           : Eigen::VectorXcd(Eigen::Map<const Eigen::VectorXcd>(found.data(), n)));
    }
  }
  return result;
}

}  // namespace stablecut::numerics
