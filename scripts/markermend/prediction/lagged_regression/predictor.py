"""Loose predictors (skurowski2022 3.3): a marker from its siblings and parent marker, not from where it was just before.

The row of inputs holds their laboratory coordinates now and a few samples before, and powers of these (eq 9, 11). What
was not seen in the sample before is taken as it is now.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.numerics.patterns import group_by_pattern
from markermend.options.prediction import LaggedRegressionOptions
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Prediction, Scene

LAGGED_REGRESSIONS = ("polynomial", "replicated_network")
"""The loose predictors by name; their options have sections of the config of the same names."""


@dataclass(frozen=True)
class Task:
    """What to learn: rows of inputs (n, k), the positions there (n, 3), mm, the frames that they are of, and whose."""

    rows: np.ndarray
    target: np.ndarray
    frames: np.ndarray
    marker: int
    rate: float


@dataclass(frozen=True)
class Learned:
    """What was learned: from rows of inputs (n, k) to positions (n, 3), mm; and its error per axis, mm, NaN if not known."""

    model: Callable[[np.ndarray], np.ndarray]
    error: float


class LaggedRegression(ABC):
    """What the loose predictors share: choosing inputs, making rows of them, and remembering what was learned."""

    name: str
    continuous = False

    def __init__(self, options: LaggedRegressionOptions) -> None:
        """Keep the options; nothing is learned before a marker is asked for."""
        self.options = options

    @abstractmethod
    def learn(self, tasks: Sequence[Task]) -> list[Learned]:
        """Learn all the tasks."""

    def rows(self, scene: Scene, marker: int, inputs: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """Inputs of a marker (n, k) at frames: coordinates of the markers `inputs`, now and before, mm."""
        step = max(1, round(self.options.lag_interval_s * scene.rate))
        known = [scene.positions[np.ix_(frames, inputs)].reshape(len(frames), -1)]
        for lag in range(1, self.options.lags + 1):
            before = scene.positions[np.ix_(np.maximum(frames - lag * step, 0), inputs)].reshape(len(frames), -1)
            known.append(np.where(np.isnan(before), known[-1], before))
        return np.concatenate(known, axis=1)

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Where a usual input is not seen, others that are seen take part, by a model of their own."""
        hidden = scene.without(marker, start, stop)
        frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
        positions = np.full((stop - start + 2, 3), np.nan)
        error = np.full(stop - start + 2, np.nan)
        for inputs, rows in self._occasions(hidden, marker, frames):
            learned = self._learned([(hidden, marker, inputs)])[0]
            positions[rows - (start - 1)] = learned.model(self.rows(hidden, marker, inputs, rows))
            error[rows - (start - 1)] = learned.error
        return Prediction(positions, error)

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Observed minus predicted, (frames, markers, 3), mm; NaN where either is missing, or one of the inputs.

        markers: indices to work on; the others stay NaN. All are learned at once, each from all of its frames.
        """
        out = np.full(scene.positions.shape, np.nan)
        jobs = self._usual_jobs((scene, m) for m in (range(scene.positions.shape[1]) if markers is None else markers))
        for (_, m, inputs), learned in zip(jobs, self._learned(jobs), strict=True):
            rows = np.flatnonzero(scene.present[:, m] & scene.present[:, inputs].all(axis=1))
            out[rows, m] = scene.positions[rows, m] - learned.model(self.rows(scene, m, inputs, rows))
        return out

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """See Trainable: learn from the usual inputs."""
        self._learned(self._usual_jobs(jobs))

    def _usual_jobs(self, jobs: Iterable[tuple[Scene, int]]) -> list[tuple[Scene, int, np.ndarray]]:
        """The jobs with the usual inputs, but for markers that are seen too rarely."""
        chosen = [(scene, marker, self._usual(scene, marker)) for scene, marker in jobs]
        return [job for job in chosen if len(job[2])]

    def _learned(self, jobs: Sequence[tuple[Scene, int, np.ndarray]]) -> list[Learned]:
        """What is known of each scene, marker and inputs; what is not yet known is learned, all of it at once."""
        keys = [(self, marker, inputs.tobytes()) for _, marker, inputs in jobs]
        new: Callable[[], list[Learned]] = list
        memory = [job[0].cached(key, new) for job, key in zip(jobs, keys, strict=True)]
        blank = [number for number, known in enumerate(memory) if not known]
        fresh = self.learn([self._task(*jobs[number]) for number in blank])
        for number, learned in zip(blank, fresh, strict=True):
            memory[number].append(learned)
        return [known[0] for known in memory]

    def _task(self, scene: Scene, marker: int, inputs: np.ndarray) -> Task:
        """What there is to learn from: of frames that show the marker and its inputs, measured ones if they are enough."""
        for source in (scene.measured or scene, scene):
            joint = np.flatnonzero(source.present[:, marker] & source.present[:, inputs].all(axis=1))
            if len(joint) >= self.options.min_training_frames:
                break
        frames = evenly_spaced(joint, self.options.max_training_frames)
        rows = self.rows(source, marker, inputs, frames)
        return Task(rows, source.positions[frames, marker], frames, marker, scene.rate)

    def _ranked(self, scene: Scene, marker: int) -> tuple[np.ndarray, int]:
        """Siblings and parent marker, then the other neighbours, nearest first; and how many to use."""
        near = np.asarray(scene.neighbours[marker], int)
        if scene.segment_mates is None:
            return near, self.options.neighbours
        first = np.asarray(scene.segment_mates[marker], int)
        return np.concatenate([first, near[~np.isin(near, first)]]), len(first)

    def _usual(self, scene: Scene, marker: int) -> np.ndarray:
        """The inputs of a marker, ascending; none where it is seen too rarely with others."""
        ranked, count = self._ranked(scene, marker)
        options = self.options
        chosen, _ = jointly_observed(
            scene, marker, ranked, share=options.min_joint_share, minimum_frames=options.min_training_frames
        )
        return np.sort(chosen[:count])

    def _occasions(self, scene: Scene, marker: int, frames: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield inputs and the frames that they are to predict: the usual inputs, then what else is seen."""
        usual = self._usual(scene, marker)
        if len(usual) == 0:
            return
        whole = scene.present[np.ix_(frames, usual)].all(axis=1)
        if whole.any():
            yield usual, frames[whole]
        left = frames[~whole]
        if len(left) == 0:
            return
        ranked, count = self._ranked(scene, marker)
        for used, places in group_by_pattern(scene.present[np.ix_(left, ranked)], count):
            options = self.options
            seen = ranked[used]
            inputs, _ = jointly_observed(
                scene, marker, seen, share=options.min_joint_share, minimum_frames=options.min_training_frames
            )
            if len(inputs):
                yield np.sort(inputs[:count]), left[places]
