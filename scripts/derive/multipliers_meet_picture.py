#!/usr/bin/python3
"""multipliers_meet_picture.py [FILE]: lib/milling/multipliers_meet.svg, two multipliers that meet on the real axis.

An oscillator (922 Hz, damping ratio 0.011) cut so briefly that a tooth acts as an impulse: v -> v - k (x - x of the
tooth before), k proportional to the depth of cut. Its period map has two multipliers, whose sum and product are
straight lines over the depth, while the multipliers have a square root where they meet. Needs gnuplot.
"""
import cmath
import math

from pictures import block, draw

OMEGA, ZETA, WAVES, NODES = 2 * math.pi * 922, 0.011, 2.43, 8  # WAVES of the mode in a period
DEEPEST = 0.14


def sum_and_product(depth):
    damped = OMEGA * math.sqrt(1 - ZETA**2)
    period = 2 * math.pi * WAVES / damped
    decay = math.exp(-ZETA * OMEGA * period)
    trace = 2 * decay * math.cos(damped * period)
    return trace - depth, decay**2 - depth  # depth: k times the displacement that a unit of velocity leaves a period later


def multipliers(depth):
    total, product = sum_and_product(depth)
    root = cmath.sqrt(total**2 / 4 - product)
    return total / 2 + root, total / 2 - root


meeting = next(d / 1e5 for d in range(int(DEEPEST * 1e5)) if multipliers(d / 1e5)[0].imag == 0)
fine = sorted([DEEPEST * i / 200 for i in range(201)] + [meeting + (i / 20)**2 * 0.01 for i in range(21)])
nodes = [DEEPEST * (1 - math.cos(math.pi * (i + 0.5) / NODES)) / 2 for i in range(NODES)]
flip = next(d for d in fine if min(m.real for m in multipliers(d)) < -1)

data = block("pair", [(d, multipliers(d)[0].real, abs(multipliers(d)[0])) for d in fine if d < meeting])
data += block("real", [(d, multipliers(d)[0].real, multipliers(d)[1].real) for d in fine if d >= meeting])
data += block("both", [(d, *sum_and_product(d)) for d in fine])
data += block("complex_nodes", [(d, multipliers(d)[0].real, abs(multipliers(d)[0])) for d in nodes if d < meeting])
data += block("real_nodes", [(d, multipliers(d)[0].real, multipliers(d)[1].real) for d in nodes if d >= meeting])
data += block("both_nodes", [(d, *sum_and_product(d)) for d in nodes])

draw("lib/milling/multipliers_meet.svg", "760,640", f"""{data}
set multiplot layout 2,1
set xrange [0:{DEEPEST}]
set lmargin 11; set rmargin 4
set grid lc rgb "#dddddd"
set arrow 1 from {meeting},graph 0 to {meeting},graph 1 nohead dt 2 lc rgb "#888888"
set arrow 2 from {flip},graph 0 to {flip},graph 1 nohead dt 3 lc rgb "#888888"
set key outside top center horizontal
set ylabel "multipliers"
set yrange [-1.3:1.1]; set ytics 0.5
set label 1 "they meet" at {meeting},0.30 right offset -0.6,0
set label 2 "flip: one passes -1" at {flip},0.30 left offset 0.6,0
set label 3 "complex pair: one track" at {meeting / 2},-0.55 center
set label 4 "two real tracks" at {(flip + DEEPEST) / 2},-0.30 center
plot $pair using 1:3 with lines lw 2 lc rgb "#0072b2" title "modulus of the pair", \\
  $pair using 1:2 with lines lw 2 lc rgb "#56b4e9" title "its real part", \\
  $real using 1:2 with lines lw 2 lc rgb "#d55e00" title "real multipliers", $real using 1:3 with lines lw 2 lc rgb "#d55e00" notitle, \\
  $complex_nodes using 1:3 with points pt 7 ps 0.7 lc rgb "#0072b2" notitle, $complex_nodes using 1:2 with points pt 7 ps 0.7 lc rgb "#56b4e9" notitle, \\
  $real_nodes using 1:2 with points pt 7 ps 0.7 lc rgb "#d55e00" notitle, $real_nodes using 1:3 with points pt 7 ps 0.7 lc rgb "#d55e00" notitle
unset label
set ylabel "what the branch stores"
set xlabel "depth of cut, scaled (one panel with its eight Chebyshev nodes)"
set yrange [-2:1]
plot $both using 1:2 with lines lw 2 lc rgb "#009e73" title "sum", $both using 1:3 with lines lw 2 lc rgb "#cc79a7" title "product", \\
  $both_nodes using 1:2 with points pt 7 ps 0.7 lc rgb "#009e73" notitle, $both_nodes using 1:3 with points pt 7 ps 0.7 lc rgb "#cc79a7" notitle
""")
