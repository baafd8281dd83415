"""HTML pages: one for each recording, and one for the data set. They work offline, from any folder.

Names come from files and may be hostile: the templates escape them, embedded data cannot end its script element, and
links quote every part of a path.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from markermend import __version__
from markermend.planning.run_summary import STATUSES
from markermend.report.dataset_summary import distinct_methods, motion_advice, ordered, totals
from markermend.report.references import REFERENCES
from markermend.report.shared_warnings import find_shared_warnings
from markermend.report.template_filters import FILTERS

TEMPLATES = Path(__file__).with_name("templates")


def page(**parts: Any) -> str:
    """Write the page of a recording.

    Parameters
    ----------
    **parts : Any
        What page.html.j2 names.

    Returns
    -------
    str
        HTML.
    """
    summary = parts["summary"]
    shown = {"rate": summary["rate"], "first_frame": summary["first_frame"]}
    return render("page.html.j2", references=REFERENCES, shown=shown, **parts)


def page_aside(summary: Mapping[str, Any]) -> str:
    """Write the page of a recording that was set aside.

    Parameters
    ----------
    summary : mapping of str to Any
        Of the recording.

    Returns
    -------
    str
        HTML.
    """
    return render("aside.html.j2", summary=summary)


def index(summaries: Sequence[Mapping[str, Any]], unfinished: Sequence[str] = ()) -> str:
    """Write the page of the data set.

    Parameters
    ----------
    summaries : Sequence[Mapping[str, Any]]
        Of its recordings, in any order.
    unfinished : sequence of str, optional
        The folders of recordings that are not finished.

    Returns
    -------
    str
        HTML.
    """
    shared = find_shared_warnings(summaries)
    entries = [
        {**summary, "href": href(summary["page"]), "warnings": shared.without(summary.get("warnings", ()))}
        for summary in ordered(summaries)
    ]
    names = sorted({entry["subject"] for entry in entries})
    return render(
        "index.html.j2",
        entries=[entry for entry in entries if entry["status"] != "set aside"],
        aside=[entry for entry in entries if entry["status"] == "set aside"],
        unfinished=unfinished,
        total=totals(entries),
        subjects={name: totals([entry for entry in entries if entry["subject"] == name]) for name in names},
        advice=motion_advice(entries),
        shared=shared.texts(),
        texts=distinct_methods(entries),
        statuses=STATUSES,
        references=REFERENCES,
    )


def href(path: str) -> str:
    """Link from the report to a page.

    Parameters
    ----------
    path : str
        Of the page, relative to the results.

    Returns
    -------
    str
        The link, every part of it quoted.
    """
    return "../" + "/".join(quote(part, safe="") for part in path.split("/"))


def plotly_script() -> Path:
    """Find the plotting script of the installed package plotly, which is not imported.

    Returns
    -------
    Path
        Its path.

    Raises
    ------
    FileNotFoundError
        If the package is not installed.
    """
    found = importlib.util.find_spec("plotly")
    if found is None or found.origin is None:
        raise FileNotFoundError("the package plotly is not installed: install it (envs/base.yaml) and run again")
    return Path(found.origin).parent / "package_data" / "plotly.min.js"


def render(template: str, **parts: Any) -> str:
    """Fill in a template.

    Parameters
    ----------
    template : str
        Name of its file.
    **parts : Any
        What it names.

    Returns
    -------
    str
        HTML.
    """
    return environment().get_template(template).render(version=__version__, **parts) + "\n"


@cache
def environment() -> Environment:
    """Set up the templates: everything is escaped, and a name that is not given is an error.

    Returns
    -------
    Environment
        The environment, the same at every call.
    """
    made = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters.update(FILTERS)
    return made
