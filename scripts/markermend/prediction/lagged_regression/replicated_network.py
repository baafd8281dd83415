"""Replicated feed-forward network (skurowski2022 3.3.3): a marker from its segment mates and its own moving average.

The output is replicated, and the mean of the replicas is the prediction: started at random and stopped early, they err
in different ways. Training is that of Matlab's `feedforwardnet`, by whose algorithm the paper trains: inputs and targets from -1 to 1, the
start of Nguyen and Widrow, errors in mm, and an end when held-out frames are predicted no better. The networks of many markers are
trained together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.numerics import intervals
from markermend.numerics.scaled_conjugate_gradient import DescentOptions, minimise
from markermend.options.prediction.lagged_regression import ReplicatedNetworkOptions
from markermend.prediction.lagged_regression.feed_forward import Stack, initial, mean_output
from markermend.prediction.lagged_regression.polynomial import MIN_DEVIATION_MM, powers
from markermend.prediction.lagged_regression.predictor import LaggedRegression, Regression, TrainingSet
from markermend.prediction.scene import Scene


class ReplicatedNetwork(LaggedRegression):
    """The replicated network as a predictor; it states no error, as the held-out frames lie too near to the others.

    Parameters
    ----------
    options : ReplicatedNetworkOptions
        Options of the inputs, the network and the training.
    """

    name = "replicated_network"
    options: ReplicatedNetworkOptions

    def __init__(self, options: ReplicatedNetworkOptions) -> None:
        super().__init__(options)

    def rows(self, scene: Scene, marker: int, inputs: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """Assemble the lagged inputs and, last, the marker's own moving average. See `LaggedRegression.rows`."""
        window = intervals.samples(self.options.moving_average_s, scene.rate)
        average = scene.cached((self.name, window, marker), lambda: moving_average(scene.positions[:, marker], window))
        return np.concatenate([super().rows(scene, marker, inputs, frames), average[frames]], axis=1)

    def fit(self, training: Sequence[TrainingSet]) -> list[Regression]:
        """Train the networks, those with equally many inputs together. See `LaggedRegression.fit`."""
        scalings = [Scaling.of(own, self.options.max_power) for own in training]
        trained: dict[int, Regression] = {}
        for width in {scaling.width for scaling in scalings}:
            group = [number for number, scaling in enumerate(scalings) if scaling.width == width]
            sizes = (width, *self.options.hidden_units, 3 * self.options.replicas)
            found = self._train([training[number] for number in group], [scalings[number] for number in group], sizes)
            for number, parameters in zip(group, found, strict=True):
                trained[number] = Regression(TrainedNetwork(scalings[number], parameters, sizes), np.nan)
        return [trained[number] for number in range(len(training))]

    def _train(self, training: Sequence[TrainingSet], scalings: Sequence[Scaling], sizes: Sequence[int]) -> np.ndarray:
        """Parameters (networks, n), each started by the seed and the marker, stopped by its error on held-out frames."""
        options = self.options
        every = round(1 / options.validation_share)
        held = [np.arange(len(own.frames)) % every == every // 2 for own in training]
        parts = list(zip(training, scalings, held, strict=True))
        units = [scaling.units for scaling in scalings]
        trained = Stack([scaling.data(own, ~out) for own, scaling, out in parts], sizes, units)
        validation = Stack([scaling.data(own, out) for own, scaling, out in parts], sizes, units)
        start = [initial(sizes, rng=np.random.default_rng([options.seed, own.marker])) for own in training]
        return minimise(
            trained.loss,
            np.stack(start),
            options=DescentOptions(
                options.max_iterations, options.gradient_tolerance, options.curvature_step, options.patience
            ),
            held_out=validation.error,
        ).parameters


@dataclass(frozen=True)
class Scaling:
    """How rows of inputs become those of the network: coordinates, their powers, and the average, each from -1 to 1 in training.

    Attributes
    ----------
    max_power : int
        Highest power of a coordinate.
    centre, half_range : np.ndarray
        Of each input (width,), mm and its powers.
    target_centre, target_half_range : np.ndarray
        Of each target (3,), mm.
    """

    max_power: int
    centre: np.ndarray
    half_range: np.ndarray
    target_centre: np.ndarray
    target_half_range: np.ndarray

    @classmethod
    def of(cls, training: TrainingSet, max_power: int) -> Scaling:
        """Take the ranges of a training set.

        Parameters
        ----------
        training : TrainingSet
            The training set.
        max_power : int
            Highest power of a coordinate.

        Returns
        -------
        Scaling
            The scaling.
        """
        return cls(max_power, *_range(_inputs(training.rows, max_power)), *_range(training.target))

    @property
    def width(self) -> int:
        """Number of inputs of the network."""
        return len(self.centre)

    def features(self, rows: np.ndarray) -> np.ndarray:
        """Compute the inputs of the network.

        Parameters
        ----------
        rows : np.ndarray
            Rows (n, k), mm.

        Returns
        -------
        np.ndarray
            Features (n, width).
        """
        scaled: np.ndarray = (_inputs(rows, self.max_power) - self.centre) / self.half_range
        return scaled

    def data(self, training: TrainingSet, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Scale some frames of a training set.

        Parameters
        ----------
        training : TrainingSet
            The training set.
        chosen : np.ndarray
            Which of its frames, bool (n,).

        Returns
        -------
        features : np.ndarray
            Inputs (m, width).
        targets : np.ndarray
            Scaled targets (m, 3).
        """
        targets = (training.target[chosen] - self.target_centre) / self.target_half_range
        return self.features(training.rows[chosen]), targets

    @property
    def units(self) -> np.ndarray:
        """What one is in each target (3,), as a part of the largest of them: so errors count in mm."""
        units: np.ndarray = self.target_half_range / self.target_half_range.max()
        return units


@dataclass(frozen=True)
class TrainedNetwork:
    """A trained network between millimetres and millimetres.

    Attributes
    ----------
    scaling : Scaling
        What is done to inputs and outputs.
    parameters : np.ndarray
        Parameters of the network (n,).
    sizes : Sequence[int]
        Sizes of its layers.
    """

    scaling: Scaling
    parameters: np.ndarray
    sizes: Sequence[int]

    def __call__(self, rows: np.ndarray) -> np.ndarray:
        """Predict positions (n, 3) from rows of inputs (n, k), mm."""
        features = self.scaling.features(rows)[None]
        outputs = mean_output(self.parameters[None], self.sizes, features, size=3)[0]
        positions: np.ndarray = outputs * self.scaling.target_half_range + self.scaling.target_centre
        return positions


def moving_average(trajectory: np.ndarray, window: int) -> np.ndarray:
    """Average a trajectory over a centred window, with straight lines where the window shows nothing.

    Parameters
    ----------
    trajectory : np.ndarray
        Positions (frames, 3), mm, NaN = missing.
    window : int
        Length of the window, samples.

    Returns
    -------
    np.ndarray
        Averages of what is observed (frames, 3), mm; NaN throughout if nothing is.
    """
    observed = ~np.isnan(trajectory).any(axis=1)
    values = np.concatenate([np.where(observed[:, None], trajectory, 0), observed[:, None]], axis=1)
    total = np.concatenate([np.zeros((1, 4)), np.cumsum(values, axis=0)])
    frames = np.arange(len(trajectory))
    last = np.minimum(frames + window // 2 + 1, len(trajectory))
    total = total[last] - total[np.maximum(frames - window // 2, 0)]
    known = np.flatnonzero(total[:, 3])
    if len(known) == 0:
        return np.full(trajectory.shape, np.nan)
    mean = total[known, :3] / total[known, 3:]
    return np.stack([np.interp(frames, known, axis) for axis in mean.T], axis=1)


def _inputs(rows: np.ndarray, max_power: int) -> np.ndarray:
    """The coordinates, their powers, and the average (skurowski2022 eq 11)."""
    return np.concatenate([*powers(rows[:, :-3], max_power), rows[:, -3:]], axis=1)


def _range(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centre and half the range of each column, the latter bounded from below."""
    least, largest = rows.min(axis=0), rows.max(axis=0)
    return (least + largest) / 2, np.maximum((largest - least) / 2, MIN_DEVIATION_MM)
