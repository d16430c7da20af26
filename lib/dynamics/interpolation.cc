#include "dynamics/interpolation.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace stablecut::dynamics {
namespace {

constexpr std::size_t kCubicLines = 4;      // lines that an interpolated value follows from
constexpr double kDoubtfulShare = 0.1;      // of the largest |h| around: an error that is remarked upon
constexpr double kSureDeviations = 5;       // of its own noise: a smaller difference is no finding
constexpr double kMostAmplification = 2;    // of the noise's variance; at equal distances it is about 1
constexpr double kSpread = 0.5;             // of an interval: least distance of the lines around it
constexpr double kDistanceRounding = 1e-9;  // of a distance of lines

// Lagrange's weights of the polynomial through all of the lines.
LineWeights lagrange_weights(const Eigen::VectorXd& f, const std::vector<Eigen::Index>& lines, double at) {
  LineWeights weights;
  for (const Eigen::Index a : lines) {
    double weight = 1;
    for (const Eigen::Index b : lines)
      if (b != a) weight *= (at - f[b]) / (f[a] - f[b]);
    weights[a] = weight;
  }
  return weights;
}

// Four lines around an interval, the two that bound it and alternately below and above it the next ones that
// are at least `distance` farther away; where one side ends the other gives more.
std::vector<Eigen::Index> lines_around(const Eigen::VectorXd& f, Eigen::Index above, double distance) {
  std::vector<Eigen::Index> lines = {above - 1, above};
  Eigen::Index first = above - 1, last = above;
  for (bool found = true; found && lines.size() < kCubicLines;) {
    const std::size_t before = lines.size();
    Eigen::Index next = first - 1;
    while (next >= 0 && f[first] - f[next] < distance) --next;
    if (next >= 0) lines.push_back(first = next);
    next = last + 1;
    while (next < f.size() && f[next] - f[last] < distance) ++next;
    if (next < f.size() && lines.size() < kCubicLines) lines.push_back(last = next);
    found = lines.size() > before;
  }
  return lines;
}

// The value at a place of a curve with one pole, and its derivatives by the values at the lines.
struct Rational {
  std::complex<double> value;
  std::map<Eigen::Index, std::complex<double>> by_line;
};

// The quotient of a quadratic and a linear polynomial through the values at four lines, R = sum l_i h_i (x_i
// - z) / (x - z). That (x - z) h has no third divided difference gives the pole z. With D and N the divided
// differences of h and (x_i - x) h, z - x = N / D.
Rational rational(const Eigen::VectorXd& f, const Eigen::VectorXcd& h, const std::vector<Eigen::Index>& lines,
                  double at) {
  const LineWeights lagrange = lagrange_weights(f, lines, at);
  std::complex<double> cubic = 0, linear = 0, d = 0, n = 0;
  LineWeights divided;
  for (const auto& [i, weight] : lagrange) {
    double product = 1;
    for (const Eigen::Index j : lines)
      if (j != i) product *= f[i] - f[j];
    divided[i] = 1 / product;
    cubic += weight * h[i];
    linear += weight * (f[i] - at) * h[i];
    d += h[i] / product;
    n += (f[i] - at) * h[i] / product;
  }
  Rational result;
  if (n == 0.0) return {cubic, {lagrange.begin(), lagrange.end()}};
  result.value = cubic - linear * d / n;
  for (const auto& [i, weight] : lagrange) {
    const double x = f[i] - at;
    result.by_line[i] = weight * (1.0 - x * d / n) - linear * divided[i] * (n - d * x) / (n * n);
  }
  return result;
}

// What the cubic's value may be off by: its difference from a curve with one pole, where this is more than
// noise, or its noise, where the cubic amplifies it.
double possible_error(const Eigen::VectorXd& f, const Eigen::VectorXcd& h, const Eigen::VectorXd& variance,
                      Eigen::Index above, double at) {
  const LineWeights cubic = cubic_weights(f, above, at);
  Rational other =
      rational(f, h, lines_around(f, above, (kSpread - kDistanceRounding) * (f[above] - f[above - 1])), at);
  double gain = 0, noise = 0, square = 0;
  for (const auto& [line, weight] : cubic) {
    gain += weight * weight;
    noise += weight * weight * variance[line];
    other.value -= weight * h[line];
    other.by_line[line] -= weight;
  }
  for (const auto& [line, weight] : other.by_line) square += std::norm(weight) * variance[line];
  const double difference = std::abs(other.value);
  return std::max(gain > kMostAmplification ? std::sqrt(noise) : 0,
                  difference > kSureDeviations * std::sqrt(square) ? difference : 0);
}

}  // namespace

LineWeights cubic_weights(const Eigen::VectorXd& frequency_hz, Eigen::Index above, double at) {
  const Eigen::Index lines = frequency_hz.size(), count = std::min<Eigen::Index>(kCubicLines, lines);
  const Eigen::Index first = std::clamp<Eigen::Index>(above - count / 2, 0, lines - count);
  std::vector<Eigen::Index> nearest;
  for (Eigen::Index i = first; i < first + count; ++i) nearest.push_back(i);
  return lagrange_weights(frequency_hz, nearest, at);
}

std::vector<DoubtfulInterval> doubtful_intervals(const Eigen::VectorXd& frequency_hz,
                                                 const Eigen::VectorXcd& h, const Eigen::VectorXd& variance,
                                                 const Eigen::VectorXd& wanted_hz) {
  std::vector<DoubtfulInterval> intervals;
  for (const double hz : wanted_hz) {
    const Eigen::Index above =
        std::lower_bound(frequency_hz.begin(), frequency_hz.end(), hz) - frequency_hz.begin();
    if (above == 0 || above == frequency_hz.size()) continue;
    const double from = frequency_hz[above - 1], to = frequency_hz[above];
    if (std::min(hz - from, to - hz) <= kDistanceRounding * hz) continue;  // on a line
    double size = 0;
    for (const auto& [line, unused] : cubic_weights(frequency_hz, above, hz))
      size = std::max(size, std::abs(h[line]));
    const double error = possible_error(frequency_hz, h, variance, above, hz);
    if (!(error > kDoubtfulShare * size)) continue;
    if (intervals.empty() || intervals.back().to_hz < from) intervals.push_back({from, to, 0});
    intervals.back().to_hz = to;
    intervals.back().error = std::max(intervals.back().error, error / size);
  }
  return intervals;
}

}  // namespace stablecut::dynamics
