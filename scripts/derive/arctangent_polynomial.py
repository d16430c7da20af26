#!/usr/bin/python3
"""The polynomial of the arctangent: kArctangent in lib/numerics/elementary_lanes.h (angle_of).

atan(t) = t + t^3 p(t^2) on |t| <= tan(pi/8), with p of degree 10. p interpolates (atan(t) / t - 1) / t^2, as
a function of s = t^2, at the 11 Chebyshev points (zeros of T_11) of [0, 1.0000001 tan^2(pi/8)]; the interval
is a ten-millionth longer than the longest argument, so that a rounded t is still inside. Computed with 60
digits, then rounded to double. (A minimax polynomial would err by 2.7e-19 instead of 1.9e-18 before that
rounding, and by about as much after it.)

Prints the constants as they stand in the code and the largest errors on |t| <= tan(pi/8).
"""
from mpmath import atan, cos, lu_solve, matrix, mp, mpf, nstr, pi, polyval, sqrt, tan

from source_check import stands_in

mp.dps = 60
DEGREE = 10
LONGEST = tan(pi / 8)
INTERVAL = (1 + mpf(10) ** -7) * LONGEST**2


def wanted(s):
    t = sqrt(s)
    return (atan(t) / t - 1) / s


points = [INTERVAL / 2 * (1 + cos((2 * i + 1) * pi / (2 * (DEGREE + 1)))) for i in range(DEGREE + 1)]
exact = list(lu_solve(matrix([[s**j for j in range(DEGREE + 1)] for s in points]),
                      matrix([wanted(s) for s in points])))
rounded = [float(c) for c in exact]

# Three to a line in columns, as clang-format lays them out.
items = [repr(c) + "," for c in rounded]
widths = [max(len(item) for item in items[column:-1:3]) + 1 for column in range(3)]
lead = "inline constexpr double kArctangent[11] = {"
lines = []
for row in range(0, len(items), 3):
    cells = "".join(item.ljust(widths[k]) for k, item in enumerate(items[row:row + 3])).rstrip()
    lines.append((lead if row == 0 else " " * len(lead)) + cells)
text = "\n".join(lines)[:-1] + "};"
limit = f"small > {float(LONGEST)!r} * large"
print(text)
print(f"// tan(pi/8): {limit}")


def largest_error(coefficients):
    places = [LONGEST * k / 4000 for k in range(1, 4001)]
    return max(abs(t + t**3 * polyval(coefficients[::-1], t * t) - atan(t)) for t in places)


print("largest error of the polynomial:", nstr(largest_error(exact), 3))
print("the same with coefficients rounded to double:", nstr(largest_error([mpf(c) for c in rounded]), 3))
stands_in("lib/numerics/elementary_lanes.h", text, limit)
