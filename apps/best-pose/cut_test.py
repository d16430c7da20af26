"""best-pose --cut: forces, frames, deflections, walls and offsets against what is computed here from the documents alone: teeth
and slices of their edges one by one, the table's transformations multiplied out, C F from the stiffness.
"""

import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

from jsonschema import Draft202012Validator

SOURCE = pathlib.Path(os.environ["SOURCE"])
sys.path.insert(0, str(SOURCE / "apps"))
sys.dont_write_bytecode = True
from testing import check, finish, product  # noqa: E402
ROBOT = json.loads((SOURCE / "testdata/kr360.json").read_text())
STIFFNESS = json.loads((SOURCE / "testdata/yanshan-poses.json").read_text())["k_theta_2d_n_m_per_rad"]
SCHEMAS = {kind: Draft202012Validator(json.loads((SOURCE / f"schemas/{kind}.schema.json").read_text()))
           for kind in ("pose", "pose-path")}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a, b, scale=1.0):
    return [x + scale * y for x, y in zip(a, b)]


def unit(a):
    size = math.sqrt(dot(a, a))
    return [x / size for x in a]


def frame(rotation, translation_mm):
    return [list(rotation[i]) + [translation_mm[i] * 1e-3] for i in range(3)] + [[0, 0, 0, 1]]


def pose_of(robot, angles_deg):
    """Tool frame and the compliance C = sum v v^T / k of its origin, m/N."""
    now, axes = frame([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0]), []
    for joint, angle in zip(robot["joints"], angles_deg):
        alpha = math.radians(joint["alpha_deg"])
        theta = math.radians(joint["theta_sign"] * angle + joint["theta_offset_deg"])
        ca, sa, ct, st = math.cos(alpha), math.sin(alpha), math.cos(theta), math.sin(theta)
        d = joint["d_mm"]
        now = product(now, frame([[ct, -st, 0], [st * ca, ct * ca, -sa], [st * sa, ct * sa, ca]],
                               [joint["a_mm"], -d * sa, d * ca]))
        axes.append(([now[i][2] for i in range(3)], [now[i][3] for i in range(3)]))
    for part in ("flange", "tool"):
        now = product(now, frame(robot[part]["rotation"], robot[part]["translation_mm"]))
    point = [now[i][3] for i in range(3)]
    compliance = [[0.0] * 3 for _ in range(3)]
    for (axis, at), k in zip(axes, STIFFNESS):
        v = cross(axis, plus(point, at, -1))
        for i in range(3):
            for j in range(3):
                compliance[i][j] += v[i] * v[j] / k
    return now, compliance


def force_at(cut, depth_mm, turn, slices):
    """On the tool, N: feed, normal (left of it, seen from the spindle), from the tip to the spindle."""
    helix = math.tan(math.radians(cut.get("helix_deg", 0)))
    sum_ = [0.0, 0.0, 0.0]
    for k in range(slices):
        height = depth_mm * (k + 0.5) / slices
        for tooth in range(cut["teeth"]):
            phi = (turn - 2 * height * helix / cut["diameter_mm"] - 2 * math.pi * tooth / cut["teeth"]) % (2 * math.pi)
            if not math.radians(cut["entry_deg"]) <= phi <= math.radians(cut["exit_deg"]):
                continue
            chip = cut["feed_per_tooth_mm"] * math.sin(phi)
            along = (cut["kt_n_per_mm2"] * chip + cut["kte_n_per_mm"]) * depth_mm / slices
            across = (cut["kr_n_per_mm2"] * chip + cut["kre_n_per_mm"]) * depth_mm / slices
            # A tooth at (sin, cos) runs clockwise, along (cos, -sin): the cut holds it back and pushes it off.
            sum_ = plus(sum_, [-math.cos(phi) * along - math.sin(phi) * across,
                               math.sin(phi) * along - math.cos(phi) * across,
                               (cut["ka_n_per_mm2"] * chip + cut["kae_n_per_mm"]) * depth_mm / slices])
    return sum_


def cut_frame(feed, tool_axis):
    z = [-a for a in tool_axis]
    x = unit(plus(feed, z, -dot(feed, z)))
    return [x, cross(z, x), z]


def moved_by(compliance, axes, force):
    """The deflection along the cut's axes, um."""
    in_base = [sum(force[k] * axes[k][i] for k in range(3)) for i in range(3)]
    displacement = [dot(row, in_base) * 1e6 for row in compliance]
    return [dot(axis, displacement) for axis in axes]


def run(*arguments):
    result = subprocess.run(["best-pose", "--quiet", *map(str, arguments)], capture_output=True, text=True, check=False)
    check(" ".join(map(str, arguments)), result.returncode == 0, result.stderr)
    return json.loads(result.stdout) if result.returncode == 0 else None


def write(path, document):
    path.write_text(json.dumps(document))
    return path


def random_cut(draw, helical):
    entry, exit_ = draw.choice([(0, draw.uniform(30, 150)), (draw.uniform(30, 150), 180), (0, 180), (20, 160)])
    cut = {"format": "stablecut/cut/1", "teeth": draw.randint(1, 5), "kt_n_per_mm2": draw.uniform(500, 2500),
           "kr_n_per_mm2": draw.uniform(100, 1200), "ka_n_per_mm2": draw.uniform(0, 400), "kte_n_per_mm": draw.uniform(0, 20),
           "kre_n_per_mm": draw.uniform(0, 20), "kae_n_per_mm": draw.uniform(0, 5), "entry_deg": entry, "exit_deg": exit_,
           "diameter_mm": draw.uniform(6, 40), "feed_per_tooth_mm": draw.uniform(0.03, 0.3)}
    if helical:
        cut["helix_deg"] = draw.choice([-20, 30, 45])
    return cut


def check_pose(name, pose, cut, depth, feed, robot, slices):
    """Fields of one pose; returns its compliance and the cut's axes."""
    tool, compliance = pose_of(robot, pose["joints_deg"])
    axes = cut_frame(feed, [tool[i][2] for i in range(3)])
    found = pose["cut"]
    for key, axis in (("feed", axes[0]), ("normal", axes[1])):
        check(f"{name}: {key}", max(abs(a - b) for a, b in zip(found[key], axis)) < 1e-9, found[key])
    turns = 1440
    forces = [force_at(cut, depth, 2 * math.pi * (i + 0.5) / turns, slices) for i in range(turns)]
    mean = [sum(f[k] for f in forces) / turns for k in range(3)]
    moves = [moved_by(compliance, axes, f) for f in forces]
    size = max(math.sqrt(dot(m, m)) for m in moves)
    for k, move in enumerate(moved_by(compliance, axes, mean)):
        check(f"{name}: mean {k}", abs(found["mean_um"][k] - move) < 3e-3 * size, (found["mean_um"], move))
        largest = max(abs(m[k]) for m in moves)
        check(f"{name}: largest {k}", abs(found["largest_um"][k] - largest) < 5e-3 * size, (found["largest_um"], largest))
    check(f"{name}: score", abs(pose["score"] / found["largest_um"][1] - 1) < 1e-9, pose["score"])
    sides = [s for s, there in (("left", cut["entry_deg"] == 0), ("right", cut["exit_deg"] == 180)) if there]
    check(f"{name}: walls", [w["side"] for w in found["walls"]] == sides, found["walls"])
    lag = 2 * depth * math.tan(math.radians(cut.get("helix_deg", 0))) / cut["diameter_mm"]
    for wall in found["walls"]:
        # A wall left of the feed is cut deeper, and less is left, where the tool stands farther to the left.
        left = wall["side"] == "left"
        sense, at, inside = (-1, 0, 1e-6) if left else (1, math.pi, -1e-6)
        check(f"{name}: wall's mean", wall["mean_error_um"] == sense * found["mean_um"][1], wall)
        errors = [sense * moved_by(compliance, axes, force_at(cut, depth, at + inside + lag * i / 60, slices))[1]
                  for i in range(61 if lag else 1)]
        # Where two errors of either sign tie, rounding decides which one it is.
        extremes = [e for e in (max(errors), min(errors)) if abs(e) > max(map(abs, errors)) - 1.5e-2 * size]
        check(f"{name}: wall {wall['side']}", any(abs(wall["error_um"] - e) < 1.5e-2 * size for e in extremes),
              (wall["error_um"], extremes))
    return compliance, axes


def evaluations(folder, draw):
    stiffness = write(folder / "k.json", {"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": STIFFNESS})
    offset = json.loads(json.dumps(ROBOT))
    offset["tool"]["translation_mm"] = [120, -30, 180]
    c, s = math.cos(0.6), math.sin(0.6)
    offset["tool"]["rotation"] = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    for n in range(8):
        helical, robot = n % 2 == 1, offset if n % 3 == 0 else ROBOT
        cut, depth = random_cut(draw, helical), draw.uniform(0.5, 5)
        poses = [[draw.uniform(*r) for r in ((-90, 90), (-110, -30), (20, 120), (-60, 60), (-80, 80), (-90, 90))] for _ in range(3)]
        feed = [draw.uniform(-1, 1) for _ in range(3)]
        document = run("--robot", write(folder / "r.json", robot), "--evaluate",
                       write(folder / "p.json", {"format": "stablecut/pose-list/1", "poses": [{"joints_deg": p} for p in poses]}),
                       "--cut", write(folder / "c.json", cut), "--cut-depth", depth, "--feed=" + ",".join(map(str, feed)), stiffness)
        SCHEMAS["pose"].validate(document)
        for k, pose in enumerate(document["evaluated"]):
            check_pose(f"cut {n}, pose {k}", pose, cut, depth, feed, robot, 60 if helical else 1)


def path(folder):
    """A circle of 100 mm seen from above, counter-clockwise, with its inside milled: down, so that the wall is on the right."""
    stiffness = write(folder / "k.json", {"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": STIFFNESS})
    cut = random_cut(random.Random(4), False) | {"entry_deg": 120, "exit_deg": 180}
    c, s = math.cos(0.5), math.sin(0.5)
    workpiece = {"translation_mm": [1900, 300, 900], "rotation": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}
    points = [{"position_mm": [100 * math.cos(a), 100 * math.sin(a), 0], "axis": [0, 0, -1], "feed": [-math.sin(a), math.cos(a), 0]}
              for a in (2 * math.pi * i / 36 for i in range(37))]
    document = run("--robot", SOURCE / "testdata/kr360.json", "--path",
                   write(folder / "t.json", {"format": "stablecut/tool-path/1", "speed_mm_per_s": 20, "frame": workpiece,
                                             "points": points}),
                   "--cut", write(folder / "c.json", cut), "--cut-depth", 2, "--offsets", folder / "offsets.csv", stiffness)
    SCHEMAS["pose-path"].validate(document)
    check("path: surface is the index", document["index"] == {"name": "surface", "unit": "um"}, document["index"])
    mean = [0.0] * 3
    for i in range(1440):
        mean = plus(mean, force_at(cut, 2, 2 * math.pi * (i + 0.5) / 1440, 1), 1 / 1440)
    with open(folder / "offsets.csv", newline="", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    check("path: a row for each point", [row["point"] for row in rows] == list(range(37)), len(rows))
    for row, point, pose in zip(rows, points, document["points"]):
        name = f"point {pose['point']}"
        rotate = [[c, -s, 0], [s, c, 0], [0, 0, 1]]
        feed = [dot(r, point["feed"]) for r in rotate]
        compliance, axes = check_pose(name, pose, cut, 2, feed, ROBOT, 1)
        offset = [row[f"offset_{k}_mm"] for k in "xyz"]
        check(f"{name}: offset", max(abs(a - b) for a, b in zip(offset, pose["offset_mm"])) < 1e-6, offset)
        check(f"{name}: normal", abs(row["offset_normal_mm"] - dot(axes[1], offset)) < 2e-6
              and abs(row["offset_normal_mm"] - pose["offset_normal_mm"]) < 1e-6, row)
        check(f"{name}: along the feed and the axis", abs(row["offset_feed_mm"] - dot(axes[0], offset)) < 2e-6
              and abs(row["offset_axial_mm"] - dot(axes[2], offset)) < 2e-6, row)
        # The pose's own compliance is off by its share of a metre.
        cancelled = [o + d * 1e-3 for o, d in zip(offset, pose["displacement_um"])]
        check(f"{name}: it cancels the deflection", math.sqrt(dot(cancelled, cancelled)) < 1e-3 * math.sqrt(dot(offset, offset)), cancelled)
        base = [row[f"base_{k}_mm"] for k in "xyz"]
        expected = plus(plus([dot(r, point["position_mm"]) for r in rotate], workpiece["translation_mm"]), offset)
        check(f"{name}: corrected point", max(abs(a - b) for a, b in zip(base, expected)) < 3e-6, base)
        back = [dot([r[k] for r in rotate], plus(base, workpiece["translation_mm"], -1)) for k in range(3)]
        check(f"{name}: in the workpiece's frame", max(abs(row[f"{k}_mm"] - b) for k, b in zip("xyz", back)) < 3e-6, row)
    check("path: the deflections are worth cancelling", max(p["deflection_um"] for p in document["points"]) > 20)


with tempfile.TemporaryDirectory() as name_:
    evaluations(pathlib.Path(name_), random.Random(3))
    path(pathlib.Path(name_))
finish()
