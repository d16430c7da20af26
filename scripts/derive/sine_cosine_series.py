#!/usr/bin/python3
"""How many terms the sine and cosine series of lib/numerics/elementary_lanes.h need.

sines_and_cosines: on |r| <= pi/4 the sine goes up to r^15 / 15! (n <= 14) and the cosine up to r^16 / 16! (n
<= 16), so that the terms left out are below 5e-17. largest_arm_compliances: on [0, pi/3] the cosine goes up
to t^18 / 18! (n <= 18), terms left out below 1e-17. The factors 1 / (n (n - 1)) and 1 / (n (n + 1)) are
computed in the code; only the loops' limits stand there.

Method: Taylor series; the first n whose next term is below the bound. Then both loops are run in double, as
the code runs them, against 40 digits.
"""
from mpmath import cos, factorial, mp, mpf, nstr, pi, sin

from source_check import stands_in

mp.dps = 40


def last_power(argument, first, bound):
    """The last power to keep: the term after it, two powers on, is below the bound."""
    n = first
    while mpf(argument) ** (n + 2) / factorial(n + 2) >= bound:
        n += 2
    return n


def next_term(argument, n):
    return mpf(argument) ** (n + 2) / factorial(n + 2)


sine = last_power(pi / 4, 1, 5e-17)
cosine = last_power(pi / 4, 0, 5e-17)
third = last_power(pi / 3, 0, 1e-17)
# The loops are over even n from 2 on: the sine's factor 1 / (n (n + 1)) brings the power n + 1.
texts = [f"kCosinePower = {cosine}, kSinePower = {sine - 1}, kThirdPower = {third};"]
for text in texts:
    print(text)
print("next terms: sine", nstr(next_term(pi / 4, sine), 3), " cosine", nstr(next_term(pi / 4, cosine), 3),
      " cosine on [0, pi/3]", nstr(next_term(pi / 3, third), 3))


def series(x, last, shift):
    value = 1.0
    for n in range(last, 1, -2):
        value = 1 - x * x * value * (1.0 / (n * (n + shift)))
    return value


errors = [mpf(0)] * 3
for i in range(4001):
    r, t = float(pi / 4) * (i - 2000) / 2000, float(pi / 3) * i / 4000
    errors = [max(errors[0], abs(r * series(r, sine - 1, 1) - sin(mpf(r)))),
              max(errors[1], abs(series(r, cosine, -1) - cos(mpf(r)))),
              max(errors[2], abs(series(t, third, -1) - cos(mpf(t))))]
print("largest errors in double: sine", nstr(errors[0], 3), " cosine", nstr(errors[1], 3),
      " cosine on [0, pi/3]", nstr(errors[2], 3))
stands_in("lib/numerics/elementary_lanes.h", *texts)
