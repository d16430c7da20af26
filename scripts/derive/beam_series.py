#!/usr/bin/python3
"""Length of the beam series: kSeriesLimit, kMostTerms, kLastTerm in lib/receptance/beam.cc (series_at).

The solutions exp(s x) of a beam at one frequency have s^2 = p or q. With P_n = (p^(n+1) - q^(n+1)) / (p - q),
whose size is at most (n + 1) max(|p|, |q|)^n, the eight functions of series_at are Taylor series in x:
  e2 = (C(p) - C(q)) / (p - q),   u = (p C(q) - q C(p)) / (p - q),   D = (p C(p) - q C(q)) / (p - q),
  o3, uo, Do: the same with S for C,
  i3 = (C(p)/p - C(q)/q) / (p - q),   iu = (p C(q)/q - q C(p)/p) / (p - q),
with C(z) = cosh(sqrt(z) x) and S(z) = sinh(sqrt(z) x) / sqrt(z). kSeriesLimit: series are used where
wavenumber times length is below 2, since above it the closed forms do not cancel (shown below for the
textbook's h11). kMostTerms: the first k at which the loop's own condition, (k + 1) size^(k-1) / (2k-2)! >
kLastTerm, fails at the largest size, 2^2.

Prints the constants, and the largest relative error of the eight series run in double against 40 digits.
"""
import cmath
import random

from mpmath import cos, cosh, factorial, mp, mpc, mpf, nstr, sin, sinh, sqrt

from source_check import stands_in

mp.dps = 40
LIMIT = 2
LAST_TERM = 1e-20

most = 1
while (most + 1) * mpf(LIMIT) ** (2 * (most - 1)) / factorial(2 * most - 2) > LAST_TERM:
    most += 1
texts = [f"constexpr double kSeriesLimit = {LIMIT};", f"constexpr int kMostTerms = {most};",
         "constexpr double kLastTerm = 1e-20;"]
print("\n".join(texts))
print(f"(k + 1) 4^k / (2k)! at k = {most}:", nstr((most + 1) * mpf(4) ** most / factorial(2 * most), 3))


def textbook_tip(wave, functions):
    """h11 lambda^3 EI of the free-free beam, for wave = lambda l."""
    c, s, ch, sh = (f(wave) for f in functions)
    return -(c * sh - s * ch) / (c * ch - 1)


for wave in (0.1, 0.5, 1.0, 2.0, 3.0):
    double = textbook_tip(wave, [cmath.cos, cmath.sin, cmath.cosh, cmath.sinh])
    exact = textbook_tip(mpf(wave), [cos, sin, cosh, sinh])
    print(f"textbook form at lambda l = {wave}: relative error {nstr(abs(double - exact) / abs(exact), 2)}")


def by_series(p, q, x):
    """As series_at does it, in double."""
    pq, total = p * q, p + q
    size = max(abs(p), abs(q)) * x * x
    term = even = 1.0
    even1 = even2 = even3 = odd1 = odd2 = 0j
    p1, p2, p3 = 1 + 0j, 0j, 0j
    k = 1
    while k < most and (k + 1) * term > LAST_TERM:
        term *= size / (2 * k * (2 * k - 1))
        even *= x * x / (2 * k * (2 * k - 1))
        odd = even * x / (2 * k + 1)
        even1, even2, even3 = even1 + even * p1, even2 + even * p2, even3 + even * p3
        odd1, odd2 = odd1 + odd * p1, odd2 + odd * p2
        p1, p2, p3 = total * p1 - pq * p2, p1, p2
        k += 1
    return [even1, 1 - pq * even2, 1 + total * even1 - pq * even2, odd1, x - pq * odd2,
            x + total * odd1 - pq * odd2, even2 - 1 / pq, total / pq + 0.5 * x * x - pq * even3]


def closed(p, q, x):
    p, q = mpc(p), mpc(q)
    c_p, c_q = cosh(sqrt(p) * x), cosh(sqrt(q) * x)
    s_p, s_q = sinh(sqrt(p) * x) / sqrt(p), sinh(sqrt(q) * x) / sqrt(q)
    top = [c_p - c_q, p * c_q - q * c_p, p * c_p - q * c_q, s_p - s_q, p * s_q - q * s_p, p * s_p - q * s_q,
           c_p / p - c_q / q, p * c_q / q - q * c_p / p]
    return [value / (p - q) for value in top]


generator = random.Random(1)
worst = [mpf(0)] * 8
for _ in range(300):
    # Lengths 1, Timoshenko's p > 0 > q with a loss factor up to 0.1, sizes over twelve decades.
    size = LIMIT**2 * 10 ** generator.uniform(-12, 0)
    loss = complex(1, -generator.uniform(0, 0.1))
    p, q = size * generator.uniform(0.2, 1) * loss, -size * loss
    for i, (got, exact) in enumerate(zip(by_series(p, q, 1.0), closed(p, q, mpf(1)))):
        worst[i] = max(worst[i], abs(got - exact) / abs(exact))
for name, error in zip(["e2", "u", "D", "o3", "uo", "Do", "i3", "iu"], worst):
    print(f"largest relative error of {name}:", nstr(error, 2))
stands_in("lib/receptance/beam.cc", *texts)
