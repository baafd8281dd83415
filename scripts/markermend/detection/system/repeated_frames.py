"""Repeated frames: all markers keep the positions of the frame before, while the subject moves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from markermend.numerics.intervals import runs
from markermend.options.detection.frames import RepeatedFramesOptions

RESOLUTION_QUANTILE = 0.01
"""Smallest changes of coordinates that count as the resolution: fewer may be chance."""

MIN_REPETITIONS = 5
"""Repetitions that can be regular, at least."""

CONTEXT = 5
"""Steps on either side of a stretch from which the usual motion is estimated."""

Span = tuple[int, int]


@dataclass(frozen=True)
class RepeatedFrames:
    """The repeated frames of a recording.

    Attributes
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions, mm, NaN = missing.
    rate : float
        Sampling rate, Hz.
    options : RepeatedFramesOptions
        Share of the markers that must repeat, and their motion around.
    """

    positions: np.ndarray
    rate: float
    options: RepeatedFramesOptions

    @cached_property
    def spans(self) -> list[Span]:
        """The stretches [start, stop) of frames that repeat the frame before them, while the subject moves around."""
        return [span for span in runs(self._repeated) if self._moves_around(*span)]

    @property
    def warning(self) -> str | None:
        """What is said of frames that repeat regularly, or so often that they are no fault of single frames; else None."""
        if self.content_rate is not None:
            return (
                f"frames repeat regularly: the recording has {self.rate:.4g} frames a second, of which about "
                f"{self.content_rate:.4g} differ; nothing was done about it"
            )
        share = sum(stop - start for start, stop in self.spans) / max(1, len(self.positions))
        if share > self.options.max_frames_share:
            return f"{100 * share:.0f} % of the frames repeat the frame before; nothing was done about it"
        return None

    @cached_property
    def content_rate(self) -> float | None:
        """Rate of the frames that differ, Hz, where repetition is regular; None where it is not."""
        spans = self.spans
        if len(spans) < MIN_REPETITIONS:
            return None
        periods = np.array([after[0] - before[0] for before, after in pairwise(spans)])
        repeated = np.array([stop - start for start, stop in spans[:-1]])
        regular = periods <= 2 * np.median(periods)
        between = np.zeros(len(self.positions), bool)
        for (start, _), period in zip(np.array(spans[:-1])[regular], periods[regular], strict=True):
            between[start : start + period] = True
        steps = np.linalg.norm(np.diff(self.positions, axis=0, prepend=np.nan), axis=2)
        moving = (steps >= self._floor_mm).mean(axis=1) >= self.options.min_moving_share
        if between[moving].mean() < self.options.min_regular_share:
            return None
        return float(self.rate * (1 - repeated[regular].sum() / periods[regular].sum()))

    def members(self, start: int, stop: int) -> list[int]:
        """List the markers that repeat their positions over a stretch.

        Parameters
        ----------
        start, stop : int
            The stretch, [start, stop).

        Returns
        -------
        list of int
            Indices of the markers that are unchanged wherever they are seen in succession.
        """
        absent = np.isnan(self.positions[start - 1 : stop, :, 0])
        unchanged, unknown = self._unchanged[start:stop], absent[1:] | absent[:-1]
        members: list[int] = np.flatnonzero((unchanged | unknown).all(axis=0) & unchanged.any(axis=0)).tolist()
        return members

    @cached_property
    def _unchanged(self) -> np.ndarray:
        """Whether each marker has exactly the position of the frame before, bool (frames, markers)."""
        same = self.positions[1:] == self.positions[:-1]
        unchanged = np.zeros(self.positions.shape[:2], bool)
        unchanged[1:] = same[..., 0] & same[..., 1] & same[..., 2]
        return unchanged

    @cached_property
    def _repeated(self) -> np.ndarray:
        """Whether nearly all of the markers that are seen in a frame and in that before are unchanged, bool (frames,)."""
        absent = np.isnan(self.positions[..., 0])
        both = np.zeros(len(absent), int)
        both[1:] = (~absent[1:] & ~absent[:-1]).sum(axis=1)
        repeated: np.ndarray = self._unchanged.sum(axis=1) >= np.maximum(
            self.options.min_repeated_share * both, self.options.min_markers
        )
        return repeated

    @property
    def _floor_mm(self) -> float:
        """Step from which a marker moves, mm."""
        options = self.options
        return max(options.min_speed_mm_s / self.rate, options.min_resolution_steps * self._resolution)

    @cached_property
    def _resolution(self) -> float:
        """Smallest step between the stored values of a coordinate, mm."""
        change = np.abs(np.diff(self.positions, axis=0))
        moving = change[change > 0]
        return float(np.quantile(moving, RESOLUTION_QUANTILE)) if moving.size else 0.0

    def _moves_around(self, start: int, stop: int) -> bool:
        """Whether enough markers move up to the frame before a stretch, and on from it, as they do further away."""
        seen = self._unchanged[start]
        sides = [self._moving(np.arange(start - CONTEXT, start)[::-1]), self._moving(np.arange(stop, stop + CONTEXT))]
        known = [side for side in sides if side is not None]
        return bool(known) and all(side[seen].mean() >= self.options.min_moving_share for side in known)

    def _moving(self, frames: np.ndarray) -> np.ndarray | None:
        """Whether each marker moves to the first of some frames, the nearest; None where the recording ends there."""
        frames = frames[(frames > 0) & (frames < len(self.positions))]
        frames = frames[~self._repeated[frames] | (np.arange(len(frames)) == 0)]
        if not len(frames):
            return None
        steps = np.linalg.norm(self.positions[frames] - self.positions[frames - 1], axis=2)
        usual = np.median(np.nan_to_num(steps), axis=0)
        moving: np.ndarray = steps[0] >= np.maximum(self._floor_mm, self.options.min_speed_ratio * usual)
        return moving
