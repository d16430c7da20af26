"""Every schema is a schema, and its fields are in the manual; bundled documents and what the tools write validate; what is wrong does not."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

from jsonschema import Draft202012Validator

source = pathlib.Path(os.environ["SOURCE"])
schemas = {path.name.removesuffix(".schema.json"): json.loads(path.read_text())
           for path in (source / "schemas").glob("*.schema.json")}
passed = failed = 0


def check(name, errors, valid=True):
    global passed, failed
    errors = [str(getattr(error, "message", error))[:200] for error in errors]
    if bool(errors) != valid:
        passed += 1
    else:
        failed += 1
        print(f"FAILED: {name}: {errors[:2] or 'no error'}")


def kind_of(document):
    return document["format"].split("/")[1]


def validate(name, document, valid=True):
    check(name, Draft202012Validator(schemas[kind_of(document)]).iter_errors(document), valid)


def run(*command, stdin=None):
    return json.loads(subprocess.run(command, input=stdin, capture_output=True, text=True, check=True).stdout)


assert schemas, "no schemas found"
for kind, schema in schemas.items():
    Draft202012Validator.check_schema(schema)
    constant = schema["properties"]["format"]["const"]
    check(f"{kind}: names itself", [] if constant == f"stablecut/{kind}/1" else [ValueError(constant)])
    for tool in ("fit-modes", "sdm-lobes", "joint-stiffness", "best-pose", "rcsa-couple", "cut-force"):
        printed = run(tool, "--print-schema", kind)
        check(f"{tool} prints {kind}", [] if printed == schema else [ValueError("another schema")])

# Each field has a description, and all are in stablecut(5), to which every tool's page sends its reader.
with tempfile.TemporaryDirectory() as folder:
    page = pathlib.Path(folder) / "page"
    written = subprocess.run([source / "scripts/derive/document_fields.py", page], capture_output=True, text=True)
    check("every field has a description", [ValueError(written.stderr)] if written.returncode else [])
    check("stablecut.5 is what scripts/derive/document_fields.py writes",
          [] if page.read_text() == (source / "apps/stablecut.5").read_text() else [ValueError("another page")])

# Documents have a format; the other files are the papers' and the controller's numbers.
bundled = [path for path in (source / "testdata").rglob("*.json") if "format" in json.loads(path.read_text())]
assert bundled, "no bundled documents found"
for path in bundled:
    validate(path.name, json.loads(path.read_text()))

table = str(source / "testdata/thesis-table-6-2.json")
cut = str(source / "testdata/thesis-cut.json")
tap = run("fit-modes", "--synthesize", "2:1000:1500", "--noise-db", "40", table)
modes = run("fit-modes", stdin=json.dumps(tap))
chart = ["--speed", "9000:12000:3", "--depth", "0:2:4"]
documents = {
    "synthesized frf": tap,
    "fitted table": modes,
    "coupled frf": run("rcsa-couple", "--slopes", str(source / "testdata/liu-assembly.json")),
    "assembly": json.loads((source / "testdata/liu-assembly.json").read_text()),
    "tip on a measured spindle": run("rcsa-couple", str(source / "testdata/carbide-in-collet.json")),
    "identified joint": run("rcsa-couple", "--identify", str(source / "testdata/carbide-tap.json"),
                            str(source / "testdata/carbide-in-collet.json")),
    "lobes": run("sdm-lobes", "--cut", cut, *chart, "--per-mode", "--modes", "1,15", "--points",
                 str(source / "testdata/thesis-table-6-3.csv"), table),
    "lobes by sdm, limit only": run("sdm-lobes", "--cut", cut, *chart, "--method", "sdm", "--limit-only", table),
}

fed = json.loads((source / "testdata/thesis-cut.json").read_text()) | {"feed_per_tooth_mm": 0.1}
slots = (source / "testdata/slot-forces.csv").read_text()
with tempfile.TemporaryDirectory() as folder:
    forces = pathlib.Path(folder) / "forces.csv"
    tool = str(source / "testdata/slotting-tool.json")
    identify = ["cut-force", "--identify", str(forces), tool]
    forces.write_text(slots)
    documents["identified cut"] = run(*identify)
    forces.write_text("\n".join(line for line in slots.splitlines() if line[0] == "f" or ",0.03," in line))
    documents["identified cut, edges held"] = run(*identify, "--edges", "cut")
documents |= {
    "force": run("cut-force", stdin=json.dumps(fed)),
    "force with points": run("cut-force", "--speed", "9000", "--table", table, "--points",
                             str(source / "testdata/thesis-table-6-3.csv"), "--passes", "100", stdin=json.dumps(fed)),
}
with tempfile.TemporaryDirectory() as folder:
    slow = pathlib.Path(folder) / "slow.csv"
    slow.write_text("1,0.01\n1,20000\n")
    documents["a point without an answer"] = run("cut-force", "--table", table, "--points", str(slow), "--passes", "64",
                                                 stdin=json.dumps(fed))

papers = json.loads((source / "testdata/yanshan-poses.json").read_text())
robot = ["--robot", str(source / "testdata/kr360.json"), "--quiet"]
stiffness = run("joint-stiffness", *robot, str(source / "testdata/kr360-loads.csv"))
partial = {"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": papers["k_theta_2d_n_m_per_rad"][:5] + [None]}
poses = {"format": "stablecut/pose-list/1", "poses": [{"joints_deg": pose["joints_deg"]} for pose in papers["height_1600_mm"]]
         + [{"joints_deg": [0, -60, 0, 0, 0, 0]}]}
with tempfile.TemporaryDirectory() as folder:
    diagram_path = pathlib.Path(folder) / "diagram.json"
    documents["best model"] = run("fit-modes", "--model", "best", "--stabilization", str(diagram_path), stdin=json.dumps(tap))
    documents["stabilization diagram"] = json.loads(diagram_path.read_text())
    modes_path = pathlib.Path(folder) / "modes.json"
    modes_path.write_text(json.dumps(documents["best model"]))
    documents["table at fixed poles"] = run("fit-modes", "--poles", str(modes_path), "--poles-are", "fixed", "--exclude", "1:3,5:6",
                                            stdin=json.dumps(tap))
    documents["table with residual terms"] = run("fit-modes", "--residuals", "--band", "30:1000", stdin=json.dumps(tap))
    diagonal = tap | {"h": [entry for entry in tap["h"] if entry["response"] == entry["reference"]]}
    documents["table of shared poles"] = run("fit-modes", "--shared-poles", stdin=json.dumps(diagonal))
liu = json.loads((source / "testdata/liu-assembly.json").read_text())
documents["assembly on a wall"] = liu | {"holder": "fixed"}
documents["assembly on a wall in x"] = liu | {"holder": {"x": {"end": "fixed"}, "y": liu["holder"]}}
taps = json.loads((source / "testdata/spindle-taps.json").read_text())
kept = [i for i, hz in enumerate(taps["frequency_hz"]) if not 280 < hz < 340]
for series in [taps, *taps["h"]]:
    for name in {"frequency_hz", "re", "im", "variance"} & series.keys():
        series[name] = [series[name][i] for i in kept]
gap = json.loads((source / "testdata/carbide-in-collet.json").read_text())
gap["holder"]["end"]["receptances"] = taps
documents["tip on taps with a gap"] = run("rcsa-couple", stdin=json.dumps(gap))
assert documents["tip on taps with a gap"]["holder"]["x"]["interpolated"]
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, str(source / "apps/fit-modes/simulate_taps.py"), folder], check=True)
    hits = run("fit-modes", "--taps", f"x={folder}/x.csv", "--tap-window", "5", "--convert")
    assert hits["covariances"] and hits["window_decay_per_s"] == 5
    documents["frf of hits"] = hits
    documents["table of hits"] = run("fit-modes", stdin=json.dumps(hits))
    one, other = pathlib.Path(folder) / "one.json", pathlib.Path(folder) / "other.json"
    one.write_text(json.dumps(documents["table of hits"]))
    documents["tracked table"] = run("fit-modes", "--track", str(one), str(one))
    other.write_text(json.dumps(documents["tracked table"]))
    documents["comparison"] = run("fit-modes", "--compare", str(other), str(one))
    documents["lobes of tracked modes"] = run("sdm-lobes", "--cut", cut, *chart, "--per-mode", str(other))
    assert documents["lobes of tracked modes"]["per_mode"][0]["mode_label"] == "m1"
with tempfile.TemporaryDirectory() as folder:
    list_path, map_path = pathlib.Path(folder) / "poses.json", pathlib.Path(folder) / "map.json"
    list_path.write_text(json.dumps(poses))
    stiffness_path = pathlib.Path(folder) / "stiffness.json"
    stiffness_path.write_text(json.dumps(stiffness))
    search = ["best-pose", *robot, "--height", "1600", "--x", "0:2500:6", "--y", "0:2500:6", "--force", "0,0,-600"]
    scored = run("best-pose", *robot, "--evaluate", str(list_path), stdin=json.dumps(stiffness))
    documents |= {
        "robot by URDF": run(str(source / "scripts/import-urdf"), str(source / "testdata/six-axis.urdf")),
        "load samples": {"format": "stablecut/load-samples/1", "frame": "base", "samples": [
            {"joints_deg": pose["joints_deg"], "force_n": [0, 0, -600], "deflection_mm": [0, 0, -0.2], "std_mm": 0.01}
            for pose in papers["height_1600_mm"]]},
        "identified stiffness": stiffness,
        "stiffness of the user": partial,
        "poses": poses,
        "plan": run("joint-stiffness", *robot, "--plan", "6", stdin=json.dumps(poses)),
        "pose": run(*search, "--map", str(map_path), stdin=json.dumps(stiffness)),
        "pose in any plane": run("best-pose", *robot, "--plane-origin", "2000,0,1500", "--plane-x", "0,1,0", "--plane-y",
                                 "0,0,1", "--tool-axis", "1,0,0", stdin=json.dumps(stiffness)),
        "evaluation": scored,
        "pose map": json.loads(map_path.read_text()),
        "path": run("best-pose", *robot, "--path", str(source / "testdata/zigzag-path.json"), "--force", "200,400,-150",
                    "--force-frame", "feed", stdin=json.dumps(stiffness)),
        "path with places": run("best-pose", *robot, "--path", str(source / "testdata/zigzag-path.json"), "--place=-900:900:3,0:0:1,0:90:2",
                                str(stiffness_path)),
        "path in parts": run("best-pose", *robot, "--path", "-", "--plane-origin", "2300,0,1600", "--path-speed", "50",
                             "--partial", str(stiffness_path), stdin="".join(f"{20 * i} 0 0\n" for i in range(31))),
        "tool path": json.loads((source / "testdata/zigzag-path.json").read_text()),
    }
spindle = json.loads((source / "testdata/carbide-in-collet.json").read_text())
taps = json.loads((source / "testdata/spindle-taps.json").read_text())
spindle["holder"] = {"receptances": {**taps, "h": [e for e in taps["h"] if e["response_position_mm"] == 0]}}
bar = str(source / "testdata/liu-assembly.json")
tip = run("rcsa-couple", bar)
bounds = ["rcsa-couple", "--quiet", "--bounds", "k1=1e5:9e7,c1=0:1", "--identify", "-", bar]
documents |= {
    "tip by a finite difference": run("rcsa-couple", "--quiet", stdin=json.dumps(spindle)),
    "joint in one direction": run("rcsa-couple", "--identify", "-", bar, stdin=json.dumps({**tip, "h": tip["h"][:1]})),
    "joint at its bounds": run(*bounds, stdin=json.dumps(tip)),
}
for model in ("base", "three-axis"):
    documents[f"stiffness, model {model}"] = run(
        "joint-stiffness", *robot, "--model", model, str(source / "testdata/kr360-loads.csv"))
documents["springs and discrepancy of the user"] = partial | {
    "model": "three-axis", "discrepancy": {"relative": 0.1, "absolute_um": 20},
    "springs": [{"name": "base.x", "compliance_m_per_n": 1e-8}, {"name": "A2.y", "compliance_rad_per_n_m": None}]}
documents["stiffness where one load leaves joints unseen"] = run(
    "joint-stiffness", *robot, stdin=json.dumps(documents["load samples"]))
required = {"cut": "teeth", "cut-force": "mean_force_n", "frf": "h", "modal-table": "modes", "mode-comparison": "pairs", "lobes": "limit", "robot": "tool", "load-samples": "samples",
            "joint-stiffness": "stiffness_n_m_per_rad", "pose-list": "poses", "measurement-plan": "samples", "pose": "index",
            "pose-map": "score", "pose-path": "points", "tool-path": "points", "assembly": "tool", "tool-joint": "x", "stabilization": "orders"}
# A joint in one direction has its values at the root.
assert set(required) == set(schemas), "a kind without an example"
for name, document in documents.items():
    validate(name, document)
    broken = dict(document)
    field = required[kind_of(document)]
    del broken[field if field in document else "k1_n_per_m"]
    validate(f"{name} with a field missing", broken, valid=False)

print(f"{passed} passed, {failed} failed")
sys.exit(1 if failed else 0)
