#!/usr/bin/python3
"""joint_landscape_picture.py [FILE]: lib/receptance/joint_landscape.svg, why the search for a joint scans.

The bar and the stub of [Liu2014, section 3] with a joint of k1 = 5e7 N/m, c1 = 200 N s/m, k2 = 5e4 N m/rad, c2 = 0.5 N m s/rad.
Colours: the relative misfit |H - H_measured| / |H_measured| over 10 to 5000 Hz for each pair of stiffnesses, with dampings in
the true ratio to them. Points: for k1 on a grid the k2 (with its own c2) that the linear least squares of
lib/receptance/joint_starts gives for it, once begun soft and once stiff. Needs gnuplot.
"""
import math

from pictures import block, draw
from liu_example import fixed_free, free_free

TRUE = (5e7, 200.0, 5e4, 0.5)
LINES = [2 * math.pi * hz for hz in range(10, 5001, 10)]
ACROSS, UP = (4.0, 11.0), (1.0, 8.0)  # decades of k1 and of k2
CELLS = 84


def planes():
    """rigid, l1, l2, r1, r2, z11, z12, z22 of README.md, section 11, line by line."""
    for omega in LINES:
        r11, r12, r21, r22 = free_free(0.11892, omega)
        held = fixed_free(0.05090, omega)
        a, b, d = r22[0][0] + held[0][0], r22[0][1] + held[0][1], r22[1][1] + held[1][1]
        low = a * d - b * b
        z11, z12, z22 = d / low, -b / low, a / low
        l1, l2 = r12[0][0] * z11 + r12[0][1] * z12, r12[0][0] * z12 + r12[0][1] * z22
        r1, r2 = z11 * r21[0][0] + z12 * r21[1][0], z12 * r21[0][0] + z22 * r21[1][0]
        yield omega, r11[0][0] - l1 * r21[0][0] - l2 * r21[1][0], l1, l2, r1, r2, z11, z12, z22


PLANES = list(planes())


def tips(joint):
    k1, c1, k2, c2 = joint
    for omega, rigid, l1, l2, r1, r2, z11, z12, z22 in PLANES:
        s1, s2 = complex(k1, omega * c1) + z11, complex(k2, omega * c2) + z22
        yield rigid + (l1 * (s2 * r1 - z12 * r2) + l2 * (s1 * r2 - z12 * r1)) / (s1 * s2 - z12 * z12)


MEASURED = list(tips(TRUE))
SIZE = math.sqrt(sum(abs(h) ** 2 for h in MEASURED))


def misfit(joint):
    return math.sqrt(sum(abs(h - m) ** 2 for h, m in zip(tips(joint), MEASURED))) / SIZE


def second_solved(k1, c1, k2, c2=0.0):
    for _ in range(2):
        sums = [0.0] * 4
        for (omega, rigid, l1, l2, r1, r2, z11, z12, z22), measured, tip in zip(PLANES, MEASURED, tips((k1, c1, k2, c2))):
            s1, y = complex(k1, omega * c1) + z11, measured - rigid
            a = y * s1 - l1 * r1
            b = s1 * l2 * r2 - l2 * z12 * r1 - l1 * z12 * r2 + z22 * l1 * r1 - y * (z22 * s1 - z12 * z12)
            low = (complex(k2, omega * c2) + z22) * s1 - z12 * z12
            weighted = a.conjugate() / abs(low) ** 2
            for i, term in enumerate(((weighted * b).real, (weighted * a).real, (weighted * b).imag * omega,
                                      (weighted * a).real * omega**2)):
                sums[i] += term
        k2, c2 = sums[0] / sums[1], max(0.0, sums[2] / sums[3])
        k2 = k2 if k2 > 0 else 10 ** UP[1]
    return k2, c2


def at(decades, i, count):
    return 10 ** (decades[0] + (decades[1] - decades[0]) * i / (count - 1))


tangents = TRUE[1] / TRUE[0], TRUE[3] / TRUE[2]
grid = []
for i in range(CELLS):
    for j in range(CELLS):
        k1, k2 = at(ACROSS, i, CELLS), at(UP, j, CELLS)
        value = misfit((k1, tangents[0] * k1, k2, tangents[1] * k2))
        grid.append((math.log10(k1), math.log10(k2), math.log10(max(value, 1e-3))))
    grid.append(())
scan = []
for i in range(57):
    k1 = at(ACROSS, i, 57)
    for begin in (0.0, 1e10):
        k2, _ = second_solved(k1, tangents[0] * k1, begin)
        scan.append((math.log10(k1), math.log10(min(max(k2, 10 ** UP[0]), 10 ** UP[1]))))

data = block("grid", grid, 4) + block("scan", scan, 4) + block("truth", [(math.log10(TRUE[0]), math.log10(TRUE[2]))], 4)
draw("lib/receptance/joint_landscape.svg", "760,520", f"""{data}
set xrange [{ACROSS[0]}:{ACROSS[1]}]
set yrange [{UP[0]}:{UP[1]}]
set cbrange [-2:0.5]
set palette defined (0 "#12395f", 0.25 "#3f83b8", 0.5 "#a9cfe5", 0.75 "#f3e3b5", 1 "#d98f4e")
set xlabel "k1 (N/m)"
set ylabel "k2 (N m/rad)"
set cblabel "relative misfit"
set format x "10^{{%g}}"
set format y "10^{{%g}}"
set format cb "10^{{%g}}"
set key outside top center horizontal samplen 1
plot $grid using 1:2:3 with image notitle, \\
     $scan using 1:2 with points pt 7 ps 0.35 lc rgb "#000000" title "k2 solved for a given k1", \\
     $truth using 1:2 with points pt 2 ps 1.3 lw 2 lc rgb "#c0392b" title "the joint"
""")
