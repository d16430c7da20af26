"""A picture of panels, for gnuplot to draw. Numbers reach it as data, texts between quotes and without signs that end them."""

import math
import os
import re
import subprocess
import sys
import tempfile

from reporting.command import fail, misuse, write_whole

from . import look
from .look import clean, number


def span(low, high):
    """A range in gnuplot's words; one that is none is left to gnuplot."""
    if low is not None and low == high:
        low = high = None
    return f"[{'*' if low is None else number(low)}:{'*' if high is None else number(high)}]"


class Panel:
    """Axes with what is drawn on them, in a box (left, right, bottom, top) in pixels from the picture's lower left corner."""

    def __init__(self, figure, box, title="", in_text=True):
        self.figure, self.box, self.title, self.in_text = figure, box, title, in_text
        self.settings, self.elements, self.texts = [], [], []
        self.x_range = self.y_range = (None, None)
        # What the axes are; and how far from the axis y, in pixels, since its numbers stand between.
        self.labels, self.label_gap = {}, 84

    def set(self, *lines):
        self.settings += lines

    def axis(self, name, label=None, low=None, high=None, log=False, ticks=None, format=None):
        """Sets the axis x, y, y2 or cb."""
        if name in ("x", "y"):
            setattr(self, f"{name}_range", (low, high))
        self.set(f"set {name}range {span(low, high)}")
        if label:
            self.labels[name] = label
        if log:
            self.set(f"set logscale {name}")
        if ticks is not None:
            self.set(f"set {name}tics {ticks}")
        if format is not None:
            self.set(f"set format {name} '{format}'")

    def add(self, rows, how, colour=None, title=None, using="1:2", letter=None, axes=None):
        """Rows of numbers, an empty one for a gap, drawn "with how"; in a text picture by a letter, "line", or not at all.

        Points outside of the axes are left out, so that the key does not speak of what is not there.
        """
        if how.startswith("points"):
            rows = [row for row in rows if row and self._shown(row)]
            if not rows:
                return
        self.draw(self.figure.data(rows), how, colour, title, using, letter, axes)

    def _shown(self, row):
        return all(value is None or (low is None or low <= value) and (high is None or value <= high)
                   for value, (low, high) in zip(row, (self.x_range, self.y_range)) if low != high)

    def draw(self, data, how, colour=None, title=None, using="1:2", letter=None, axes=None):
        if self.figure.text:
            if letter is None:
                return
            how = "lines" if letter == "line" else f"points pt '{letter}'"
        else:
            how = look.scaled(how, self.figure.form)
        paint = f" lc {colour if colour == 'palette' else f'rgb {chr(39)}{colour}{chr(39)}'}" if colour else ""
        self.elements.append((f"{data} using {using}{f' axes {axes}' if axes else ''} with {how}{paint}", f"with {how}{paint}", title))

    def explain(self, how, colour, title, letter):
        """An entry of the key for what is drawn otherwise."""
        how = f"points pt '{letter}'" if self.figure.text else f"{look.scaled(how, self.figure.form)} lc rgb '{colour}'"
        self.elements.append((None, f"with {how}", title))

    def label(self, text, at, colour=look.INK, align="center", px=look.FONT_PX):
        """A text at a place in gnuplot's words."""
        self.texts.append(f"set label '{self.figure.said(text)}' at {at} {align} front noenhanced textcolor rgb '{colour}'{self.figure.font(px)}")

    def colours(self, palette, label, low=None, high=None, ticks=None):
        """The scale of colours, at the right of the panel."""
        left, right, bottom, top = self.box
        width, height = self.figure.width, self.figure.height
        self.set(f"set palette defined {palette}",
                 f"set colorbox user origin screen {(right + 14) / width:.4f},{bottom / height:.4f} "
                 f"size screen {16 / width:.4f},{(top - bottom) / height:.4f}")
        self.axis("cb", label, low, high, ticks=ticks)

    def shape(self):
        """Pixels between the axes, and pixels per unit; None where an end is left to gnuplot."""
        left, right, bottom, top = self.box
        scale = [None if None in ends or ends[0] == ends[1] else size / (ends[1] - ends[0])
                 for ends, size in ((self.x_range, right - left), (self.y_range, top - bottom))]
        return right - left, top - bottom, *(one if one is not None and math.isfinite(one) else None for one in scale)

    def _axis_labels(self):
        """At fixed distances: gnuplot's own depend on how wide it takes the numbers to be, which differs between forms."""
        if self.figure.text:
            return [f"set {name}label '{self.figure.said(label)}' noenhanced" for name, label in self.labels.items()]
        left, right, bottom, _ = self.box
        width, height = self.figure.width, self.figure.height
        places = {"x": f"graph 0.5, screen {(bottom - 49) / height:.4f} center", "y": f"screen {(left - self.label_gap) / width:.4f}, graph 0.5 center rotate",
                  "y2": f"screen {(right + 74) / width:.4f}, graph 0.5 center rotate", "cb": f"screen {(right + 100) / width:.4f}, graph 0.5 center rotate"}
        return [f"set label '{self.figure.said(label)}' at {places[name]} noenhanced{self.figure.font(self._fitting(name, label))}"
                for name, label in self.labels.items()]

    def _fitting(self, name, label):
        """The size of text with which a label is no longer than its axis and a little."""
        left, right, bottom, top = self.box
        length = (right - left if name == "x" else top - bottom) + 40
        return max(8, min(look.FONT_PX, length / look.text_width(label, 1)))

    def commands(self, key):
        """Its lines of gnuplot; key: the lines that set the key, or nothing, and what stands in it for other panels."""
        left, right, bottom, top = self.box
        width, height = self.figure.width, self.figure.height
        lines = ["reset", "set encoding utf8", "set border lw 1", "set tics out nomirror", "unset colorbox", "unset key"]
        if not self.figure.text:
            lines += [f"set lmargin at screen {left / width:.4f}; set rmargin at screen {right / width:.4f}",
                      f"set bmargin at screen {bottom / height:.4f}; set tmargin at screen {top / height:.4f}"]
        if self.title:
            # Over the panel and half of what lies beside it; smaller where that is not enough.
            fits = (right - left + 180) / look.text_width(self.title, 1)
            lines.append(f"set title '{self.figure.said(self.title)}' noenhanced offset 0,-0.3{self.figure.font(max(8, min(look.FONT_PX, fits)))}")
        said, plots = set(), []
        for drawn, how, title in self.elements:
            if drawn or key:
                plots.append(f"{drawn or f'keyentry {how}'} {self.figure.titled(title if title not in said else None, key)}")
            said.add(title)
        if key:
            lines += key[0]
            plots += [f"keyentry {how} {self.figure.titled(title, key)}" for how, title in key[1]]
        return [*lines, *self.settings, *self._axis_labels(), *self.texts, "plot " + ", ".join(plots or ["NaN notitle"])]


class Figure:
    """What is drawn, and where it goes. The form is svg, png, pdf or dumb."""

    def __init__(self, options, width, height, title=""):
        self.output, self.form = options["output"] or "-", options["form"]
        self.text = self.form == "dumb"
        given = options["size"]
        self.width, self.height = look.text_size(*(given or ())) if self.text else given or (width, height)
        self.title = options["title"] if options["title"] is not None else title
        self.head = 34 if self.title else 14
        # Pixels at the bottom that the key takes.
        self.foot = 4
        self.panels, self.blocks = [], []

    def compose(self, build):
        """Calls build until it has found the room that its key takes, which depends on what it draws."""
        for _ in range(3):
            foot = self.foot
            self.panels, self.blocks = [], []
            build()
            rows = self.key_rows(title for panel in self.panels for _, _, title in panel.elements)
            self.foot = rows * look.LINE_PX + 24 if rows else 4
            if self.foot == foot:
                return

    def said(self, text):
        return clean(look.plain(text) if self.text else text)

    def font(self, px):
        """The words that set a size of text."""
        return "" if self.text else f" font '{look.FONT},{px if self.form == 'svg' else px * 72 / look.PX_PER_INCH:.4g}'"

    def titled(self, title, key):
        return f"title '{self.said(title)}'" if title and key else "notitle"

    def data(self, rows):
        """The name of a block of data: rows of numbers, an empty row for a gap."""
        name = f"$d{len(self.blocks)}"
        self.blocks.append("\n".join([f"{name} << END", *(" ".join(map(number, row)) for row in rows), "END"]))
        return name

    def panel(self, box, title="", in_text=True):
        self.panels.append(Panel(self, box, title, in_text))
        return self.panels[-1]

    def key_rows(self, titles):
        """Rows that the key needs with all its titles."""
        unique = list(dict.fromkeys(title for title in titles if title))
        if not unique:
            return 0
        longest = max(map(len, unique))
        across = max(1, int((self.width - 10) / (longest + 12) if self.text else (self.width - 40) / (look.KEY_CHARACTER * longest + 90)))
        return math.ceil(len(unique) / across)

    def _key(self):
        """For the first panel: the key of the whole picture."""
        entries = {}
        for panel in self.panels:
            for _, how, title in panel.elements:
                if title and title not in entries:
                    entries[title] = (panel, how)
        if not entries:
            return None
        others = [(how, title) for title, (panel, how) in entries.items() if panel is not self.panels[0]]
        lines = [f"set key at screen 0.5,{6 / self.height:.4f} center bottom vertical maxrows {self.key_rows(entries)} "
                 f"samplen 3 spacing {look.KEY_SPACING[self.form]} Left reverse noenhanced"]
        return lines, others

    def commands(self):
        colours = self.output == "-" and sys.stdout.isatty() and not os.environ.get("NO_COLOR")
        lines = [look.terminal(self.form, self.width, self.height, colours), *self.blocks]
        if self.text:
            for panel in self.panels:
                if panel.in_text:
                    panel.title = ": ".join(text for text in (self.title if panel is self.panels[0] else "", panel.title) if text)
                    rows = self.key_rows(title for _, _, title in panel.elements)
                    lines += panel.commands(([f"set key bmargin center bottom horizontal noenhanced", f"set bmargin {rows + 4}"], []))
            return lines
        lines.append("set multiplot")
        key = self._key()
        for panel in self.panels:
            if panel is self.panels[0]:
                panel.texts.append(f"set label '{self.said(self.title)}' at screen 0.5,{1 - 17 / self.height:.4f} center noenhanced"
                                   + self.font(max(8, min(look.FONT_PX, (self.width - 20) / look.text_width(self.title or "-", 1)))))
            lines += panel.commands(key if panel is self.panels[0] else None)
        return [*lines, "unset multiplot"]

    def draw(self):
        """Draws it, whole or not at all, the same bytes from the same document. Ends the program where a panel has no room."""
        if not self.text and any(right - left < 40 or top - bottom < 25 for left, right, bottom, top in (panel.box for panel in self.panels)):
            misuse(f"--size: {self.width}:{self.height}: expected more, for {len(self.panels)} panel{'s' if len(self.panels) > 1 else ''} and the key")
        with tempfile.TemporaryDirectory() as scratch:
            # -d: without the user's own start-up file.
            run = subprocess.run(["gnuplot", "-d", "-"], input="\n".join([*self.commands(), ""]).encode(), capture_output=True, cwd=scratch,
                                 check=False)
        if run.returncode != 0 or not run.stdout:
            words = [line.strip() for line in run.stderr.decode(errors="replace").splitlines() if line.strip(" ^")]
            fail(f"gnuplot failed: {words[-1] if words else 'no picture'}", 70)
        picture = run.stdout
        if self.form == "pdf":
            # Cairo writes the time into it.
            picture = re.sub(rb"(?<=/CreationDate \(D:)[0-9]{14}", b"19700101000000", picture)
        elif self.text:
            picture = picture.replace(b"\f", b"")
        write_whole(self.output, picture)


def contours(xs, ys, grid, levels):
    """Lines of equal value of a grid [y][x] with gaps: (value, points) each."""
    rows = [row for i, y in enumerate(ys) for row in [*((x, y, grid[i][j]) for j, x in enumerate(xs)), ()]]
    lines = ["\n".join(["$grid << END", *(" ".join(map(number, row)) for row in rows), "END"]), "set contour base", "unset surface",
             f"set cntrparam levels auto {int(levels)}", "set table 'lines'", "splot $grid using 1:2:3 with lines"]
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run(["gnuplot", "-d", "-"], input="\n".join([*lines, ""]).encode(), capture_output=True, cwd=scratch, check=False)
        try:
            with open(os.path.join(scratch, "lines"), encoding="ascii") as file:
                blocks = file.read().split("\n\n")
        except OSError:
            return []
    found = []
    for block in blocks:
        points = [tuple(map(float, words)) for words in (line.split() for line in block.splitlines() if not line.startswith("#"))
                  if len(words) == 3]
        if len(points) > 1:
            found.append((points[0][2], [(x, y) for x, y, _ in points]))
    return found
