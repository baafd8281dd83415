"""Pages for people: one for each recording, and one for the data set. Everything works offline, from any folder.

Names come from files and may be hostile: the templates escape them, embedded data cannot end its script element, and
links quote every part of a path.
"""

from __future__ import annotations

import importlib.util
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from markermend import __version__
from markermend.core.artifacts import ARTIFACTS
from markermend.planning.run_summary import STATUSES
from markermend.report.methods_text import REFERENCES

TEMPLATES = Path(__file__).with_name("templates")

COLUMNS = (
    "recording", "subject", "status", "stage", "reason", "source", "kind", "frames", "rate", "duration_s", "markers",
    "missing_share_before", "missing_share_after", "changed_samples", "changed_share", "repaired", "blanked",
    "findings_open", "filled", "gaps_open", "largest_change_mm", "expected_error_median_mm", "expected_error_max_mm", "warnings",
    "attention", "page",
)  # fmt: skip
"""The columns of summary.tsv."""


COUNTED = ("repaired", "blanked", "findings_open", "filled", "gaps_open")
"""The keys of a summary that hold a number of findings."""


def page(**parts: Any) -> str:
    """Write the page of a recording; parts: what page.html.j2 names."""
    summary = parts["summary"]
    detectors = {artifact.stage: f"{artifact.plural}: {artifact.text}" for artifact in ARTIFACTS}
    shown = {"rate": summary["rate"], "first_frame": summary["first_frame"]}
    return render("page.html.j2", detectors=detectors, references=REFERENCES, shown=shown, **parts)


def page_aside(summary: Mapping[str, Any]) -> str:
    """Write the page of a recording that was set aside."""
    return render("aside.html.j2", summary=summary)


def index(summaries: Sequence[Mapping[str, Any]]) -> str:
    """Write the page of the data set, from the summaries of its recordings in any order."""
    entries = [{**summary, "href": href(summary["page"])} for summary in ordered(summaries)]
    names = sorted({entry["subject"] for entry in entries})
    return render(
        "index.html.j2",
        entries=[entry for entry in entries if entry["status"] != "set aside"],
        aside=[entry for entry in entries if entry["status"] == "set aside"],
        total=totals(entries),
        subjects={name: totals([entry for entry in entries if entry["subject"] == name]) for name in names},
        texts=methods(entries),
        statuses=STATUSES,
        references=REFERENCES,
    )


def table(summaries: Sequence[Mapping[str, Any]]) -> str:
    """Write summary.tsv: one row per recording, worst first; counts in place of lists, empty cells for what is unknown."""
    rows = ["\t".join(COLUMNS)]
    rows += ["\t".join(cell(summary.get(column)) for column in COLUMNS) for summary in ordered(summaries)]
    return "\n".join(rows) + "\n"


def cell(value: Any) -> str:
    """Write one value as a cell on one line."""
    if isinstance(value, Mapping):
        value = value["events"]
    elif isinstance(value, list):
        value = len(value)
    return "" if value is None else " ".join(str(value).split())


def ordered(summaries: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Sort recordings, those set aside first, then by the attention that they want."""
    return sorted(summaries, key=lambda s: (-s.get("attention", float("inf")), s["subject"], s["recording"]))


def totals(entries: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Add up recordings: how many of each status, samples, changes, and what was missing."""
    done = [entry for entry in entries if entry["status"] != "set aside"]
    sizes = [entry["frames"] * entry["markers"] for entry in done]
    samples = sum(sizes)

    def share(key: str) -> float:
        return sum(e[key] * size for e, size in zip(done, sizes, strict=True)) / samples if samples else 0.0

    return {
        **{status: sum(entry["status"] == status for entry in entries) for status in STATUSES},
        "recordings": len(entries),
        "samples": samples,
        "changed_samples": sum(entry["changed_samples"] for entry in done),
        "changed_share": share("changed_share"),
        "missing_share_before": share("missing_share_before"),
        "missing_share_after": share("missing_share_after"),
        **{key: sum(entry[key]["events"] for entry in done) for key in COUNTED},
    }


def methods(entries: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Give each different methods text once, with the number of recordings that it holds for, most first."""
    texts = {entry["methods"]["text"]: entry["methods"] for entry in entries if "methods" in entry}
    counts = Counter(entry["methods"]["text"] for entry in entries if "methods" in entry)
    order = sorted(texts, key=lambda text: (-counts[text], text))
    return [{**texts[text], "recordings": counts[text]} for text in order]


def href(path: str) -> str:
    """Link from the report to a page; path: relative to the results."""
    return "../" + "/".join(quote(part, safe="") for part in path.split("/"))


def plotly_script() -> Path:
    """Path of the plotting script that the installed package plotly carries; the package is not imported."""
    found = importlib.util.find_spec("plotly")
    if found is None or found.origin is None:
        raise FileNotFoundError("the package plotly is not installed: install it (envs/base.yaml) and run again")
    return Path(found.origin).parent / "package_data" / "plotly.min.js"


def render(template: str, **parts: Any) -> str:
    """Fill in a template."""
    return environment().get_template(template).render(version=__version__, **parts) + "\n"


@cache
def environment() -> Environment:
    """Set up the templates: everything is escaped, and a name that is not there is an error."""
    made = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters.update(embed=embed, figure=figure, short=short, count=count, percent=percent, tojson_text=compact)
    return made


def compact(value: Any) -> str:
    """Write JSON on one line, with sorted keys."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def embed(value: Any) -> Markup:
    """Write JSON that is safe inside a script element: no character of it can end the element or start another."""
    escaped = compact(value)
    for character in "<>&":
        escaped = escaped.replace(character, f"\\u{ord(character):04x}")
    return Markup(escaped)


def figure(value: float | None, digits: int) -> str:
    """Write a number with so many decimals; an en dash where there is none."""
    return "–" if value is None else f"{value:.{digits}f}"


def short(value: float | None) -> str:
    """Write a number with the decimals that it needs; an en dash where there is none."""
    return "–" if value is None else f"{value:.10g}"


def count(value: int) -> str:
    """Write a whole number with thin spaces between its thousands."""
    return f"{value:,}".replace(",", "\u202f")


def percent(share: float) -> str:
    """Write a share as a percentage; what is not quite 0 or 100 never looks like it."""
    value = 100 * share
    if 0 < value < 0.05:
        return "<0.1"
    if 99.95 <= value < 100:
        return ">99.9"
    return f"{value:.1f}"
