"""Options of the state-space models: kalman and bolero."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import (
    AtLeast,
    Count,
    CountOrNone,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Seconds,
    Share,
)


@dataclass(frozen=True)
class KalmanSmootherOptions:
    """Low-dimensional Kalman smoother (Burke & Lasenby 2016), the member for blackouts: kalman."""

    neighbours: Count = 20
    """Neighbours in the model, at most."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Joint frames, at least."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    explained_variance: Share = 0.9999
    """Share of the variance of the shape that sets the number of components (0 to 1)."""

    max_components: Count = 30
    """Components of the shape, at most."""

    min_noise_mm: PositiveMillimetres = 1
    """Deviation of a marker from the pose, at least."""

    context_s: PositiveSeconds = 0.3
    """Time on either side of a gap that the smoother uses."""

    folds: Annotated[int, AtLeast(2)] = 5
    """One in this many stretches as long as the gap is left out in turn to measure how well the pose predicts the marker."""


@dataclass(frozen=True)
class BoleroOptions:
    """Linear dynamical system with soft bone lengths (Li et al. 2009, 2010): bolero."""

    state_dimensions: Count = 16
    """Dimensions of the state, at most."""

    neighbours: Count = 8
    """Neighbours in the model, at most, without the other ends of bones."""

    centred: bool = True
    """Whether the mean of the neighbours that are never missing is subtracted from each frame."""

    context_s: PositiveSeconds = 3
    """The window extends beyond either border of the gap by one to two times this."""

    min_training_frames: Count = 60
    """Markers that are seen on fewer frames of the window are left out."""

    lag_s: Seconds = 0.05
    """Time by which the first guess of the states looks ahead; 0 leaves velocities out of it."""

    max_iterations: Count = 20
    """Steps of expectation maximisation, at most."""

    tolerance: NotNegative = 1e-4
    """Learning ends when the log-likelihood rises by less than this per observed number."""

    min_deviation_share: Positive = 0.001
    """Standard deviation of noise, innovation and bone lengths, as a share of the spread of the markers, at least."""

    bones: CountOrNone = 3
    """Bone lengths that hold for each missing marker; 0 leaves the plain linear dynamical system (DynaMMo)."""

    max_bone_frames: Count = 1000
    """Frames from which bone lengths are learned, at most."""

    max_bone_steps: Count = 10
    """Steps towards the bone lengths, at most."""
