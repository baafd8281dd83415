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
    markers : tuple of str
        Names of the markers of the recording.
    marker : ndarray of int, shape (n,)
        Index of each sample's marker among them.
    frame : ndarray of int, shape (n,)
        Its frame as a row counted from 0.
    positions : ndarray of float, shape (n, 3)
        What was measured, mm, bit for bit; NaN where the marker was missing.
    origin : ndarray of uint8, shape (n,)
        What stands there now: places in `markermend.core.recording.ORIGINS`.
    classes : tuple of str
        The class of the change of each sample as the table of changes has it, such as "peak+slow" or "gap".
    first_frame : int
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
        """Whether each sample had been measured, bool (n,); the others were missing."""
        known: np.ndarray = ~np.isnan(self.positions).any(axis=1)
        return known


def find_originals(measured: Recording, restored: Restored, applied: Sequence[Change]) -> Originals:
    """Collect the original values of all samples that changed.

    Parameters
    ----------
    measured : Recording
        The recording as ingested.
    restored : Restored
        The same after repair and filling; not modified.
    applied : sequence of Change
        The changes as applied, see `markermend.core.applied_changes`.

    Returns
    -------
    Originals
        One entry for each sample that differs, by marker and frame; empty where nothing was changed.
    """
    differs = changed(measured, restored)
    classes = np.full(differs.shape, "", object)
    # A sample that was exchanged or adopted, and then repaired or taken away, has the class of what was done last.
    for change in sorted(applied, key=lambda change: change.outcome not in (Outcome.EXCHANGED, Outcome.ADOPTED)):
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
    positions : ndarray of float, shape (frames, markers, 3)
        Cleaned positions, mm, NaN = missing; not modified.
    markers : sequence of str
        Names of the markers of the second axis.
    originals : Originals
        The original values of that recording.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        Positions as ingested, mm, bit for bit; NaN where the marker was missing.

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
    originals : Originals
        The samples.

    Returns
    -------
    list of str
        A name of `markermend.core.recording.ORIGINS` for each sample.
    """
    return [ORIGINS[code] for code in originals.origin]
