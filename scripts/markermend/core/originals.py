"""The original value of every changed sample: what is needed to take changes back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.changes import Change, Outcome
from markermend.core.recording import ORIGINS, Recording, Restored, changed


@dataclass(frozen=True)
class Originals:
    """The samples that differ from the recording as ingested, and what they were, by marker and frame.

    Attributes
    ----------
    markers
        Names of the markers of the recording.
    marker
        Index of each sample's marker among them, int (n,).
    frame
        Its frame as a row counted from 0, int (n,).
    positions
        What was measured, (n, 3), mm, bit for bit; NaN where the marker was missing.
    origin
        What stands there now, uint8 (n,): positions in `markermend.core.recording.ORIGINS`.
    classes
        The class of the change of each sample as the table of changes has it, such as "peak+slow" or "gap"; n strings.
    first_frame
        The capture program's number of row 0.
    """

    markers: tuple[str, ...]
    marker: np.ndarray
    frame: np.ndarray
    positions: np.ndarray
    origin: np.ndarray
    classes: tuple[str, ...]
    first_frame: int = 1

    @property
    def measured(self) -> np.ndarray:
        """Bool (n,): True where a sample had been measured, False where it was missing and was written."""
        known: np.ndarray = ~np.isnan(self.positions).any(axis=1)
        return known


def find_originals(measured: Recording, restored: Restored, applied: Sequence[Change]) -> Originals:
    """Collect the original values of all samples that changed.

    Parameters
    ----------
    measured
        The recording as ingested.
    restored
        The same after repair and filling; not modified.
    applied
        The changes as applied, see `markermend.core.applied_changes`.

    Returns
    -------
    Originals
        One entry for each sample that differs, by marker and frame; empty where nothing was changed.
    """
    differs = changed(measured, restored)
    classes = np.full(differs.shape, "", object)
    # A sample that was exchanged and then repaired or taken away has the class of what was done last.
    for change in sorted(applied, key=lambda change: change.outcome is not Outcome.EXCHANGED):
        classes[change.start : change.stop, measured.markers.index(change.marker)] = change.kind
    marker, frame = np.nonzero(differs.T)
    return Originals(
        measured.markers,
        marker,
        frame,
        measured.positions[frame, marker],
        restored.origin[frame, marker],
        tuple(classes[frame, marker]),
        measured.first_frame,
    )


def restore_originals(positions: np.ndarray, markers: Sequence[str], originals: Originals) -> np.ndarray:
    """Take all changes back.

    Parameters
    ----------
    positions
        Cleaned positions, (frames, markers, 3), mm, NaN = missing; not modified.
    markers
        Names of the markers of the second axis.
    originals
        The original values of that recording.

    Returns
    -------
    ndarray
        Positions as ingested, (frames, markers, 3), mm, bit for bit: NaN where the marker was missing.

    Raises
    ------
    ValueError
        Where a marker of the originals is not among the markers.
    """
    index = np.array([markers.index(name) for name in originals.markers], int)
    restored = positions.copy()
    restored[originals.frame, index[originals.marker]] = originals.positions
    return restored


def origin_names(originals: Originals) -> list[str]:
    """Name what stands at each sample now.

    Parameters
    ----------
    originals
        The samples.

    Returns
    -------
    list of str
        A name of `markermend.core.recording.ORIGINS` for each sample.
    """
    return [ORIGINS[code] for code in originals.origin]
