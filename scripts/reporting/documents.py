"""Reads documents and checks each against the schema of its kind."""

import dataclasses
import hashlib
import json
import math
import pathlib
import sys

from jsonschema import Draft202012Validator

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "schemas"


class Refused(Exception):
    """What is wrong, and the exit status that says so."""

    def __init__(self, message, status=65):
        super().__init__(message)
        self.status = status


@dataclasses.dataclass
class Document:
    name: str  # of the file, without its folders
    kind: str
    sha256: str
    content: dict

    @property
    def label(self):
        """What the reader knows it by: its own label, or the name of the file."""
        label = self.content.get("label")
        return label if isinstance(label, str) and label else pathlib.PurePath(self.name).stem


def _refuse_constant(text):
    raise ValueError(f"{text}: expected a finite number")


def _finite(text):
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text[:40]}: expected a finite number")
    return value


def _whole(text):
    _finite(text)
    return int(text)


def _unique(pairs):
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError(f"a key stands twice among {', '.join(sorted({key for key, _ in pairs}))[:80]}")
    return found


def _pointer(error):
    return "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in error.absolute_path)


def _expected(error):
    """A broken schema in the words of the tools: (where, what was expected)."""
    at, wanted = _pointer(error), error.validator_value
    if error.validator == "required":
        missing = next(name for name in wanted if name not in error.instance)
        return f"{at}/{missing}", "missing"
    if error.validator == "dependentRequired":
        missing = next(name for field, names in wanted.items() if field in error.instance for name in names if name not in error.instance)
        return f"{at}/{missing}", "missing"
    words = {"type": lambda: " or ".join([wanted] if isinstance(wanted, str) else wanted), "const": lambda: wanted,
             "enum": lambda: f"one of {', '.join(map(str, wanted))}", "minimum": lambda: f"at least {wanted}",
             "maximum": lambda: f"at most {wanted}", "exclusiveMinimum": lambda: f"more than {wanted}",
             "minItems": lambda: f"at least {wanted} items", "maxItems": lambda: f"at most {wanted} items",
             "pattern": lambda: f"a text like {wanted}", "oneOf": lambda: "another form (see the schema)"}
    if error.validator in words:
        return at or "/", f"expected {words[error.validator]()}"
    return at or "/", " ".join(error.message.split())[-160:]


def _lists(kind, content):
    """What a schema cannot say: (pointer, list, the length that it has to have)."""
    def grid(pointer, rows, down, across):
        yield pointer, rows, len(content[down])
        for i, row in enumerate(rows):
            yield f"{pointer}/{i}", row, len(content[across])

    if kind == "lobes":
        grids = {"spectral_radius": content.get("spectral_radius"), "probability_stable": content.get("probability_stable")}
        grids |= {f"surface/{name}": rows for name, rows in content.get("surface", {}).items()}
        for name, rows in grids.items():
            if rows is not None:
                yield from grid(f"/{name}", rows, "depth_mm", "speed_rpm")
    elif kind == "pose-map":
        for name, rows in content.items():
            if name in ("score", "redundancy_deg", "branch") or name.startswith("stiffness_"):
                yield from grid(f"/{name}", rows, "y_mm", "x_mm")
    elif kind == "frf":
        for i, entry in enumerate(content["h"]):
            for part in ("re", "im"):
                yield f"/h/{i}/{part}", entry[part], len(content["frequency_hz"])
    elif kind == "stabilization":
        for i, values in enumerate(content["singular_values_m_per_n"]):
            yield f"/singular_values_m_per_n/{i}", values, len(content["frequency_hz"])
    elif kind == "cut-force" and "wave" in content:
        for name, values in content["wave"].items():
            yield f"/wave/{name}", values, len(content["wave"]["turn_deg"])
    elif kind == "pose" and "redundancy_sweep" in content:
        sweep = content["redundancy_sweep"]
        yield "/redundancy_sweep/score", sweep["score"], len(sweep["redundancy_deg"])


def _disordered(kind, content):
    """The first place where an axis does not increase, or has no value: (pointer, what was expected); None where all do."""
    for name in {"lobes": ("speed_rpm", "depth_mm"), "pose-map": ("x_mm", "y_mm"), "frf": ("frequency_hz",), "stabilization": ("frequency_hz",)}.get(kind, ()):
        if not content[name]:
            return f"/{name}", "expected at least 1 item"
        for i, (before, after) in enumerate(zip(content[name], content[name][1:]), 1):
            if after <= before:
                return f"/{name}/{i}", f"{after:g}: expected more than {before:g}, the one before"
    return None


def read_document(path, kind=None):
    """The document in a file, or in standard input for "-"; of that kind, where one is given. Raises Refused."""
    shown = "<stdin>" if path == "-" else path
    try:
        raw = sys.stdin.buffer.read() if path == "-" else pathlib.Path(path).read_bytes()
    except (OSError, ValueError):
        raise Refused(f"{shown}: cannot be read", 66) from None
    if not raw.strip():
        raise Refused(f"{shown}: empty input: expected a JSON document")
    try:
        content = json.loads(raw.decode(), parse_constant=_refuse_constant, parse_float=_finite, parse_int=_whole,
                             object_pairs_hook=_unique)
    except (ValueError, RecursionError) as error:
        raise Refused(f"{shown}: not JSON: {str(error)[:160]}") from None
    found = content.get("format") if isinstance(content, dict) else None
    known = {f"stablecut/{file.name.removesuffix('.schema.json')}/1": file for file in SCHEMAS.glob("*.schema.json")}
    wanted = f"stablecut/{kind or '<kind>'}/1"
    if not isinstance(found, str) or found not in known or (kind and found != wanted):
        raise Refused(f"{shown}: /format: {str(found)[:80] if found else 'nothing'}: expected {wanted}")
    schema = json.loads(known[found].read_text())
    # The deepest error of the best match says more than "is not valid under any of the given schemas".
    for error in Draft202012Validator(schema).iter_errors(content):
        while error.context:
            error = max(error.context, key=lambda inner: len(inner.absolute_path))
        raise Refused(f"{shown}: {': '.join(_expected(error))}")
    for pointer, values, length in _lists(found.split("/")[1], content):
        if len(values) != length:
            raise Refused(f"{shown}: {pointer}: {len(values)} values: expected {length}")
    if disordered := _disordered(found.split("/")[1], content):
        raise Refused(f"{shown}: {': '.join(disordered)}")
    name = "standard input" if path == "-" else pathlib.PurePath(path).name
    return Document(name, found.split("/")[1], hashlib.sha256(raw).hexdigest(), content)
