"""The experiment with operators: what a person found against what the algorithm finds in the same recording (skurowski2022, 4.1.2, E2).

A finding of a person is confirmed if the algorithm finds anything on this marker that shares a frame with it. One of the algorithm is confirmed
if a person found the same class there: the paper's expert judged the classification.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.evaluation.classification import CLASSES
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
