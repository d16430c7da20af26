"""What report and the plot scripts are as commands: options, refusals, help, output that is whole or not there."""

import dataclasses
import math
import os
import pathlib
import re
import sys
import tempfile
import textwrap
from collections.abc import Callable

PROGRAM = pathlib.PurePath(sys.argv[0]).name


def fail(message, status):
    print(f"{PROGRAM}: " + "".join(c if c.isprintable() else "?" for c in message), file=sys.stderr)
    raise SystemExit(status)


def misuse(message):
    fail(f"{message} (see {PROGRAM} --help)", 64)


def warn(message):
    print(f"{PROGRAM}: warning: " + "".join(c if c.isprintable() else "?" for c in message), file=sys.stderr)


@dataclasses.dataclass(frozen=True)
class Option:
    """An option: a flag without a form. read makes its value of the text and raises ValueError with what was expected."""
    name: str
    form: str | None
    help: str
    read: Callable = str
    short: str | None = None


def number_range(text):
    """LO:HI, LO: or :HI as (low, high); None where it is left to the document."""
    expected = ValueError("expected LO:HI, with LO below HI")
    parts = text.split(":")
    if len(parts) != 2 or not any(parts):
        raise expected
    try:
        low, high = (float(part) if part else None for part in parts)
    except ValueError:
        raise expected from None
    if any(end is not None and not math.isfinite(end) for end in (low, high)) or (None not in (low, high) and low >= high):
        raise expected
    return low, high


def whole_number(least, largest):
    def read(text):
        if not re.fullmatch("[0-9]{1,9}", text) or not least <= int(text) <= largest:
            raise ValueError(f"expected a number from {least} to {largest}")
        return int(text)
    return read


def one_of(*names):
    def read(text):
        if text not in names:
            raise ValueError(f"expected {', '.join(names[:-1])} or {names[-1]}")
        return text
    return read


def several_of(*names):
    def read(text):
        found = text.split(",")
        if any(name not in names for name in found):
            raise ValueError(f"expected one or more of {', '.join(names)}, with commas between")
        return found
    return read


def _distance(a, b):
    """Damerau's: letters put in, left out, changed, or two neighbours exchanged."""
    rows = [list(range(len(b) + 1))]
    for i, left in enumerate(a, 1):
        row = [i]
        for j, right in enumerate(b, 1):
            row.append(min(rows[-1][j] + 1, row[-1] + 1, rows[-1][j - 1] + (left != right)))
            if i > 1 and j > 1 and left == b[j - 2] and a[i - 2] == right:
                row[-1] = min(row[-1], rows[-2][j - 2] + 1)
        rows.append(row)
    return rows[-1][-1]


def _unknown(word, options):
    nearest = min(options, key=lambda name: _distance(word, name))
    # As far as half of the word is another word.
    hint = f": expected {nearest}" if _distance(word, nearest) <= max(1, (len(word) - 2) // 2) else ""
    misuse(f"{word[:80]}: unknown option{hint}")


def _help(example, synopsis, text, options):
    lines = ["Example:", *(f"  {line}" for line in example.strip().splitlines()), "",
             *textwrap.wrap(f"Usage: {PROGRAM} [options] {synopsis}", 80), ""]
    for paragraph in text.strip().split("\n\n"):
        lines += [*textwrap.wrap(" ".join(paragraph.split()), 80, break_on_hyphens=False), ""]
    for option in options:
        head = f"  {option.short + ', ' if option.short else ''}{option.name}{' ' + option.form if option.form else ''}"
        wrapped = textwrap.wrap(option.help, 56, break_on_hyphens=False)
        if len(head) > 22:
            lines.append(head)
            head = ""
        lines += [f"{head:24}{wrapped[0]}", *(" " * 24 + line for line in wrapped[1:])]
    return "\n".join(lines)


def arguments(given, options, example, synopsis, text, most_inputs):
    """The options by their names without dashes, and "inputs". Ends the program for --help and where the usage is wrong."""
    options = [*options, Option("--help", None, "this page", short="-h")]
    known = {name: option for option in options for name in (option.name, option.short) if name}
    found = {option.name[2:]: None for option in options} | {"inputs": []}
    rest = iter(given)
    for word in rest:
        if not word.startswith("-") or word == "-":
            found["inputs"].append(word)
            continue
        name, equals, value = word.partition("=")
        if name not in known:
            _unknown(name, [option.name for option in options])
        option = known[name]
        if option.name == "--help":
            print(_help(example, synopsis, text, options))
            raise SystemExit(0)
        if option.form is None:
            if equals:
                misuse(f"{name}: {value[:80]}: expected no value")
            found[option.name[2:]] = True
            continue
        value = value if equals else next(rest, None)
        if value is None:
            misuse(f"{name}: expected a value")
        try:
            found[option.name[2:]] = option.read(value)
        except ValueError as error:
            misuse(f"{name}: {value[:80]}: {error}")
    if len(found["inputs"]) > most_inputs:
        misuse(f"expected at most {most_inputs} input{'s' if most_inputs > 1 else ''}")
    if found["inputs"].count("-") > 1:
        misuse("-: expected standard input once")
    return found


def write_whole(path, content):
    """Bytes into a file that is there whole or not at all, or to standard output. Ends the program where that fails."""
    if path == "-":
        try:
            sys.stdout.buffer.write(content)
            sys.stdout.flush()
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            raise SystemExit(141) from None
        except OSError as error:
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            fail(f"<stdout>: {error.strerror}", 74)
        return
    target = pathlib.Path(path)
    if target.exists() and not target.is_file():
        try:
            target.write_bytes(content)
        except OSError as error:
            fail(f"{path}: {error.strerror}", 74 if target.is_char_device() else 73)
        return
    part = None
    try:
        with tempfile.NamedTemporaryFile("wb", dir=target.parent, prefix=f".{PROGRAM}.", delete=False) as file:
            part = file.name
            file.write(content)
        os.chmod(part, 0o666 & ~os.umask(os.umask(0o022)))
        os.replace(part, target)
    except OSError:
        if part:
            pathlib.Path(part).unlink(missing_ok=True)
        fail(f"{path}: cannot be created", 73)
