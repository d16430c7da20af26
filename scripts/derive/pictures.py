"""Shared by the scripts of this folder that draw a picture: where it goes, and gnuplot."""
import argparse
import pathlib
import subprocess


def output_path(usual):
    """The path given to the script, or the picture's place in the project (`usual`, from the project's root)."""
    parser = argparse.ArgumentParser()
    parser.add_argument("path", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2] / usual)
    return parser.parse_args().path


def block(name, points, digits=5):
    """Rows of numbers as a data block $name of gnuplot's; an empty row separates scans."""
    lines = (" ".join(f"{value:.{digits}g}" for value in point) for point in points)
    return f"${name} << EOD\n" + "\n".join(lines) + "\nEOD\n"


def draw(usual, size, commands):
    """A picture of that size ("760,420") by gnuplot's commands."""
    subprocess.run(["gnuplot"], check=True, text=True, input=f"""
set terminal svg size {size} font "Helvetica,13" background "white"
set output "{output_path(usual)}"
{commands}
""")
