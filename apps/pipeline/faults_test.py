"""Disks that are full, pipes that close, signals at any moment, limits of the system, names and inputs that no one expects:
a status of the contract, one line, and each file whole, the old one or the new one."""

import itertools
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.environ["SOURCE"], "apps"))
from testing import check, finish

data = pathlib.Path(os.environ["SOURCE"]) / "testdata"
CUT = ["--cut", str(data / "thesis-cut.json")]
TABLE = str(data / "thesis-table-6-2.json")
SMALL = ["sdm-lobes", *CUT, "--speed", "9000:12000:3", "--depth", "0:2:3"]


def tools(folder):
    """Each tool with what it works on, so that each has something to write."""
    robot = ["--robot", str(data / "kr360.json")]
    fed = folder / "fed.json"
    fed.write_text(json.dumps(json.loads((data / "aluminium-cut.json").read_text()) | {"feed_per_tooth_mm": 0.1, "diameter_mm": 12}))
    return [
        [*SMALL, TABLE],
        ["fit-modes", "--synthesize", "800:1000:50", TABLE],
        ["joint-stiffness", *robot, str(data / "kr360-loads.csv")],
        ["rcsa-couple", str(data / "liu-assembly.json")],
        ["cut-force", str(fed)],
    ]


def run(command, limits=(), **more):
    """(status, standard output, lines of standard error) with limits of the system, (what, how much)."""
    def set_limits():
        for what, most in limits:
            resource.setrlimit(what, (most, most))
    done = subprocess.run(command, stdout=more.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE, preexec_fn=set_limits,
                          timeout=120, **more)
    return done.returncode, done.stdout, done.stderr.decode(errors="replace").splitlines()


def failed_with(name, status, pattern, command, **more):
    got, out, said = run(command, **more)
    errors = [line for line in said if ": warning: " not in line]
    check(name, got == status and not out and len(errors) == 1 and pattern in errors[0], f"status {got}, {said}")


def leftovers(folder):
    return [path.name for path in folder.iterdir() if path.name.startswith(".stablecut-")]


def outputs(folder):
    for command in tools(folder):
        tool = command[0]
        with open("/dev/full", "wb") as full:
            failed_with(f"{tool}: standard output on a full disk", 74, "No space left on device", command, stdout=full)
        failed_with(f"{tool}: a file on a full disk", 74, "No space left on device", [*command, "-o", "/dev/full"])
        failed_with(f"{tool}: a folder that is not there", 73, "cannot be created", [*command, "-o", str(folder / "no" / "x.json")])
        failed_with(f"{tool}: a folder that may not be written", 73, "cannot be created", [*command, "-o", "/proc/x.json"])
        failed_with(f"{tool}: a file is a folder", 73, "", [*command, "-o", str(folder)])
        old = folder / "old.json"
        old.write_text("old")
        failed_with(f"{tool}: files may not be that large", 74, "File too large", [*command, "-o", str(old)],
                    limits=[(resource.RLIMIT_FSIZE, 64)])
        check(f"{tool}: the old file is whole", old.read_text() == "old" and not leftovers(folder), old.read_text()[:50])
        got, _, said = run(["bash", "-c", '"$@" | true; exit ${PIPESTATUS[0]}', "x", *command])
        check(f"{tool}: a reader that leaves", got in (0, 141) and not any("error" in line for line in said), f"{got} {said}")
        for stream, name in ((0, "input"), (1, "output"), (2, "error")):
            got, _, said = run(["bash", "-c", f'exec {stream}<&-; exec "$@"', "x", *command])
            check(f"{tool}: standard {name} is closed", got == (74 if stream == 1 else 0), f"{got} {said}")


def full_disk(folder):
    """A file system of 64 KiB, where one may be mounted."""
    script = """mount -t tmpfs -o size=64k none "$1" && cd "$1" && echo old >old.json && head -c 40000 /dev/zero >filling &&
      { "${@:2}" -o old.json 2>"$0"; echo $? $(cat old.json) $(ls -A | grep -c stablecut-) $(cat "$0"); }"""
    disk = folder / "disk"
    disk.mkdir()
    wide = ["sdm-lobes", *CUT, "--speed", "9000:12000:40", "--depth", "0:2:100", TABLE]
    done = subprocess.run(["unshare", "--map-root-user", "--mount", "bash", "-c", script, str(folder / "said"), str(disk), *wide],
                          capture_output=True, text=True)
    if "74" not in done.stdout and done.returncode != 0:
        print(f"a full disk: skipped, no file system may be mounted here: {done.stderr.strip()[:100]}")
        return
    check("a full disk: the old file is whole", done.stdout.startswith("74 old 0 sdm-lobes: ")
          and "No space left" in done.stdout, done.stdout + done.stderr)


def signals(folder):
    target = folder / "signalled.json"
    long = ["sdm-lobes", *CUT, "--speed", "4000:20000:120", "--depth", "0:3:20", TABLE, "-o", str(target)]
    started = time.monotonic()
    run(long)
    whole = time.monotonic() - started
    new = target.read_bytes()
    for number, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGKILL, -9)):
        seen = set()
        for share in (0.02, 0.1, 0.3, 0.6, 0.9, 0.97, 1.0):
            target.write_bytes(b"old")
            # A job in the background has SIGINT ignored, and hands that on.
            process = subprocess.Popen(long, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       preexec_fn=lambda: [signal.signal(n, signal.SIG_DFL) for n in (signal.SIGINT, signal.SIGHUP)])
            time.sleep(share * whole)
            process.send_signal(number)
            process.wait(60)
            seen.add(process.returncode)
            check(f"signal {number.name} after {share} of the time: old or new", target.read_bytes() in (b"old", new))
            if number != signal.SIGKILL:
                check(f"signal {number.name}: no temporaries", not leftovers(folder), leftovers(folder))
        check(f"signal {number.name}: its status", seen <= {0, status} and status in seen, seen)
    for name in leftovers(folder):
        (folder / name).unlink()


def one_file(folder):
    """Input and output in one file; two runs that write one file."""
    both = folder / "both.json"
    shutil.copy(TABLE, both)
    run([*SMALL, str(both), "-o", str(both)])
    check("output over the input", json.loads(both.read_text())["format"] == "stablecut/lobes/1")
    one = folder / "one.json"
    runs = [[*SMALL, TABLE, "--modes", str(mode), "-o", str(one)] for mode in (14, 15)]
    wanted = []
    for command in runs:
        run(command)
        wanted.append(one.read_bytes())
    for _ in range(5):
        processes = [subprocess.Popen(command) for command in runs]
        statuses = [process.wait(60) for process in processes]
        check("two runs write one file: one of the two, whole", statuses == [0, 0] and one.read_bytes() in wanted)


def limits(folder):
    """Memory and files."""
    for most in range(8, 200, 12):
        got, out, said = run([*SMALL, TABLE], limits=[(resource.RLIMIT_AS, most << 20)])
        # Below, not even the libraries can be loaded.
        started = got != 127 and not any("error while loading" in line for line in said)
        check(f"{most} MiB of memory", not started or (got == 0 and out) or (got == 70 and not out and "out of memory" in said[-1]),
              f"{got} {said}")
    # Where the JSON library cannot throw.
    failed_with("memory for a document", 70, "fit-modes: out of memory", ["fit-modes", "--synthesize", "1:1000:2000000", TABLE],
                limits=[(resource.RLIMIT_AS, 400 << 20)])
    for most in range(3, 9):
        got, out, said = run([*SMALL, TABLE, "-o", str(folder / "few.json")], limits=[(resource.RLIMIT_NOFILE, most)])
        started = not any("error while loading" in line for line in said)
        check(f"{most} files", not started or got == 0 or (got in (66, 73, 74) and len(said) == 1), f"{got} {said}")


def inputs(folder):
    odd = os.fsencode(folder) + b"/b\xffad\x1b[31m.json"
    shutil.copy(TABLE, odd)
    got, out, said = run([*SMALL, odd])
    check("a name that is not UTF-8: in the provenance", got == 0 and "ad" in json.loads(out)["provenance"]["inputs"][1]["name"], said)
    with open(odd, "w") as file:
        file.write("x")
    got, out, said = run([*SMALL, odd])
    check("a name that is not UTF-8, in a message", got == 65 and "not a modal table" in said[0] and "\x1b" not in said[0], said)
    pipe = folder / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(["bash", "-c", f"cat '{TABLE}' > '{pipe}'"]):
        check("a FIFO", run([*SMALL, str(pipe)])[0] == 0)
    failed_with("an input without an end", 65, "expected at most 1 GiB", [*SMALL, "/dev/zero"])
    with subprocess.Popen(["bash", "-c", "head -c 1000000000 /dev/zero | tr '\\0' '['"], stdout=subprocess.PIPE) as brackets:
        failed_with("a gigabyte of brackets", 65, "nested too deeply", SMALL, stdin=brackets.stdout)
        brackets.stdout.close()
    failed_with("a folder", 66, "cannot be read", [*SMALL, str(folder)])
    failed_with("a name that is too long", 66, "cannot be read", [*SMALL, "x" * 5000])


def comma(folder):
    """A locale that writes a comma, where its source is installed."""
    made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / "de_DE.UTF-8")], capture_output=True)
    if made.returncode > 1:
        print("a comma locale: skipped, the locale's source (package locales) is not installed")
        return
    plain = run([*SMALL, TABLE])[1]
    environment = os.environ | {"LOCPATH": str(folder), "LC_ALL": "de_DE.UTF-8"}
    check("a comma locale changes nothing", run([*SMALL, TABLE], env=environment)[1] == plain)


def large(folder):
    """300 MB of a valid document: read, and an answer or a reason."""
    lines = 60_000
    numbers = ", ".join(f"{1e-7 + i * 1e-13:.17g}" for i in range(lines))
    zeros = ", ".join("0.0" + "0" * 60 for _ in range(lines))
    entries = [f'{{"response": "{a}", "reference": "{b}", "re": [{numbers if k == 0 else zeros}], "im": [{zeros}]}}'
               for k, (a, b) in enumerate(itertools.product("xyz", repeat=2))]
    frequency = ", ".join(f"{1 + i * 0.01:.2f}" for i in range(lines))
    padding = " " * (300_000_000 - sum(map(len, entries)) - len(frequency))
    path = folder / "large.json"
    path.write_text(f'{{"format": "stablecut/frf/1", "quantity": "receptance", "frequency_hz": [{frequency}], "h": [{", ".join(entries)}]'
                    + padding + "}")
    got, _, said = run(["fit-modes", "--convert", str(path), "-o", str(folder / "out.json")])
    check("300 MB of a document", got == 0 or (got in (1, 65) and len(said) >= 1), f"{got} {said[-1:]}")
    path.unlink()


def main():
    for part in (outputs, full_disk, signals, one_file, limits, inputs, comma, large):
        with tempfile.TemporaryDirectory() as name:
            part(pathlib.Path(name))
    finish()


if __name__ == "__main__":
    main()
