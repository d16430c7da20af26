#!/usr/bin/python3
"""Section 3 of Liu et al. 2014 by textbook formulas: numbers in lib/receptance/receptance_test.cc.

A 12 mm steel bar (118.92 mm, free at both ends) on a stub (50.90 mm, fixed at one end), Euler-Bernoulli with
E (1 + 0.02 i), joined rigidly (one cantilever of 169.82 mm) or by the joint that the paper identified.
Method: the closed forms of the paper's Table 1 with c4 = cos - cosh, and eq. 6. Prints the first natural
frequencies of the parts (cos x cosh x = -1 and 1), the frequencies at which the tips peak (to 1 Hz), and the
paper's objective, the norm of the amplitudes' difference on 1 to 5000 Hz in steps of 1 Hz.
"""
import cmath
import math

from source_check import stands_in

E, LOSS, DENSITY, D = 200e9, 0.02, 7800.0, 0.012
EI = E * (1 + 1j * LOSS) * math.pi * D**4 / 64
MASS_PER_M = DENSITY * math.pi * D**2 / 4
JOINT = (97062227, 18.633, 95978423, 10.399)


def functions(length, omega):
    wave = cmath.sqrt(cmath.sqrt(omega**2 * MASS_PER_M / EI))
    x = wave * length
    return wave, cmath.cos(x), cmath.sin(x), cmath.cosh(x), cmath.sinh(x)


def fixed_free(length, omega):
    k, c, s, ch, sh = functions(length, omega)
    c8 = EI * (c * ch + 1)
    h, l, p = -(c * sh - s * ch) / (k**3 * c8), s * sh / (k**2 * c8), (c * sh + s * ch) / (k * c8)
    return [[h, l], [l, p]]


def free_free(length, omega):
    """R11, R12, R21, R22: end 1 is the tip; the slope is taken towards the tip."""
    k, c, s, ch, sh = functions(length, omega)
    c7 = EI * (c * ch - 1)
    h, l, p = -(c * sh - s * ch) / (k**3 * c7), s * sh / (k**2 * c7), (c * sh + s * ch) / (k * c7)
    h12, l12, p12 = (s - sh) / (k**3 * c7), -(c - ch) / (k**2 * c7), (s + sh) / (k * c7)
    return [[h, l], [l, p]], [[h12, l12], [-l12, p12]], [[h12, -l12], [l12, p12]], [[h, -l], [-l, p]]


def tip(omega, joint):
    r11, r12, r21, r22 = free_free(0.11892, omega)
    held = fixed_free(0.05090, omega)
    a = [[r22[i][j] + held[i][j] for j in range(2)] for i in range(2)]
    if joint:
        a[0][0] += 1 / (joint[0] + 1j * omega * joint[1])
        a[1][1] += 1 / (joint[2] + 1j * omega * joint[3])
    determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0]
    adjugate = [[a[1][1], -a[0][1]], [-a[1][0], a[0][0]]]
    pairs = ((i, j) for i in range(2) for j in range(2))
    return r11[0][0] - sum(r12[0][i] * adjugate[i][j] * r21[j][0] for i, j in pairs) / determinant


def peak(lo, hi, response):
    return max(range(lo, hi + 1), key=lambda f: abs(response(2 * math.pi * f)))


def natural_hz(length, lo, hi, side):
    """Of the wave number times length between lo and hi at which cos x cosh x = side."""
    for _ in range(60):
        middle = (lo + hi) / 2
        same = (math.cos(lo) * math.cosh(lo) > side) == (math.cos(middle) * math.cosh(middle) > side)
        lo, hi = (middle, hi) if same else (lo, middle)
    return round((lo / length) ** 2 * math.sqrt(EI.real / MASS_PER_M) / (2 * math.pi))


if __name__ == "__main__":
    parts = [natural_hz(0.05090, 1.5, 2.5, -1), natural_hz(0.11892, 4, 5, 1)]
    bands = ((280, 310), (1800, 1900))
    peaks = [peak(lo, hi, lambda w: tip(w, joint)) for joint in (None, JOINT) for lo, hi in bands]
    lines = [2 * math.pi * f for f in range(1, 5001)]
    objective = math.sqrt(sum((abs(tip(w, JOINT)) - abs(tip(w, None))) ** 2 for w in lines))
    print("stub, bar:", parts, " rigidly joined:", peaks[:2], " with the joint:", peaks[2:])
    print(f"objective: {objective:.6g}")
    cantilever = fixed_free(0.16982, lines[999])[0][0]
    off = abs(tip(lines[999], None) / cantilever - 1)
    print(f"rigid joint against one cantilever, 1000 Hz: relative difference {off:.1e}")
    stands_in("lib/receptance/receptance_test.cc", f"{parts[0]} Hz of the stub, {parts[1]} Hz of the bar",
              f"{peaks[0]} and {peaks[1]} Hz of both", *(f"Approx({f})" for f in parts + peaks),
              f"Approx({objective:.3g})".replace("e-05", "e-5"))
