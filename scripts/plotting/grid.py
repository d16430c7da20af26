"""Draws a grid of values as coloured cells; in a text picture as digits."""


def edges(values, ends):
    """Where the cell of each value begins and ends, cut off at the axis's ends; (None, None) outside of it. A single one fills it."""
    if len(values) == 1:
        return [tuple(ends)]
    middles = [(before + after) / 2 for before, after in zip(values, values[1:])]
    found = []
    for low, high in zip([values[0], *middles], [*middles, values[-1]]):
        low, high = (low if ends[0] is None else max(low, ends[0])), (high if ends[1] is None else min(high, ends[1]))
        found.append((low, high) if low < high else (None, None))
    return found


def raster(values, ends, most=400):
    """Centres of small cells that fill the axis between two ends as far as the values go, and the nearest value's index of each."""
    found = [edge for edge in edges(values, ends) if edge[0] is not None]
    if not found:
        return [], []
    low, high = found[0][0], found[-1][1]
    # Half a cell each where that is exact.
    halves, half = 2 * (len(values) - 1), (values[-1] - values[0]) / max(1, len(values) - 1) / 2
    exact = 0 < halves <= most and (low, high) == (values[0], values[-1]) and all(
        abs(value - values[0] - 2 * k * half) < 1e-6 * half for k, value in enumerate(values))
    count = halves if exact else most
    centres = [low + (high - low) * (k + 0.5) / count for k in range(count)]
    indices, at = [], 0
    for centre in centres:
        while at + 1 < len(values) and abs(values[at + 1] - centre) < abs(values[at] - centre):
            at += 1
        indices.append(at)
    return centres, indices


def cells(panel, xs, ys, grid, low, high, words):
    """A grid [y][x], null where nothing is. low and high: the ends of the digits 0 to 9 in a text picture, words what they mean (None: nothing)."""
    if panel.figure.text:
        _digits(panel, xs, ys, grid, low, high, words)
        return
    if panel.figure.form == "png":
        # An image whose cells end at the axes: gnuplot does not cut one off right, and single cells would show seams.
        (across, columns), (up, lines) = raster(xs, panel.x_range), raster(ys, panel.y_range)
        if across and up:
            panel.add([(x, y, grid[i][j]) for y, i in zip(up, lines) for x, j in zip(across, columns)], "image", using="1:2:3")
        return
    columns, lines = edges(xs, panel.x_range), edges(ys, panel.y_range)
    rows = [(xs[j], ys[i], left, right, bottom, top, value) for i, (bottom, top) in enumerate(lines) for j, (left, right) in enumerate(columns)
            if None not in (left, bottom, value := grid[i][j])]
    if rows:
        panel.add(rows, "boxxyerror fs solid noborder", "palette", using="1:2:3:4:5:6:7")


def _digits(panel, xs, ys, grid, low, high, words):
    found = {}
    for y, row in zip(ys, grid):
        for x, value in zip(xs, row):
            if value is not None:
                step = 0 if high <= low else min(9, max(0, int(10 * (value - low) / (high - low))))
                found.setdefault(step, []).append((x, y))
    for step, places in sorted(found.items()):
        title = words.format(low + (high - low) * (step + 0.5) / 10) if words and step in (min(found), max(found)) else None
        panel.add(places, "points", None, title, letter=str(step))


def ticks(ends, width):
    """A step of ticks whose numbers do not touch, on an axis of so many pixels."""
    span = ends[1] - ends[0]
    if span <= 0:
        return None
    return next((step * 10.0 ** power for power in range(-9, 12) for step in (1, 2, 5) if span / (step * 10.0 ** power) * 62 <= max(width, 62)), None)


def fitted(box, x_range, y_range):
    """The largest part of a box whose axes have one scale; the box for a line."""
    left, right, bottom, top = box
    across, up = (ends[1] - ends[0] for ends in (x_range, y_range))
    if across <= 0 or up <= 0 or right - left < 120 or top - bottom < 120:
        return box
    scale = min((right - left) / across, (top - bottom) / up)
    # A strip stays wide enough to be seen; then its axes have two scales.
    width, height = max(across * scale, 120), max(up * scale, 120)
    return left + (right - left - width) / 2, left + (right - left + width) / 2, top - height, top


def index_label(index):
    """Words for the score of an index, and the factor from its unit to the words'."""
    if index["unit"] != "um":
        return f"{index['name']} stiffness, N/µm", 1e-6
    return (f"{index['name']}, µm" if index["name"] == "deflection" else f"{index['name']} deflection, µm"), 1
