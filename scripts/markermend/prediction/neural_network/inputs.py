"""What networks are fed: the coordinates of a few markers now and one frame ago, in z-scores (skurowski2021 section 3.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.intervals import runs
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Scale:
    """What turns columns of numbers into z-scores."""

    middle: np.ndarray
    deviation: np.ndarray

    @classmethod
    def of(cls, columns: np.ndarray) -> Scale:
        """The scale of (n, columns); of a column that does not vary the scores are 0."""
        deviation = columns.std(axis=0)
        return cls(columns.mean(axis=0), np.where(deviation > 1e-9, deviation, 1.0))

    def scores(self, columns: np.ndarray) -> np.ndarray:
        """The z-scores (n, columns)."""
        return (columns - self.middle) / self.deviation

    def columns(self, scores: np.ndarray) -> np.ndarray:
        """What has these z-scores."""
        return scores * self.deviation + self.middle


def chosen(
    scene: Scene, marker: int, seen: np.ndarray, *, most: int, minimum: int, share: float, minimum_frames: int
) -> np.ndarray:
    """The markers to predict a marker from (k <= most,); none where too few frames of the scene train.

    seen: (markers,), which are there throughout the gap. Siblings and parent marker, then the first of the mesh's
    ranking, so that one network serves all gaps of a marker; where fewer than `minimum` of these are seen, the first
    that are, if those are enough. share, minimum_frames: see companions.
    """
    near = np.asarray(scene.neighbours[marker], int)
    if scene.segment_mates is not None:
        related = np.asarray(scene.segment_mates[marker], int)
        near = np.concatenate([related, near[~np.isin(near, related)]])
    choices = []
    for ranked in (near, near[seen[near]]):
        together, _ = jointly_observed(scene, marker, ranked, share=share, minimum_frames=minimum_frames)
        choices.append(together[:most])
        if np.count_nonzero(seen[choices[-1]]) >= minimum:
            return choices[-1]
    return choices[0]


def features(positions: np.ndarray, frames: np.ndarray, *, centred: bool) -> tuple[np.ndarray, np.ndarray]:
    """Inputs (n, 6 markers) of a network at some frames; source: skurowski2021 eq 12.

    positions: (all frames, markers, 3), mm. Of each marker the position and the one a frame before; where that is
    missing, the position again. Also returns what was subtracted from each frame (n, 3): if `centred` the mean of the
    markers' positions, else 0. NaN where a marker is missing.
    """
    now, former = positions[frames], positions[np.maximum(frames - 1, 0)]
    former = np.where(np.isnan(former), now, former)
    middle = now.mean(axis=1) if centred else np.zeros((len(frames), 3))
    both = np.stack([now, former], axis=2) - middle[:, None, None]
    return both.reshape(len(frames), -1), middle


def completed(positions: np.ndarray, examples: np.ndarray, *, minimum: int) -> np.ndarray:
    """Positions (n, markers, 3), mm, with what is missing in a frame told from the markers that are there.

    By least squares over complete examples (m, markers, 3). NaN stays where fewer than `minimum` markers are there.
    """
    out = positions.copy()
    seen = ~np.isnan(positions).any(axis=2)
    for pattern in np.unique(seen[~seen.all(axis=1)], axis=0):
        if np.count_nonzero(pattern) < max(minimum, 1):
            continue
        rows = np.flatnonzero((seen == pattern).all(axis=1))
        known, wanted = (
            examples[:, pattern].reshape(len(examples), -1),
            examples[:, ~pattern].reshape(len(examples), -1),
        )
        middle = known.mean(axis=0)
        beta = np.linalg.lstsq(known - middle, wanted - wanted.mean(axis=0), rcond=1e-6)[0]
        told = (positions[np.ix_(rows, pattern)].reshape(len(rows), -1) - middle) @ beta + wanted.mean(axis=0)
        out[np.ix_(rows, ~pattern)] = told.reshape(len(rows), -1, 3)
    return out


def stretches(seen: np.ndarray, *, longest: int, frames: int) -> list[np.ndarray]:
    """Frames of equally long stretches of up to `longest` frames that are all seen, evenly spread.

    seen: bool (frames,), True somewhere. Of so many stretches that together they have about `frames` frames.
    """
    pieces: list[np.ndarray] = []
    for start, stop in runs(seen):
        pieces += np.array_split(np.arange(start, stop), -(-(stop - start) // longest))
    wanted = int(np.ceil(len(pieces) * min(1.0, frames / np.count_nonzero(seen))))
    return [pieces[number] for number in evenly_spaced(np.arange(len(pieces)), wanted)]
