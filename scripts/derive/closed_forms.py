#!/usr/bin/python3
"""Numbers in the code that are plain mathematics or definitions, each with its closed form.

Golden section: lib/numerics/golden_section.h. Windows
of a sixth of an octave: kWindowRatio in lib/modal/line_windows.cc. A phase of -45 degrees: kPhase in
lib/modal/mode_parameters.cc. Rounding by adding 1.5 2^52: kShift in lib/numerics/elementary_lanes.h. Pound-force and
standard gravity, by definition: lib/document/measured/frf_unit.cc. Weights 1, -4, 6, -4, 1 over the root of 70 of
fourth differences on equal lines: lib/dynamics/noise.cc. Numbers of universal files, dataset 164:
lib/document/measured/universal_file_writer.cc. Sum and product of the exceptional shifts of EISPACK's HQR, shifts 3/4
s +- sqrt(-7/16) s: 1.5 s and s^2 in lib/numerics/francis_qr.h.

Prints each number with the closed form; all are exact to the last digit that is printed.
"""
from fractions import Fraction
from math import comb

from mpmath import mp, mpf, nstr, pi, sqrt

from source_check import stands_in

mp.dps = 40
golden = (sqrt(mpf(5)) - 1) / 2
checks = [
    ("lib/numerics/golden_section.h", f"kGoldenShare = {1 - float(golden)!r};", "1 - (sqrt(5) - 1) / 2, in double"),
    ("lib/modal/line_windows.cc", f"kWindowRatio = {nstr(mpf(2) ** (mpf(1) / 6), 5)};", "2^(1/6), five digits"),
    ("lib/modal/mode_parameters.cc", f"std::polar(1.0, {float(-pi / 4)!r})", "-pi / 4"),
    ("lib/numerics/elementary_lanes.h", f"kShift = {1.5 * 2.0**52!r};", "1.5 2^52"),
    ("lib/base/units.h", f"kStandardGravity = {float(Fraction('9.80665'))!r};", "definition (CGPM 1901), m/s^2"),
    ("lib/document/measured/frf_unit.cc", f"kPoundForce = {float(Fraction('0.45359237') * Fraction('9.80665'))!r};",
     "0.45359237 kg (definition of the pound) times standard gravity, N"),
    ("lib/document/measured/universal_file_writer.cc", f"{273.16:.17e}".replace("e", "D"), "273.16 in 18 digits"),
    ("lib/numerics/francis_qr.h", f"return {{{float(2 * Fraction(3, 4))!r} * size, size * size}};",
     f"sum of the shifts, and their product: (3/4)^2 + 7/16 = {Fraction(3, 4) ** 2 + Fraction(7, 16)}"),
]
weights = [(-1) ** k * comb(4, k) for k in range(5)]
for path, text, why in checks:
    print(f"{text}    // {why}")
print("fourth differences:", weights, " sum of squares:", sum(w * w for w in weights))
for path, text, _ in checks:
    stands_in(path, text)
