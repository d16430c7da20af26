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

// README.md, section 3; derived by scripts/derive/beam_series.py.
constexpr double kSeriesLimit = 2;   // wavenumber times length up to which the power series are used
constexpr int kMostTerms = 16;       // of the power series
constexpr double kLastTerm = 1e-20;  // relative to the first term, 1

// The coefficients of Timoshenko's equations for one segment at one frequency; solutions are exp(s x) with
// s^2 = p or s^2 = q, the roots z of (z + a) (z + b) = c4. In Euler and Bernoulli's theory a = b = 0.
// README.md, section 2.
struct Waves {
  Complex bending;  // EI
  double inertia;   // rho A w^2
  Complex a;        // rho A w^2 / (kappa G A): shear
  Complex b;        // rho I w^2 / EI: rotary inertia
  Complex c4;       // rho A w^2 / EI: bending
  Complex p, q;     // p = beta^2, q = -alpha^2
};

Waves waves_of(const BeamSegment& s, BeamTheory theory, double omega) {
  for (const double size :
       {s.length_m, s.outer_diameter_m, s.youngs_modulus_pa, s.density_kg_per_m3, omega}) {
    if (!(size > 0))
      throw InvalidArgument("beam: " + number_text(size) +
                            ": expected length, diameter, modulus, density and frequency above 0");
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
  w.p = (w.a * w.b - w.c4) / w.q;  // the product of the roots
  return w;
}

// The eight functions of README.md, section 3, at a place x: combinations of cosh(sqrt(p) x), cosh(sqrt(q) x)
// and of the hyperbolic sines that are entire in p and q: u, uo, e2 and o3 begin with 1, x, x^2/2 and x^3/6;
// d_odd and d are the first and second derivative of e2; i3 and iu are integrals of o3 and uo.
struct Series {
  Complex e2, u, d, o3, uo, d_odd, i3, iu;
};

// Sums of P_(k-1), P_(k-2) and P_(k-3) over k, where P_n = sum over i + j = n of p^i q^j, give all eight: P_k
// = (p + q) P_(k-1) - pq P_(k-2).
Series series_at(const Waves& w, double x) {
  const Complex pq = w.a * w.b - w.c4, sum = -(w.a + w.b);
  // |P_k| x^2k is at most (k + 1) size^k.
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

// Two solutions of the beam's equations at one place, a column each: deflection and rotation, and the shear
// force and bending moment there.
struct SolutionPair {
  Eigen::Matrix2cd movement, load;
};

// The even solutions e0 = u - a e2 (whose moment is EI c4 e2) and e2.
SolutionPair even_by_series(const Waves& w, const Series& s) {
  const Complex integral0 = s.uo - w.a * s.o3, pq = w.a * w.b - w.c4;
  SolutionPair pair;
  pair.movement << s.u - w.a * s.e2, s.e2, -pq * s.o3 - w.a * s.d_odd + w.a * integral0, s.d_odd + w.a * s.o3;
  pair.load << -w.inertia * integral0, -w.inertia * s.o3, w.bending * w.c4 * s.e2,
      w.bending * (s.d + w.a * s.e2);
  return pair;
}

// The odd solutions o1 = uo - a o3 (whose moment is EI c4 o3) and o3.
SolutionPair odd_by_series(const Waves& w, const Series& s) {
  const Complex integral1 = s.iu - w.a * s.i3;
  SolutionPair pair;
  pair.movement << s.uo - w.a * s.o3, s.o3, s.u - w.a * s.e2 + w.a * integral1, s.e2 + w.a * s.i3;
  pair.load << -w.inertia * integral1, -w.inertia * s.i3, w.bending * w.c4 * s.o3,
      w.bending * (s.d_odd + w.a * s.o3);
  return pair;
}

// Even solutions cos(alpha x) and cosh(beta x), odd ones sin(alpha x) and sinh(beta x), the hyperbolic ones
// divided by cosh(beta x) so that long segments do not overflow.
std::pair<SolutionPair, SolutionPair> by_functions(const Waves& w, double x) {
  const Complex alpha = std::sqrt(-w.q), beta = std::sqrt(w.p);
  const Complex decay = std::exp(-2.0 * beta * x), tanh = (1.0 - decay) / (1.0 + decay);
  const Complex sine = std::sin(alpha * x), cosine = std::cos(alpha * x);
  const Complex turn_a = alpha - w.a / alpha, turn_b = beta + w.a / beta;
  const Complex moment_a = w.bending * (w.q + w.a), moment_b = w.bending * (w.p + w.a);
  SolutionPair even, odd;
  even.movement << cosine, 1, -turn_a * sine, turn_b * tanh;
  even.load << -w.inertia * sine / alpha, -w.inertia * tanh / beta, moment_a * cosine, moment_b;
  odd.movement << sine, tanh, turn_a * cosine, turn_b;
  odd.load << w.inertia * cosine / alpha, -w.inertia / beta, moment_a * sine, moment_b * tanh;
  return {even, odd};
}

Eigen::Matrix2cd receptance(const SolutionPair& pair) { return pair.movement * pair.load.inverse(); }

// Any motion is the sum of one that is even about the middle and one that is odd, and the two do not mix:
// each is a problem of two unknowns in which nothing cancels.
BeamReceptances free_by_functions(const Waves& w, double length) {
  const auto [even_pair, odd_pair] = by_functions(w, 0.5 * length);
  const Eigen::Matrix2cd even = receptance(even_pair), odd = receptance(odd_pair);
  // Seen from the other end the deflection keeps its sign and the slope changes it.
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
  // With deflection w0, rotation psi0, shear force V0 and bending moment M0 at end 2, where x = 0, the
  // solution is w0 e0 + M0/EI e2 + (psi0 + a V0 / (rho A w^2)) o1 - (V0/EI + b psi0) o3.
  const Series s = series_at(w, length);
  const SolutionPair even = even_by_series(w, s), odd = odd_by_series(w, s);
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
  // End 2 carries no load when only end 1 is pushed, and the other way round.
  const Receptance<2> r21 = transfer_.load_of_movement.inverse();
  return {transfer_.movement_of_movement * r21, r21.transpose(), r21, r21 * transfer_.load_of_load};
}

template <int N>
Receptance<N> SegmentMotion::held(const Receptance<N>& holder) const {
  // A segment that carries waves is far from moving as a rigid body: coupling its free receptances cancels
  // nothing.
  if (!short_) return coupled_tip<N>(free_, holder);
  const Receptance<N> movement = in_all_directions<N>(transfer_.movement_of_movement) * holder +
                                 in_all_directions<N>(transfer_.movement_of_load);
  const Receptance<N> load = in_all_directions<N>(transfer_.load_of_movement) * holder +
                             in_all_directions<N>(transfer_.load_of_load);
  return movement * load.inverse();
}

BeamReceptances SegmentMotion::before(const BeamReceptances& inner) const {
  if (!short_) return rigidly_coupled(free_, inner);
  // The load on the inner part's end 1 per load at the new end 1, nothing pushing at end 2.
  const Receptance<2> passed_on = (transfer_.load_of_movement * inner.r11 + transfer_.load_of_load).inverse();
  const Receptance<2> r21 = inner.r21 * passed_on;
  return {(transfer_.movement_of_movement * inner.r11 + transfer_.movement_of_load) * passed_on,
          r21.transpose(), r21, inner.r22 - r21 * transfer_.load_of_movement * inner.r12};
}

template Receptance<2> SegmentMotion::held<2>(const Receptance<2>&) const;
template Receptance<4> SegmentMotion::held<4>(const Receptance<4>&) const;

}  // namespace stablecut::receptance
