"""Noisy tails: the last samples before a gap, or the first after it, that wander off as the marker goes out of sight."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs, prediction_discrepancy
from markermend.detection.prediction_discrepancy import Place
from markermend.numerics.intervals import runs, samples
from markermend.options.detection import TailsOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene


def detect_tails(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: TailsOptions, predictor: LocalRidge
) -> list[Event]:
    """Find noisy tails on either side of gaps.

    scene: positions (frames, markers, 3), mm, NaN = missing. earlier: bool, like positions, what other detectors
    claimed: that makes no gap, but where it touches one, a tail may end there. A marker that drifts into a gap without
    any sudden change is not told from one that moves. Nothing is found at the ends of a recording.
    """
    believed = inputs.without(scene, earlier)
    suspects = _suspects(scene, believed, options, predictor)
    hidden = prediction_discrepancy.hiding(believed, [place for place, _ in suspects])
    found = []
    for (m, start, stop), side in suspects:
        score, _ = prediction_discrepancy.disagreement(
            believed,
            hidden,
            (m, start, stop),
            predictor=predictor,
            sigmas=options.threshold_sigmas,
            floor_mm=options.floor_mm,
        )
        weak = score[::side] >= options.half_fraction  # towards the gap
        length = len(weak) - int(np.argmax(weak))
        if score.max() >= 1 and weak[-length:].mean() >= 0.5:
            tail = (stop - length, stop) if side > 0 else (start, start + length)
            found.append(prediction_discrepancy.event(markers[m], *tail, score))
    return events.tidy(found)


def _suspects(scene: Scene, believed: Scene, options: TailsOptions, predictor: LocalRidge) -> list[tuple[Place, int]]:
    """From the first sudden change beside a gap up to the gap, each with the side on which the gap is."""
    lengths = options.max_duration_s, options.min_seen_before_s, options.scale_window_s
    longest, before, activity = (max(2, samples(length, scene.rate)) for length in lengths)
    borders = list(_borders(scene.present, believed.present, longest + before))
    residual = predictor.residuals(believed, np.unique([m for m, *_ in borders]).astype(int))
    size = np.linalg.norm(np.diff(residual, axis=0), axis=2)
    overall = [_median(own) for own in size.T]
    out = []
    for m, frame, side in borders:
        # Towards the gap: what is in order, then what may be a tail.
        rows = frame - side * np.arange(longest + before, 0, -1) - (side < 0)
        near = slice(max(0, rows.min() - activity), rows.max() + activity)
        usual = max(_median(size[near, m]), overall[m])
        begin = _onset(believed.positions[rows, m], residual[rows, m], before, options.onset_factor * usual)
        if begin is not None:
            length = longest - begin
            out.append(((m, frame - length, frame) if side > 0 else (m, frame, frame + length), side))
    return out


def _borders(present: np.ndarray, believed: np.ndarray, shortest: int) -> Iterator[tuple[int, int, int]]:
    """Where runs of believed samples meet a gap, as (marker, frame, side): side 1 where the gap begins at that frame, -1
    where it ends there. Runs that are too short to tell are left out."""
    for m in range(present.shape[1]):
        holes = [(start, stop) for start, stop in runs(~believed[:, m]) if not present[start:stop, m].all()]
        begins, ends = {start for start, _ in holes}, {stop for _, stop in holes}
        for start, stop in runs(believed[:, m]):
            if stop - start >= shortest:
                yield from [(m, start, -1)] if start in ends else []
                yield from [(m, stop, 1)] if stop in begins else []


def _onset(course: np.ndarray, residual: np.ndarray, before: int, level: float) -> int | None:
    """After how many of the samples that follow the first `before` something sudden begins; None if nothing does.

    course, residual: (n, 3), mm. Sudden is what bends the course by more than `level` mm from one frame to the next, and
    the residual alike: a neighbour's artifact or gap changes only the residual, motion that goes on as it did bends the
    course little. It begins where both leave together for the first time.
    """
    change, motion = np.diff(residual, axis=0)[before - 1 :], np.diff(course, axis=0)
    bend = _shared(np.diff(motion, axis=0)[before - 2 :], change) > level
    away = _shared((motion - np.median(motion[: before - 1], axis=0))[before - 1 :], change) > level
    return int(np.argmax(bend | away)) if bend.any() else None


def _shared(motion: np.ndarray, change: np.ndarray) -> np.ndarray:
    """How much of each change of the residual (n, 3) the motion makes as well, mm; 0 where either is unknown."""
    length = np.linalg.norm(change, axis=1)
    along = np.einsum("na,na->n", motion, change) / np.maximum(length, 1e-9)
    return np.nan_to_num(np.clip(along, 0, length))


def _median(values: np.ndarray) -> float:
    """Median of what is known, 0 without any."""
    known = values[~np.isnan(values)]
    return float(np.median(known)) if len(known) else 0.0
