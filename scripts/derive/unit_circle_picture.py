#!/usr/bin/python3
"""unit_circle_picture.py [FILE]: lib/milling/unit_circle.svg, limits of the one-mode slot from the unit circle.

Left: the eigenvalues of (1 - 1/mu) M(mu) as mu goes along the upper half of the unit circle; where one is real and
positive, its inverse is a depth at which a multiplier lies on the circle. Right: det(I - a (1 - 1/mu) M(mu)) at a
depth below the limit and one above it, which goes round the origin as often as multipliers are outside. With the cut
of one_mode_limits.py. Needs gnuplot.
"""
import cmath
import math

from pictures import block, draw
from one_mode_limits import Cut

SPEED, LIMIT, POINTS = 12000, 2.14931, 20  # rpm; mm: flip; Gauss points
SHALLOW, DEEP, STEPS, SHOWN = 1.0, 2.5, 150, 6


def eigenvalues(matrix):
    """Of a small complex matrix: Gram-Schmidt QR steps with Wilkinson's shift, deflated from the end."""
    a, found = [row[:] for row in matrix], []
    while a:
        n = len(a)
        for _ in range(200):
            if n == 1 or sum(abs(v) for v in a[n - 1][:n - 1]) < 1e-9 * max(abs(a[i][i]) for i in range(n)):
                break
            p, q, r, s = a[n - 2][n - 2], a[n - 2][n - 1], a[n - 1][n - 2], a[n - 1][n - 1]
            root = cmath.sqrt((p - s)**2 / 4 + q * r)
            shift = min((p + s) / 2 + root, (p + s) / 2 - root, key=lambda z: abs(z - s))
            columns, upper = [], [[0j] * n for _ in range(n)]
            for j in range(n):
                v = [a[i][j] - (shift if i == j else 0) for i in range(n)]
                for k, column in 2 * list(enumerate(columns)):  # twice: the last column is nearly a sum of the others
                    part = sum(x.conjugate() * y for x, y in zip(column, v))
                    upper[k][j] += part
                    v = [y - part * x for x, y in zip(column, v)]
                upper[j][j] = math.sqrt(sum(abs(y)**2 for y in v)) or 1e-300
                columns.append([y / upper[j][j] for y in v])
            a = [[sum(upper[i][k] * columns[j][k] for k in range(i, n)) + (shift if i == j else 0) for j in range(n)]
                 for i in range(n)]
        found.append(a[n - 1][n - 1])
        a = [row[:n - 1] for row in a[:n - 1]]
    return sorted(found, key=abs, reverse=True)


cut = Cut(SPEED, 0.0, math.pi, 1, POINTS)
# Finer towards the angle of the mode's own multiplier, where everything moves fast.
mode = abs(cmath.phase(cut.multiplier[0]))
phis = sorted([math.pi * (i + 0.02) / STEPS for i in range(STEPS)] + [math.pi] +
              [mode + 0.2 * math.sinh(i / 4) / math.sinh(5) for i in range(-20, 21)])
phis = [phi for phi in phis if 0 < phi <= math.pi]
loci = [[value * 1e-3 for value in eigenvalues(cut.operator(phi))[:SHOWN]] for phi in phis]
data = block("loci", [(value.real, value.imag) for values in loci for value in values])
data += block("flip", [(value.real, value.imag) for value in loci[-1]])


for name, depth in (("shallow", SHALLOW), ("deep", DEEP)):
    curve = [cut.determinant(depth * 1e-3, phi) for phi in phis]
    data += block(name, [(v.real, v.imag) for v in curve] + [(v.real, -v.imag) for v in reversed(curve)])
print("unstable multipliers at the two depths:", cut.unstable(SHALLOW * 1e-3), cut.unstable(DEEP * 1e-3))

draw("lib/milling/unit_circle.svg", "900,470", f"""{data}
set multiplot layout 1,2
set grid lc rgb "#dddddd"
set zeroaxis lc rgb "#888888"
set size ratio -1
set key below
set title "eigenvalues along the upper half of the circle, 1/mm"
set xlabel "real part"; set ylabel "imaginary part"
set label 1 "flip: 1/({LIMIT:.2f} mm)" at {1 / LIMIT},0 offset 0.6,0.6
set xrange [-0.8:1.2]; set yrange [-0.8:0.8]
plot $loci using 1:2 with points pt 7 ps 0.25 lc rgb "#0072b2" title "the {SHOWN} largest", \
  $flip using 1:2 with points pt 6 ps 0.8 lc rgb "#d55e00" title "at mu = -1"
unset label 1
set title "determinant along the whole circle"
set label 2 "0" at 0,0 point pt 2 ps 1.2 offset 0.5,-0.7
set xrange [-1.5:2]; set yrange [-1.4:1.4]
plot $shallow using 1:2 with lines lw 2 lc rgb "#0072b2" title "{SHALLOW} mm", \\
  $deep using 1:2 with lines lw 2 lc rgb "#d55e00" title "{DEEP} mm"
""")
