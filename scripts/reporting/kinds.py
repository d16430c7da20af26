"""Sections of the page: of each kind of document its charts, tables and facts."""

import math

from . import charts
from .charts import axis, chart, curve, short

TWO_PI = 2 * math.pi


def section(title, facts=(), chart_list=(), tables=()):
    return {"title": title, "facts": list(facts), "charts": [one for one in chart_list if one], "tables": list(tables)}


def table(title, head, rows):
    """Without the columns that say nothing in any row."""
    rows = [[short(value, 5) for value in row] for row in rows]
    said = [i for i in range(len(head)) if not rows or any(row[i] is not None for row in rows)]
    return {"title": title, "head": [head[i] for i in said], "rows": [[row[i] for i in said] for row in rows]}


def _cut_words(cut):
    arc = (f"{cut['milling']} milling, ae/D {cut['radial_immersion']:g}" if "radial_immersion" in cut
           else f"teeth in cut from {cut['entry_deg']:g} to {cut['exit_deg']:g} deg")
    return f"{cut['teeth']} teeth, Kt {cut['kt_n_per_mm2']:g}, Kr {cut['kr_n_per_mm2']:g} N/mm2, {arc}"


def _limit_curve(content, name, index):
    limit = sorted(content["limit"] + [entry for entry in content.get("what_to_run", {}).get("limit_between", [])],
                   key=lambda entry: entry["speed_rpm"])
    return curve(name, [entry["speed_rpm"] for entry in limit], [entry["depth_mm"] for entry in limit], index,
                 points=sum(entry["depth_mm"] is not None for entry in limit) < 3, width=2,
                 hover=[("chatter frequency, Hz", [entry.get("chatter_frequency_hz") for entry in limit]),
                        ("kind", [entry.get("kind") for entry in limit]), ("lobe", [entry.get("lobe") for entry in limit]),
                        ("mode", [entry.get("mode") for entry in limit])])


def _lobes_curves(content):
    found = []
    band = [entry for entry in content["limit"] if (entry.get("interval_95_mm") or [None])[0] is not None]
    if band:
        top = max(content["depth_mm"])
        speeds = [entry["speed_rpm"] for entry in band]
        found += [curve("95 % interval, lower end", speeds, [entry["interval_95_mm"][0] for entry in band], 7, width=1),
                  curve("95 % interval, upper end", speeds, [entry["interval_95_mm"][1] if entry["interval_95_mm"][1] is not None else top
                                                             for entry in band], 7, width=1)]
    found.append(_limit_curve(content, "limit", 0))
    lowest = {entry["speed_rpm"]: entry["depth_mm"] for entry in content["limit"]}
    islands = [entry for entry in content.get("crossings", []) if lowest.get(entry["speed_rpm"]) != entry["depth_mm"]]
    if islands:
        found.append(curve("other boundaries", [entry["speed_rpm"] for entry in islands], [entry["depth_mm"] for entry in islands], 7,
                           points=True, line=False, radius=1.5, hover=[("above it", [entry["above"] for entry in islands])]))
    to_run = content.get("what_to_run", {})
    depth = to_run.get("unconditional", {}).get("depth_mm")
    if depth is not None:
        speeds = content["speed_rpm"]
        found.append(curve("stable at every speed", [min(speeds), max(speeds)], [depth, depth], 2, dash=[8, 4]))
    best = to_run.get("best", [])
    if best:
        found.append(curve("what to run", [entry["speed_rpm"] for entry in best], [entry["depth_mm"] for entry in best], 2, points=True,
                           line=False, radius=6, hover=[("limit, mm", [entry["limit_mm"] for entry in best]),
                                                        ("removal of best", [entry["removal_of_best"] for entry in best])]))
    for index, shape, name, wanted in ((3, "circle", "stable", True), (1, "triangle", "chatter", False)):
        points = [p for p in content.get("points", []) if (p["observed"] == name if "observed" in p else p["stable"] == wanted)]
        if points:
            word = "observed" if "observed" in points[0] else "predicted"
            found.append(curve(f"{word} {name}", [p["speed_rpm"] for p in points], [p["depth_mm"] for p in points], index, points=True,
                               line=False, shape=shape, radius=6, hover=[
                                   ("spectral radius", [p["spectral_radius"] for p in points]),
                                   ("model", ["stable" if p["stable"] else "chatter" for p in points])]))
    missed = [p for p in content.get("points", []) if p.get("agrees") is False]
    if missed:
        found.append(curve("model disagrees", [p["speed_rpm"] for p in missed], [p["depth_mm"] for p in missed], 0, points=True, line=False,
                           shape="circle", radius=11, hollow=True))
    return found


def _span(values):
    return min(values), max(values)


def lobes(document):
    content = document.content
    speed, depth = axis("spindle speed, rpm", False, *_span(content["speed_rpm"])), axis("axial depth, mm", False, *_span(content["depth_mm"]))
    limit = {entry["speed_rpm"]: entry for entry in content["limit"]}
    at = [limit.get(value, {}) for value in content["speed_rpm"]]
    columns = [("limit at this speed, mm", [entry.get("depth_mm") for entry in at]),
               ("chatter frequency there, Hz", [entry.get("chatter_frequency_hz") for entry in at])]
    found = []
    rows = content.get("spectral_radius")
    grid = rows and charts.cells("spectral radius", content["speed_rpm"], content["depth_mm"], rows,
                                 [0.9, 0.95, 0.98, 1, 1.02, 1.05, 1.1, 1.2],
                                 charts.colours_of(charts.STABLE, 4) + charts.colours_of(charts.UNSTABLE, 5), columns)
    note = "Colour: spectral radius of a tooth period; from 1 on the cut chatters. " if grid else ""
    if rows and not grid:
        note = "The chart's speeds or depths are not evenly spaced: its spectral radii are not drawn. "
    if all(entry["depth_mm"] is None and entry.get("not_resolved") is None for entry in content["limit"]):
        note += "Stable over the whole chart."
    found.append(chart("Stability lobes: " + _cut_words(content["cut"]), speed, depth, _lobes_curves(content), grid, note=note or None))
    chattering = [entry for entry in content["limit"] if entry.get("chatter_frequency_hz") is not None]
    if chattering:
        curves = []
        for index, kind in enumerate(("hopf", "flip", "fold")):
            of_kind = [entry for entry in chattering if entry["kind"] == kind]
            if of_kind:
                curves.append(curve(kind, [entry["speed_rpm"] for entry in of_kind], [entry["chatter_frequency_hz"] for entry in of_kind], index,
                                    points=True, line=False, radius=2.5, hover=[("lobe", [entry.get("lobe") for entry in of_kind]),
                                                                                ("mode", [entry.get("mode") for entry in of_kind])]))
        found.append(chart("Chatter frequency at the limit", speed, axis("chatter frequency, Hz"), curves))
    if content.get("per_mode"):
        alone = [one for one in content["per_mode"] if any(entry["depth_mm"] is not None for entry in one["limit"])]
        silent = [str(one["mode"]) for one in content["per_mode"] if one not in alone]
        curves = [_limit_curve(one, f"mode {one['mode']}", i + 1) for i, one in enumerate(alone)]
        found.append(alone and chart("Limit of each mode alone", speed, depth, [_limit_curve(content, "all modes", 0) | {"width": 3}] + curves,
                           note=f"Without a limit in the chart: mode {', '.join(silent)}." if silent else None))
    if content.get("probability_stable"):
        grid = charts.cells("probability that the cut is stable", content["speed_rpm"], content["depth_mm"], content["probability_stable"],
                            [0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95], charts.colours_of(charts.UNLIKELY_TO_LIKELY, 8))
        found.append(chart(f"Probability of a stable cut, {content['samples']} samples", speed, depth, (), grid))
    if content.get("surface"):
        errors = content["surface"]["location_error_um"]
        edges = sorted({0, *charts.round_edges([value for row in errors for value in row])})
        grid = charts.cells("surface location error, um", content["speed_rpm"], content["depth_mm"], errors, edges,
                            charts.colours_about_zero(edges))
        found.append(chart("Where the wall lies (above 0: material left)", speed, depth, [_limit_curve(content, "limit", 0)], grid))
    best = content.get("what_to_run", {}).get("best", [])
    tables = [table("What to run", ["speed, rpm", "depth, mm", "limit, mm", "from, rpm", "to, rpm", "removal of best"], [
        [entry["speed_rpm"], entry["depth_mm"], entry["limit_mm"], entry["slowest_rpm"], entry["fastest_rpm"], entry["removal_of_best"]]
        for entry in best])] if best else []
    facts = [("method", content["method"]), ("estimated error of the spectral radius", content["convergence"])]
    points = [p for p in content.get("points", []) if "agrees" in p]
    if points:
        facts.append(("verdicts as observed", f"{sum(p['agrees'] for p in points)} of {len(points)}"))
    facts += [("modal tables, all of which are stable below the limit", len(content["tables"]))] if "tables" in content else []
    return section(f"Stability: {document.label}", facts, found, tables)


def all_lobes(documents):
    """Several charts: their limits in one picture."""
    curves = [_limit_curve(document.content, document.label, i) for i, document in enumerate(documents)]
    depth = max(max(document.content["depth_mm"]) for document in documents)
    speeds = [value for document in documents for value in document.content["speed_rpm"]]
    return section("Stability: all limits", (), [chart("Limits of all charts", axis("spindle speed, rpm", False, *_span(speeds)),
                                                       axis("axial depth, mm", False, 0, depth), curves)])


_ORDER = {"receptance": 0, "mobility": 1, "accelerance": 2}
_UNIT = {"receptance": "m/N", "mobility": "m/(N s)", "accelerance": "m/(N s2)"}


def _responses(content, quantity):
    """Place -> (name, values in the wanted quantity), signs of directions taken out."""
    found = {}
    for entry in content["h"]:
        sign = (-1) ** (entry["response"].startswith("-") + entry["reference"].startswith("-"))
        pair = entry["response"].lstrip("-"), entry["reference"].lstrip("-")
        where = entry.get("response_position_mm", 0), entry.get("reference_position_mm", 0)
        steps = _ORDER[quantity] - _ORDER[content["quantity"]]
        values = [sign * complex(re, im) * (1j * TWO_PI * f) ** steps if f or steps >= 0 else complex("nan")
                  for f, re, im in zip(content["frequency_hz"], entry["re"], entry["im"])]
        if any(values):
            found[pair + where] = values
    return found


def frf(documents):
    """All frequency responses, entry by entry, the documents over each other."""
    quantity = documents[0].content["quantity"]
    responses = [_responses(document.content, quantity) for document in documents]
    places = list(dict.fromkeys(place for found in responses for place in found))
    found = []
    for place in places:
        upper, lower = [], []
        for i, (document, of_one) in enumerate(zip(documents, responses)):
            values = of_one.get(place)
            if values is None:
                continue
            frequencies = document.content["frequency_hz"]
            style = {"width": 3, "colour": "#9fb1c1"} if i == 0 and len(documents) > 1 else {"width": 1.5}
            upper.append(curve(document.label, frequencies, [abs(v) or None for v in values], i, digits=5, **style))
            lower.append(curve(document.label, frequencies, [math.degrees(math.atan2(v.imag, v.real)) for v in values], i, digits=4, wrap=180, **style))
        frequency = axis("frequency, Hz", charts.wide(documents[0].content["frequency_hz"]),
                         *_span([f for document in documents for f in _span(document.content["frequency_hz"])]))
        name = f"H {place[0]}{place[1]}" + (f" at {place[2]:g} and {place[3]:g} mm from the tip" if any(place[2:]) else "")
        unit = _UNIT[quantity] if "slope" not in place[0] + place[1] else "SI"
        found += [chart(f"{name}, magnitude", frequency, axis(f"|H|, {unit}", True), upper),
                  chart(f"{name}, phase", frequency, axis("phase, deg", False, -180, 180), lower)]
    return section("Frequency responses: " + ", ".join(document.label for document in documents),
                   [("quantity", quantity)], found)


def modal_table(document):
    content = document.content
    dofs = content["dofs"]
    head = ["mode", "frequency, Hz", "its deviation", "damping, %", "its deviation"] + [f"|psi_R| {d}" for d in dofs] + [f"|psi_L| {d}" for d in dofs]
    rows = []
    for number, mode in enumerate(content["modes"], 1):
        std = mode.get("std", {})
        deviation = std.get("damping_ratio")
        rows.append([number, mode["frequency_hz"], std.get("frequency_hz"), 100 * mode["damping_ratio"],
                     None if deviation is None else 100 * deviation] + [abs(complex(*v)) for v in mode["psi_r"] + mode["psi_l"]])
    fit = content.get("fit", {})
    facts = [(name, fit[key]) for key, name in (("model", "model"), ("noise", "noise"), ("relative_error", "relative error of the fit"),
                                                ("reduced_chi_square", "chi-square per degree of freedom")) if key in fit]
    return section(f"Modes: {document.label}", facts, (), [table("Modes (shapes in sqrt(s/kg))", head, rows)])


def stabilization(document):
    content = document.content
    poles = [(pole["frequency_hz"], order["pole_pairs"], pole["damping_ratio"], pole["stable"])
             for order in content["orders"] for pole in order["poles"]]
    curves = []
    for kind, index, words in (("new", 7, "new"), ("frequency", 2, "frequency within 1 %"), ("pole", 1, "damping within 10 % too")):
        of_kind = [pole for pole in poles if pole[3] == kind]
        if of_kind:
            curves.append(curve(words, [p[0] for p in of_kind], [p[1] for p in of_kind], index, points=True, line=False, radius=3,
                                hover=[("damping ratio", [p[2] for p in of_kind])]))
    top = max((p[1] for p in poles), default=1)
    for number, mode in enumerate(content["modes"], 1):
        curves.append(curve(f"mode {number}", [mode["frequency_hz"]] * 2, [0, top + 1], 7, dash=[4, 4], quiet=True,
                            hover=[("damping ratio", [mode["damping_ratio"]] * 2)]))
    frequencies = content["frequency_hz"]
    band = axis("frequency, Hz", charts.wide(frequencies), frequencies[0], frequencies[-1])
    singular = [curve(f"singular value {i}", frequencies, [v if v > 0 else None for v in values], i - 1)
                for i, values in enumerate(content["singular_values_m_per_n"], 1)]
    return section(f"Stabilization: {document.label}", [("modes chosen", len(content["modes"]))], [
        chart("Poles of fits of rising order, dashed: the modes chosen", band, axis("pole pairs", False, 0, top + 1), curves),
        chart("Singular values of H", band, axis("singular value, m/N", True), singular)])
