"""The experiment with operators: what a person found against what the algorithm finds in the same recording (skurowski2022, 4.1.2, E2).

A finding of a person is confirmed if the algorithm finds anything on this marker that shares a frame with it. One of the algorithm is confirmed
if a person found the same class there: the paper's expert judged the classification.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd

from markermend import api
from markermend.core.artifacts import BY_NAME
from markermend.core.decisions import EVER
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.evaluation.classification import CLASSES
from markermend.export.change_table import COLUMNS as COLUMNS_OF_CHANGES
from markermend.planning.decision_table import COLUMNS as COLUMNS_OF_DECISIONS
from markermend.planning.recordings import BadDataSet
from markermend.planning.tables import read_table
from markermend.simulation.published_contamination import contaminate_coordinates

COLUMNS = (
    "recording",
    "operator",
    "preset",
    "class",
    "human",
    "algorithm",
    "human_confirmed",
    "same_class",
    "algorithm_confirmed",
    "only_human",
    "only_algorithm",
)
"""Columns of the table of findings."""

REQUIRED = ("recording", "marker", "decision")
"""The columns that a table of decisions must have."""

REQUIRED_OF_FINDINGS = ("recording", "marker", "first_frame", "last_frame", "class")
"""The columns that a table of findings must have."""

EVERY = "all"
"""Name of the row over all classes."""


@dataclass(frozen=True)
class Agreement:
    """How the findings of a person and of the algorithm agree, in numbers of findings.

    Attributes
    ----------
    human, algorithm : int
        What each found.
    human_confirmed : int
        What the person found and the algorithm finds, too, in whatever class.
    same_class : int
        Those of them that have the same class.
    algorithm_confirmed : int
        What the algorithm found and the person found, too, in the same class; the paper's expert approves it.
    only_human, only_algorithm : int
        What the other did not find, or the algorithm in another class: missed, and rejected, in the words of the paper.
    """

    human: int
    algorithm: int
    human_confirmed: int
    same_class: int
    algorithm_confirmed: int
    only_human: int
    only_algorithm: int


def synthetic_operator(
    clean: Recording, *, amplitude_mm: float, share_percent: float, rng: np.random.Generator
) -> tuple[Recording, dict[str, Sequence[Event]]]:
    """Make a recording with artifacts, and the findings of a person who sees all of them.

    Parameters
    ----------
    clean : Recording
        The recording, cleaned and denoised.
    amplitude_mm : float
        Mean amplitude, mm.
    share_percent : float
        Share of the time that each class distorts, %.
    rng : Generator
        Source of randomness.

    Returns
    -------
    recording : Recording
        The contaminated recording.
    findings : dict of str to sequence of Event
        What was put in, by class.
    """
    made = contaminate_coordinates(
        clean.positions, clean.markers, amplitude=amplitude_mm, share=share_percent / 100, rng=rng
    )
    return replace(clean, positions=made.positions), dict(made.events)


def read_operator(path: Path, name: str, recording: Recording) -> dict[str, list[Event]]:
    """Read what a person found.

    Parameters
    ----------
    path : Path
        Either a table of decisions (config/README.md), of which the lines `accept` and `class` with a class are what was found, or a table of
        findings: the columns `recording`, `marker`, `first_frame`, `last_frame` and `class`, and those of changes.tsv.
    name : str
        The recording as the table calls it.
    recording : Recording
        The recording.

    Returns
    -------
    dict of str to list of Event
        The findings by detector; lines without a class or without frames are left out.

    Raises
    ------
    BadOptions or BadDataSet
        With lines that mean nothing or contradict each other.
    """
    header = path.read_text(encoding="utf-8-sig").partition("\n")[0]
    read = _read_findings if "class" in re.split("[\t,;]", header.strip()) else _read_decisions
    found: dict[str, list[Event]] = {}
    for stage, event in read(path, name, recording):
        found.setdefault(stage, []).append(event)
    return found


def _read_decisions(path: Path, name: str, recording: Recording) -> Iterator[tuple[str, Event]]:
    """The findings in a table of decisions."""
    rows = read_table(str(path), what="decisions", columns=COLUMNS_OF_DECISIONS, required=REQUIRED)
    lines = [
        {column: text for column, text in row.items() if column not in ("recording", "subject")}
        for _, row in rows
        if row["recording"] == name
    ]
    for decision in api.read_decisions(lines, recording):
        artifact = BY_NAME.get(decision.value.partition(":")[0])
        if decision.verb not in ("accept", "class") or artifact is None or abs(decision.start) == EVER:
            continue
        for marker in recording.markers:
            if decision.matches(marker):
                yield artifact.stage, Event(marker, decision.start, decision.stop, 1.0)


def _read_findings(path: Path, name: str, recording: Recording) -> Iterator[tuple[str, Event]]:
    """The findings in a table of findings; what is no artifact, such as a filled gap, is left out."""
    for number, row in read_table(
        str(path), what="findings", columns=COLUMNS_OF_CHANGES, required=REQUIRED_OF_FINDINGS
    ):
        artifact = BY_NAME.get(row.get("class", ""))
        if row["recording"] != name or artifact is None:
            continue
        if row["marker"] not in recording.markers:
            raise BadDataSet(
                f"findings: {path} line {number} names marker {row['marker']!r}, which {name} does not have"
            )
        start, stop = (int(row[column]) - recording.first_frame for column in ("first_frame", "last_frame"))
        yield artifact.stage, Event(row["marker"], start, stop + 1, 1.0)


def compare(human: Mapping[str, Sequence[Event]], algorithm: Mapping[str, Sequence[Event]]) -> dict[str, Agreement]:
    """Compare the findings of a person with those of the algorithm.

    Parameters
    ----------
    human, algorithm : mapping of str to sequence of Event
        The findings by class; other classes than CLASSES are of the algorithm's alone, or of the person's.

    Returns
    -------
    dict of str to Agreement
        By class, and over EVERY class. Events of one group count once each.
    """
    people = [(kind, event) for kind, own in human.items() for event in own]
    machine = [(kind, event) for kind, own in algorithm.items() for event in own]
    confirmed = [_confirmed(kind, event, machine) for kind, event in people]
    known = [_confirmed(kind, event, people)[1] for kind, event in machine]
    table = {}
    for chosen in (*_classes(human, algorithm), EVERY):
        mine = [found for (kind, _), found in zip(people, confirmed, strict=True) if chosen in (kind, EVERY)]
        theirs = [found for (kind, _), found in zip(machine, known, strict=True) if chosen in (kind, EVERY)]
        both = sum(found for found, _ in mine)
        same = sum(same for _, same in mine)
        shared = sum(theirs)
        table[chosen] = Agreement(len(mine), len(theirs), both, same, shared, len(mine) - both, len(theirs) - shared)
    return table


def agreement_rows(recording: str, operator: str, preset: str, agreements: Mapping[str, Agreement]) -> pd.DataFrame:
    """Arrange a comparison as a table.

    Parameters
    ----------
    recording, operator, preset : str
        Names of the recording, the person, and the detectors.
    agreements : mapping of str to Agreement
        See compare.

    Returns
    -------
    DataFrame
        The columns COLUMNS, one row for each class.
    """
    rows = [{"class": kind, **vars(own)} for kind, own in agreements.items()]
    return pd.DataFrame(rows).assign(recording=recording, operator=operator, preset=preset)[list(COLUMNS)]


def _classes(human: Mapping[str, Sequence[Event]], algorithm: Mapping[str, Sequence[Event]]) -> list[str]:
    """The classes of the paper, then others in which anything was found."""
    others = [
        kind for kind in {**human, **algorithm} if kind not in CLASSES and (human.get(kind) or algorithm.get(kind))
    ]
    return [*CLASSES[1:], *others]


def _confirmed(kind: str, event: Event, others: Sequence[tuple[str, Event]]) -> tuple[bool, bool]:
    """Whether an event shares frames with another of this marker, and with one of the same class."""
    sharing = [
        name for name, own in others if own.marker == event.marker and own.start < event.stop and event.start < own.stop
    ]
    return bool(sharing), kind in sharing
