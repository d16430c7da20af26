"""The page: one HTML file that carries its data, its script and the chart library, and asks no network for anything."""

import base64
import hashlib
import html
import json
import mimetypes
import pathlib
import re

import markdown

from . import kinds, robots
from .documents import Refused

HERE = pathlib.Path(__file__).resolve().parent
# Debian's package libjs-chart.js: Chart.js 3.9.1.
LIBRARY = pathlib.Path("/usr/share/javascript/chart.js/chart.min.js")
LICENCE = pathlib.Path("/usr/share/doc/libjs-chart.js/copyright")


def _escaped(value):
    if isinstance(value, bool):
        value = "yes" if value else "no"
    long = isinstance(value, float) or isinstance(value, int) and abs(value) >= 1e7
    text = "" if value is None else f"{value:.6g}" if long else str(value)
    # Half a character, of a file name or of JSON's escapes, has no place in a page.
    return html.escape(text.encode("utf-8", "replace").decode())


def _data(charts):
    """Charts as JSON that cannot end the element that carries it. Abscissas that curves share stand in it once, each curve says which."""
    abscissas = {}
    charts = [one | {"curves": [curve | {"x": abscissas.setdefault(tuple(curve["x"]), len(abscissas))} for curve in one["curves"]]} for one in charts]
    text = json.dumps({"charts": charts, "abscissas": list(abscissas)}, separators=(",", ":"), allow_nan=False)
    # Of numbers alone: 1e-07 is 1e-7.
    text = re.sub(r'"(?:[^"\\]|\\.)*"|e-0', lambda found: "e-" if found[0] == "e-0" else found[0], text)
    return text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")


def _table(table):
    head = "".join(f"<th>{_escaped(name)}</th>" for name in table["head"])
    rows = "".join("<tr>" + "".join(
        f'<td class="number">{_escaped(cell)}</td>' if isinstance(cell, (int, float)) and not isinstance(cell, bool) else f"<td>{_escaped(cell)}</td>"
        for cell in row) + "</tr>" for row in table["rows"])
    return f'<h3>{_escaped(table["title"])}</h3><div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'


def _section(section, charts):
    parts = [f"<section><h2>{_escaped(section['title'])}</h2>"]
    if section["facts"]:
        parts.append("<dl>" + "".join(f"<dt>{_escaped(name)}</dt><dd>{_escaped(value)}</dd>" for name, value in section["facts"]) + "</dl>")
    for chart in section["charts"]:
        shape = "drawing square" if chart.get("equal") else "drawing"
        note = f"<figcaption>{_escaped(chart['note'])}</figcaption>" if "note" in chart else ""
        title = _escaped(chart["title"])
        parts.append(f'<figure><h3>{title}</h3><div class="{shape}"><canvas data-chart="{len(charts)}" role="img" aria-label="{title}"></canvas>'
                     f'<div class="hover" role="status" hidden></div></div>{note}</figure>')
        charts.append(chart)
    parts += [_table(table) for table in section["tables"]]
    return "".join(parts) + "</section>"


def _provenance(documents):
    """What came from what: of each document the run that wrote it, its inputs below."""
    given = {document.sha256: document.name for document in documents}

    def run(provenance, sha256):
        if not provenance:
            return ""
        arguments = " ".join(provenance["arguments"])
        inputs = "".join(
            f"<li>{_escaped(one['name'])} <code>{_escaped(one['sha256'][:12])}</code>"
            + (f" (in this page: {_escaped(given[one['sha256']])})" if one["sha256"] in given and one["sha256"] != sha256 else "")
            + run(one.get("from"), sha256) + "</li>" for one in provenance["inputs"])
        return f"<ul><li>{_escaped(provenance['tool'])} {_escaped(provenance['version'])} <code>{_escaped(arguments)}</code><ul>{inputs}</ul></li></ul>"

    items = "".join(f"<li><b>{_escaped(d.name)}</b> {_escaped(d.kind)} <code>{d.sha256[:12]}</code>"
                    + (run(d.content.get("provenance"), d.sha256) or "<ul><li>no provenance: written by hand, or left out</li></ul>") + "</li>" for d in documents)
    return ('<section class="provenance"><h2>Provenance</h2><p>What each document came from; the digits begin the SHA-256 sum of the file.</p>'
            f"<ul>{items}</ul></section>")


def _text(path):
    """Markdown to HTML. HTML in it stands as text; pictures beside it are packed into the page."""
    try:
        source = pathlib.Path(path).read_text()
    except (OSError, UnicodeDecodeError):
        raise Refused(f"{path}: cannot be read", 66) from None
    converter = markdown.Markdown(extensions=["tables"], extension_configs={"tables": {"use_align_attribute": True}})
    converter.preprocessors.deregister("html_block")
    converter.inlinePatterns.deregister("html")

    def packed(match):
        name = html.unescape(match.group(1))
        kind = mimetypes.guess_type(name)[0]
        picture = pathlib.Path(path).parent / name
        if kind not in ("image/svg+xml", "image/png"):
            raise Refused(f"{path}: {name}: expected a picture that ends in .svg or .png")
        try:
            return f'src="data:{kind};base64,{base64.b64encode(picture.read_bytes()).decode()}"'
        except OSError:
            raise Refused(f"{path}: {name}: cannot be read", 66) from None

    page = re.sub(r'<a href="(?!https?://|#)[^"]*"', "<a", converter.convert(source))
    return re.sub(r'src="([^"]*)"', packed, page)


def sections(documents):
    """In the order of the documents; what belongs together stands together at the first of its kind."""
    of_kind = {}
    for document in documents:
        of_kind.setdefault(document.kind, []).append(document)
    poses, paths = of_kind.get("pose", []), of_kind.get("pose-path", [])
    one_each = {"lobes": kinds.lobes, "modal-table": kinds.modal_table, "stabilization": kinds.stabilization, "pose": robots.pose,
                "joint-stiffness": robots.joint_stiffness, "tool-joint": robots.tool_joint, "pose-path": robots.pose_path,
                "cut-force": robots.cut_force, "pose-map": lambda document: robots.pose_map(document, poses, paths)}
    found = []
    for kind, several in of_kind.items():
        if kind == "frf":
            found.append(kinds.frf(several))
            continue
        if kind == "lobes" and len(several) > 1:
            found.append(kinds.all_lobes(several))
        found += [one_each.get(kind, robots.anything)(document) for document in several]
    return found


def page(title, documents, text=None):
    """The whole HTML text. Raises Refused."""
    try:
        library, licence = LIBRARY.read_text(), LICENCE.read_text()
    except OSError as error:
        raise Refused(f"{error.filename}: the chart library is missing (Debian package libjs-chart.js)", 70) from None
    scripts = [library, (HERE / "page.js").read_text()]
    style = (HERE / "page.css").read_text()
    charts = []
    body = (_text(text) if text else "") + "".join(_section(one, charts) for one in sections(documents))
    # Only these scripts and this style, by their sums: nothing that a document says can run.
    sums = [base64.b64encode(hashlib.sha256(part.encode()).digest()).decode() for part in (*scripts, style)]
    policy = (f"default-src 'none'; script-src {' '.join(f'&#39;sha256-{one}&#39;' for one in sums[:-1])}; "
              f"style-src &#39;sha256-{sums[-1]}&#39;; img-src data:; base-uri 'none'; form-action 'none'")
    heading = "" if text else f"<h1>{_escaped(title)}</h1>"
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{policy}">'
            f'<meta name="viewport" content="width=device-width"><title>{_escaped(title)}</title><style>{style}</style></head>\n'
            f"<body>{heading}{body}{_provenance(documents)}"
            f"<footer><p>Charts are drawn by Chart.js 3.9.1, packed into this page; its licence:</p><pre>{_escaped(licence)}</pre></footer>\n"
            f'<script type="application/json" id="charts">{_data(charts)}</script>\n'
            + "".join(f"<script>{script}</script>\n" for script in scripts) + "</body></html>\n")
