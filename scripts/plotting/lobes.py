"""What a lobes document has to draw: limit curves, their gaps, the lobes that they consist of."""

import collections
import itertools


def limit(content):
    """Entries of the lowest limit by speed, those between the chart's speeds too."""
    return sorted(content["limit"] + content.get("what_to_run", {}).get("limit_between", []), key=lambda entry: entry["speed_rpm"])


def _unknown(entry):
    return entry.get("not_resolved") is not None


def curve(entries, top):
    """(rows of the curve, rows that lead to the top, rows of points that stand alone).

    A limit between two speeds that are stable to the top leaves the chart somewhere on the way to each of them: the rows that
    lead to the top go to the neighbour. Speeds that are not resolved leave a gap.
    """
    rows, leaving, alone = [], [], []
    for i, entry in enumerate(entries):
        if _unknown(entry) or entry["depth_mm"] is None:
            rows.append(())
            continue
        here = (entry["speed_rpm"], entry["depth_mm"])
        rows.append(here)
        beside = [entries[k] for k in (i - 1, i + 1) if 0 <= k < len(entries)]
        if all(_unknown(other) or other["depth_mm"] is None for other in beside):
            alone.append(here)
        for other in beside:
            if not _unknown(other) and other["depth_mm"] is None and here[1] <= top:
                leaving += [here, (other["speed_rpm"], top), ()]
    return rows, leaving, alone


def lobes(entries):
    """Stretches of the limit with one number of lobe, whatever mode each of their lobes is of: (lobe, entries)."""
    stretches = itertools.groupby(entries, key=lambda entry: None if entry.get("depth_mm") is None else entry.get("lobe"))
    return [(lobe, list(stretch)) for lobe, stretch in stretches if lobe is not None]


def mode_name(entry):
    """Empty where nothing says which mode it is."""
    if entry.get("mode") is None:
        return ""
    return (f"table {entry['table']}, " if entry.get("table") is not None else "") + f"mode {entry['mode']}"


def modes(entries, most=9):
    """Names of the modes that chatter, those of the most entries, by number."""
    counts = collections.Counter((entry.get("table", 0), entry["mode"], mode_name(entry)) for entry in entries if entry.get("mode") is not None)
    return [name for _, _, name in sorted(key for key, _ in counts.most_common(most))]


def islands(content):
    """Boundaries above the lowest one: where a cut becomes stable or unstable again."""
    lowest = {entry["speed_rpm"]: entry.get("depth_mm") for entry in content["limit"]}
    return [(entry["speed_rpm"], entry["depth_mm"]) for entry in content.get("crossings", []) if lowest.get(entry["speed_rpm"]) != entry["depth_mm"]]


def cut_words(cut):
    arc = (f"{cut['milling']} milling, ae/D {cut['radial_immersion']:g}" if "radial_immersion" in cut
           else f"in cut from {cut['entry_deg']:g} to {cut['exit_deg']:g}°")
    return f"{cut['teeth']} teeth, Kt {cut['kt_n_per_mm2']:g}, Kr {cut['kr_n_per_mm2']:g} N/mm², {arc}"
