"""What finally differs from what was measured: the changes of repair and filling together, one by one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from markermend.core.changes import Change, Outcome, largest
from markermend.core.recording import FILLED, Recording, Restored, changed
from markermend.numerics.intervals import runs


def applied_changes(measured: Recording, restored: Restored, changes: Sequence[Change]) -> list[Change]:
    """List the changes that are found in the result.

    Where measured samples were blanked and then filled, the change has the classes and the evidence of the finding, and
    the method of the fill; a gap that holds both such samples and others becomes several changes.

    Parameters
    ----------
    measured : Recording
        The recording as ingested.
    restored : Restored
        The recording after repair and filling.
    changes : sequence of Change
        What repair and filling did to each stretch.

    Returns
    -------
    list of Change
        By marker, first frame and class; what was left is not among them. The figures are those of the samples that
        differ from what was measured, and `samples` is their number.
    """
    differs, filled = changed(measured, restored), restored.origin == FILLED
    taken = [change for gone in (Outcome.BLANKED, Outcome.EXCHANGED) for change in changes if change.outcome is gone]
    applied = []
    for outcomes in ((Outcome.REPAIRED, Outcome.EXCHANGED, Outcome.ADOPTED), (Outcome.BLANKED,)):
        for change in (change for change in changes if change.outcome in outcomes):
            m = restored.markers.index(change.marker)
            own = _within(change, differs[:, m] & ~filled[:, m])
            if own.any():
                applied.append(_measured_anew(change, measured, restored, m, own))
    for fill in (change for change in changes if change.outcome is Outcome.FILLED):
        m = restored.markers.index(fill.marker)
        for was_seen in (False, True):
            own = _within(fill, differs[:, m] & filled[:, m] & (measured.missing[:, m] != was_seen))
            for start, stop in runs(own):
                part = replace(fill, start=start, stop=stop)
                part = _in_place_of(part, taken) if was_seen else part
                applied.append(_measured_anew(part, measured, restored, m, _within(part, own)))
    return sorted(applied, key=lambda change: (change.marker, change.start, change.kind))


def _within(change: Change, where: np.ndarray) -> np.ndarray:
    """Bool (frames,): where both the change lies and `where` holds."""
    own = np.zeros(len(where), bool)
    own[change.start : change.stop] = where[change.start : change.stop]
    return own


def _in_place_of(fill: Change, taken: Iterable[Change]) -> Change:
    """A fill with the evidence of the finding for which its measured samples were taken away."""
    covering = (t for t in taken if t.marker == fill.marker and t.start <= fill.start < t.stop)
    finding = next(covering, None)
    if finding is None:
        return fill
    return replace(
        finding,
        start=fill.start,
        stop=fill.stop,
        outcome=Outcome.FILLED,
        method=fill.method,
        member_weights=fill.member_weights,
        decisions=tuple(dict.fromkeys([*finding.decisions, *fill.decisions])),
    )


def _measured_anew(change: Change, measured: Recording, restored: Restored, m: int, own: np.ndarray) -> Change:
    """A change with the figures of its own samples, bool (frames,), of marker m."""
    rows = np.flatnonzero(own)
    return replace(
        change,
        samples=len(rows),
        largest_change_mm=largest(np.linalg.norm(restored.positions[rows, m] - measured.positions[rows, m], axis=1)),
        expected_error_mm=largest(restored.error[rows, m]),
        expected_error95_mm=largest(restored.error95[rows, m]),
    )
