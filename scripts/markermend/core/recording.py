"""What a recording is: marker trajectories in mm at a fixed rate, and what restoration adds to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.numerics.intervals import runs

ORIGINS = (
    "measured",
    "peak",
    "noise",
    "step",
    "swap",
    "slow",
    "filled",
    "missing",
    "displaced",
    "creep",
    "jump",
    "shift",
    "slip",
    "adopted",
)
"""What a written sample is: as measured, repaired by class, filled, or missing; stored by name, in memory its place here."""

MEASURED, FILLED, MISSING = ORIGINS.index("measured"), ORIGINS.index("filled"), ORIGINS.index("missing")
ADOPTED = ORIGINS.index("adopted")


class BadRecording(Exception):
    """A recording that cannot be used, with a reason that a person can act on."""


class SourceChanged(Exception):
    """The original file changed while the run was on; unlike BadRecording, the next run tries again."""


class SetAside(Exception):
    """A recording that an earlier stage set aside.

    Parameters
    ----------
    stage : str
        Name of that stage.
    reason : str
        Why it set the recording aside.
    """

    def __init__(self, stage: str, reason: str) -> None:
        super().__init__(reason)
        self.stage = stage
        self.reason = reason


@dataclass(frozen=True)
class Recording:
    """The labelled markers of one recording.

    Attributes
    ----------
    markers : tuple of str
        Unique names, one per trajectory.
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm along the laboratory's axes as recorded; NaN = missing (all three axes or none).
    rate : float
        Frames per second.
    first_frame : int
        The capture program's number of row 0.
    facts : dict
        How the recording came to be, JSON values only.
    unlabelled : mapping of str to ndarray of float, shape (frames, 3)
        Positions of the trajectories that the file holds without the label of a marker, mm, by their names; NaN = missing.
    """

    markers: tuple[str, ...]
    positions: np.ndarray
    rate: float
    first_frame: int = 1
    facts: dict[str, Any] = field(default_factory=dict)
    unlabelled: Mapping[str, np.ndarray] = field(default_factory=dict, kw_only=True)

    def __post_init__(self) -> None:
        if self.positions.ndim != 3 or self.positions.shape[1:] != (len(self.markers), 3):
            raise ValueError(f"positions {self.positions.shape} do not fit {len(self.markers)} markers")
        if len(set(self.markers)) != len(self.markers):
            raise ValueError("marker names are not unique")
        if any(own.shape != (len(self.positions), 3) for own in self.unlabelled.values()):
            raise ValueError(f"unlabelled trajectories do not have {len(self.positions)} frames: cut or drop them, too")

    @property
    def frames(self) -> int:
        """Number of frames."""
        frames: int = self.positions.shape[0]
        return frames

    @property
    def missing(self) -> np.ndarray:
        """Whether each marker was not seen, bool (frames, markers)."""
        absent = np.isnan(self.positions)
        # Ten times as fast as any() over so short an axis.
        missing: np.ndarray = absent[..., 0] | absent[..., 1] | absent[..., 2]
        return missing


@dataclass(frozen=True)
class Restored(Recording):
    """A recording after repair or filling, with the origin and the expected error of every sample.

    Attributes
    ----------
    origin : ndarray of uint8, shape (frames, markers)
        What each sample is: its place in ORIGINS.
    error, error95 : ndarray of float, shape (frames, markers)
        Radii in mm of the balls around the written position that hold the true one with probability 0.68 and 0.95; 0
        where measured, NaN where missing.
    """

    origin: np.ndarray = field(default_factory=lambda: np.empty((0, 0), np.uint8))
    error: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))
    error95: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))


def gaps(recording: Recording) -> list[tuple[int, int, int]]:
    """List the gaps of a recording.

    Parameters
    ----------
    recording : Recording
        The recording.

    Returns
    -------
    list of tuple of int
        Index of the marker, first frame and frame after the last of each gap, by marker, then by frame.
    """
    missing = recording.missing
    return [(m, start, stop) for m in range(missing.shape[1]) for start, stop in runs(missing[:, m])]


def changed(before: Recording, after: Recording) -> np.ndarray:
    """Find the samples that differ between two versions of a recording.

    Parameters
    ----------
    before, after : Recording
        The versions, with the same frames and markers.

    Returns
    -------
    ndarray of bool, shape (frames, markers)
        True where the positions are not equal; a missing sample equals a missing sample.
    """
    same = (before.positions == after.positions) | (np.isnan(before.positions) & np.isnan(after.positions))
    differs: np.ndarray = ~same.all(axis=2)
    return differs
