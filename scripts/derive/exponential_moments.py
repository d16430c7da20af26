#!/usr/bin/python3
"""Lengths in lib/numerics/exponential_moments.cc: series of (exp(w) - 1) / w, tail of Olver's method.

exponential_quotient sums w^(k-1) / k! for k < 20 where |w| <= 0.5; k < 15 would do for double, so 20 was
chosen generously and costs nothing that the digits show. exponential_moments solves
  -z I_(j-1) - (2j+1) I_j + z I_(j+1) = P_(j-1)(x) - P_(j+1)(x)
for j above |Im z| as a tridiagonal system that ends `margin` = 24 + |Re z| beyond max(count, |Im z|), where
I_j has its first-order value (Olver 1967). What a shorter or longer margin costs is shown with 50 digits, in
which rounding plays no part (24 leaves less than a double's rounding); then the code's own steps are run in
double.

Prints the two limits as they stand in the code, and the largest errors over |z| <= 100, damping ratios up to
one half, relative to the largest I_j.
"""
import cmath

from mpmath import exp, factorial, mp, mpc, mpf, nstr

from source_check import stands_in

mp.dps = 50
SERIES, MARGIN = 20, 24
texts = [f"kSeriesTerms = {SERIES};", f"kTail = {MARGIN};"]
print("\n".join(texts))

enough = 2
while mpf("0.5") ** (enough - 1) / factorial(enough) > mpf(2) ** -53:
    enough += 1
for k in (enough, SERIES):
    print(f"k < {k}: first term left out at |w| = 0.5: {nstr(mpf('0.5') ** (k - 1) / factorial(k), 2)}")


def legendre(x, count):
    p = [x * 0 + 1, x]
    for j in range(1, count - 1):
        p.append(((2 * j + 1) * x * p[j] - j * p[j - 1]) / (j + 1))
    return p[:count]


def quotient_in_double(w):
    if abs(w) > 0.5:
        return (cmath.exp(w) - 1) / w
    term = total = 1
    for k in range(2, SERIES):
        term *= w / k
        total += term
    return total


def moments(z, x, count, first, forward, margin):
    """I_0 ... I_(count-1) in the arguments' precision; `first` is I_0 and, where forward > 0, I_1."""
    tail = max(count, forward) + margin
    p = legendre(x, tail + 2)
    jump = [0] + [p[j + 1] - p[j - 1] for j in range(1, tail + 1)]
    moment = list(first) + [0] * (tail + 1 - len(first))
    for j in range(1, forward):
        moment[j + 1] = moment[j - 1] + ((2 * j + 1) * moment[j] - jump[j]) / z
    moment[tail] = jump[tail] / (2 * tail + 1)
    pivot = [0] * tail
    for j in range(forward + 1, tail):
        right, diagonal = -jump[j], z * 0 - (2 * j + 1)
        if j == forward + 1:
            right += z * moment[forward]
        else:
            diagonal += z / pivot[j - 1] * z
            right += z / pivot[j - 1] * moment[j - 1]
        if j == tail - 1:
            right -= z * moment[tail]
        pivot[j], moment[j] = diagonal, right
    for j in range(tail - 1, forward, -1):
        if j < tail - 1:
            moment[j] -= z * moment[j + 1]
        moment[j] /= pivot[j]
    return moment[:count]


def exact_moments(z, x, count, forward, margin):
    z, x = mpc(z), mpf(x)
    first = [(exp(z * (x + 1)) - 1) / z]
    if forward > 0:
        first.append((first[0] - x - exp(z * (x + 1))) / z)
    return moments(z, x, count, first, forward, margin)


MARGINS = (8, 16, MARGIN, 32)
truncation = {margin: mpf(0) for margin in MARGINS}
rounding = mpf(0)
for size in (0.1, 2, 12, 40, 100):
    for damping in (0, 0.02, 0.5):
        z = size * complex(-damping, (1 - damping**2) ** 0.5)
        forward = 0 if abs(z.imag) < 1 else int(abs(z.imag))
        for count in (8, 24):
            for x in (-0.97, -0.3, 1.0):
                extra = int(abs(z.real))
                exact = exact_moments(z, x, count, forward, 90 + extra)
                largest = max(abs(value) for value in exact)
                for margin in MARGINS:
                    got = exact_moments(z, x, count, forward, margin + extra)
                    error = max(abs(a - b) for a, b in zip(got, exact)) / largest
                    truncation[margin] = max(truncation[margin], error)
                first = [(x + 1) * quotient_in_double(z * (x + 1))]
                if forward > 0:
                    first.append((first[0] - x - cmath.exp(z * (x + 1))) / z)
                got = moments(z, x, count, first, forward, MARGIN + extra)
                rounding = max(rounding, max(abs(a - b) for a, b in zip(got, exact)) / largest)
for margin in MARGINS:
    print(f"tail of {margin} + |Re z|: largest error of truncation {nstr(truncation[margin], 2)}")
print("largest error of the code's steps in double:", nstr(rounding, 2))
stands_in("lib/numerics/exponential_moments.cc", *texts)
