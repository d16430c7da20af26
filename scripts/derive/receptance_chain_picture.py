#!/usr/bin/python3
"""receptance_chain_picture.py [FILE]: lib/receptance/chain.svg, the parts of an assembly and the names of their ends."""
from pictures import output_path

INK, STEEL, CARBIDE, GREY, RED, BLUE = "#222222", "#d9dde3", "#c3cbd6", "#777777", "#c0392b", "#1f5fa8"
AXIS = 150  # height of the tool's axis
shapes = []


def line(x1, y1, x2, y2, colour=INK, width=1.5, extra=""):
    shapes.append(f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" stroke="{colour}" stroke-width="{width}" {extra}/>')


def arrow(x1, y1, x2, y2, colour):
    line(x1, y1, x2, y2, colour, 2, 'marker-end="url(#head)"')


def text(x, y, words, colour=INK, size=14, anchor="middle"):
    shapes.append(f'<text x="{x}" y="{y}" fill="{colour}" font-size="{size}" text-anchor="{anchor}">{words}</text>')


def segment(x, width, height, colour):
    shapes.append(f'<rect x="{x}" y="{AXIS - height / 2}" width="{width}" height="{height}" fill="{colour}" stroke="{INK}"/>')


def spring(x1, x2, y):
    step = (x2 - x1 - 16) / 6
    points = [(x1, y), (x1 + 8, y)] + [(x1 + 8 + step * (i + 0.5), y + (8 if i % 2 else -8)) for i in range(6)]
    points += [(x2 - 8, y), (x2, y)]
    path = " ".join(f"{x:.1f},{v}" for x, v in points)
    shapes.append(f'<polyline points="{path}" fill="none" stroke="{RED}" stroke-width="1.8"/>')


def damper(x1, x2, y):
    middle = (x1 + x2) / 2
    line(x1, y, middle - 2, y, RED, 1.8)
    line(middle - 2, y - 6, middle - 2, y + 6, RED, 1.8)
    shapes.append(f'<polyline points="{middle - 10},{y - 8} {middle + 6},{y - 8} {middle + 6},{y + 8} {middle - 10},{y + 8}" '
                  f'fill="none" stroke="{RED}" stroke-width="1.8"/>')
    line(middle + 6, y, x2, y, RED, 1.8)


# Tool: three segments from the tip; joint; holder: two segments; what stands behind them.
segment(60, 110, 30, CARBIDE)
segment(170, 70, 24, CARBIDE)
segment(240, 90, 40, CARBIDE)
for x in (330, 420):
    line(x, AXIS - 50, x, AXIS + 50, INK, 2.5)
spring(330, 420, AXIS - 36)
damper(330, 420, AXIS - 12)
spring(330, 420, AXIS + 14)
damper(330, 420, AXIS + 36)
text(375, AXIS - 58, "k1, c1: deflection", RED, 13)
text(375, AXIS + 68, "k2, c2: slope", RED, 13)
segment(420, 80, 90, STEEL)
segment(500, 90, 120, STEEL)
for y in range(AXIS - 66, AXIS + 67, 12):
    line(590, y + 10, 604, y - 4, GREY, 1)
line(590, AXIS - 70, 590, AXIS + 70, INK, 2.5)
text(612, AXIS - 28, "fixed, free, or a spindle:", GREY, 13, "start")
text(612, AXIS - 10, "its receptances, or", GREY, 13, "start")
text(612, AXIS + 8, "its modes", GREY, 13, "start")
line(20, AXIS, 605, AXIS, GREY, 1, 'stroke-dasharray="10 4 2 4"')

arrow(60, AXIS - 75, 60, AXIS - 19, BLUE)
text(60, AXIS - 82, "force f, deflection h f", BLUE, 13)
text(60, AXIS + 42, "end 1", INK, 13)
text(60, AXIS + 58, "the tip", GREY, 12)
text(306, AXIS + 42, "end 2", INK, 13)
text(424, AXIS + 84, "face of the holder", GREY, 12, "start")
arrow(330, 250, 70, 250, INK)
text(200, 243, "s", INK, 15)
text(200, 270, "slope = d(deflection)/ds", INK, 13)
text(195, 300, "tool: R11, R12, R21, R22 (free at both ends)", INK, 13)
text(375, 266, "joint: Kc", RED, 13)
text(375, 282, "opening g", RED, 13)
text(510, 300, "holder: H (at its face)", INK, 13)

output_path("lib/receptance/chain.svg").write_text(f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="-20 40 790 275" width="790" height="275" font-family="Helvetica, Arial, sans-serif">
<defs><marker id="head" markerWidth="9" markerHeight="8" refX="7" refY="4" orient="auto"><path d="M0,0 L9,4 L0,8 z" fill="{INK}"/></marker></defs>
<rect x="-20" y="40" width="790" height="275" fill="white"/>
""" + "\n".join(shapes) + "\n</svg>\n")
