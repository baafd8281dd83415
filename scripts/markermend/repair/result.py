"""A recording while it is repaired: every sample that is written, and every finding that is left, is recorded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from markermend.core.artifacts import class_of
from markermend.core.changes import DECIMALS, Alternative, Change, Outcome, largest
from markermend.core.events import Event
from markermend.core.reasons import Reason
from markermend.core.recording import ADOPTED, MEASURED, MISSING, ORIGINS, Recording, Restored
from markermend.core.rulings import Ruling
from markermend.options.repair import RepairRadiusOptions
from markermend.repair.candidates import Candidate


class Restoration:
    """The result of a repair as it grows.

    Parameters
    ----------
    recording : Recording
        The recording as it is to be repaired; never modified.
    left : iterable of Change
        What is already known about stretches that are not repaired.
    radius : RepairRadiusOptions
        Radii of the balls in standard deviations.
    adopted : ndarray of bool, shape (frames, markers), optional
        The samples of the recording that were taken over from unlabelled trajectories; by default none.

    Attributes
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions as repaired so far, mm, NaN = missing.
    """

    def __init__(
        self,
        recording: Recording,
        left: Iterable[Change],
        radius: RepairRadiusOptions,
        *,
        adopted: np.ndarray | None = None,
    ) -> None:
        self._recording, self._radius = recording, radius
        self.positions = recording.positions.copy()
        self._origin = np.where(recording.missing, MISSING, MEASURED).astype(np.uint8)
        if adopted is not None:
            self._origin[adopted & ~recording.missing] = ADOPTED
        self._error = np.where(recording.missing, np.nan, 0.0)
        self._repairs: list[Change] = []
        self._left = list(left)

    @property
    def markers(self) -> tuple[str, ...]:
        """Names of the markers."""
        return self._recording.markers

    def write(
        self, stage: str, event: Event, taken: Candidate, candidates: Iterable[Candidate], ruling: Ruling
    ) -> None:
        """Write a candidate where the marker was seen.

        Parameters
        ----------
        stage : str
            The detector of the finding.
        event : Event
            The finding.
        taken : Candidate
            The candidate that is taken.
        candidates : iterable of Candidate
            All candidates for the finding.
        ruling : Ruling
            The ruling on the finding.
        """
        m, proposal = self.markers.index(event.marker), taken.proposal
        seen = ~np.isnan(self.positions[event.start : event.stop, m]).any(axis=1)
        rows = np.flatnonzero(seen) + event.start
        self.positions[rows, m] = proposal.positions[seen]
        name = class_of(stage, event).name
        self._origin[rows, m] = ORIGINS.index(name)
        self._error[rows, m] = proposal.error[seen]
        change = _change(event, (name,), Outcome.REPAIRED, ruling)
        self._repaired(replace(change, method=proposal.method, alternatives=alternatives(candidates)), rows)

    def exchange(self, cycle: Sequence[Event], ruling: Ruling) -> None:
        """Give each marker of a cycle the original samples of its partner.

        Parameters
        ----------
        cycle : sequence of Event
            The exchanges, all over the same interval.
        ruling : Ruling
            The ruling on the finding.
        """
        span = slice(cycle[0].start, cycle[0].stop)
        index = self.markers.index
        own, partners = [index(event.marker) for event in cycle], [index(str(event.partner)) for event in cycle]
        self.positions[span, own] = self._recording.positions[span, partners]
        missing = np.isnan(self.positions[span, own]).any(axis=2)
        taken = self._origin[span, partners] == ADOPTED
        self._origin[span, own] = np.where(missing, MISSING, np.where(taken, ADOPTED, ORIGINS.index("swap")))
        self._error[span, own] = np.where(missing, np.nan, 0.0)
        for event in cycle:
            change = _change(event, ("swap",), Outcome.EXCHANGED, ruling)
            self._repaired(replace(change, method="swap"), np.arange(event.start, event.stop))

    def move_back(self, event: Event, moved: np.ndarray, error: np.ndarray, ruling: Ruling) -> None:
        """Move the samples of a marker back that were displaced.

        Parameters
        ----------
        event : Event
            The finding, which states its class.
        moved : ndarray of float, shape (n, 3)
            Its samples, moved back, mm.
        error : ndarray of float, shape (n,)
            Standard deviation per axis, mm.
        ruling : Ruling
            The ruling on the finding.
        """
        m, name = self.markers.index(event.marker), class_of("frames", event).name
        own = np.flatnonzero(~np.isnan(self.positions[event.start : event.stop, m]).any(axis=1))
        rows = own + event.start
        self._error[rows, m] = error[own]
        self.positions[rows, m] = moved[own]
        self._origin[rows, m] = ORIGINS.index(name)
        self._repaired(replace(_change(event, (name,), Outcome.REPAIRED, ruling), method="move_back"), rows)

    def leave(
        self,
        event: Event,
        classes: tuple[str, ...],
        reason: Reason,
        ruling: Ruling,
        *,
        blank: bool,
        candidates: Iterable[Candidate] = (),
    ) -> None:
        """Record that a stretch was not repaired.

        Parameters
        ----------
        event : Event
            The finding, or what stands for several.
        classes : tuple of str
            Names of the classes that it was found to be.
        reason : Reason
            Why it was not repaired.
        ruling : Ruling
            The ruling on the finding.
        blank : bool
            Whether its samples become missing.
        candidates : iterable of Candidate
            All candidates for the finding.
        """
        span, m = slice(event.start, event.stop), self.markers.index(event.marker)
        samples = event.stop - event.start
        if blank:
            samples = int(np.count_nonzero(~np.isnan(self.positions[span, m]).any(axis=1)))
            self.positions[span, m] = np.nan
            self._origin[span, m] = MISSING
            self._error[span, m] = np.nan
        change = _change(event, classes, Outcome.BLANKED if blank else Outcome.LEFT, ruling)
        self._left.append(replace(change, alternatives=alternatives(candidates), samples=samples, reason=reason))

    def finished(self) -> tuple[Restored, tuple[Change, ...]]:
        """Finish the repair.

        Returns
        -------
        restored : Restored
            The repaired recording.
        changes : tuple of Change
            What was repaired, then what was not and why, each in the order of the work.
        """
        common = (self._recording.markers, self.positions, self._recording.rate, self._recording.first_frame)
        inner, outer = self._radius.inner, self._radius.outer
        restored = Restored(*common, self._recording.facts, self._origin, self._error * inner, self._error * outer)
        return restored, (*self._repairs, *self._left)

    def _repaired(self, change: Change, rows: np.ndarray) -> None:
        """Record a repair of samples (rows) that were just written, with its figures."""
        m = self.markers.index(change.marker)
        moved = np.linalg.norm(self.positions[rows, m] - self._recording.positions[rows, m], axis=1)
        error = self._error[rows, m]
        self._repairs.append(
            replace(
                change,
                samples=len(rows),
                largest_change_mm=largest(moved),
                expected_error_mm=largest(error * self._radius.inner),
                expected_error95_mm=largest(error * self._radius.outer),
            )
        )


def _change(event: Event, classes: tuple[str, ...], outcome: Outcome, ruling: Ruling) -> Change:
    """What is recorded of any finding: its place, the evidence for it, and the decisions that bear on it."""
    return Change(
        event.marker,
        event.start,
        event.stop,
        classes,
        outcome,
        event.score,
        event.axes,
        event.partner,
        decisions=ruling.texts,
        group=event.group,
    )


def alternatives(candidates: Iterable[Candidate]) -> tuple[Alternative, ...]:
    """List the candidates for a finding as its record states them.

    Parameters
    ----------
    candidates : iterable of Candidate
        The candidates, in the order of the methods.

    Returns
    -------
    tuple of Alternative
        Each method with the largest error to be expected of it.
    """
    return tuple(Alternative(own.proposal.method, round(own.expected_error, DECIMALS)) for own in candidates)
