"""Shared by the scripts of this folder: whether what was derived stands in the source.

A difference ends the script with status 1. Where the source is not there (the script was copied out of the
project), it says so and compares nothing.
"""
import os
import re
import sys

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "..", ".."))


def _source(path):
    try:
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            return file.read()
    except FileNotFoundError:
        print(f"{path}: not here, nothing was compared")
        return None


def stands_in(path, *texts):
    """Each text stands in the file at `path` (from the project's root), whatever the blanks."""
    source = _source(path)
    if source is None:
        return
    packed = "".join(source.split())
    missing = [text for text in texts if "".join(text.split()) not in packed]
    for text in missing:
        print(f"{path}: does not hold: {text}")
    if missing:
        sys.exit(1)
    print(f"{path}: holds the same text")


def stands_near(path, relative, *expected):
    """Pairs of a regular expression with one group, a number, and the value that it is near to."""
    source = _source(path)
    if source is None:
        return
    for pattern, value in expected:
        match = re.search(pattern, source)
        off = abs(float(match[1]) / float(value) - 1) if match else float("inf")
        print(f"{path}: {match[1] if match else pattern}: relative difference {off:.1e}")
        if off > relative:
            sys.exit(1)
