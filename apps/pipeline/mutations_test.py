"""What a damaged input does to a tool: a status of the contract, one line that names the file and the place, nothing on
standard output unless the status is 0, then a document of its schema; in bounded time and memory. Every second of all
`mutations` of a small document or table of each kind that a tool reads; with STABLECUT_MUTATIONS=N every Nth."""

import concurrent.futures
import itertools
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile

from jsonschema import Draft202012Validator

import mutations

source = pathlib.Path(os.environ["SOURCE"])
every = int(os.environ.get("STABLECUT_MUTATIONS", "2"))
data = source / "testdata"
validators = {path.name.removesuffix(".schema.json"): Draft202012Validator(json.loads(path.read_text()))
              for path in (source / "schemas").glob("*.schema.json")}
sanitized = bool(os.environ.get("STABLECUT_SANITIZED"))
# Of a processor, so that a busy machine fails nothing; by the clock ten times as long. A cut whose limits lie at a millionth of the depths
# takes 6 s at each of three speeds.
SECONDS = 300 if sanitized else 60
# The address sanitizer reserves terabytes of addresses.
MEMORY = None if sanitized else 2 << 30


# What a tool wrote is read in part: names that nobody looks at may be anything there.
READ_IN_PART = ("pose", "part of a chart", "joint-stiffness")


def bundled(name):
    return json.loads((data / name).read_text())


def output_of(*command):
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def written(folder, name, document):
    path = folder / name
    path.write_text(document if isinstance(document, str) else json.dumps(document))
    return str(path)


def subjects(folder):
    """(name, text to damage, function of the damaged file's path that gives the command)."""
    table = bundled("thesis-table-6-2.json")
    table["modes"] = table["modes"][13:15]
    two = written(folder, "two-modes.json", table)
    small = ["--speed", "9000:12000:3", "--depth", "0:2:3", "--threads", "1"]
    cut = str(data / "thesis-cut.json")
    fed = bundled("thesis-cut.json") | {"feed_per_tooth_mm": 0.1, "kte_n_per_mm": 5, "diameter_mm": 12}
    everything = fed | {"pitch_deg": [170, 190], "runout_um": [1, -1], "helix_deg": 20, "process_damping_n_per_m": 1e3,
                        "process_damping_friction": 0.3, "kt_std_n_per_mm2": 10, "kr_std_n_per_mm2": 10}
    fed_path = written(folder, "fed.json", fed)
    robot = ["--robot", str(data / "kr360.json"), "--quiet"]
    loads = (data / "kr360-loads.csv").read_text()
    stiffness_path = written(folder, "stiffness.json", output_of("joint-stiffness", *robot, str(data / "kr360-loads.csv")))
    stiffness = json.loads(pathlib.Path(stiffness_path).read_text())
    own = {"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": [1e6, 2e6, 2e6, 2e5, 2e5, None],
           "discrepancy": {"relative": 0.1, "absolute_um": 20, "force_n": 500}, "springs": [
               {"name": "base.x", "compliance_m_per_n": 1e-8}, {"name": "A2.y", "compliance_rad_per_n_m": None}]}
    listed = {"format": "stablecut/pose-list/1",
              "poses": [{"joints_deg": pose["joints_deg"]} for pose in bundled("yanshan-poses.json")["height_1600_mm"][:4]]}
    poses = written(folder, "poses.json", listed)
    scored = output_of("best-pose", *robot, "--evaluate", poses, stiffness_path)
    scored["evaluated"] = scored["evaluated"][:1]
    path = bundled("zigzag-path.json")
    path["points"] = path["points"][:3]
    tap = output_of("fit-modes", "--synthesize", "820:980:24", "--noise-db", "40", two)
    assembly = bundled("liu-assembly.json")
    sizes = bundled("carbide-in-collet.json")
    sizes["holder"]["end"]["receptances"]["file"] = str(data / "spindle-taps.json")
    samples = {"format": "stablecut/load-samples/1", "frame": "base", "samples": [
        {"joints_deg": pose["joints_deg"], "force_n": [10, 20, -600], "deflection_mm": [0.01, 0.02, -0.2], "std_mm": 0.01}
        for pose in bundled("yanshan-poses.json")["height_1600_mm"]]}
    points = [{"depth_mm": 1, "speed_rpm": 20000}, {"depth_mm": 2, "speed_rpm": 5000, "observed": "chatter"}]
    part = output_of("sdm-lobes", "--cut", cut, *small, "--shard", "1/2", two)
    other = written(folder, "part2.json", output_of("sdm-lobes", "--cut", cut, *small, "--shard", "2/2", two))
    lobes = ["sdm-lobes", *small]
    evaluated = ["best-pose", *robot, "--evaluate", poses]
    return [
        ("modal-table", table, lambda file: [*lobes, "--cut", cut, file]),
        ("modal-table of a simulation", table, lambda file: ["cut-force", "--table", file, "--speed", "9000", "--depth", "0.5",
                                                             "--passes", "20", fed_path]),
        ("cut", everything, lambda file: [*lobes, "--limit-only", "--cut", file, two]),
        ("cut of a force", everything, lambda file: ["cut-force", file]),
        ("cut of poses", fed, lambda file: [*evaluated, "--cut", file, "--cut-depth", "1", "--feed", "1,0,0", stiffness_path]),
        ("points", points, lambda file: [*lobes, "--cut", cut, "--points", file, two]),
        ("points as CSV", "1,20000\n2,5000\n1.5,9000\n", lambda file: [*lobes, "--cut", cut, "--points", file, two]),
        ("part of a chart", part, lambda file: [*lobes, "--cut", cut, "--merge", file, "--merge", other, two]),
        ("pose", scored, lambda file: [*lobes, "--cut", fed_path, "--surface", "--static", file, two]),
        ("forces", (data / "slot-forces.csv").read_text(), lambda file: ["cut-force", "--identify", file,
                                                                         str(data / "slotting-tool.json")]),
        ("frf", tap, lambda file: ["fit-modes", "--quiet", file]),
        ("load samples", samples, lambda file: ["joint-stiffness", *robot, "--model", "base", file]),
        ("load samples as CSV", loads, lambda file: ["joint-stiffness", *robot, "--model", "base", file]),
        ("robot", bundled("kr360.json"), lambda file: ["best-pose", "--quiet", "--robot", file, "--evaluate", poses, stiffness_path]),
        ("robot of loads", bundled("kr360.json"), lambda file: ["joint-stiffness", "--quiet", "--model", "base", "--robot", file,
                                                                str(data / "kr360-loads.csv")]),
        ("joint-stiffness", stiffness, lambda file: [*evaluated, file]),
        ("joint-stiffness of the user", own, lambda file: [*evaluated, file]),
        ("pose-list", listed, lambda file: ["best-pose", *robot, "--evaluate", file, stiffness_path]),
        ("tool-path", path, lambda file: ["best-pose", *robot, "--path", file, stiffness_path]),
        ("assembly", assembly, lambda file: ["rcsa-couple", "--quiet", file]),
        ("assembly on a spindle", sizes, lambda file: ["rcsa-couple", "--quiet", file]),
    ]


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    if MEMORY:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def fault(command, file, what, all_names):
    """What is wrong with a run on a damaged file; None where nothing is. `all_names`: no name may be wrong."""
    try:
        run = subprocess.run(command, capture_output=True, timeout=10 * SECONDS, preexec_fn=limited)
    except subprocess.TimeoutExpired:
        return f"not done after {10 * SECONDS} s"
    if run.returncode == -signal.SIGKILL:
        return f"not done after {SECONDS} s of a processor"
    said = run.stderr.decode(errors="replace").splitlines()
    # A field that an option needs is missing: the option is wrong. A file that a document names is not there.
    asked = run.returncode == 64 and re.match(r"\S+: --\S+: expected \S+ and \S+ in the cut ", said[-1])
    absent = run.returncode == 66 and "/file " in what
    if run.returncode not in (0, 1, 65) and not asked and not absent:
        return f"status {run.returncode}: {said[-1:]}"
    if any(not line.startswith(f"{command[0]}: ") for line in said):
        return f"a line that does not begin with the tool's name: {said}"
    if any(not char.isprintable() for line in said for char in line):
        return f"characters for the terminal: {said}"
    if run.returncode == 0:
        if all_names and " misspelt " in what and not what.startswith("/provenance"):
            return "a misspelt name is taken"
        try:
            document = json.loads(run.stdout)
        except ValueError:
            return "status 0 without a document"
        broken = next(validators[document["format"].split("/")[1]].iter_errors(document), None)
        return broken and f"the output breaks its schema: {broken.json_path}: {broken.message[:200]}"
    if run.stdout:
        return f"status {run.returncode}, and something on standard output"
    errors = [line for line in said if not line.startswith(f"{command[0]}: warning: ")]
    if len(errors) != 1:
        return f"{len(errors)} lines of an error: {errors}"
    named = "|".join(re.escape(part) for part in command if os.path.exists(part))
    if run.returncode == 65 and not re.search(rf"({named}): (/|line \d|empty|expected|.*at byte \d)", errors[0]):
        return f"without the file and the place: {errors[0]}"
    return None


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        cases = 0
        faults = []

        def judged(case):
            number, (title, command_for, (what, text)) = case
            file = written(folder, f"case-{number}", text)
            found = fault(command_for(file), file, what, title not in READ_IN_PART)
            os.remove(file)
            return found and f"{title}: {what}: {found}".replace(str(folder) + "/", "")

        # Charts of unequal pitches with a helix and process damping take minutes under a sanitizer.
        every_case = ((title, command_for, damage) for title, whole, command_for in subjects(folder) if not (sanitized and title == "cut")
                      for damage in (mutations.of_table if isinstance(whole, str) else mutations.of_document)(whole))
        chosen = enumerate(itertools.islice(every_case, 0, None, every))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for found in pool.map(judged, chosen):
                cases += 1
                if found:
                    faults.append(found)
                    print(f"FAILED: {found}", flush=True)
    print(f"{cases - len(faults)} of {cases} damaged inputs handled as they should be")
    sys.exit(bool(faults) or cases == 0)


if __name__ == "__main__":
    main()
