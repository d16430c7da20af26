#!/usr/bin/python3
"""arcs_of_a_period_picture.py [FILE]: lib/milling/arcs_of_a_period.svg, where teeth are in cut and where pieces end.

Four cutters over one period, by the rules of lib/milling/cut_schedule.cc: a piece ends where any part of a tooth in it enters or
leaves. Needs gnuplot.
"""
import math

from pictures import draw

DEGREES = 1e-9


def distinct(angles):
    result = []
    for angle in sorted(angles):
        if not result or angle - result[-1] > DEGREES:
            result.append(angle)
    return result


def equal(teeth, entry, leave, lag=0.0):
    """Period, bars (row, from, to) of the teeth, pieces (from, to) by rows of their own."""
    pitch = 360 / teeth
    events = distinct([entry, leave, entry + lag, leave + lag])
    ends = distinct([event % pitch for event in events])
    start = ends[0]
    ends = [end - start for end in ends] + [pitch]
    bars = []
    for j in range(-teeth, teeth + 1):
        low, high = entry - start - j * pitch, leave + lag - start - j * pitch
        if high > DEGREES and low < pitch - DEGREES:
            bars.append((max(low, 0), min(high, pitch)))
    bars.sort()
    pieces = [(a, b) for a, b in zip(ends, ends[1:]) if any(f < (a + b) / 2 < t for f, t in bars)]
    return pitch, [(row, *bar) for row, bar in enumerate(bars)], [(None, *piece) for piece in pieces]


def unequal(pitches, entry, leave):
    behind = [sum(pitches[:j]) for j in range(len(pitches))]
    ends = [entry, leave]
    for own in behind:
        for other in behind:
            for event in (entry, leave):
                for turn in (-360, 0, 360):
                    angle = event + other - own + turn
                    if entry < angle < leave:
                        ends.append(angle)
    ends = distinct(ends)
    bars, pieces = [], []
    for j, own in enumerate(behind):
        bars.append((j, own, own + leave - entry))
        pieces += [(j, own + a - entry, own + b - entry) for a, b in zip(ends, ends[1:])]
    return 360, bars, pieces


CASES = [
    ("2 teeth, 25 % immersion, up: period 180 degrees, one piece, then free flight", *equal(2, 0, 60)),
    ("3 teeth, slot: period 120 degrees, two teeth in cut, then one", *equal(3, 0, 180)),
    ("2 teeth with helix, 25 % immersion, edges 40 degrees behind at the top of the cut", *equal(2, 0, 60, 40)),
    ("4 teeth, pitches 70, 110, 70, 110, entry 0, exit 100: period 360 degrees, pieces of each tooth", *unequal([70, 110, 70, 110], 0, 100)),
]
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"]

commands = []
for index, (title, period, bars, pieces) in enumerate(CASES):
    rows = 1 + max(bar[0] for bar in bars)
    lines = [f'set title "{title}" offset 0,-0.6', f"set xrange [0:{period}]", f"set yrange [{rows}:-0.05]",
             f"set xtics {30 if period > 180 else 20}", "unset object", "unset arrow", "unset label"]
    own = pieces[0][0] is not None
    item = 0
    for row, low, high in bars:
        item += 1
        lines.append(f'set label {item} "tooth {row + 1}" at {low + 0.008 * period},{row + 0.38} left font ",11" front')
        lines.append(f'set object {item} rectangle from {low},{row + 0.12} to {high},{row + 0.62} fs solid 0.35 noborder '
                     f'fc rgb "{COLOURS[row % 4]}" front')
        if high > period:  # a tooth that is in cut when the period ends
            item += 1
            lines.append(f'set object {item} rectangle from {low - period},{row + 0.12} to {high - period},{row + 0.62} '
                         f'fs solid 0.35 noborder fc rgb "{COLOURS[row % 4]}" front')
    arrow = 0
    for row, low, high in pieces:
        top, bottom = (row + 0.05, row + 0.95) if own else (0, rows)
        for shift in (0, -period):
            if high + shift <= 0 or low + shift >= period:
                continue
            for end in (low + shift, high + shift):
                arrow += 1
                lines.append(f'set arrow {arrow} from {end},{top} to {end},{bottom} nohead lw 1.2 lc rgb "#000000" front')
            for i in range(7):  # the zeros of P_7, well enough for a picture
                place = (low + high) / 2 + shift - (high - low) / 2 * math.cos(math.pi * (i + 0.75) / 7.5)
                arrow += 1
                height = (row + 0.78) if own else rows - 0.22
                lines.append(f'set arrow {arrow} from {place},{height} to {place},{height + 0.14} nohead lc rgb "#444444" front')
    lines.append("set xlabel 'turn of the cutter, degrees (bars: tooth in cut; lines: ends of pieces; ticks: force at Gauss points)'"
                 if index == len(CASES) - 1 else "unset xlabel")
    lines.append("plot -1 notitle")
    commands += lines

draw("lib/milling/arcs_of_a_period.svg", "800,720", f"""
set multiplot layout {len(CASES)},1
set lmargin 4; set rmargin 4; set tmargin 2
set border 1; set tics nomirror; unset ytics
""" + "\n".join(commands) + "\n")
