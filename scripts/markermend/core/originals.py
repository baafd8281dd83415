"""The original value of every changed sample: what is needed to take changes back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase

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
    finding : ndarray of int, shape (n,)
        Number of the finding or gap that each sample belongs to. Changes that share samples, both markers of an exchange, and all
        markers of a finding about several have one number: they can be taken back together only.
    first_frame : int
        The capture program's number of row 0.
    """

    markers: tuple[str, ...]
    marker: np.ndarray
    frame: np.ndarray
    positions: np.ndarray
    origin: np.ndarray
    classes: tuple[str, ...]
    finding: np.ndarray
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
    classes, findings = np.full(differs.shape, "", object), np.full(differs.shape, -1)
    # A sample that was exchanged or adopted, and then repaired or taken away, has the class of what was done last.
    for change in sorted(applied, key=lambda change: change.outcome not in (Outcome.EXCHANGED, Outcome.ADOPTED)):
        classes[change.start : change.stop, measured.markers.index(change.marker)] = change.kind
    for number, change in zip(_number_findings(applied), applied, strict=True):
        findings[change.start : change.stop, measured.markers.index(change.marker)] = number
    marker, frame = np.nonzero(differs.T)
    return Originals(
        measured.markers,
        marker,
        frame,
        measured.positions[frame, marker],
        restored.origin[frame, marker],
        tuple(classes[frame, marker]),
        findings[frame, marker],
        measured.first_frame,
    )


def _number_findings(applied: Sequence[Change]) -> np.ndarray:
    """Give each change the number of its finding, the same to those that can be taken back together only."""
    numbers = np.arange(len(applied))
    open_changes: list[int] = []
    for one in sorted(numbers.tolist(), key=lambda number: applied[number].start):
        open_changes = [other for other in open_changes if applied[other].stop > applied[one].start]
        for other in open_changes:
            if numbers[one] != numbers[other] and _inseparable(applied[one], applied[other]):
                numbers[numbers == max(numbers[one], numbers[other])] = min(numbers[one], numbers[other])
        open_changes.append(one)
    return numbers


def _inseparable(one: Change, other: Change) -> bool:
    """Whether two changes on the same frames share a marker, are parts of one exchange, or of one finding about several markers."""
    exchange = one.outcome is other.outcome is Outcome.EXCHANGED and (
        other.marker == one.partner or one.marker == other.partner
    )
    joint = one.group is not None and (one.group, one.classes) == (other.group, other.classes)
    return one.marker == other.marker or exchange or joint


def select_findings(
    originals: Originals, *, markers: Sequence[str] = (), frames: tuple[int, int] | None = None
) -> np.ndarray:
    """Select the samples of findings and gaps.

    Parameters
    ----------
    originals : Originals
        The original values of a recording.
    markers : sequence of str, optional
        Names or patterns with `*` and `?`; by default all markers.
    frames : (int, int), optional
        First and last frame, as the capture program numbers them; by default all frames.

    Returns
    -------
    ndarray of bool, shape (n,)
        The samples of each finding and gap that shares a sample of one of these markers with these frames: a finding is selected as a
        whole.
    """
    named = [not markers or any(fnmatchcase(name, own) for own in markers) for name in originals.markers]
    own = np.array(named, bool)[originals.marker]
    if frames is not None:
        number = originals.frame + originals.first_frame
        own &= (number >= frames[0]) & (number <= frames[1])
    selected: np.ndarray = np.isin(originals.finding, originals.finding[own])
    return selected


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
