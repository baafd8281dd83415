"""Two labels on one marker: points nearer to each other than two markers can be.

The label whose trajectory is broken where this begins and ends was on its own marker before and after; the other one is right.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.events import Event
from markermend.detection.labelling.evidence import LabelEvidence
from markermend.numerics.intervals import runs
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.shape_evidence import ShapeEvidence


@dataclass(frozen=True)
class OneSpotSearch:
    """The samples under their right labels.

    Attributes
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing, exchanged labels undone.
    evidence : LabelEvidence
        The same in the frames that are looked at.
    """

    positions: np.ndarray
    evidence: LabelEvidence

    def find(self, markers: Sequence[str]) -> list[Event]:
        """Find the stretches over which a label is on the marker of another one.

        Parameters
        ----------
        markers : Sequence[str]
            Names of the markers.

        Returns
        -------
        list[Event]
            Events of the class `foreign`, sorted.
        """
        found = [
            Event(markers[off], start, stop, 1.0, kind="foreign")
            for a, b in self._close_pairs()
            for start, stop in self._stretches(a, b)
            if (off := self._off(a, b, start, stop)) is not None
        ]
        return sorted(found, key=lambda event: event.order)

    def _close_pairs(self) -> Iterator[tuple[int, int]]:
        """Pairs of markers that are apart, and so close now and then that only one marker can be there."""
        options = self.evidence.options
        apart = self.evidence.shape.distance >= options.min_usual_mm
        for a in range(self.positions.shape[1] - 1):
            others = a + 1 + np.flatnonzero(apart[a, a + 1 :])
            # Axis by axis: hardly any points are that close along one.
            for axis in range(3):
                near = (
                    np.abs(self.positions[:, others, axis] - self.positions[:, a, None, axis]) < options.max_one_spot_mm
                )
                others = others[np.count_nonzero(near, axis=0) >= options.min_one_spot_frames]
            yield from ((a, b) for b in others.tolist())

    def _stretches(self, a: int, b: int) -> Iterator[tuple[int, int]]:
        """The stretches over which two labels are on one marker; not where that is most of the recording."""
        options = self.evidence.options
        distance = np.linalg.norm(self.positions[:, a] - self.positions[:, b], axis=1)
        together = np.nan_to_num(distance, nan=np.inf) < options.max_one_spot_mm
        if np.count_nonzero(together) <= options.max_foreign_share * np.count_nonzero(~np.isnan(distance)):
            yield from ((start, stop) for start, stop in runs(together) if stop - start >= options.min_one_spot_frames)

    def _is_broken(self, m: int, start: int, stop: int) -> bool:
        """Whether the trajectory of a marker is broken at both ends of a stretch, within the recording."""
        tracks, frames = self.evidence.tracks, len(self.positions)
        first = start == 0 or tracks.is_broken(m, start)
        last = stop == frames or tracks.is_broken(m, stop)
        return first and last and (start > 0 or stop < frames)

    def _off(self, a: int, b: int, start: int, stop: int) -> int | None:
        """Which of two markers is not at the place of both: the one that is broken, or whose distances contradict it more.

        None where neither is broken, or where both are and too few others are seen to say which.
        """
        broken = [m for m in (a, b) if self._is_broken(m, start, stop)]
        if len(broken) < 2:
            return broken[0] if broken else None
        step = max(1, (stop - start) // self.evidence.options.open_frames)
        fit = ShapeEvidence(self.positions[start:stop:step], self.evidence.shape, self.evidence.options.shape)
        with_other = fit.own_log_likelihoods_without_other()
        misfit = self.evidence.usual_likelihood[[a, b]] - np.stack((with_other[:, a, b], with_other[:, b, a]), axis=1)
        if np.isnan(misfit).all(axis=0).any():
            return None
        first, second = np.nanmean(misfit, axis=0)
        return a if first > second else b


def shared_spots(positions: np.ndarray, *, markers: Sequence[str], options: LabelsOptions) -> list[str]:
    """Warn of labels that are on one marker nearly throughout a recording, so that nothing says which of them is right.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    markers : Sequence[str]
        Names of the markers.
    options : LabelsOptions
        How near to each other, and for how long, no two markers are.

    Returns
    -------
    list[str]
        One sentence at most, with the pairs.
    """
    rows = positions[:: max(1, len(positions) // options.open_frames)]
    pairs = []
    for a in range(len(markers) - 1):
        distance = np.linalg.norm(rows[:, a + 1 :] - rows[:, a, None], axis=2)
        together = np.count_nonzero(distance < options.max_one_spot_mm, axis=0)
        seen = np.count_nonzero(~np.isnan(distance), axis=0)
        shared = (together >= options.min_one_spot_frames) & (together >= options.min_one_spot_share * seen)
        pairs += [f"{markers[a]} and {markers[b]}" for b in (a + 1 + np.flatnonzero(shared)).tolist()]
    if not pairs:
        return []
    near = f"nearer to each other than {options.max_one_spot_mm:g} mm throughout"
    return [f"labels that may be on one marker, {near}: {', '.join(pairs)}"]
