#!/usr/bin/python3
"""document_fields.py [FILE]: apps/stablecut.5, the manual page of all fields of all documents, from schemas/*.schema.json.

A field without a description ends it with status 1.
"""
import json
import pathlib
import sys

from pictures import output_path

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMAS = {path.name.removesuffix(".schema.json"): json.loads(path.read_text())
           for path in sorted((ROOT / "schemas").glob("*.schema.json"))}
TYPES = {"string": "text", "boolean": "true or false", "array": "list"}
undescribed = []


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def sentence(text):
    return roff(text) + "."


def bounds(schema):
    words = [f"{sign} {schema[name]}" for name, sign in (("exclusiveMinimum", "above"), ("minimum", "at least"),
                                                         ("exclusiveMaximum", "below"), ("maximum", "at most")) if name in schema]
    return " " + ", ".join(words) if words else ""


def form(schema):
    """What a value may be, in words."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        return "[re, im]" if name == "complex" else name
    if "const" in schema:
        return json.dumps(schema["const"])
    if "enum" in schema:
        return " or ".join("null" if value is None else str(value) for value in schema["enum"])
    if "oneOf" in schema:
        return " or ".join(dict.fromkeys(filter(None, map(form, schema["oneOf"]))))
    types = [schema["type"]] if isinstance(schema.get("type"), str) else schema.get("type", [])
    words = []
    for name in types:
        if name == "array":
            count = f" of {schema['minItems']}" if schema.get("minItems") == schema.get("maxItems") and "minItems" in schema else ""
            of = form(schema.get("items", {}))
            words.append(f"list{count}" + (f" ({of})" if of else ""))
        else:
            words.append(TYPES.get(name, name) + (bounds(schema) if name in ("number", "integer") else ""))
    return " or ".join(words)


def inner(schema):
    """The schemas with fields of their own inside a value."""
    if not isinstance(schema, dict):
        return
    if "properties" in schema:
        yield schema
    for name in ("items", "additionalProperties"):
        yield from inner(schema.get(name))
    for choice in schema.get("oneOf", []):
        yield from inner(choice)


def fields(kind, schema):
    told = set()
    for group in inner(schema):
        for name, field in group["properties"].items():
            if name in ("format", "label", "provenance") and group is SCHEMAS[kind]:
                continue
            if name in told and "description" not in field:
                continue  # what a choice asks of a field that stands above
            told.add(name)
            if "description" not in field:
                undescribed.append(f"{kind}: {name}")
            optional = "" if name in group.get("required", []) else ", optional"
            print(f".TP\n\\fB{roff(name)}\\fP: {roff(form(field) + optional)}\n{sentence(field.get('description', ''))}", file=page)
            names = {inside for part in inner(field) for inside in part["properties"]}
            if name != kind and name in SCHEMAS and names and names <= set(SCHEMAS[name]["properties"]):
                print(f"Fields as in {name}.", file=page)
            elif names:
                print(".RS", file=page)
                fields(kind, field)
                print(".RE", file=page)


def section(name, kind, schema, what):
    print(f".SS {roff(name)}\n{sentence(what)}", file=page)
    fields(kind, schema)


with open(output_path("apps/stablecut.5"), "w", encoding="utf-8") as page:
    print(r""".\" Written by scripts/derive/document_fields.py from schemas/*.schema.json: change those.
.TH STABLECUT 5 "" stablecut "stablecut manual"
.SH NAME
stablecut \- all fields of the documents
.SH DESCRIPTION
What each field of a document holds. Which tool writes and reads a kind says
.BR stablecut (7);
.B \-\-print\-schema
.I KIND
of every tool prints the same as JSON Schema. Units are the ends of the names; without one a number is a ratio. Fields without "optional" have to be
there, beside
.IR format .
A form that is no type
.RI ( segment )
has a section of its own under its kind.
A field that is not known is an error unless it begins with
.IR x_ .
Every document may have a
.IR label " and a " provenance .
.SH DOCUMENTS""", file=page)
    for kind, schema in SCHEMAS.items():
        section(kind, kind, schema, schema["title"])
        for name, part in schema.get("$defs", {}).items():
            if name not in ("provenance", "complex"):
                section(f"{kind}: {name}", kind, part, part.get("description", f"inside {kind}"))
    common = SCHEMAS["frf"]
    section("label", "frf", {}, common["properties"]["label"]["description"])
    section("provenance", "frf", common["$defs"]["provenance"], common["$defs"]["provenance"]["description"])
    print(".SH SEE ALSO\n.BR stablecut (7)", file=page)
if undescribed:
    sys.exit("document_fields.py: expected a description of " + ", ".join(undescribed))
