"""Draws a grid of values as coloured cells; in a text picture as digits."""


def even(values):
    """Indices into values that step evenly along them: all of them where they do already."""
    least, span = min(b - a for a, b in zip(values, values[1:])), values[-1] - values[0]
    if span <= least * (len(values) - 1) * (1 + 1e-6):
        return values, list(range(len(values)))
    count = min(1000, round(span / least) + 1)
    steps = [values[0] + span * k / (count - 1) for k in range(count)]
    return steps, [min(range(len(values)), key=lambda i: abs(values[i] - step)) for step in steps]


def cells(panel, xs, ys, grid, low, high, words=None):
    """A grid [y][x], null where nothing is. low and high: the ends of the digits 0 to 9 in a text picture, words what they mean."""
    if panel.figure.text:
        _digits(panel, xs, ys, grid, low, high, words or "{:.3g}")
        return
    if len(xs) < 2 or len(ys) < 2:
        panel.add([(x, y, grid[i][j]) for i, y in enumerate(ys) for j, x in enumerate(xs)], "points pt 5 ps 1.4", "palette", using="1:2:3")
        return
    (across, columns), (up, lines) = even(xs), even(ys)
    # The cells of an SVG are drawn one by one, since an image would not be clipped; those of a PNG would show seams.
    panel.add([(x, y, grid[i][j]) for y, i in zip(up, lines) for x, j in zip(across, columns)],
              "image" if panel.figure.form == "png" else "image pixels", using="1:2:3")


def _digits(panel, xs, ys, grid, low, high, words):
    found = {}
    for y, row in zip(ys, grid):
        for x, value in zip(xs, row):
            if value is not None:
                step = 0 if high <= low else min(9, max(0, int(10 * (value - low) / (high - low))))
                found.setdefault(step, []).append((x, y))
    for step, places in sorted(found.items()):
        title = words.format(low + (high - low) * (step + 0.5) / 10) if step in (min(found), max(found)) else None
        panel.add(places, "points", None, title, letter=str(step))


def ticks(ends, width):
    """A step of ticks whose numbers do not touch, on an axis of so many pixels."""
    span = ends[1] - ends[0]
    if span <= 0:
        return None
    return next(step * 10.0 ** power for power in range(-9, 12) for step in (1, 2, 5) if span / (step * 10.0 ** power) * 62 <= max(width, 62))


def fitted(box, x_range, y_range):
    """The largest part of a box whose axes have one scale; the box for a line."""
    left, right, bottom, top = box
    across, up = (ends[1] - ends[0] for ends in (x_range, y_range))
    if across <= 0 or up <= 0 or right - left < 60 or top - bottom < 60:
        return box
    scale = min((right - left) / across, (top - bottom) / up)
    # A strip stays wide enough to be seen; then its axes have two scales.
    width, height = max(across * scale, 60), max(up * scale, 60)
    return left + (right - left - width) / 2, left + (right - left + width) / 2, top - height, top


def index_label(index):
    """Words for the score of an index, and the factor from its unit to the words'."""
    if index["unit"] != "um":
        return f"{index['name']} stiffness, N/µm", 1e-6
    return (f"{index['name']}, µm" if index["name"] == "deflection" else f"{index['name']} deflection, µm"), 1
