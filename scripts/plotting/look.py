"""How all pictures look: colours, fonts, the terminals of gnuplot."""

import math
import re
import shutil
import unicodedata

# Each lighter than the one before, so that they can be told apart in grey; with dashes and symbols for lines upon each other.
SERIES = ["#14213d", "#a8201a", "#23718c", "#c2761b", "#6fae5c", "#d99bb5"]
INK, GREY, PALE = "#1a1a1a", "#808080", "#a9bac8"
BLUE, RED, GREEN, BAND = "#1d4f91", "#b02418", "#1b6e3c", "#5a5a5a"

DASHES = ["1", "(10,4)", "(4,2.5)", "(10,3,2,3)", "(18,5)"]
POINTS = [7, 9, 5, 11, 13, 6, 8, 4, 10, 12]

FONT = "DejaVu Sans"
FONT_PX, SMALL_PX, LINE_PX = 14, 11, 19
# Widths of DejaVu Sans, of its size: most texts stay below.
CHARACTER = 0.6
# Pixels that gnuplot reckons for a character of its key.
KEY_CHARACTER = 9.4
PX_PER_INCH = 96
# gnuplot's points, dashes and lines of the key are not of one size in all forms.
POINT_SCALE = {"svg": 0.55, "png": 1, "pdf": 1}
DASH_SCALE = {"svg": 1, "png": 2, "pdf": 2}
KEY_SPACING = {"svg": 0.9, "png": 1.17, "pdf": 1.17}

# Light where stable, dark where not; dark where soft, light where stiff; from one sign over white to the other; round a circle.
STABILITY = "(0.9 '#f4f8fb', 0.9999 '#cfe3ee', 1.0 '#fbe3c4', 1.05 '#eda65a', 1.1 '#c4651f')"
PROBABILITY = "(0 '#c4651f', 0.5 '#fbe3c4', 0.95 '#e4eef5', 1 '#c3dceb')"
STIFFNESS = "(0 '#3b2a5c', 0.35 '#3f6f9c', 0.7 '#86c5a0', 1 '#fdf3c0')"
SIGNED = "(-1 '#3b6ea5', -0.3 '#b5cde4', 0 '#ffffff', 0.3 '#f3cda6', 1 '#b8621b')"
CYCLIC = "(-180 '#2b2118', -90 '#a8502a', 0 '#f7f1dc', 90 '#4c88a8', 180 '#2b2118')"


def series(index):
    """Colour, and dash and point type, of the index-th curve."""
    return SERIES[index % len(SERIES)], f"dt {DASHES[index % len(DASHES)]}", f"pt {POINTS[index % len(POINTS)]}"


def clean(text):
    """A text that can stand between quotes in gnuplot's commands: letters and digits of any script, harmless signs."""
    return "".join(c if unicodedata.category(c)[0] in "LNM" or c in " _.,:/^+*()=%|°±-" else "?" for c in text)


def plain(text):
    """The same for a terminal that may know ASCII only."""
    return text.replace("µ", "u").replace("²", "^2").replace("°", " deg").replace("±", "+-")


def number(value):
    """A number for gnuplot, as data: what is not one ends in an error here."""
    return "NaN" if value is None else repr(float(value))


def decades(low, high):
    """Ticks 1, 2, 5 of each decade, fewer over many decades, in gnuplot's words."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    steps = (1, 2, 5) if last - first <= 3 else (1,)
    return "(" + ", ".join(f"{step}e{power}" for power in range(first, last + 1) for step in steps) + ")"


def along(value, low, high, log):
    """Where a value lies on an axis: 0 at its low end, 1 at its high one."""
    return math.log(value / low) / math.log(high / low) if log else (value - low) / (high - low)


def text_width(text, px=FONT_PX):
    return CHARACTER * px * len(text)


def text_size(columns=None, rows=None):
    """Columns and rows of a picture in text."""
    columns = columns or shutil.get_terminal_size((100, 32)).columns
    return columns, rows or (40 if columns > 120 else 32)


def scaled(how, form):
    """A style of drawing with points and dashes as large as in the other forms."""
    def times(scale, numbers):
        return ",".join(f"{float(one) * scale:g}" for one in numbers.split(","))

    how = re.sub(r"(?<= ps )[0-9.]+", lambda found: times(POINT_SCALE[form], found[0]), how)
    return re.sub(r"(?<= dt \()[0-9.,]+", lambda found: times(DASH_SCALE[form], found[0]), how)


def terminal(form, width, height, colours=False):
    """The line that sets gnuplot's terminal; the size in pixels, of text in characters."""
    if form == "svg":
        return f"set terminal svg size {width},{height} font '{FONT},{FONT_PX}' background 'white'"
    # Points of 1/72 inch.
    points = FONT_PX * 72 / PX_PER_INCH
    if form == "png":
        return f"set terminal pngcairo size {width},{height} font '{FONT},{points:g}'"
    if form == "pdf":
        return (f"set terminal pdfcairo size {width / PX_PER_INCH:g}in,{height / PX_PER_INCH:g}in font '{FONT},{points:g}' "
                f"fontscale 0.75 linewidth 1.4 pointscale 0.7 background 'white'")
    return f"set terminal dumb {'ansi' if colours else 'mono'} size {width},{height} noenhanced"
