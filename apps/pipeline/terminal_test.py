"""At a terminal: a bar with the time left, one line that says what went into a file; nothing of both elsewhere."""

import json
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.environ["SOURCE"], "apps"))
from testing import check, finish

data = pathlib.Path(os.environ["SOURCE"]) / "testdata"
TABLE, CUT = str(data / "thesis-table-6-2.json"), ["--cut", str(data / "thesis-cut.json")]
CHART = ["sdm-lobes", TABLE, *CUT, "--speed", "9000:12000:3", "--depth", "0:2:3"]


def at_terminal(command, until=None):
    """(status, what standard error, a terminal, has shown); with `until` it is interrupted once it has shown that."""
    master, slave = pty.openpty()
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=slave)
    os.close(slave)
    shown = b""
    while select.select([master], [], [], 120)[0]:
        try:
            more = os.read(master, 4096)
        except OSError:  # the other end is closed
            break
        if not more:
            break
        shown += more
        if until is not None and re.search(until, shown):
            process.send_signal(signal.SIGINT)
            until = None
    os.close(master)
    return process.wait(), shown.decode()


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    fed = folder / "fed.json"
    fed.write_text(json.dumps(json.loads((data / "thesis-cut.json").read_text()) | {"feed_per_tooth_mm": 0.1}))
    papers = json.loads((data / "yanshan-poses.json").read_text())
    poses = folder / "poses.json"
    poses.write_text(json.dumps({"format": "stablecut/pose-list/1",
                                 "poses": [{"joints_deg": pose["joints_deg"]} for pose in papers["height_1600_mm"]]}))
    robot, stiffness = ["--robot", str(data / "kr360.json")], str(folder / "stiffness")
    collet = [str(data / "carbide-tap.json"), str(data / "carbide-in-collet.json")]
    number = r"-?[0-9.e+-]+"
    for file, command, expected in [
            ("lobes", CHART, f"(stable at every speed of the chart below {number} mm; )?most removed at {number} mm, {number} rpm"),
            ("part", [*CHART, "--shard", "1/2"], "a part of a chart"),
            ("tap", ["fit-modes", "--synthesize", "2:300:600", TABLE], "4 curves, 600 lines, 2 to 300 Hz"),
            ("modes", ["fit-modes", "--band", "2:60", str(folder / "tap")], f"[0-9]+ modes, {number} to {number} Hz"),
            ("force", ["cut-force", "--depth", "0.5", "--speed", "9000", str(fed)],
             f"mean force {number}, {number}, 0 N, peak {number} N"),
            ("cut", ["cut-force", "--identify", str(data / "slot-forces.csv"), str(data / "slotting-tool.json")],
             f"Kt {number}, Kr {number} N/mm2"),
            ("stiffness", ["joint-stiffness", *robot, str(data / "kr360-loads.csv")],
             f"6 of 6 joints identified, residual {number} um RMS"),
            ("plan", ["joint-stiffness", *robot, "--plan", "6", str(poses)], "measurement-plan"),
            ("pose", ["best-pose", *robot, "--height", "1600", "--x", "1500:1700:2", "--y", "0:0:1", stiffness],
             f"weakest {number} N/m at {number}(, {number}){{5}} deg"),
            ("evaluated", ["best-pose", *robot, "--evaluate", str(poses), stiffness], "[0-9]+ poses evaluated"),
            ("motion", ["best-pose", *robot, "--path", str(data / "zigzag-path.json"), "--force", "200,400,-150", stiffness],
             f"[0-9]+ points, the worst deflection {number} um"),
            ("joint", ["rcsa-couple", "--identify", *collet], f"x: k1 {number} N/m, k2 {number} N m/rad; y: .*")]:
        output = str(folder / file)
        status, shown = at_terminal([*command, "-o", output])
        # The bar, if there was one, has been wiped away.
        lines = [line for line in re.sub("\r[^\r\n]*\x1b\\[K", "", shown).splitlines() if ": warning: " not in line]
        found = len(lines) == 1 and re.fullmatch(f"{command[0]}: {re.escape(output)}: {expected}", lines[0])
        check(f"{file}: a summary", status == 0 and found, f"{status}, {shown!r}")

    for name, command in [("standard output", CHART), ("--quiet", [*CHART, "--quiet", "-o", str(folder / "quiet.json")])]:
        status, shown = at_terminal(command)
        check(f"{name}: nothing to say", status == 0 and "mm" not in shown, f"{status}, {shown!r}")
    done = subprocess.run([*CHART, "-o", str(folder / "file.json")], capture_output=True, text=True)
    check("no terminal: nothing to say", done.returncode == 0 and "mm" not in done.stderr and not done.stdout, done.stderr)
    status, shown = at_terminal(["sdm-lobes", TABLE, *CUT, "--samples", "4900", "-o", str(folder / "long.json")], rb"[0-9] %, [0-9hmin ]+ s?.*left")
    check("a bar with the time left", status == 130 and re.search("\rsdm-lobes: [a-z]+ \\[", shown), f"{status}, {shown[-300:]!r}")
finish()
