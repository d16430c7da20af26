#include "modal/disturbed_lines.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr double kOutstanding = 10;
constexpr Eigen::Index kReach = 12;         // lines in which neighbours are looked for
constexpr std::size_t kNear = 2, kFar = 4;  // on each side
constexpr Eigen::Index kCluster = 3;        // lines nearer than that belong together
constexpr std::size_t kWidest = 2;          // lines of a hum that lies between two
constexpr double kRounding = 1e-13;

class DisturbedLines {
 public:
  DisturbedLines(const Eigen::VectorXd& hz, const Eigen::VectorXcd& h, const Eigen::VectorXd& variance)
      : hz_(hz), h_(h), variance_(variance), out_(hz.size(), false) {}

  // The others may only stand out because of the one that does most.
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
      const Eigen::Index last = std::min(at + kReach, h_.size() - 1);
      for (Eigen::Index i = std::max<Eigen::Index>(at - kReach, 0); i <= last; ++i)
        standing[i] = outstanding(i);
    }
  }

 private:
  // The nearest lines that are not out; false where there are fewer.
  template <std::size_t N>
  bool neighbours(Eigen::Index at, std::array<Eigen::Index, N>& lines) const {
    std::size_t filled = 0;
    for (const Eigen::Index step : {-1, 1}) {
      const std::size_t wanted = filled + N / 2;
      for (Eigen::Index i = at + step; filled < wanted; i += step) {
        if (i < 0 || i >= h_.size() || std::abs(i - at) > kReach) return false;
        if (!out_[i]) lines[filled++] = i;
      }
    }
    return true;
  }

  // How many deviations the value is from the predicted one, whose variance is `gain` times the neighbours':
  // that of the noise, or of what the model leaves of them.
  template <std::size_t N>
  double deviations(Eigen::Index at, Complex predicted, double gain,
                    const std::array<Eigen::Index, N>& others, double left = 0) const {
    double noise = 0;
    for (const Eigen::Index i : others) noise += variance_[i] / static_cast<double>(N);
    const double deviation = std::sqrt((1 + gain) * std::max(noise, left));
    return std::abs(h_[at] - predicted) / std::max(deviation, kRounding * std::abs(h_[at]));
  }

  // From the cubic through the neighbours.
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

  // From a quadratic over 1 + a x by least squares, linear in its unknowns: a resonance on, between or over
  // some lines. x is 0 on the line itself, so that the first unknown is its value.
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
    const Eigen::Vector4d norms = design.colwise().norm().cwiseMax(1e-300);
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
    // Only few lines need the dearer model.
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
