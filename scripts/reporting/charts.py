"""What the page's script draws: plain data, numbers rounded to what a screen shows.

A chart has a title, an x and a y axis (label with unit, perhaps "log", "min", "max"), "curves" (points, lines, bands) and
perhaps "cells": values over a regular grid in steps of colour. "hover" of a curve or of cells: names and one value for each
point (for cells: for each column), shown beside the coordinates.
"""

import bisect
import math

# Told apart in grey and by the colour-blind; lines besides by their dashes, points by their shapes.
COLOURS = ["#1a1a1a", "#b02418", "#1d4f91", "#1b6e3c", "#8a5a00", "#6b3a7d", "#00707a", "#7a7a7a"]
DASHES = [[], [6, 3], [2, 2], [8, 3, 2, 3]]
SHAPES = ["circle", "triangle", "rectRot", "rect", "crossRot", "star"]
STABLE = ["#f4f8fb", "#bcd6e6"]
UNSTABLE = ["#fbdcb4", "#c4651f"]
UNLIKELY_TO_LIKELY = ["#c4651f", "#eda65a", "#fbe3c4", "#cfe3ee", "#f4f8fb"]
SOFT_TO_STIFF = ["#3b2a5c", "#3f6f9c", "#86c5a0", "#fdf3c0"]
LEFT_AND_CUT = ["#3b6ea5", "#ffffff", "#b8621b"]


def short(value, digits=6):
    """A number with the digits that a screen shows; None stays."""
    if value is None or isinstance(value, (str, bool)):
        return value
    if not math.isfinite(value):
        return None
    return float(f"{value:.{digits}g}") if value != int(value) or abs(value) >= 1e15 else int(value)


def shorts(values, digits=6):
    """Numbers of one curve: what is rounding beside the largest is 0."""
    numbers = [abs(value) for value in values if isinstance(value, (int, float)) and math.isfinite(value)]
    least = 1e-12 * max(numbers, default=0)
    return [0 if isinstance(value, float) and abs(value) < least else short(value, digits) for value in values]


def axis(label, log=False, low=None, high=None):
    found = {"label": label}
    if log:
        found["log"] = True
    if low is not None and high is not None and high > low:
        found |= {"min": short(low), "max": short(high)}
    return found


def curve(name, x, y, index=0, points=False, line=True, hover=None, digits=6, **style):
    """One curve; None in y is a gap. digits: of y."""
    found = {"name": name, "x": shorts(x), "y": shorts(y, digits), "colour": COLOURS[index % len(COLOURS)],
             "dash": DASHES[(index // 2) % len(DASHES)], "shape": SHAPES[index % len(SHAPES)], "points": points, "line": line}
    if hover:
        found["hover"] = [[title, shorts(values)] for title, values in hover]
    return found | style


def _mixed(stops, where):
    """The colour at 0 <= where <= 1 along the stops."""
    at = min(where, 1) * (len(stops) - 1)
    first = min(int(at), len(stops) - 2)
    pair = [[int(stop[i:i + 2], 16) for i in (1, 3, 5)] for stop in stops[first:first + 2]]
    return "#" + "".join(f"{round(a + (b - a) * (at - first)):02x}" for a, b in zip(*pair))


def colours_about_zero(edges):
    """Blue below zero, brown above, the same strength for the same distance."""
    step = min((b - a for a, b in zip(edges, edges[1:])), default=1)
    middles = [edges[0] - step / 2] + [(a + b) / 2 for a, b in zip(edges, edges[1:])] + [edges[-1] + step / 2]
    largest = max(abs(middle) for middle in middles)
    return [_mixed(LEFT_AND_CUT, 0.5 + 0.5 * middle / largest) for middle in middles]


def colours_of(stops, count):
    return [_mixed(stops, step / max(count - 1, 1)) for step in range(count)]


def _even(values):
    steps = [b - a for a, b in zip(values, values[1:])]
    return not steps or min(steps) > 0 and max(steps) - min(steps) <= 1e-3 * max(steps)


def cells(name, x, y, rows, edges, colours, hover=None):
    """Values [y][x] in the steps between the edges; below the first and above the last edge count too: a colour each. None where the
    grid is not even: its cells would lie in wrong places."""
    if not (_even(x) and _even(y)):
        return None
    steps = [f"below {edges[0]:g}"] + [f"{a:g} to {b:g}" for a, b in zip(edges, edges[1:])] + [f"above {edges[-1]:g}"]
    used = {bisect.bisect_right(edges, value) for row in rows for value in row if value is not None}
    return {"name": name, "x": shorts(x, 8), "y": shorts(y, 8), "rows": [shorts(row, 5) for row in rows], "edges": shorts(edges),
            "colours": colours, "steps": [step if i in used else None for i, step in enumerate(steps)],
            "hover": [[title, shorts(values)] for title, values in hover or []]}


def round_edges(values, count=10):
    """Round numbers that cut the span of most values into about count steps; at least one."""
    values = sorted(value for value in values if value is not None)
    if not values:
        return [0]
    low, high = values[int(0.01 * (len(values) - 1))], values[int(0.99 * (len(values) - 1))]
    if not high > low:
        return [low]
    power = 10 ** math.floor(math.log10((high - low) / count))
    step = next(power * factor for factor in (1, 2, 5, 10) if power * factor * count >= high - low)
    first = math.ceil(low / step)
    return [float(f"{step * i:.10g}") for i in range(first, max(math.floor(high / step), first) + 1)]


def chart(title, x, y, curves=(), grid=None, equal=False, note=None):
    """Curves without a value are left out; without any and without cells there is nothing to draw, which is None."""
    curves = [one for one in curves if any(value is not None for value in one["y"])]
    if not curves and not grid:
        return None
    found = {"title": title, "x": x, "y": y, "curves": curves}
    if grid:
        found["cells"] = grid
    if equal:
        found["equal"] = True
    if note:
        found["note"] = note
    return found


def wide(frequencies):
    """A wide band shows its low modes on a logarithmic axis."""
    return frequencies[0] > 0 and frequencies[-1] / frequencies[0] > 50
