#!/usr/bin/python3
"""Limit depths of the one-mode benchmark: the two tables of lib/milling/lobes_test.cc.

An oscillator (0.03993 kg, 922 Hz, damping ratio 0.011) cut by two straight teeth, Kt = 600 and Kr = 200
N/mm2: a slot with the oscillator in x only, and up-milling at 5 % immersion with the same oscillator in x and
in y.

Method, independent of the library's: at a limit the motion of a tooth period is mu times that of the one
before, |mu| = 1, so the chip thickness h(t) = s x + c y obeys h = (1 - 1/mu) a M(mu) h with M from the
structure's impulse response (integrals over Lagrange polynomials at Gauss points, coefficients exact). The
unstable multipliers at depth a are as many as the turns of det(I - (1 - 1/mu) a M(mu)) round 0, against mu's,
as mu goes round the unit circle (its poles, the structure's own multipliers, lie inside). A tabulated depth
is confirmed when nothing is unstable at sixths of it and half a unit of its last digit below it, and
something is half a unit above it: one multiplier for a flip, two else. Prints the tables.
"""
import cmath
import math
import sys

from source_check import stands_in

MASS, OMEGA, ZETA = 0.03993, 2 * math.pi * 922, 0.011
KT, KR, TEETH = 600e6, 200e6, 2
POLE = OMEGA * complex(-ZETA, math.sqrt(1 - ZETA**2))
POLES = (POLE, POLE.conjugate())
RESIDUES = (1 / (2j * MASS * POLE.imag), -1 / (2j * MASS * POLE.imag))
SLOT = ({5000: ".40863", 6000: ".35322", 7000: "1.15199", 8000: ".67639", 9000: "3.00921", 10000: ".32238",
          12000: "2.14931", 15000: ".38659", 20000: "1.41751", 25000: "3.93993"}, {12000, 20000})
LOW = ({5000: "1.84380", 6000: "1.53627", 8000: "2.22940", 10000: "1.48695", 15000: "1.65121",
         20000: "3.25039"}, {20000})


def gauss(n):
    nodes, weights = [], []
    for i in range(n):
        x = -math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(50):
            p0, p1 = 1.0, x
            for j in range(1, n):
                p0, p1 = p1, ((2 * j + 1) * x * p1 - j * p0) / (j + 1)
            slope = n * (x * p1 - p0) / (x * x - 1)
            x -= p1 / slope
        nodes.append(x)
        weights.append(2 / ((1 - x * x) * slope * slope))
    return nodes, weights


def lagrange(nodes, x):
    return [math.prod((x - b) / (a - b) for b in nodes if b != a) for a in nodes]


class Cut:
    """From the entry angle on; the period starts where the tooth enters."""

    def __init__(self, rpm, entry, leave, directions, count=None):
        self.period = 60 / (TEETH * rpm)
        speed = 2 * math.pi * rpm / 60
        arc = (leave - entry) / speed
        count = count or 12 + int(12 * arc / self.period) + int(0.45 * OMEGA * arc)
        nodes, _ = gauss(count)
        fine, fine_weights = gauss(count + 12)
        times = [arc * (x + 1) / 2 for x in nodes]

        def sense(t):
            phi = entry + speed * t
            return [math.sin(phi), math.cos(phi)][:directions]

        def drive(t):
            s, c = math.sin(entry + speed * t), math.cos(entry + speed * t)
            return [-KT * c - KR * s, KT * s - KR * c][:directions]

        def integrals(to, pole):
            """Of exp(pole (to - s)) drive(s) times each Lagrange polynomial, s up to `to`: [directions][nodes]."""
            sums = [[0j] * count for _ in range(directions)]
            for x, w in zip(fine, fine_weights):
                s = to * (x + 1) / 2
                basis = lagrange(nodes, 2 * s / arc - 1)
                for d, force in enumerate(drive(s)):
                    factor = to / 2 * w * cmath.exp(pole * (to - s)) * force
                    for j in range(count):
                        sums[d][j] += factor * basis[j]
            return sums

        # h at node i: own[i][j] of this period's h, seen[i][k] of mode state k; left[k][j]: what h leaves in that.
        self.own = [[0j] * count for _ in range(count)]
        self.seen, self.left, self.multiplier = [[] for _ in range(count)], [], []
        for pole, residue in zip(POLES, RESIDUES):
            for i, t in enumerate(times):
                part = integrals(t, pole)
                for j in range(count):
                    self.own[i][j] += residue * sum(a * part[d][j] for d, a in enumerate(sense(t)))
            end = [[v * cmath.exp(pole * (self.period - arc)) for v in row] for row in integrals(arc, pole)]
            for d in range(directions):
                self.left.append(end[d])
                self.multiplier.append(cmath.exp(pole * self.period))
                for i, t in enumerate(times):
                    self.seen[i].append(residue * cmath.exp(pole * t) * sense(t)[d])

    def operator(self, phi):
        """(1 - 1/mu) M(mu) at mu = e^(i phi)."""
        mu = cmath.exp(1j * phi)
        shares = [1 / (mu - m) for m in self.multiplier]
        rows = []
        for own, seen in zip(self.own, self.seen):
            carried = [s * g for s, g in zip(seen, shares)]
            rows.append([(1 - 1 / mu) * (own[j] + sum(c * left[j] for c, left in zip(carried, self.left)))
                         for j in range(len(own))])
        return rows

    def determinant(self, depth, phi):
        n = len(self.own)
        a = [[(i == j) - depth * value for j, value in enumerate(row)] for i, row in enumerate(self.operator(phi))]
        result = 1 + 0j
        for k in range(n):
            best = max(range(k, n), key=lambda r: abs(a[r][k]))
            if best != k:
                a[k], a[best] = a[best], a[k]
                result = -result
            result *= a[k][k]
            for r in range(k + 1, n):
                ratio = a[r][k] / a[k][k]
                if ratio:
                    row, pivot = a[r], a[k]
                    for c in range(k + 1, n):
                        row[c] -= ratio * pivot[c]
        return result

    def unstable(self, depth):
        """Number of multipliers outside the unit circle."""
        turn = 0.0
        phis = [math.pi * i / 24 for i in range(25)]
        values = [self.determinant(depth, phi) for phi in phis]
        stack = list(zip(phis, values, phis[1:], values[1:]))
        while stack:
            phi0, value0, phi1, value1 = stack.pop()
            step = cmath.phase(value1 / value0)
            if abs(step) > 0.6 and phi1 - phi0 > 1e-7:
                middle = (phi0 + phi1) / 2
                value = self.determinant(depth, middle)
                stack += [(phi0, value0, middle, value), (middle, value, phi1, value1)]
            else:
                turn += step
        return round(-turn / math.pi)  # half of the circle; the determinant turns backwards


def main():
    wrong = False
    texts = []
    for (table, flips), entry, leave, directions in ((SLOT, 0.0, math.pi, 1), (LOW, 0.0, math.acos(0.9), 2)):
        rows = []
        for rpm, text in table.items():
            cut = Cut(rpm, entry, leave, directions)
            limit = float(text) * 1e-3
            below = [cut.unstable(depth) for depth in [limit * k / 6 for k in range(1, 6)] + [limit - 0.5e-8]]
            above = cut.unstable(limit + 0.5e-8)
            wrong |= any(below) or above == 0 or (above == 1) != (rpm in flips)
            rows.append(f"{{{rpm}, {text}, {'kFlip' if above == 1 else 'kHopf'}}}")
        texts.append("{" + ", ".join(rows) + "}")
        print(texts[-1])
    print("not confirmed" if wrong else "confirmed to half a unit of the last digit")
    stands_in("lib/milling/lobes_test.cc", *texts)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
