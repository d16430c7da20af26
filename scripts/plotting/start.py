"""What every plot script begins with: the options that all have, the documents."""

import pathlib
import re
import shutil
import sys

from reporting.command import Option, arguments, fail, misuse


def _size(text):
    if not re.fullmatch("[0-9]{2,5}:[0-9]{2,5}", text):
        raise ValueError("expected W:H, each from 10 to 99999")
    return tuple(map(int, text.split(":")))


FIRST = [Option("--output", "FILE", "picture file: .svg, .png or .pdf (default: an SVG to standard output; there a picture in "
                "characters where that is a terminal)", short="-o"),
         Option("--terminal", None, "a picture in characters"),
         Option("--size", "W:H", "pixels; of a picture in characters columns and rows", _size),
         Option("--title", "TEXT", "in the place of the picture's own")]


def start(own, example, synopsis, text, most_inputs=1):
    """The options, with the form of the picture."""
    sys.dont_write_bytecode = True
    options = arguments(sys.argv[1:], [*FIRST, *own], example, synopsis, text, most_inputs)
    output = options["output"] or "-"
    options["inputs"] = options["inputs"] or ["-"]
    ending = output.rpartition(".")[2]
    if options["terminal"]:
        options["form"] = "dumb"
    elif output == "-":
        options["form"] = "dumb" if sys.stdout.isatty() else "svg"
    elif "." in output and ending in ("svg", "png", "pdf"):
        options["form"] = ending
    else:
        misuse(f"{output}: expected a name that ends in .svg, .png or .pdf")
    if options["form"] != "dumb" and options["size"] and not all(200 <= side <= 10000 for side in options["size"]):
        misuse(f"--size: {options['size'][0]}:{options['size'][1]}: expected 200 to 10000 pixels each")
    if not shutil.which("gnuplot"):
        fail("gnuplot is needed (Debian package gnuplot-nox)", 70)
    return options


def read(path, kind):
    """A document of that kind; ends the program where there is none."""
    # Here, so that a wrong option is refused at once.
    try:
        from reporting.documents import Refused, read_document
    except ImportError as missing:
        fail(f"{missing.name}: missing (Debian package python3-jsonschema)", 70)
    try:
        return read_document(path, kind)
    except Refused as refused:
        return fail(str(refused), refused.status)
    except RecursionError:
        return fail(f"{path}: a document is nested too deeply", 65)


def names(documents, paths):
    """What the documents are called: by their labels, else their files; by more of the path where two would be called the same."""
    found = [document.label for document in documents]
    parts = [pathlib.PurePath(path).with_suffix("").parts for path in paths]
    for depth in range(1, max(map(len, parts)) + 1):
        found = ["/".join(own[-depth:]) if found.count(name) > 1 else name for name, own in zip(found, parts)]
    return [f"{name} ({found[:i].count(name) + 1})" if found.count(name) > 1 else name for i, name in enumerate(found)]


def within(given, low, high):
    """A range as given, its open ends the document's."""
    return tuple(end if end is not None else own for end, own in zip(given or (None, None), (low, high)))


def run(main):
    """Runs a script; what nobody thought of ends it with the contract's status."""
    try:
        main()
    except ArithmeticError:
        fail("the numbers are too large or too small to be drawn", 65)
    except Exception as error:  # pylint: disable=broad-except
        fail(f"internal error: {type(error).__name__}: {error}", 70)
