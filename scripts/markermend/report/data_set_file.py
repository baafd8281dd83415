"""The file that all pages of a report share: which recordings there are, in order, and the lines of the table of decisions.

It is a script and not JSON, since pages that are opened from a folder may load scripts and nothing else.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from markermend.planning.decision_table import COLUMNS
from markermend.planning.tables import read_table
from markermend.report.dataset_summary import ordered
from markermend.report.template_filters import compact


def read_decisions(path: Path) -> list[list[str]]:
    """Read the lines of the table of decisions.

    Parameters
    ----------
    path : Path
        The table.

    Returns
    -------
    list of list of str
        The cells of each line, by COLUMNS.

    Raises
    ------
    BadDataSet
        Where it is no table of decisions.
    """
    rows = read_table(str(path), what="decisions", columns=COLUMNS, required=("recording", "marker", "decision"))
    return [[row.get(column, "") for column in COLUMNS] for _, row in rows]


def data_set_script(summaries: Sequence[Mapping[str, Any]], decisions: Sequence[Sequence[str]]) -> str:
    """Write the file.

    Parameters
    ----------
    summaries : sequence of mapping
        Of the recordings.
    decisions : sequence of sequence of str
        The lines of the table of decisions.

    Returns
    -------
    str
        JavaScript that sets `markermendDataSet`: `columns` and `decisions` of the table; of the `recordings`, worst first, the path of the
        page and the names of recording and subject.
    """
    recordings = [[summary["page"], summary["recording"], summary["subject"]] for summary in ordered(summaries)]
    content = {"columns": list(COLUMNS), "decisions": list(decisions), "recordings": recordings}
    return f"globalThis.markermendDataSet = {compact(content)};\n"
