"""What of a result the file of a recording holds: samples that its number format cannot hold stay as measured."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Change, Outcome
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import MEASURED, MISSING, Recording, Restored

REFUSED = Reason(Cause.NUMBER_FORMAT, "the number format of the file cannot hold the new samples")
"""Why a change was not written."""


@dataclass(frozen=True)
class WrittenChanges:
    """The changes that were written into the file of a recording, and those that were refused.

    Attributes
    ----------
    recording : Restored
        The result as the file holds it.
    applied : list of Change
        The changes that were written, see `applied_changes`.
    refused : list of Change
        Those that were not, with the samples that stay as measured, and the largest change that was wanted.
    """

    recording: Restored
    applied: list[Change]
    refused: list[Change]


def written_changes(
    measured: Recording, restored: Restored, changes: Sequence[Change], refused: Iterable[Mapping[str, Any]]
) -> WrittenChanges:
    """Separate what was written from what was refused.

    Parameters
    ----------
    measured : Recording
        The recording as ingested.
    restored : Restored
        The recording after repair and filling.
    changes : sequence of Change
        What repair and filling did to each stretch.
    refused : iterable of mapping
        `marker` and `frame`, as the capture program numbers it, of each sample that was refused, as the certificate has them.

    Returns
    -------
    WrittenChanges
        The result as written, and the changes.
    """
    where = np.zeros(measured.missing.shape, bool)
    for sample in refused:
        where[sample["frame"] - measured.first_frame, measured.markers.index(sample["marker"])] = True
    written = _partly(measured, restored, ~where)
    if not where.any():
        return WrittenChanges(written, applied_changes(measured, written, changes), [])
    wanted = applied_changes(measured, _partly(measured, restored, where), changes)
    left = [replace(change, outcome=Outcome.LEFT, method=None, reason=REFUSED) for change in wanted]
    return WrittenChanges(written, applied_changes(measured, written, changes), left)


def _partly(measured: Recording, restored: Restored, where: np.ndarray) -> Restored:
    """The result at some samples, bool (frames, markers), and what was measured at the others."""
    if where.all():
        return restored
    return replace(
        restored,
        positions=np.where(where[..., None], restored.positions, measured.positions),
        origin=np.where(where, restored.origin, np.where(measured.missing, MISSING, MEASURED)).astype(np.uint8),
        error=np.where(where, restored.error, np.where(measured.missing, np.nan, 0.0)),
        error95=np.where(where, restored.error95, np.where(measured.missing, np.nan, 0.0)),
    )


def is_reported(change: Change) -> bool:
    """Check whether a finding of one marker is left because its class is only reported.

    Parameters
    ----------
    change : Change
        What was done to it.

    Returns
    -------
    bool
        Whether it is.
    """
    return change.group is None and change.reason is not None and change.reason.cause is Cause.REPORTED
