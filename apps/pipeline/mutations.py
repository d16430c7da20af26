"""Every small way to damage a document or a table of numbers: generators of (what was done, damaged text)."""

import copy
import json

VALUES = {"null": None, "true": True, "text": "x", "number as text": "1", "empty text": "", "empty list": [], "empty object": {},
          "list": [1], "object": {"a": 1}, "0": 0, "-1": -1, "1e15": 1e15, "1e308": 1e308, "1e-308": 1e-308, "0.5": 0.5}
# Written as they are: not JSON, or numbers that no double holds.
LITERALS = ("NaN", "1e999", "-Infinity", "01", "1.", "+1", "'x'", "[" * 3000 + "]" * 3000, "{", "")
MARK = "\u0001mark\u0001"
# Of a list the first two and the last are damaged: the others are read by the same loop.
SHOWN = (0, 1, -1)


def places(node, at=()):
    """Paths of all nodes but the root; of a list those of SHOWN."""
    if isinstance(node, dict):
        children = list(node.items())
    elif isinstance(node, list):
        children = [(i, node[i]) for i in sorted({shown % len(node) for shown in SHOWN if -len(node) <= shown < len(node)})]
    else:
        return
    for key, child in children:
        yield at + (key,)
        yield from places(child, at + (key,))


def pointer(path):
    return "".join(f"/{part}" for part in path)


def holder(document, path):
    for part in path[:-1]:
        document = document[part]
    return document


def replaced(document, path, value):
    other = copy.deepcopy(document)
    holder(other, path)[path[-1]] = value
    return other


def without(document, path):
    other = copy.deepcopy(document)
    del holder(other, path)[path[-1]]
    return other


def misspelt(key):
    """Two letters changed places, one lost, one doubled."""
    middle = len(key) // 2
    yield key[:middle - 1] + key[middle] + key[middle - 1] + key[middle + 1:]
    yield key[:middle] + key[middle + 1:]
    yield key[:middle] + key[middle] + key[middle:]


def renamed(document, path, name):
    other = copy.deepcopy(document)
    place = holder(other, path)
    if name in place:
        return None
    items = [(name if key == path[-1] else key, value) for key, value in place.items()]
    place.clear()
    place.update(items)
    return other


def of_document(document):
    """Damages of a JSON document."""
    for path in places(document):
        here = pointer(path)
        value = holder(document, path)[path[-1]]
        yield f"{here} removed", json.dumps(without(document, path))
        for name, other in VALUES.items():
            if other != value or type(other) is not type(value):
                yield f"{here} = {name}", json.dumps(replaced(document, path, other))
        for literal in LITERALS:
            text = json.dumps(replaced(document, path, MARK)).replace(json.dumps(MARK), literal)
            yield f"{here} written {literal[:10]}", text
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            yield f"{here} negated", json.dumps(replaced(document, path, -value))
            yield f"{here} times 1e6", json.dumps(replaced(document, path, value * 1e6))
            yield f"{here} by 1e6", json.dumps(replaced(document, path, value / 1e6))
        if isinstance(value, list):
            if len(value) > 1:
                yield f"{here} one shorter", json.dumps(replaced(document, path, value[:-1]))
            yield f"{here} one longer", json.dumps(replaced(document, path, value + value[-1:]))
            yield f"{here} a list in a list", json.dumps(replaced(document, path, [value]))
        if isinstance(path[-1], str):
            for name in misspelt(path[-1]):
                other = renamed(document, path, name)
                if other is not None:
                    yield f"{here} misspelt {name}", json.dumps(other)
            text = json.dumps(replaced(document, path, MARK))
            twice = f"{json.dumps(value)}, {json.dumps(path[-1])}: {json.dumps(value)}"
            yield f"{here} twice", text.replace(json.dumps(MARK), twice)
    whole = json.dumps(document)
    for size in range(0, len(whole), max(1, len(whole) // 20)):
        yield f"cut after {size} characters", whole[:size]
    for literal in LITERALS:
        yield f"only {literal[:10]}", literal
    for name, other in VALUES.items():
        yield f"only {name}", json.dumps(other)


CELLS = ("", "x", "NaN", "inf", "-1", "0", "1e308", "1e-308", "1e15", "1e999", "1,5", "1;5", '"', '"1', "0x10", "\u00e9", "1 2")


def of_table(text):
    """Damages of a CSV file with one line of names."""
    rows = [line.split(",") for line in text.splitlines()]
    lines = sorted({0, 1, 2, len(rows) // 2, len(rows) - 1})
    for line in lines:
        def written(row):
            return "\n".join(",".join(cells) for cells in rows[:line] + row + rows[line + 1:]) + "\n"
        yield f"line {line + 1} removed", written([])
        yield f"line {line + 1} twice", written([rows[line]] * 2)
        yield f"line {line + 1} shorter", written([rows[line][:-1]])
        yield f"line {line + 1} longer", written([rows[line] + ["1"]])
        yield f"line {line + 1} by semicolons", written([[";".join(rows[line])]])
        for column, cell in enumerate(rows[line]):
            for other in CELLS if line else CELLS[:2] + tuple(misspelt(cell)):
                yield f"line {line + 1}, column {column + 1} = {other}", written([rows[line][:column] + [other] + rows[line][column + 1:]])
    for size in range(0, len(text), max(1, len(text) // 20)):
        yield f"cut after {size} characters", text[:size]
    for literal in LITERALS:
        yield f"only {literal[:10]}", literal
