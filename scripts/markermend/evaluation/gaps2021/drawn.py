"""Runs: the same recording with other gaps in each (skurowski2021, section 3.5)."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace

from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.randomness import generator
from markermend.simulation.published_gaps import draw_gaps, hide

log = logging.getLogger("markermend")


@dataclass(frozen=True)
class Run:
    """A recording with gaps.

    Attributes
    ----------
    length : int
        Mean length of its gaps, frames.
    number : int
        Number of the run.
    gaps : sequence of Event
        The gaps, in the order of time.
    hidden : Recording
        The recording without their samples.
    """

    length: int
    number: int
    gaps: Sequence[Event]
    hidden: Recording


def make_runs(name: str, clean: Recording, options: Gaps2021Options, *, numbers: Sequence[int], seed: int) -> list[Run]:
    """Hide gaps in a recording, in each run at random; methods do not matter.

    Parameters
    ----------
    name : str
        Name of the recording.
    clean : Recording
        The recording.
    options : Gaps2021Options
        Mean lengths and number of gaps.
    numbers : sequence of int
        Numbers of the runs of each length.
    seed : int
        Equal seeds give equal gaps.

    Returns
    -------
    list of Run
        The runs of all lengths but those for which the recording has no room.
    """
    runs = []
    for length in options.mean_lengths:
        for number in numbers:
            rng = generator(seed, name, length, number)
            try:
                gaps = draw_gaps(clean.missing, clean.markers, mean_length=length, rng=rng, count=options.gaps)
            except ValueError as error:
                log.warning("%s: %s", name, error)
                break
            hidden = replace(clean, positions=hide(clean.positions, clean.markers, gaps))
            runs.append(Run(length, number, gaps, hidden))
    return runs
