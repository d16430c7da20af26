#include "receptance/beam.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/number_text.h"
#include "receptance/coupling.h"

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

// Below this size of wavenumber times length the series are used, above it the functions themselves.
constexpr double kSeriesLimit = 2;
constexpr int kMostTerms = 16;       // (k + 1) 4^k / (2k)! is below 1e-20 from here on
constexpr double kLastTerm = 1e-20;  // of a series that begins with 1

// A segment at one frequency. With the deflection w and the section's rotation psi, V' = -rho A w^2 w, M' =
// -V - rho I w^2 psi, psi' = M / EI, w' = psi + V / (kappa G A); solutions exp(s x) with s^2 = p or q, the
// roots of (z + a) (z + b) = c4, where a = rho A w^2 / (kappa G A), b = rho I w^2 / EI, c4 = rho A w^2 / EI.
// In Euler and Bernoulli's theory a = b = 0.
struct Waves {
  Complex bending;  // EI
  double inertia;   // rho A w^2
  Complex a, b, c4;
  Complex p, q;  // p = beta^2, q = -alpha^2
};

Waves waves_of(const BeamSegment& s, BeamTheory theory, double omega) {
  for (const double size :
       {s.length_m, s.outer_diameter_m, s.youngs_modulus_pa, s.density_kg_per_m3, omega}) {
    if (!(size > 0))
      throw InvalidArgument("beam: " + number_text(size) + ": expected sizes and a frequency above 0");
  }
  if (!(s.inner_diameter_m >= 0 && s.inner_diameter_m < s.outer_diameter_m)) {
    throw InvalidArgument("beam: inner diameter " + number_text(s.inner_diameter_m) +
                          " m: expected at least 0 and less than the outer");
  }
  const double pi = std::numbers::pi;
  const double outer2 = s.outer_diameter_m * s.outer_diameter_m,
               inner2 = s.inner_diameter_m * s.inner_diameter_m;
  const double area = pi / 4 * (outer2 - inner2),
               second_moment = pi / 64 * (outer2 * outer2 - inner2 * inner2);
  const Complex modulus = s.youngs_modulus_pa * Complex(1, s.loss_factor);
  Waves w;
  w.bending = modulus * second_moment;
  w.inertia = s.density_kg_per_m3 * area * omega * omega;
  w.c4 = w.inertia / w.bending;
  if (theory == BeamTheory::kTimoshenko) {
    const double kappa = cowper_shear_coefficient(s.inner_diameter_m / s.outer_diameter_m, s.poisson_ratio);
    w.a = w.inertia / (kappa * area * modulus / (2 * (1 + s.poisson_ratio)));
    w.b = s.density_kg_per_m3 * second_moment * omega * omega / w.bending;
  }
  const Complex root = std::sqrt(0.25 * (w.a - w.b) * (w.a - w.b) + w.c4);
  w.q = -0.5 * (w.a + w.b) - root;
  w.p = (w.a * w.b - w.c4) / w.q;  // not by the difference, which cancels
  return w;
}

// Entire functions of p and q at x, by their series: with P_n = sum over i + j = n of p^i q^j,
// e2 = sum x^2k/(2k)! P_(k-1), u = 1 - pq sum x^2k/(2k)! P_(k-2), D = sum x^2k/(2k)! P_k; o3, uo, Do the same
// with x^(2k+1)/(2k+1)!; and the integrals of o3 and uo without a constant, i3 = -1/(pq) + ..., iu = (p +
// q)/(pq) + ... Sums of P_(k-1), P_(k-2) and P_(k-3) suffice, since P_k = (p + q) P_(k-1) - pq P_(k-2).
struct Series {
  Complex e2, u, d, o3, uo, d_odd, i3, iu;
};

Series series_at(const Waves& w, double x) {
  const Complex pq = w.a * w.b - w.c4, sum = -(w.a + w.b);
  // |P_k| is at most (k + 1) size^k.
  const double size = std::sqrt(std::max(std::norm(w.p), std::norm(w.q))) * x * x;
  double term = 1;
  Complex even1, even2, even3, odd1, odd2;
  // P_(k-1), P_(k-2), P_(k-3) for k = 1.
  Complex p1 = 1, p2 = 0, p3 = 0;
  double even = 1;  // x^2k/(2k)!
  for (int k = 1; k < kMostTerms && (k + 1) * term > kLastTerm; ++k) {
    term *= size / (2 * k * (2 * k - 1));
    even *= x * x / (2 * k * (2 * k - 1));
    const double odd = even * x / (2 * k + 1);
    even1 += even * p1;
    even2 += even * p2;
    even3 += even * p3;
    odd1 += odd * p1;
    odd2 += odd * p2;
    const Complex p0 = sum * p1 - pq * p2;  // P_k
    p3 = p2;
    p2 = p1;
    p1 = p0;
  }
  const Complex inverse = 1.0 / pq;
  return {even1,
          1.0 - pq * even2,
          1.0 + sum * even1 - pq * even2,
          odd1,
          x - pq * odd2,
          x + sum * odd1 - pq * odd2,
          even2 - inverse,
          sum * inverse + 0.5 * x * x - pq * even3};
}

// Two solutions at a place: columns; deflection and rotation above, force and moment that the place's end
// takes below.
struct Pair {
  Eigen::Matrix2cd movement, load;
};

// e0 and e2: even; o1 and o3: odd. Solutions e0 = u - a e2 and o1 = uo - a o3 have M = EI c4 e2 and EI c4 o3.
Pair even_by_series(const Waves& w, const Series& s) {
  const Complex integral0 = s.uo - w.a * s.o3, pq = w.a * w.b - w.c4;
  Pair pair;
  pair.movement << s.u - w.a * s.e2, s.e2, -pq * s.o3 - w.a * s.d_odd + w.a * integral0, s.d_odd + w.a * s.o3;
  pair.load << -w.inertia * integral0, -w.inertia * s.o3, w.bending * w.c4 * s.e2,
      w.bending * (s.d + w.a * s.e2);
  return pair;
}

Pair odd_by_series(const Waves& w, const Series& s) {
  const Complex integral1 = s.iu - w.a * s.i3;
  Pair pair;
  pair.movement << s.uo - w.a * s.o3, s.o3, s.u - w.a * s.e2 + w.a * integral1, s.e2 + w.a * s.i3;
  pair.load << -w.inertia * integral1, -w.inertia * s.i3, w.bending * w.c4 * s.o3,
      w.bending * (s.d_odd + w.a * s.o3);
  return pair;
}

// The same by cos and cosh, sin and sinh, the hyperbolic ones over cosh(beta x).
std::pair<Pair, Pair> by_functions(const Waves& w, double x) {
  const Complex alpha = std::sqrt(-w.q), beta = std::sqrt(w.p);
  const Complex decay = std::exp(-2.0 * beta * x), tanh = (1.0 - decay) / (1.0 + decay);
  const Complex sine = std::sin(alpha * x), cosine = std::cos(alpha * x);
  const Complex turn_a = alpha - w.a / alpha, turn_b = beta + w.a / beta;
  const Complex moment_a = w.bending * (w.q + w.a), moment_b = w.bending * (w.p + w.a);
  Pair even, odd;
  even.movement << cosine, 1, -turn_a * sine, turn_b * tanh;
  even.load << -w.inertia * sine / alpha, -w.inertia * tanh / beta, moment_a * cosine, moment_b;
  odd.movement << sine, tanh, turn_a * cosine, turn_b;
  odd.load << w.inertia * cosine / alpha, -w.inertia / beta, moment_a * sine, moment_b * tanh;
  return {even, odd};
}

Eigen::Matrix2cd receptance(const Pair& pair) { return pair.movement * pair.load.inverse(); }

// Motion that is even and odd about the middle: each an own problem of two unknowns, in which nothing
// cancels.
BeamReceptances free_by_functions(const Waves& w, double length) {
  const auto [even_pair, odd_pair] = by_functions(w, 0.5 * length);
  const Eigen::Matrix2cd even = receptance(even_pair), odd = receptance(odd_pair);
  // Mirrored at the middle the deflection keeps its sign and the slope changes it.
  const Eigen::Vector2cd mirror(1, -1);
  const Eigen::Matrix2cd sum = 0.5 * (even + odd), difference = 0.5 * (even - odd);
  return {sum, difference * mirror.asDiagonal(), mirror.asDiagonal() * difference,
          mirror.asDiagonal() * sum * mirror.asDiagonal()};
}

}  // namespace

double cowper_shear_coefficient(double ratio, double poisson) {
  const double m2 = ratio * ratio, one = (1 + m2) * (1 + m2);
  return 6 * (1 + poisson) * one / ((7 + 6 * poisson) * one + (20 + 12 * poisson) * m2);
}

SegmentMotion::SegmentMotion(const BeamSegment& segment, BeamTheory theory, double omega_rad_per_s) {
  const Waves w = waves_of(segment, theory, omega_rad_per_s);
  const double length = segment.length_m;
  short_ = std::max(std::norm(w.p), std::norm(w.q)) * std::pow(length, 4) < std::pow(kSeriesLimit, 4);
  if (!short_) {
    free_ = free_by_functions(w, length);
    return;
  }
  // From end 2 at x = 0, where it does w0, psi0 and takes V0, M0: the solution is w0 e0 + M0/EI e2 + (psi0 +
  // a V0 / (rho A w^2)) o1 - (V0/EI + b psi0) o3.
  const Series s = series_at(w, length);
  const Pair even = even_by_series(w, s), odd = odd_by_series(w, s);
  const Eigen::Matrix2cd even_of_movement{{1, 0}, {0, 0}}, even_of_load{{0, 0}, {0, 1.0 / w.bending}};
  const Eigen::Matrix2cd odd_of_movement{{0, 1}, {0, -w.b}},
      odd_of_load{{w.a / w.inertia, 0}, {-1.0 / w.bending, 0}};
  transfer_.movement_of_movement = even.movement * even_of_movement + odd.movement * odd_of_movement;
  transfer_.movement_of_load = even.movement * even_of_load + odd.movement * odd_of_load;
  transfer_.load_of_movement = even.load * even_of_movement + odd.load * odd_of_movement;
  transfer_.load_of_load = even.load * even_of_load + odd.load * odd_of_load;
}

BeamReceptances SegmentMotion::free() const {
  if (!short_) return free_;
  // Nothing is taken at the end that is not pushed.
  const Receptance<2> r21 = transfer_.load_of_movement.inverse();
  return {transfer_.movement_of_movement * r21, r21.transpose(), r21, r21 * transfer_.load_of_load};
}

template <int N>
Receptance<N> SegmentMotion::held(const Receptance<N>& holder) const {
  // With waves on it the free segment is no rigid body any more, and holding its end cancels nothing.
  if (!short_) return coupled_tip<N>(free_, holder);
  const Receptance<N> movement = in_all_directions<N>(transfer_.movement_of_movement) * holder +
                                 in_all_directions<N>(transfer_.movement_of_load);
  const Receptance<N> load = in_all_directions<N>(transfer_.load_of_movement) * holder +
                             in_all_directions<N>(transfer_.load_of_load);
  return movement * load.inverse();
}

template Receptance<2> SegmentMotion::held<2>(const Receptance<2>&) const;
template Receptance<4> SegmentMotion::held<4>(const Receptance<4>&) const;

}  // namespace stablecut::receptance
