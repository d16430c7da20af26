"""Sections of the page: joints, poses, maps, paths, and every other kind as tables."""

import math

from . import charts
from .charts import axis, chart, curve
from .kinds import section, table


def joint_stiffness(document):
    content = document.content
    values = content["stiffness_n_m_per_rad"]
    names = content.get("joints", [f"A{i}" for i in range(1, len(values) + 1)])
    intervals = content.get("interval_95_n_m_per_rad") or [None] * len(values)
    deviations = content.get("std_n_m_per_rad") or [None] * len(values)
    rows = []
    for name, value, interval, deviation in zip(names, values, intervals, deviations):
        low, high = interval or (None, None)
        rows.append([name, "not identifiable" if value is None else value, deviation, low, high])
    facts = [(name, content[key]) for key, name in (("rank", "rank"), ("condition_number", "condition number"), ("residual_rms_um", "residual, um RMS"))
             if key in content]
    return section(f"Joint stiffness: {document.label}", facts, (),
                   [table("Joints, N m/rad", ["joint", "stiffness", "deviation", "95 % from", "to"], rows)])


_JOINT = (("k1_n_per_m", "k1, N/m"), ("c1_n_s_per_m", "c1, N s/m"), ("k2_n_m_per_rad", "k2, N m/rad"), ("c2_n_m_s_per_rad", "c2, N m s/rad"))


def tool_joint(document):
    content = document.content
    directions = {name: content[name] for name in ("x", "y") if name in content} or {content.get("direction", ""): content}
    rows, facts = [], [("band, Hz", " to ".join(f"{f:g}" for f in content["band_hz"]))] if "band_hz" in content else []
    for direction, joint in directions.items():
        for i, (field, name) in enumerate(_JOINT):
            std = joint.get("std", {}).get(field)
            value = joint[field]
            known = joint.get("identifiable", [True] * 4)[i]
            says = "at its bound" if joint.get("at_bound", [False] * 4)[i] else "" if known else "not identifiable"
            interval = (None, None) if std is None else (max(0, value - 1.959964 * std), value + 1.959964 * std)
            rows.append([direction, name, value, std, *interval, says])
        if "residual" in joint:
            facts.append((f"residual, {direction}", joint["residual"]))
    return section(f"Tool joint: {document.label}", facts, (), [
        table("Joint", ["direction", "value of", "estimate", "deviation", "95 % from", "to", ""], rows)])


def _score(index):
    """Axis label and factor of a score."""
    if index["unit"] == "um":
        return "deflection, um", 1
    return f"{index['name']} stiffness, N/um", 1e-6


def _in_plane(document, point):
    plane = document.content.get("plane", {"origin_mm": [0, 0, 0], "x_axis": [1, 0, 0], "y_axis": [0, 1, 0]})
    away = [a - b for a, b in zip(point, plane["origin_mm"])]
    return [sum(a * b for a, b in zip(away, plane[name])) for name in ("x_axis", "y_axis")]


def pose_map(document, poses=(), paths=()):
    """The map, and on it the poses searched in its plane and the paths that run at its height."""
    content = document.content
    label, factor = _score(content["index"])
    rows = [[None if value is None else value * factor for value in row] for row in content["score"]]
    edges = charts.round_edges([value for row in rows for value in row])
    stops = charts.SOFT_TO_STIFF if content["index"]["unit"] != "um" else charts.SOFT_TO_STIFF[::-1]
    curves = []
    for pose in poses:
        if [pose.content.get(key) for key in ("height_mm", "plane")] != [content.get(key) for key in ("height_mm", "plane")]:
            continue
        for name, index, found in ((f"best of {pose.label}", 1, [pose.content.get("best")]),
                                   (f"runners-up of {pose.label}", 0, pose.content.get("alternatives", []))):
            places = [_in_plane(document, one["tcp_mm"]) for one in found if one]
            if places:
                curves.append(curve(name, [p[0] for p in places], [p[1] for p in places], index, points=True, line=False, radius=7,
                                    hover=[(label, [one["score"] and one["score"] * factor for one in found if one])]))
    for i, path in enumerate(paths):
        if all(abs(p["tcp_mm"][2] - content.get("height_mm", math.inf)) < 1 for p in path.content["points"]):
            curves.append(_plan(path, i))
    across = "(base frame)" if "plane" not in content else "(in the plane)"
    where = f"z = {content['height_mm']:g} mm" if "height_mm" in content else f"plane at {', '.join(f'{v:g}' for v in content['plane']['origin_mm'])} mm"
    grid = charts.cells(label, content["x_mm"], content["y_mm"], rows, edges, charts.colours_of(stops, len(edges) + 1))
    found = [chart(f"Stiffest pose at each point: {content['index']['name']}, {where}", axis(f"x, mm {across}"), axis(f"y, mm {across}"),
                   curves, grid, equal=True)]
    return section(f"Pose map: {document.label}", (), found)


def _margin(one):
    """To a billionth of a degree: at a limit it is 0, not what rounding leaves."""
    margin = one.get("limit_margin_deg")
    return None if margin is None else round(margin, 9)


def pose(document, most_rows=60):
    content = document.content
    label, factor = _score(content["index"])
    best = [("best", content["best"])] if content.get("best") else []
    rows = [[name, *one["joints_deg"], *one["tcp_mm"], one["redundancy_deg"], None if one["score"] is None else one["score"] * factor,
             None if one.get("score_std") is None else one["score_std"] * factor, _margin(one)]
            for name, one in best + [(f"runner-up {i}", one) for i, one in enumerate(content.get("alternatives", []), 1)]
            + [(one.get("name") or f"pose {i}", one) for i, one in enumerate(content.get("evaluated", []), 1)]]
    joints = len(rows[0]) - 8 if rows else 6
    head = ["", *[f"joint {i}, deg" for i in range(1, joints + 1)], "x, mm", "y, mm", "z, mm", "redundancy, deg", label, "deviation", "limit margin, deg"]
    evaluated = content.get("evaluated", [])
    clouds = []
    if evaluated:
        scores = [None if one["score"] is None else one["score"] * factor for one in evaluated]
        for first, second in ((0, 2), (0, 1)):
            places = [[one["tcp_mm"][axis_number] for one in evaluated] for axis_number in (first, second)]
            spans = [max(place) - min(place) for place in places]
            if min(spans) < max(1, 0.1 * max(spans)):
                continue  # nearly a line, which needs no picture
            clouds.append(chart("Tool points from the side" if second == 2 else "Tool points from above", axis(f"{'xyz'[first]}, mm (base frame)"),
                                axis(f"{'xyz'[second]}, mm (base frame)"), [curve("poses", *places, 2, points=True, line=False,
                                radius=1 if len(evaluated) > most_rows else 4, hover=[("pose", list(range(1, len(evaluated) + 1))), (label, scores)])], equal=True))
    sweep = content.get("redundancy_sweep")
    found = [chart("Score over the redundancy angle", axis("redundancy angle, deg"), axis(label), [
        curve("score", sweep["redundancy_deg"], [None if v is None else v * factor for v in sweep["score"]], 0)])] if sweep else []
    title = "Poses" if len(rows) <= most_rows else f"Poses, the first {most_rows} of {len(rows)}"
    return section(f"Poses: {document.label}", [("index", content["index"]["name"])], clouds + found, [table(title, head, rows[:most_rows])])


def _plan(document, index):
    points = document.content["points"]
    label, factor = _score(document.content["index"])
    return curve(f"path {document.label}", [p["tcp_mm"][0] for p in points], [p["tcp_mm"][1] for p in points], index, points=len(points) < 400,
                 radius=2, hover=[("point", [p["point"] for p in points]),
                                  (label, [None if p["score"] is None else p["score"] * factor for p in points])])


def pose_path(document):
    content = document.content
    points = content["points"]
    label, factor = _score(content["index"])
    ends = {part["last"] for part in content.get("parts", [])}
    times, offset = [], 0.0
    for point in points:  # the parts follow each other
        times.append(offset + point["time_s"])
        if point["point"] in ends:
            offset += point["time_s"]
    seconds = axis("time, s")
    scores = [None if p["score"] is None else p["score"] * factor for p in points]
    over_time = [curve(label.split(",")[0], times, scores, 0, hover=[("point", [p["point"] for p in points])])]
    deviations = [p.get("score_std") for p in points]
    if any(deviations):
        for sign, words in ((-2, "two deviations below"), (2, "two deviations above")):
            over_time.append(curve(words, times, [None if s is None or d is None else s + sign * d * factor for s, d in zip(scores, deviations)], 7))
    joints = len(points[0]["joints_deg"])
    found = [chart("Along the path", seconds, axis(label), over_time),
             chart("Plan view", axis("x, mm (base frame)"), axis("y, mm (base frame)"), [_plan(document, 0)], equal=True),
             chart("Joint angles", seconds, axis("angle, deg"), [curve(f"joint {i + 1}", times, [p["joints_deg"][i] for p in points], i) for i in range(joints)])]
    if all("joint_speed_deg_per_s" in p for p in points):
        found.append(chart("Joint speeds", seconds, axis("speed, deg/s"), [
            curve(f"joint {i + 1}", times, [p["joint_speed_deg_per_s"][i] for p in points], i) for i in range(joints)]))
    worst = content["worst"]
    facts = [("objective", content["objective"]), ("worst point", worst["point"]), (f"{label} there", charts.short(worst["score"] * factor, 5))]
    return section(f"Path: {document.label}", facts, found)


def cut_force(document):
    content = document.content
    feed, normal, axial = content["mean_force_n"]
    facts = [("depth, mm", content.get("depth_mm")), ("speed, rpm", content.get("speed_rpm")), ("mean force feed, normal, axial, N",
             ", ".join(f"{v:.4g}" for v in (feed, normal, axial))), ("peak force, N", content.get("peak_force_n")), ("power, W", content.get("power_w"))]
    wave = content.get("wave")
    found = [chart("Force over a turn", axis("turn of the cutter, deg"), axis("force on the tool, N"), [
        curve(name, wave["turn_deg"], wave[f"{name}_n"], i) for i, name in enumerate(("feed", "normal", "axial"))])] if wave else []
    points = content.get("points", [])
    rows = [[p["speed_rpm"], p["depth_mm"], p.get("growth_per_tooth"), p.get("stable"), p.get("settled"), p.get("chatter_frequency_hz"),
             p.get("peak_vibration_um"), p.get("observed")] for p in points]
    tables = [table("Cuts followed in time", ["speed, rpm", "depth, mm", "growth per tooth", "stable", "settled", "chatter, Hz", "peak vibration, um",
                                              "observed"], rows)] if rows else []
    return section(f"Cutting force: {document.label}", [fact for fact in facts if fact[1] is not None], found, tables)


def _plain(value):
    return value is None or isinstance(value, (str, int, float, bool))


def anything(document, most_rows=200):
    """Single values as facts, lists of numbers in a line, lists of objects as tables of their single values."""
    facts, tables = [], []

    def walk(value, path):
        if _plain(value):
            facts.append((path, value))
        elif isinstance(value, list) and all(_plain(item) for item in value):
            shown = ", ".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in value[:12])
            facts.append((path, shown + (f", ... ({len(value)} values)" if len(value) > 12 else "")))
        elif isinstance(value, list) and all(isinstance(item, dict) for item in value):
            head = list(dict.fromkeys(key for item in value for key, inner in item.items() if _plain(inner) or (
                isinstance(inner, list) and len(inner) <= 6 and all(_plain(v) for v in inner))))
            rows = [[item.get(key) if _plain(item.get(key)) else ", ".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in item[key])
                     for key in head] for item in value[:most_rows]]
            tables.append(table(f"{path}" + (f", the first {most_rows} of {len(value)}" if len(value) > most_rows else ""), head, rows))
        elif isinstance(value, dict):
            for key, inner in value.items():
                walk(inner, f"{path} {key}".strip())

    walk({key: inner for key, inner in document.content.items() if key not in ("format", "provenance", "label")}, "")
    return section(f"{document.kind}: {document.label}", facts, (), tables)
