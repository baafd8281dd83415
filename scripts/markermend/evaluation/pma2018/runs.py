"""The runs of the experiments: hide concurrent gaps, fill them with each method, and measure the errors (tits2018, Experiments)."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import pandas as pd

from markermend import api
from markermend.core.recording import Recording
from markermend.evaluation.pma2018.fillings import fill_by_methods
from markermend.evaluation.pma2018.jobs import Condition
from markermend.evaluation.pma2018.methods import Method
from markermend.evaluation.randomness import generator
from markermend.filling.gap import Gap
from markermend.numerics.intervals import samples
from markermend.options.filling import FillOptions
from markermend.prediction.scene import Scene
from markermend.simulation.concurrent_gaps import draw_concurrent_gaps, draw_fragment

log = logging.getLogger("markermend")

RUN_COLUMNS = (
    "recording", "procedure", "gaps", "length_s", "duration_s", "run", "marker", "start", "method", "error_mm"
)  # fmt: skip
"""Columns of the table of runs: one row for each gap and method; `start` is a frame of the whole recording."""

LIFTED: Mapping[str, Any] = {
    "fill": {
        "max_gap_s": None,
        "fill_ends": True,
        "min_seen_share": 0,
        "max_error_mm": None,
        "max_error95_mm": None,
        "max_altered_share": 1,
    },
    "advanced": {"fill": {"border_s": 0}},
}
"""Options by which filling refuses no gap."""

GapErrors = Iterator[tuple[str, dict[Gap, float]]]
"""For each method its name and its mean distance from the true positions in each gap, mm; NaN where it cannot fill it."""


@dataclass(frozen=True)
class Job:
    """What is run.

    Attributes
    ----------
    recording : str
        Name of the recording.
    procedure : str
        What fills the gaps.
    condition : Condition
        The gaps.
    """

    recording: str
    procedure: str
    condition: Condition


@dataclass(frozen=True)
class HiddenGaps:
    """A recording, or a fragment of one, in which concurrent gaps are hidden.

    Attributes
    ----------
    whole : Recording
        The recording before they were hidden.
    gaps : tuple of Gap
        The gaps, those of markers that are seen most first, as filling takes them.
    first_frame : int
        The frame of the whole recording at which it begins.
    """

    whole: Recording
    gaps: tuple[Gap, ...]
    first_frame: int = 0

    @cached_property
    def positions(self) -> np.ndarray:
        """Positions without the gaps, (frames, markers, 3), mm."""
        positions = self.whole.positions.copy()
        for gap in self.gaps:
            positions[gap.samples] = np.nan
        return positions

    def error(self, gap: Gap, filled: np.ndarray) -> float:
        """Compute the mean distance of positions from the true ones.

        Parameters
        ----------
        gap : Gap
            One of the gaps.
        filled : ndarray, shape (n, 3)
            Positions in the gap, mm.

        Returns
        -------
        float
            Its error, mm; NaN where a position is unknown.

        References
        ----------
        tits2018, eq 28.
        """
        return float(np.linalg.norm(filled - self.whole.positions[gap.samples], axis=1).mean())


def hide_gaps(recording: Recording, condition: Condition, *, rng: np.random.Generator) -> HiddenGaps:
    """Draw a fragment of a recording, if the condition wants one, and gaps in it.

    Parameters
    ----------
    recording : Recording
        The recording; it is not modified.
    condition : Condition
        Number and length of the gaps, duration of the fragment.
    rng : Generator
        Source of randomness.

    Returns
    -------
    HiddenGaps
        The fragment and its gaps.

    Raises
    ------
    ValueError
        Where there is no room for the gaps.
    """
    start, stop = 0, recording.frames
    if condition.duration_s is not None:
        start, stop = draw_fragment(recording.frames, duration_s=condition.duration_s, rate=recording.rate, rng=rng)
    fragment = replace(recording, positions=recording.positions[start:stop], unlabelled={})
    length = samples(condition.length_s, recording.rate)
    events = draw_concurrent_gaps(fragment.missing, fragment.markers, count=condition.gaps, length=length, rng=rng)
    gaps = [Gap(fragment.markers.index(event.marker), event.start, event.stop) for event in events]
    missing = fragment.missing.sum(axis=0)
    ordered = sorted(gaps, key=lambda gap: (missing[gap.marker], gap.marker))
    return HiddenGaps(fragment, tuple(ordered), start)


def published_errors(hidden: HiddenGaps, methods: Sequence[Method], options: FillOptions) -> GapErrors:
    """Fill the gaps by published methods, for which every marker is a neighbour of every other.

    Parameters
    ----------
    hidden : HiddenGaps
        The gaps.
    methods : sequence of Method
        The methods.
    options : FillOptions
        Options of a published preset.

    Yields
    ------
    str, dict of Gap to float
        See GapErrors.
    """
    markers = np.arange(len(hidden.whole.markers))
    scene = Scene(hidden.positions, hidden.whole.rate, [np.delete(markers, marker) for marker in markers])
    for method, filled in fill_by_methods(scene, hidden.gaps, methods, options).items():
        yield method.name, {gap: hidden.error(gap, positions) for gap, positions in filled.items()}


def default_errors(hidden: HiddenGaps) -> GapErrors:
    """Fill the gaps by our ensemble, with the mesh that is inferred from what is left.

    Parameters
    ----------
    hidden : HiddenGaps
        The gaps.

    Yields
    ------
    str, dict of Gap to float
        See GapErrors.
    """
    options = api.Options.read(LIFTED)
    gapped = replace(hidden.whole, positions=hidden.positions)
    mesh = api.infer_mesh([gapped])
    filled = api.fill(api.repair(gapped, mesh, {}, options), mesh, options).recording
    yield "default", {gap: hidden.error(gap, filled.positions[gap.samples]) for gap in hidden.gaps}


def run_rows(
    recording: Recording, job: Job, fill: Callable[[HiddenGaps], GapErrors], *, runs: Iterable[int], seed: int
) -> pd.DataFrame:
    """Hide gaps in a recording again and again, and fill them.

    Parameters
    ----------
    recording : Recording
        The recording; it is not modified.
    job : Job
        Its name, what fills the gaps, and the condition.
    fill : callable
        Fills hidden gaps.
    runs : iterable of int
        Numbers of the runs.
    seed : int
        Equal seeds give equal gaps, whatever fills them.

    Returns
    -------
    DataFrame
        The columns RUN_COLUMNS; no rows where the recording is too short, or has too few markers.
    """
    condition = job.condition
    rows = []
    if condition.duration_s is None or recording.frames >= samples(condition.duration_s, recording.rate):
        for run in runs:
            try:
                hidden = hide_gaps(recording, condition, rng=generator(seed, job.recording, condition.name, run))
            except ValueError as error:
                log.warning("%s: %s", job.recording, error)
                break
            rows += [(run, *row) for row in _gap_rows(hidden, fill(hidden))]
    own = (job.recording, job.procedure, condition.gaps, condition.length_s, condition.duration_s)
    return pd.DataFrame([(*own, *row) for row in rows], columns=list(RUN_COLUMNS))


def _gap_rows(hidden: HiddenGaps, errors: GapErrors) -> Iterator[tuple[str, int, str, float]]:
    """Marker, first frame, method and error of each gap and method."""
    for method, of_gaps in errors:
        for gap, error in of_gaps.items():
            yield hidden.whole.markers[gap.marker], hidden.first_frame + gap.start, method, error
