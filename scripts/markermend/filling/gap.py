"""What a gap is, and which gaps of a marker are of one kind, so that their pseudo-gaps serve all of them."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass

import numpy as np

from markermend.numerics.intervals import runs
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Gap:
    """A gap of one marker over the frames [start, stop).

    Attributes
    ----------
    marker : int
        Index of the marker in its recording.
    start, stop : int
        First frame of the gap and the frame after its last.
    """

    marker: int
    start: int
    stop: int

    @property
    def length(self) -> int:
        """Number of frames."""
        return self.stop - self.start

    @property
    def samples(self) -> tuple[slice, int]:
        """Index of the gap's samples in arrays (frames, markers, ...)."""
        return slice(self.start, self.stop), self.marker


@dataclass(frozen=True)
class GapKind:
    """What gaps of one kind have in common.

    Attributes
    ----------
    marker : int
        Index of the marker.
    length_class : int
        Logarithm of the length, rounded down.
    at_ends : tuple of bool
        Whether the gap is at the start and at the end of the recording.
    absent : frozenset of int
        Those of the nearest neighbours that are missing during the gap.
    """

    marker: int
    length_class: int
    at_ends: tuple[bool, bool]
    absent: frozenset[int]


def find_gaps(missing: np.ndarray) -> Iterator[Gap]:
    """Find the gaps of a recording, marker by marker.

    Parameters
    ----------
    missing : ndarray of bool, shape (frames, markers)
        True where a sample is missing.

    Yields
    ------
    Gap
        Each longest run of missing samples of a marker.
    """
    for marker in range(missing.shape[1]):
        for start, stop in runs(missing[:, marker]):
            yield Gap(marker, start, stop)


def gap_kind(scene: Scene, gap: Gap, *, length_ratio: float, neighbours: int) -> GapKind:
    """Classify a gap by its marker, its length, the ends of the recording, and the neighbours that are missing.

    Parameters
    ----------
    scene : Scene
        The recording with the gap.
    gap : Gap
        The gap.
    length_ratio : float
        Gaps whose lengths differ by this factor are of different kinds.
    neighbours : int
        Number of nearest neighbours that count.

    Returns
    -------
    GapKind
        The kind.
    """
    nearest = np.asarray(scene.neighbours[gap.marker], int)[:neighbours]
    absent = np.flatnonzero(~scene.present[gap.start : gap.stop, nearest].all(axis=0))
    length_class = math.floor(math.log(gap.length, length_ratio))
    at_ends = gap.start == 0, gap.stop == len(scene.positions)
    return GapKind(gap.marker, length_class, at_ends, frozenset(nearest[absent].tolist()))


def known_kind(kind: GapKind, known: Collection[GapKind], *, max_kinds: int) -> GapKind:
    """Replace a kind by the most similar known one of the marker where the marker has enough kinds already.

    Parameters
    ----------
    kind : GapKind
        The kind of a gap.
    known : collection of GapKind
        The kinds of earlier gaps.
    max_kinds : int
        From this number of known kinds of the marker on, no new one is added where a known one can stand in.

    Returns
    -------
    GapKind
        `kind` itself, or the known one at the same ends whose length class, then whose missing neighbours differ least.
    """
    of_marker = [other for other in known if other.marker == kind.marker]
    similar = [other for other in of_marker if other.at_ends == kind.at_ends]
    if kind in known or len(of_marker) < max_kinds or not similar:
        return kind

    def difference(other: GapKind) -> tuple[int, int, list[int]]:
        lengths = abs(other.length_class - kind.length_class)
        return lengths, len(other.absent ^ kind.absent), sorted(other.absent)

    return min(similar, key=difference)
