"""Reads docs/*.md, the pages of the project that they include, and the docstrings of `markermend.api`; Sphinx makes docs/_build/html of them.

Pages that lie elsewhere in the project, such as README.md, are included and not repeated. Their links are relative to where they lie;
here they lead to the pages of this site, else to a copy of the file. Each option is a target: {setting}`fill.max_gap_s` leads to its row.
"""

from __future__ import annotations

import posixpath
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

PROJECT = Path(__file__).parents[1]
sys.path.insert(0, str(PROJECT / "scripts"))

from markermend import __version__  # noqa: E402
from markermend.planning import option_tables  # noqa: E402
from markermend.planning.result_files import ResultFiles  # noqa: E402

project, author, copyright = "markermend", "markermend developers", "markermend developers"
release = version = __version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "numpydoc"]
exclude_patterns = ["_build", "_static", "_templates"]
templates_path = ["_templates"]
nitpicky = True
suppress_warnings = ["myst.header"]  # a part of a page may begin at any level

myst_enable_extensions = ["attrs_inline", "deflist", "substitution"]
myst_heading_anchors = 4

autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False

highlight_language = "none"
html_theme = "furo"
html_title = "markermend"
html_static_path, html_css_files = ["_static"], ["site.css"]
html_copy_source = html_show_sourcelink = html_show_sphinx = False

PAGES = {
    "README.md": "index.md",
    "config/README.md": "settings.md",
    "config/README.md#recordings": "own_data.md#a-folder-or-a-table-of-recordings",
    "config/README.md#decisions": "decisions.md",
    "benchmarks/README.md": "benchmarks.md",
    "CONTRIBUTING.md": "contributing.md",
    "DECISIONS.md": "design.md",
    "CHANGELOG.md": "changelog.md",
    "README.md#figures": "figures.md",
    "benchmarks/README.md#kinds-of-faults": "benchmarks.md#kinds-of-faults",
}
"""The page of this site that shows a page of the project."""

LINK = re.compile(
    r"(?P<code>(?P<ticks>`+).*?(?P=ticks))|(?<!!)\[(?P<words>[^\]]+)\]\((?!\w+:|#)(?P<file>[^)#\s]+)(?P<anchor>#[^)\s]*)?\)",
    re.S,
)
"""A link to another file of the project; what stands in backticks is none."""

HEADING = re.compile(r"^#{2,3} (?:`([\w.]+)`: )?")
"""The heading of a section of options, with its name where they have one."""

ROW = re.compile(r"^\| `([\w.]+)` \|")
"""The beginning of an option's row."""

FAULT = re.compile(r"^\| ([a-z][^|]*?) \| \d+ of \d+ \| \d+ of (\d+) \((\d+)\) \|", re.M)
"""A row of the two tables of kinds of faults in benchmarks/README.md: what is found now, and how much in the right class."""


WILDCARD = re.compile(r"\{(\w+)\}")
"""A part of a file's name that differs between subjects and recordings."""


def faults_found() -> dict[str, str]:
    """How many faults of each kind are found, in words: on calm recordings, then on moving ones."""
    rows = FAULT.findall((PROJECT / "benchmarks/README.md").read_text(encoding="utf-8"))
    calm, moving = ({kind: f"{right} of {all_}" for kind, all_, right in part} for part in halves(rows))
    return {kind: f"{calm[kind]} calm, {moving[kind]} moving" for kind in calm}


def halves(rows: list[tuple[str, str, str]]) -> tuple[list[tuple[str, str, str]], list[tuple[str, str, str]]]:
    """The rows of either table: the second begins where the first kind comes again."""
    second = [kind for kind, *_ in rows].index(rows[0][0], 1)
    return rows[:second], rows[second:]


def result_files() -> str:
    """A table of the files of results, from what the properties of their names say."""
    files, rows = ResultFiles("RESULTS"), ["| file | content |", "|---|---|"]
    for name, own in vars(ResultFiles).items():
        if isinstance(own, property):
            paths = getattr(files, name)
            listed = paths.values() if isinstance(paths, Mapping) else [paths]
            shown = "<br>".join(f"`{WILDCARD.sub(lambda found: found[1].upper(), path)}`" for path in listed)
            rows.append(f"| {shown} | {own.__doc__} |")
    return "\n".join(rows)


myst_substitutions = {"found": faults_found(), "result_files": result_files()}


def included(app: Sphinx, path: Path, docname: str, content: list[str]) -> None:
    """Make a page of the project part of this site."""
    page = (Path(app.srcdir) / path).resolve().relative_to(PROJECT)
    text = LINK.sub(lambda link: relocated(link, page), content[0])
    content[0] = with_targets(text) if page.as_posix() == "config/README.md" else text


def read(app: Sphinx, docname: str, content: list[str]) -> None:
    """Let links of this site's own pages be those of the project."""
    page = Path("docs", f"{docname}.md")
    if (PROJECT / page).exists():  # what autosummary makes is no Markdown
        content[0] = LINK.sub(lambda link: relocated(link, page), content[0])


def relocated(link: re.Match[str], page: Path) -> str:
    """A link of a page, relative to it, as it is on this site: to a page, to a copy of a file, or, for a folder, none."""
    if link["code"]:
        return link[0]
    words, anchor = link["words"], link["anchor"] or ""
    target = posixpath.normpath(posixpath.join(page.parent.as_posix(), link["file"]))
    if target + anchor in PAGES:
        return f"[{words}](/{PAGES[target + anchor]})"
    if target.startswith("docs/") and target.endswith(".md"):
        return f"[{words}](/{target.removeprefix('docs/')}{anchor})"
    if not (PROJECT / target).exists():
        raise FileNotFoundError(f"{page} links to {target}, which is not there")
    return f"[{words}](path:/../{target})" if (PROJECT / target).is_file() else words


def with_targets(page: str) -> str:
    """The tables of options with the full name of each option as the target of links."""
    before, begin, tables = page.partition(option_tables.BEGIN)
    section, lines = "", []
    for line in tables.split("\n"):
        heading, row = HEADING.match(line), ROW.match(line)
        if heading:
            section = f"{heading[1]}." if heading[1] else ""
        lines.append(ROW.sub(f'| `{row[1]}`{{id="{section}{row[1]}"}} |', line) if row else line)
    return before + begin + "\n".join(lines)


def note_settings(app: Sphinx, doctree: nodes.document) -> None:
    """Make the options of the settings page known to {setting}`...`."""
    if app.env.docname == "settings":
        for node in doctree.findall(nodes.literal):
            for name in node["names"]:
                app.env.domains.standard_domain.note_object("setting", name, node["ids"][0], location=node)


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect what stands above to Sphinx."""
    app.add_object_type("setting", "setting")
    app.connect("include-read", included)
    app.connect("source-read", read)
    app.connect("doctree-read", note_settings)
    return {"parallel_read_safe": True}
