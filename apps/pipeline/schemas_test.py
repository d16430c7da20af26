"""Every schema is a schema; bundled documents and what the tools write validate; what is wrong does not."""

import json
import os
import pathlib
import subprocess
import sys

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
    for tool in ("fit-modes", "sdm-lobes"):
        printed = run(tool, "--print-schema", kind)
        check(f"{tool} prints {kind}", [] if printed == schema else [ValueError("another schema")])

bundled = [path for path in (source / "testdata").rglob("*.json")]
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
    "lobes": run("sdm-lobes", "--cut", cut, *chart, "--per-mode", "--modes", "1,15", "--points",
                 str(source / "testdata/thesis-table-6-3.csv"), table),
    "lobes by sdm, limit only": run("sdm-lobes", "--cut", cut, *chart, "--method", "sdm", "--limit-only", table),
}
for name, document in documents.items():
    validate(name, document)
    broken = dict(document)
    del broken[{"frf": "h", "modal-table": "modes", "lobes": "limit"}[kind_of(document)]]
    validate(f"{name} with a field missing", broken, valid=False)

print(f"{passed} passed, {failed} failed")
sys.exit(1 if failed else 0)
