#!/usr/bin/python3
"""Cowper's shear coefficient of a round tube: cowper_shear_coefficient in lib/receptance/beam.cc.

Cowper (1966): K = 2 (1 + v) I / (v/2 (I_x - I_y) - A/I integral of x (chi + x y^2) over the section), with
chi harmonic and, on the boundary, d chi / dn = -n_x (v/2 x^2 + (1 - v/2) y^2) - n_y (2 + v) x y. On a circle
of radius r that is d chi / dr = -r^2 ((v/2 + 3/4) cos t - 3/4 cos 3t), so that in a ring with radii a < b chi
= (alpha r + gamma / r) cos t + (beta r^3 + delta / r^3) cos 3t, and I_x = I_y. With m = a / b the result has
the form 6 (1 + v) (1 + m^2)^2 / ((A0 + A1 v) (1 + m^2)^2 + (B0 + B1 v) m^2).

Method: exact fractions; the four coefficients from four (v, m), then the form checked at others (no error is
left).
"""
from fractions import Fraction

from source_check import stands_in


def coefficient(v, m):
    """K of a ring with radii m and 1; areas and moments over pi."""
    a, b = m, Fraction(1)
    area, inertia = b**2 - a**2, (b**4 - a**4) / 4
    c = v / 2 + Fraction(3, 4)
    # alpha - gamma / r^2 = -c r^2 at both radii; the cos 3t part (beta = 1/4) integrates to nothing.
    gamma = -c * a**2 * b**2
    alpha = -c * (a**2 + b**2)
    assert all(alpha - gamma / r**2 == -c * r**2 for r in (a, b) if r)
    integral = alpha * (b**4 - a**4) / 4 + gamma * (b**2 - a**2) / 2 + (b**6 - a**6) / 24
    return 2 * (1 + v) * inertia / (-(area / inertia) * integral)


def denominator(v, m):
    return 6 * (1 + v) * (1 + m * m) ** 2 / coefficient(v, m)


half, zero, one = Fraction(1, 2), Fraction(0), Fraction(1)
a0 = denominator(zero, zero)
a1 = denominator(one, zero) - a0
ring = (1 + half**2) ** 2
b0 = (denominator(zero, half) - a0 * ring) / half**2
b1 = (denominator(one, half) - (a0 + a1) * ring) / half**2 - b0
for v in (Fraction(3, 10), Fraction(1, 4), half):
    for m in (Fraction(1, 10), Fraction(3, 5), Fraction(9, 10)):
        form = (a0 + a1 * v) * (1 + m * m) ** 2 + (b0 + b1 * v) * m * m
        assert form == denominator(v, m)
text = f"return 6 * (1 + poisson) * one / (({a0} + {a1} * poisson) * one + ({b0} + {b1} * poisson) * m2);"
print(text)
print("a solid circle, v = 0.3:", float(coefficient(Fraction(3, 10), zero)),
      " a thin tube:", float(coefficient(Fraction(3, 10), Fraction(999, 1000))))
print("error: none, the form is exact")
stands_in("lib/receptance/beam.cc", text)
