"""Options of the regressions on earlier samples (skurowski2022): polynomial and replicated_network."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import (
    Above,
    AtLeast,
    AtMost,
    Count,
    CountOrNone,
    NotNegative,
    Positive,
    PositiveSeconds,
    Share,
)


@dataclass(frozen=True)
class LaggedRegressionOptions:
    """Polynomial least squares on siblings and parent marker (skurowski2022): polynomial."""

    neighbours: Count = 6
    """Nearest neighbours that are used where siblings and parent marker are not known."""

    lags: CountOrNone = 3
    """Earlier samples that are used."""

    lag_interval_s: PositiveSeconds = 0.01
    """Time between them."""

    max_power: Count = 4
    """Highest power of a coordinate."""

    max_training_frames: Annotated[int, AtLeast(10)] = 2500
    """Training frames, at most; they are evenly spaced."""

    min_training_frames: Annotated[int, AtLeast(10)] = 60
    """Joint frames, at least."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the frames gives way to the next nearest (0 to 1)."""


@dataclass(frozen=True)
class ReplicatedNetworkOptions(LaggedRegressionOptions):
    """Neural network with replicated outputs (skurowski2022): replicated_network."""

    lags: CountOrNone = 1
    """Earlier samples that are used."""

    max_power: Count = 2
    """Highest power of a coordinate."""

    max_training_frames: Annotated[int, AtLeast(10)] = 800
    """Training frames, at most; they are evenly spaced."""

    moving_average_s: PositiveSeconds = 2
    """Window of the moving average of the marker's own trajectory, which is an input too.

    Change it when artifacts last longer than this."""

    hidden_units: tuple[Count, ...] = (12, 20)
    """Units of the hidden layers."""

    replicas: Count = 5
    """Copies of the output; the prediction is their mean."""

    validation_share: Annotated[float, Above(0), AtMost(0.5)] = 0.15
    """Share of the frames that is held out to decide when training stops (0 to 0.5)."""

    max_iterations: Count = 1000
    """Steps of the training, at most.

    Change it when you trade time for accuracy."""

    gradient_tolerance: NotNegative = 1e-6
    """Training ends when no component of the gradient is larger."""

    curvature_step: Positive = 5e-5
    """Length of the step over which the training measures curvature."""

    patience: Count = 6
    """Training ends after this many steps without a smaller error on the held-out frames."""

    seed: CountOrNone = 1
    """Seed of the first weights."""
