#!/usr/bin/python3
"""coupling_error_picture.py [FILE]: lib/receptance/coupling_error.svg, what cancels when receptances are coupled.

The bar and the stub of [Liu2014, section 3] (118.92 mm and 50.90 mm of 12 mm steel, Euler-Bernoulli) joined rigidly are one
cantilever of 169.82 mm, which is computed with 40 digits. Against it, in double precision, the tip's deflection per force
  1. by the closed forms of [Liu2014, Table 1] and eq. 6,
  2. by eq. 6 from receptances that are exact but for their rounding to double,
  3. carried outwards from the fixed end as lib/receptance does: power series where the bar is short compared with its waves,
     motion even and odd about its middle where it is not.
Prints the largest errors below 10 Hz and above, too. Needs gnuplot and mpmath.
"""
import cmath
import math

import mpmath
from mpmath import mp, mpc, mpf

from pictures import block, draw

mp.dps = 40
TOOL, STUB = 0.11892, 0.05090
EI = 200e9 * complex(1, 0.02) * (math.pi / 64 * 0.012**4)
MASS = 7800 * math.pi / 4 * 0.012**2
SERIES_LIMIT = 2


class Double:
    cos, sin, cosh, sinh, root = cmath.cos, cmath.sin, cmath.cosh, cmath.sinh, cmath.sqrt
    number = complex


class Exact:
    cos, sin, cosh, sinh, root = mpmath.cos, mpmath.sin, mpmath.cosh, mpmath.sinh, mpmath.sqrt
    number = mpc


def wave(omega, of):
    # of.number(...) of what was rounded to double: all three start from the same numbers.
    return of.root(of.root(of.number(MASS) * of.number(omega) ** 2 / of.number(EI)))


def closed(length, omega, fixed, of):
    """R11, R12, R22 by Table 1, or R11 of the fixed-free beam."""
    k = wave(omega, of)
    x, ei = k * of.number(length), of.number(EI)
    c, s, ch, sh = of.cos(x), of.sin(x), of.cosh(x), of.sinh(x)
    below = ei * (c * ch + (1 if fixed else -1))
    h, n, p = -(c * sh - s * ch) / (k**3 * below), s * sh / (k**2 * below), (c * sh + s * ch) / (k * below)
    if fixed:
        return [[h, n], [n, p]]
    h12, n12, p12 = (s - sh) / (k**3 * below), (c - ch) / (k**2 * below), (s + sh) / (k * below)
    return [[h, n], [n, p]], [[h12, -n12], [n12, p12]], [[h, -n], [-n, p]]


def coupled(free, held):
    (r11, r12, r22) = free
    a, b, d = r22[0][0] + held[0][0], r22[0][1] + held[0][1], r22[1][1] + held[1][1]
    low = a * d - b * b
    x, y = r12[0]
    return r11[0][0] - (x * (d * x - b * y) + y * (a * y - b * x)) / low


def rounded(matrices):
    return [[[complex(v) for v in row] for row in matrix] for matrix in matrices]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(2)) for j in range(2)] for i in range(2)]


def over(a, b):
    """a b^-1."""
    low = b[0][0] * b[1][1] - b[0][1] * b[1][0]
    return product(a, [[b[1][1] / low, -b[0][1] / low], [-b[1][0] / low, b[0][0] / low]])


def outwards(omega):
    held = [[0j, 0j], [0j, 0j]]
    for length in (STUB, TOOL):
        k4 = MASS * omega**2 / EI
        if abs(k4) ** 0.25 * length < SERIES_LIMIT:
            u, uo, e2, o3 = (sum(k4**j * length ** (4 * j + first) / math.factorial(4 * j + first) for j in range(8))
                             for first in range(4))
            # Movement and load at end 1 from movement and load at end 2.
            mm, ml = [[u, uo], [k4 * o3, u]], [[-o3 / EI, e2 / EI], [-e2 / EI, uo / EI]]
            lm, ll = [[-EI * k4 * uo, -EI * k4 * e2], [EI * k4 * e2, EI * k4 * o3]], [[u, -k4 * o3], [-uo, u]]
            sums = [[[p + q for p, q in zip(*rows)] for rows in zip(product(m, held), f)] for m, f in ((mm, ml), (lm, ll))]
            held = over(sums[0], sums[1])
            continue
        x, k = length / 2, k4**0.25
        c, s, t = cmath.cos(k * x), cmath.sin(k * x), cmath.tanh(k * x)
        even = over([[c, 1], [-k * s, k * t]], [[-EI * k**3 * s, -EI * k**3 * t], [-EI * k**2 * c, EI * k**2]])
        odd = over([[s, t], [k * c, k]], [[EI * k**3 * c, -EI * k**3], [-EI * k**2 * s, EI * k**2 * t]])
        r11 = [[(e + o) / 2 for e, o in zip(*rows)] for rows in zip(even, odd)]
        r12 = [[sign * (e - o) / 2 for e, o, sign in zip(*rows, (1, -1))] for rows in zip(even, odd)]
        free = r11, r12, [[r11[0][0], -r11[0][1]], [-r11[1][0], r11[1][1]]]
        full = [[free[2][i][j] + held[i][j] for j in range(2)] for i in range(2)]
        r21 = [[r12[j][i] for j in range(2)] for i in range(2)]
        taken = product(over(r12, full), r21)
        held = [[r11[i][j] - taken[i][j] for j in range(2)] for i in range(2)]
    return held[0][0]


rows = []
for step in range(431):
    hz = 10 ** (4.3010 * step / 430)
    omega = 2 * math.pi * hz
    exact = closed(TOOL + STUB, omega, True, Exact)[0][0]
    tool, stub = closed(TOOL, omega, False, Exact), closed(STUB, omega, True, Exact)
    answers = [coupled(closed(TOOL, omega, False, Double), closed(STUB, omega, True, Double)),
               coupled(rounded(tool), rounded([stub])[0]), outwards(omega)]
    rows.append([hz] + [max(float(abs(mpc(v) - exact) / abs(exact)), 1e-17) for v in answers])
for column, name in enumerate(["closed forms, eq. 6", "exact receptances rounded, eq. 6", "carried outwards"], 1):
    print(f"{name}: below 10 Hz {max(r[column] for r in rows if r[0] < 10):.1e}, "
          f"above {max(r[column] for r in rows if r[0] >= 10):.1e}")

draw("lib/receptance/coupling_error.svg", "760,420", f"""{block("error", rows, 3)}
set logscale xy
set xrange [1:20000]
set yrange [1e-17:1e-6]
set format y "10^{{%T}}"
set format x "%g"
set grid lc rgb "#dddddd"
set key outside top center vertical samplen 2
set xlabel "frequency (Hz)"
set ylabel "relative error of the tip"
plot $error using 1:2 with lines lw 1.5 lc rgb "#c0392b" title "closed forms of Table 1, coupled by eq. 6", \\
     $error using 1:3 with lines lw 1.5 lc rgb "#e08e0b" title "exact free receptances rounded to double, coupled by eq. 6", \\
     $error using 1:4 with lines lw 1.5 lc rgb "#1f5fa8" title "carried outwards from the fixed end"
""")
