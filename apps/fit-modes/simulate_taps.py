#!/usr/bin/env python3
"""Records of hits on two known modes, for taps_test.sh, independent of the tools: closed form in the time domain.

The force of a blow is F sin^6(pi t / w), a sum of e^{i j W t} for j = -3 ... 3, W = 2 pi / w, with less than 1e-6 of it above 3 kHz. The response of a pole lambda to
e^{mu t} over 0 to w is (e^{mu m + lambda (t - m)} - e^{lambda t}) / (mu - lambda), m = min(t, w).
Usage: simulate_taps.py FOLDER   writes x.csv (eight hits, the fifth double), its hits one by one as hit1.csv ..., the
same without noise as exact.csv, in volts as volts.csv, and x.uff.
"""
import cmath
import math
import pathlib
import random
import sys

RATE, WIDTH, GAP, G = 4096, 3.5e-3, 1.0, 9.80665
MODES = [(60.0, 0.04, (1.0, 0.6), 8.0), (210.0, 0.02, (-0.5, 1.0), 5.0)]  # Hz, damping ratio, shape in x and y, kg
FORCES = [80, 95, 70, 110, 90, 60, 85, 100]


def accelerations(blows, samples):
    """x and y of forces along x at (time, newtons)."""
    signals = [[0.0] * samples for _ in range(2)]
    for frequency, damping, shape, mass in MODES:
        omega = 2 * math.pi * frequency
        pole = complex(-damping, math.sqrt(1 - damping**2)) * omega
        residue = 1 / (2j * mass * pole.imag)
        for at, force in blows:
            parts = [(force * (-1) ** j * math.comb(6, 3 + j) / 64, 2j * math.pi * j / WIDTH) for j in range(-3, 4)]
            for i in range(max(0, math.ceil(at * RATE)), samples):
                t = i / RATE - at
                m = min(t, WIDTH)
                x = sum(a * (cmath.exp(mu * m + pole * (t - m)) - cmath.exp(pole * t)) / (mu - pole) for a, mu in parts)
                inside = t < WIDTH
                f = sum(a * cmath.exp(mu * t) for a, mu in parts) if inside else 0
                slope = sum(a * mu * cmath.exp(mu * t) for a, mu in parts) if inside else 0
                value = 2 * (residue * (pole * pole * x + pole * f + slope)).real
                for c in range(2):
                    signals[c][i] += shape[0] * shape[c] * value
    return signals


def force_of(blows, samples):
    force = [0.0] * samples
    for at, newtons in blows:
        for i in range(max(0, math.ceil(at * RATE)), min(samples, math.ceil((at + WIDTH) * RATE))):
            force[i] += newtons * math.sin(math.pi * (i / RATE - at) / WIDTH) ** 6
    return force


def csv(path, names, columns, digits=9):
    with open(path, "w") as out:
        out.write(",".join(names) + "\n")
        for row in zip(*columns):
            out.write(",".join(f"{value:.{digits}g}" for value in row) + "\n")


def uff(path, channels):
    """Dataset 58 in text, one function for each (data type, direction, values)."""
    with open(path, "w") as out:
        for kind, direction, values in channels:
            out.write("    -1\n    58\nrecord\nNONE\nNONE\nNONE\nNONE\n")
            out.write(f"{1:5d}{0:10d}{1:5d}{0:10d} {'NONE':10s}{1:10d}{direction:4d} {'NONE':10s}{0:10d}{0:4d}\n")
            out.write(f"{4:10d}{len(values):10d}{1:10d}{0:13.5e}{1 / RATE:13.5e}{0:13.5e}\n")
            for data_type, label, unit in ((17, "Time", "s"), (kind, "Force" if kind == 13 else "Acceleration", "N" if kind == 13 else "m/s^2"), (0, "NONE", "NONE"), (0, "NONE", "NONE")):
                out.write(f"{data_type:10d}{0:5d}{0:5d}{0:5d} {label:20s} {unit:20s}\n")
            for i in range(0, len(values), 4):
                out.write("".join(f"{value:20.11e}" for value in values[i:i + 4]) + "\n")
            out.write("    -1\n")


def main():
    folder = pathlib.Path(sys.argv[1])
    samples = round((len(FORCES) * GAP + 0.1) * RATE)
    blows = [(0.06 + GAP * i, force) for i, force in enumerate(FORCES)]
    exact_force, exact = force_of(blows, samples), accelerations(blows, samples)
    names = ["time (s)", "hammer (N)", "acc_x (g)", "acc_y (g)"]
    time = [i / RATE for i in range(samples)]
    csv(folder / "exact.csv", names, [time, exact_force] + [[a / G for a in signal] for signal in exact], 17)
    second = [(0.06 + GAP * 4 + 0.017, 30)]
    generator = random.Random(7)

    def noisy(signal, more, deviation):
        return [a + b + deviation * generator.gauss(0, 1) for a, b in zip(signal, more)]

    force = noisy(exact_force, force_of(second, samples), 0.2)
    x, y = (noisy(a, b, 0.02) for a, b in zip(exact, accelerations(second, samples)))
    columns = [time, force, [a / G for a in x], [a / G for a in y]]
    csv(folder / "x.csv", names, columns)
    volts = [time, [0.00225 * f for f in force], [0.1 * a / G for a in x], [0.1 * a / G for a in y]]
    csv(folder / "volts.csv", ["time (s)", "hammer (V)", "acc_x (V)", "acc_y (V)"], volts)
    for i in range(len(FORCES)):
        part = slice(round(GAP * i * RATE), round((GAP * (i + 1) + 0.05) * RATE))
        csv(folder / f"hit{i + 1}.csv", names, [column[part] for column in columns])
    uff(folder / "x.uff", [(12, 1, x), (13, 1, force), (12, -2, [-a for a in y])])


main()
