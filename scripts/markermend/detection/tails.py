"""Noisy tails: the last samples before a gap, or the first after it, that wander off as the marker goes out of sight."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs, prediction_discrepancy
from markermend.detection.prediction_discrepancy import Stretch
from markermend.numerics.intervals import runs, samples
from markermend.options.detection.tails import TailsOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene


def detect_tails(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: TailsOptions, predictor: LocalRidge
) -> list[Event]:
    """Find the noisy tails on either side of gaps.

    A marker that drifts into a gap without any sudden change cannot be distinguished from one that moves.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found at the ends of the recording.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions: it is no gap, but where it touches one a tail may end.
    options : TailsOptions
        Longest tail, onset threshold, threshold of the discrepancy.
    predictor : LocalRidge
        Predicts each marker from its neighbours and its own trajectory.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    unclaimed = inputs.without_claimed(scene, earlier)
    candidates = _candidates(scene, unclaimed, options, predictor)
    hidden = prediction_discrepancy.hide_stretches(unclaimed, [one.stretch for one in candidates])
    found = []
    for candidate in candidates:
        score = prediction_discrepancy.discrepancy(
            unclaimed,
            hidden,
            candidate.stretch,
            predictor=predictor,
            sigmas=options.threshold_sigmas,
            floor_mm=options.floor_mm,
        )
        high = score[:: candidate.side] >= options.half_fraction  # towards the gap
        length = len(high) - int(np.argmax(high))
        if score.max() >= 1 and high[-length:].mean() >= 0.5:
            m, start, stop = candidate.stretch
            tail = (stop - length, stop) if candidate.side > 0 else (start, start + length)
            found.append(prediction_discrepancy.unmeasured_event(markers[m], *tail, score))
    return events.disjoint(found)


@dataclass(frozen=True)
class _Border:
    """Where a run of samples of a marker meets a gap, which begins (side 1) or ends (side -1) at a frame."""

    marker: int
    frame: int
    side: int

    def samples(self, count: int) -> np.ndarray:
        """Give the last frames before the gap in order, or the first after it in reverse: towards the gap."""
        return self.frame - self.side * np.arange(count, 0, -1) - (self.side < 0)

    def stretch(self, length: int) -> Stretch:
        """Give the stretch of a number of samples next to the gap."""
        if self.side > 0:
            return self.marker, self.frame - length, self.frame
        return self.marker, self.frame, self.frame + length


@dataclass(frozen=True)
class _Candidate:
    """A stretch that may be a tail, from its first sudden change up to the gap, before (side 1) or after (side -1) it."""

    stretch: Stretch
    side: int


def _candidates(scene: Scene, unclaimed: Scene, options: TailsOptions, predictor: LocalRidge) -> list[_Candidate]:
    """The stretches from the first sudden change next to a gap up to it."""
    lengths = options.max_duration_s, options.min_seen_before_s, options.scale_window_s
    longest, before, around = (max(2, samples(length, scene.rate)) for length in lengths)
    borders = list(_borders(scene.present, unclaimed.present, longest + before))
    residual = predictor.residuals(unclaimed, np.unique([border.marker for border in borders]).astype(int))
    size = np.linalg.norm(np.diff(residual, axis=0), axis=2)
    overall = [_known_median(own) for own in size.T]
    candidates = []
    for border in borders:
        m, rows = border.marker, border.samples(longest + before)
        near = slice(max(0, rows.min() - around), rows.max() + around)
        usual = max(_known_median(size[near, m]), overall[m])
        onset = _onset(unclaimed.positions[rows, m], residual[rows, m], before, options.onset_factor * usual)
        if onset is not None:
            candidates.append(_Candidate(border.stretch(longest - onset), border.side))
    return candidates


def _borders(present: np.ndarray, unclaimed: np.ndarray, shortest: int) -> Iterator[_Border]:
    """The borders of runs of unclaimed samples with gaps, without runs shorter than `shortest` samples."""
    for m in range(present.shape[1]):
        holes = [(start, stop) for start, stop in runs(~unclaimed[:, m]) if not present[start:stop, m].all()]
        begins, ends = {start for start, _ in holes}, {stop for _, stop in holes}
        for start, stop in runs(unclaimed[:, m]):
            if stop - start >= shortest:
                yield from [_Border(m, start, -1)] if start in ends else []
                yield from [_Border(m, stop, 1)] if stop in begins else []


def _onset(trajectory: np.ndarray, residual: np.ndarray, before: int, level: float) -> int | None:
    """After how many of the samples that follow the first `before` something sudden begins; None if nothing does.

    trajectory, residual: (n, 3), mm. Sudden is what bends both by more than `level` mm from one frame to the next: a
    neighbour's artifact or gap changes the residual alone, and natural motion bends the trajectory little. It begins where
    both first depart together.
    """
    change, motion = np.diff(residual, axis=0)[before - 1 :], np.diff(trajectory, axis=0)
    bend = _common_part(np.diff(motion, axis=0)[before - 2 :], change) > level
    away = _common_part((motion - np.median(motion[: before - 1], axis=0))[before - 1 :], change) > level
    return int(np.argmax(bend | away)) if bend.any() else None


def _common_part(motion: np.ndarray, change: np.ndarray) -> np.ndarray:
    """How much of each change of the residual (n, 3) the motion makes as well, mm; 0 where either is unknown."""
    length = np.linalg.norm(change, axis=1)
    along = np.einsum("na,na->n", motion, change) / np.maximum(length, 1e-9)
    clipped: np.ndarray = np.nan_to_num(np.clip(along, 0, length))
    return clipped


def _known_median(values: np.ndarray) -> float:
    """Median of what is known, 0 without any."""
    known = values[~np.isnan(values)]
    return float(np.median(known)) if len(known) else 0.0
