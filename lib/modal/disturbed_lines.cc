#include "modal/disturbed_lines.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr double kOutstanding = 10;           // deviations from which on a line stands out
constexpr Eigen::Index kNeighbourReach = 12;  // lines on each side among which neighbours are looked for
constexpr std::size_t kNear = 2, kFar = 4;    // neighbours on each side for the cubic, and for the resonance
constexpr Eigen::Index kCluster = 3;          // outstanding lines no further apart belong together
constexpr std::size_t kWidest = 2;            // lines of a hum whose frequency lies between two
constexpr double kLeastNorm = 1e-300;         // of a column, in a quotient
constexpr double kValueRounding = 1e-13;      // of a value: deviations are not smaller

class DisturbedLines {
 public:
  DisturbedLines(const Eigen::VectorXd& hz, const Eigen::VectorXcd& h, const Eigen::VectorXd& variance)
      : hz_(hz), h_(h), variance_(variance), out_(hz.size(), false) {}

  // The line that stands out most is taken out first: others may stand out only because of it.
  std::vector<Eigen::Index> find() {
    std::vector<double> standing(out_.size(), 0.0);
    for (Eigen::Index i = 0; i < h_.size(); ++i) standing[i] = outstanding(i);
    std::vector<Eigen::Index> lines;
    for (;;) {
      const auto most = std::max_element(standing.begin(), standing.end());
      if (most == standing.end() || *most < kOutstanding) return lines;
      const Eigen::Index at = most - standing.begin();
      lines.push_back(at);
      out_[at] = true;
      const Eigen::Index last = std::min(at + kNeighbourReach, h_.size() - 1);
      for (Eigen::Index i = std::max<Eigen::Index>(at - kNeighbourReach, 0); i <= last; ++i)
        standing[i] = outstanding(i);
    }
  }

 private:
  // The nearest N / 2 lines on each side that have not been taken out; false where there are fewer.
  template <std::size_t N>
  bool neighbours(Eigen::Index at, std::array<Eigen::Index, N>& lines) const {
    std::size_t filled = 0;
    for (const Eigen::Index step : {-1, 1}) {
      const std::size_t wanted = filled + N / 2;
      for (Eigen::Index i = at + step; filled < wanted; i += step) {
        if (i < 0 || i >= h_.size() || std::abs(i - at) > kNeighbourReach) return false;
        if (!out_[i]) lines[filled++] = i;
      }
    }
    return true;
  }

  // How many standard deviations the value is away from one that was predicted from other lines. The
  // prediction's variance is `gain` times that of the others: of their noise, or of what the model leaves of
  // them (`left`), if more.
  template <std::size_t N>
  double deviations(Eigen::Index at, Complex predicted, double gain,
                    const std::array<Eigen::Index, N>& others, double left = 0) const {
    double noise = 0;
    for (const Eigen::Index i : others) noise += variance_[i] / static_cast<double>(N);
    const double deviation = std::sqrt((1 + gain) * std::max(noise, left));
    return std::abs(h_[at] - predicted) / std::max(deviation, kValueRounding * std::abs(h_[at]));
  }

  // Deviations from the cubic through the neighbours.
  double from_cubic(Eigen::Index at, const std::array<Eigen::Index, 2 * kNear>& others) const {
    Complex predicted = 0;
    double gain = 0;
    for (const Eigen::Index a : others) {
      double weight = 1;
      for (const Eigen::Index b : others)
        if (b != a) weight *= (hz_[at] - hz_[b]) / (hz_[a] - hz_[b]);
      predicted += weight * h_[a];
      gain += weight * weight;
    }
    return deviations(at, predicted, gain, others);
  }

  // Deviations from a resonance on, between or over some lines: (a + b x + c x^2) / (1 + d x), fitted to the
  // neighbours by least squares after multiplication with the denominator, so that all unknowns are linear. x
  // is 0 on the line itself, so that a is the value there.
  double from_resonance(Eigen::Index at, const std::array<Eigen::Index, 2 * kFar>& others) const {
    Eigen::Matrix<Complex, 2 * kFar, 4> design;
    Eigen::Matrix<Complex, 2 * kFar, 1> values;
    const double scale = hz_[others.back()] - hz_[others.front()];
    for (Eigen::Index r = 0; r < design.rows(); ++r) {
      const Eigen::Index i = others[r];
      const double x = (hz_[i] - hz_[at]) / scale;
      values[r] = h_[i];
      design.row(r) << 1, x, x * x, -x * h_[i];
    }
    const Eigen::Vector4d norms = design.colwise().norm().cwiseMax(kLeastNorm);
    const Eigen::MatrixXcd scaled = design * norms.cwiseInverse().asDiagonal();
    const Eigen::MatrixXcd inverse =
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXcd>(scaled).pseudoInverse();
    const Eigen::VectorXcd solution = inverse * values;
    const double left = (scaled * solution - values).squaredNorm() / static_cast<double>(2 * kFar - 4);
    return deviations(at, solution[0] / norms[0], inverse.row(0).squaredNorm() / (norms[0] * norms[0]),
                      others, left);
  }

  double outstanding(Eigen::Index at) const {
    std::array<Eigen::Index, 2 * kNear> near{};
    std::array<Eigen::Index, 2 * kFar> far{};
    if (out_[at] || !neighbours(at, near)) return 0;
    const double by_cubic = from_cubic(at, near);
    // Only few lines need the second model, which costs more.
    if (by_cubic < kOutstanding || !neighbours(at, far)) return 0;
    return std::min(by_cubic, from_resonance(at, far));
  }

  const Eigen::VectorXd& hz_;
  const Eigen::VectorXcd& h_;
  const Eigen::VectorXd& variance_;
  std::vector<bool> out_;
};

}  // namespace

std::vector<Eigen::Index> disturbed_lines(const Eigen::VectorXd& hz, const Eigen::VectorXcd& h,
                                          const Eigen::VectorXd& variance) {
  std::vector<Eigen::Index> lines = DisturbedLines(hz, h, variance).find();
  std::sort(lines.begin(), lines.end());
  // Several lines side by side are no hum but what the models cannot follow.
  std::vector<Eigen::Index> single;
  for (std::size_t first = 0; first < lines.size();) {
    std::size_t end = first + 1;
    while (end < lines.size() && lines[end] - lines[end - 1] <= kCluster) ++end;
    for (std::size_t i = first; end - first <= kWidest && i < end; ++i) single.push_back(lines[i]);
    first = end;
  }
  return single;
}

}  // namespace stablecut::modal
