"""Replicated feed-forward network (skurowski2022 3.3.3): a marker from its relatives, and from where it is on average.

Its three outputs are there several times and their mean is the prediction: begun at random and not trained to the end,
the replicas err in different ways. The networks of many markers are trained together.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.numerics import intervals
from markermend.numerics.scaled_conjugate_gradient import DescentOptions, minimise
from markermend.options.prediction import ReplicatedNetworkOptions
from markermend.prediction.lagged_regression.feed_forward import Stack, initial, mean_output
from markermend.prediction.lagged_regression.polynomial import raised
from markermend.prediction.lagged_regression.predictor import LaggedRegression, Learned, Task
from markermend.prediction.scene import Scene


class ReplicatedNetwork(LaggedRegression):
    """The replicated network as a predictor; states no error, as the held-out frames lie too near to those trained on."""

    name = "replicated_network"
    options: ReplicatedNetworkOptions

    def __init__(self, options: ReplicatedNetworkOptions) -> None:
        """Keep the options; nothing is trained before a marker is asked for."""
        super().__init__(options)

    def rows(self, scene: Scene, marker: int, inputs: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """The relatives' coordinates and, last, the marker's own moving average (skurowski2022 eq 11), (n, k), mm."""
        window = intervals.samples(self.options.moving_average_s, scene.rate)
        average = scene.cached((self.name, window, marker), lambda: moving_average(scene.positions[:, marker], window))
        return np.concatenate([super().rows(scene, marker, inputs, frames), average[frames]], axis=1)

    def learn(self, tasks: Sequence[Task]) -> list[Learned]:
        """See LaggedRegression. Networks with as many inputs advance together."""
        scalings = [Scaling(task, self.options.max_power) for task in tasks]
        learned: dict[int, Learned] = {}
        for width in {scaling.width for scaling in scalings}:
            alike = [number for number, scaling in enumerate(scalings) if scaling.width == width]
            sizes = (width, *self.options.hidden_units, 3 * self.options.replicas)
            found = self._train([tasks[number] for number in alike], [scalings[number] for number in alike], sizes)
            for number, parameters in zip(alike, found, strict=True):
                learned[number] = scalings[number].learned(parameters, sizes)
        return [learned[number] for number in range(len(tasks))]

    def _train(self, tasks: Sequence[Task], scalings: Sequence[Scaling], sizes: Sequence[int]) -> np.ndarray:
        """Parameters (tasks, n) of networks, each begun as its marker and the seed say."""
        options = self.options
        each = round(1 / options.validation_share)
        held = [np.arange(len(task.frames)) % each == each // 2 for task in tasks]
        parts = list(zip(tasks, scalings, held, strict=True))
        trained = Stack([scaling.data(task, ~out) for task, scaling, out in parts], sizes)
        judged = Stack([scaling.data(task, out) for task, scaling, out in parts], sizes)
        start = [initial(sizes, rng=np.random.default_rng([options.seed, task.marker])) for task in tasks]
        return minimise(
            trained.loss,
            np.stack(start),
            options=DescentOptions(
                options.max_iterations, options.gradient_tolerance, options.curvature_step, options.patience
            ),
            held_out=judged.error,
        ).parameters


class Scaling:
    """How rows of one task become what its network sees: standardized coordinates, their powers, and the average."""

    def __init__(self, task: Task, powers: int) -> None:
        self.powers = powers
        self.middle, self.scale = _spread(task.rows)
        self.second_middle, self.second_scale = np.zeros(1), np.ones(1)
        self.second_middle, self.second_scale = _spread(self.features(task.rows))
        self.centre, self.size = _spread(task.target)
        self.width = len(self.second_middle)

    def features(self, rows: np.ndarray) -> np.ndarray:
        """Inputs of the network, (n, width)."""
        plain = (rows - self.middle) / self.scale
        features = np.concatenate([*raised(plain[:, :-3], self.powers), plain[:, -3:]], axis=1)
        return (features - self.second_middle) / self.second_scale

    def data(self, task: Task, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What a network is given (n, width) and is to say (n, 3) at the chosen of its task's frames."""
        return self.features(task.rows[chosen]), (task.target[chosen] - self.centre) / self.size

    def learned(self, parameters: np.ndarray, sizes: Sequence[int]) -> Learned:
        """The trained network."""

        def model(rows: np.ndarray) -> np.ndarray:
            said = mean_output(parameters[None], sizes, self.features(rows)[None], size=3)[0]
            return said * self.size + self.centre

        return Learned(model, np.nan)


def moving_average(course: np.ndarray, window: int) -> np.ndarray:
    """Mean of what is seen of a course (frames, 3) within half a window of each frame; where nothing is, a straight line."""
    seen = ~np.isnan(course).any(axis=1)
    values = np.concatenate([np.where(seen[:, None], course, 0), seen[:, None]], axis=1)
    total = np.concatenate([np.zeros((1, 4)), np.cumsum(values, axis=0)])
    frames = np.arange(len(course))
    last = np.minimum(frames + window // 2 + 1, len(course))
    total = total[last] - total[np.maximum(frames - window // 2, 0)]
    known = np.flatnonzero(total[:, 3])
    if len(known) == 0:
        return np.full(course.shape, np.nan)
    mean = total[known, :3] / total[known, 3:]
    return np.stack([np.interp(frames, known, axis) for axis in mean.T], axis=1)


def _spread(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean and standard deviation of each column; what hardly varies is not blown up."""
    return rows.mean(axis=0), np.maximum(rows.std(axis=0), 1e-3)
