"""What frf documents have to draw: their entries in one quantity and one sign, their names, their ranges."""

import dataclasses
import math

ORDER = {"receptance": 0, "mobility": 1, "accelerance": 2}
PER_SECOND = {"receptance": "", "mobility": " s", "accelerance": " s²"}


@dataclasses.dataclass
class Curve:
    """An entry of a document: frequencies in Hz, complex values, and what is known of their noise."""
    name: str
    frequency: list
    values: list
    deviation: list | None  # of the complex value
    coherence: list | None


def bare(direction):
    return direction.removeprefix("-")


def place(entry):
    """What makes two entries the same: directions without sign, and positions."""
    return (bare(entry["response"]), bare(entry["reference"]), entry.get("response_position_mm", 0), entry.get("reference_position_mm", 0))


def moves(entry):
    return any(entry["re"]) or any(entry["im"])


def unit(entry, quantity):
    top = "rad" if "slope" in entry["response"] else "m"
    bottom = ("N m" if "slope" in entry["reference"] else "N") + PER_SECOND[quantity]
    return f"{top}/({bottom})" if " " in bottom else f"{top}/{bottom}"


def heading(entry):
    at = f", {entry['response_position_mm']:g} and {entry['reference_position_mm']:g} mm from the tip" if (
        entry.get("response_position_mm") and "reference_position_mm" in entry) else ""
    return f"H {entry['response']}{entry['reference']}{at}"


def curve(name, content, entry, like, quantity):
    """An entry in another quantity, each step a derivative, and with the sign of the entry that it is drawn over."""
    sign = math.prod(-1 if direction.startswith("-") else 1
                     for one in (entry, like) for direction in (one["response"], one["reference"]))
    steps = ORDER[quantity] - ORDER[content["quantity"]]
    frequency = content["frequency_hz"]
    # 0 Hz has no integral.
    factors = [sign * (2j * math.pi * f) ** steps if f > 0 or steps == 0 else sign * 0.0 if steps > 0 else math.nan for f in frequency]
    values = [complex(re, im) * factor if factor == factor else None for re, im, factor in zip(entry["re"], entry["im"], factors)]
    variance = entry.get("variance")
    deviation = [math.sqrt(v) * abs(factor) for v, factor in zip(variance, factors)] if variance else None
    return Curve(name, frequency, values, deviation, entry.get("coherence"))


def origin(provenance):
    """What a response is by what made it: None where that is not known."""
    if not isinstance(provenance, dict):
        return None
    tool, given = provenance.get("tool"), provenance.get("arguments", [])
    if tool == "rcsa-couple":
        return "computed"
    if tool != "fit-modes":
        return None
    if "--synthesize" in given:
        return "synthesized"
    if "--convert" in given:
        inputs = provenance.get("inputs", [])
        return (origin(inputs[0].get("from")) if inputs else None) or "measured"
    return "fitted"


def magnitudes(values):
    return [None if value is None else abs(value) for value in values]


def phases(values):
    return [None if value is None or value == 0 else math.degrees(math.atan2(value.imag, value.real)) for value in values]


def rows(frequency, values, wrap=None):
    """Rows to draw; a gap where the value jumps round by more than wrap, so that no line leads across."""
    found, before = [], None
    for f, value in zip(frequency, values):
        if wrap and None not in (before, value) and abs(value - before) > wrap:
            found.append(())
        found.append((f, value))
        before = value
    return found


def extent(series, low, high, log):
    """The least and the largest of (frequencies, values) pairs between two frequencies, with a margin; None where nothing is."""
    found = [value for frequency, values in series for f, value in zip(frequency, values)
             if value is not None and low <= f <= high and (value > 0 or not log)]
    if not found:
        return None, None
    least, largest = min(found), max(found)
    if log:
        margin = max(largest / least, 1.5) ** 0.04
        return least / margin, largest * margin
    margin = 0.04 * (largest - least) or 0.04 * abs(largest) or 1
    return least - margin, largest + margin
