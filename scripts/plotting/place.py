"""Finds places for numbers: inside the panel, and on nothing else."""


class Places:
    """What is taken of a panel of width x height pixels."""

    def __init__(self, width, height):
        self.width, self.height, self.taken = width, height, []

    def take(self, x, y, width, height):
        """A rectangle by its centre."""
        self.taken.append((x - width / 2, x + width / 2, y - height / 2, y + height / 2))

    def take_line(self, points, thickness=6):
        """A line through points; None for a gap."""
        for before, after in zip(points, points[1:]):
            if before is None or after is None:
                continue
            steps = max(1, int(max(abs(after[0] - before[0]), abs(after[1] - before[1])) / thickness))
            for k in range(steps + 1):
                self.take(before[0] + (after[0] - before[0]) * k / steps, before[1] + (after[1] - before[1]) * k / steps,
                          thickness, thickness)

    def inside(self, x, y, width, height):
        # What lies on the edge is inside, whatever rounding made of it.
        edge = 1e-6
        return (-edge <= x - width / 2 and x + width / 2 <= self.width + edge and
                -edge <= y - height / 2 and y + height / 2 <= self.height + edge)

    def free(self, x, y, width, height):
        return self.inside(x, y, width, height) and not any(
            x - width / 2 < right and left < x + width / 2 and y - height / 2 < top and bottom < y + height / 2
            for left, right, bottom, top in self.taken)

    def find(self, candidates, width, height):
        """The first free place of a rectangle among centres, which is taken then; None where there is none."""
        for x, y in candidates:
            if self.free(x, y, width, height):
                self.take(x, y, width, height)
                return x, y
        return None


def around(x, y, width, height, gap=7):
    """Centres of a rectangle round a mark, near ones first."""
    for ring in (1, 1.8, 2.8, 4):
        across, up = width / 2 + gap * ring, height / 2 + gap * ring
        for dx, dy in ((across, up), (across, 0), (0, up), (-across, up), (-across, 0), (across, -up), (0, -up), (-across, -up)):
            yield x + dx, y + dy
