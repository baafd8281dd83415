"""Kalman smoother in a low-dimensional space of poses: carries the whole body across blackouts (Burke & Lasenby 2016).

The state is the place of the body and its pose, principal components of the shape, with their velocities.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.low_rank import conditional_mean
from markermend.options.prediction.state_space import KalmanSmootherOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Scene
from markermend.prediction.state_space.linear_dynamics import LinearDynamics

DIFFUSE = 10
"""Variance of the first state in units of that over the recording."""


def constant_velocity_model(
    loading: np.ndarray,
    offset: np.ndarray,
    *,
    observation_noise: np.ndarray,
    acceleration: np.ndarray,
    position_variance: np.ndarray,
    velocity_variance: np.ndarray,
) -> LinearDynamics:
    """Make a system of d states that keep their velocities but for white acceleration, in units of frames.

    Parameters
    ----------
    loading : np.ndarray
        Position of each marker per unit of state, (markers, 3, d).
    offset : np.ndarray
        Positions (markers, 3) at state zero.
    observation_noise : np.ndarray
        Variances (markers,) of each observed coordinate.
    acceleration : np.ndarray
        Variances (d,) of the velocity that comes in per frame.
    position_variance : np.ndarray
        Variances (d,) of the first state about zero.
    velocity_variance : np.ndarray
        Variances (d,) of its velocity about zero.

    Returns
    -------
    LinearDynamics
        The system; its 2 d dimensions are the states and, after them, their velocities.

    References
    ----------
    Bar-Shalom, Li & Kirubarajan (2001), Estimation with Applications to Tracking and Navigation, section 6.2.2.
    """
    each = np.eye(len(acceleration))
    return LinearDynamics(
        initial_variance=np.concatenate([position_variance, velocity_variance]),
        transition=np.kron([[1, 1], [0, 1]], each),
        process_noise=np.kron([[1 / 3, 1 / 2], [1 / 2, 1]], acceleration * each),
        loading=np.concatenate([loading, np.zeros_like(loading)], axis=2),
        offset=offset,
        observation_noise=observation_noise,
    )


@dataclass(frozen=True)
class _PoseSpace:
    """Place and principal components of the shape of a body of k markers.

    place: (3,), mm, mean over the training. shape: (3 k,), mm, the mean shape about the place. basis: (3 k, c).
    """

    place: np.ndarray
    shape: np.ndarray
    basis: np.ndarray

    def loading(self) -> np.ndarray:
        """Position of each marker per unit of state, (k, 3, 3 + c)."""
        translation = np.tile(np.eye(3), (len(self.shape) // 3, 1))
        return np.concatenate([translation, self.basis], axis=1).reshape(len(self.shape) // 3, 3, -1)

    def states(self, poses: np.ndarray) -> np.ndarray:
        """States (n, 3 + c) of poses (n, k, 3)."""
        places = poses.mean(axis=1)
        scores = ((poses - places[:, None]).reshape(len(poses), -1) - self.shape) @ self.basis
        return np.concatenate([places - self.place, scores], axis=1)


class KalmanSmoother:
    """The low-dimensional Kalman smoother as a predictor; it states the smoother's own error.

    Parameters
    ----------
    options : KalmanSmootherOptions
        Options of the choice of markers and frames, and of the pose space.

    References
    ----------
    Burke & Lasenby (2016), "Estimating missing marker positions using low dimensional Kalman smoothing", Journal of
    Biomechanics 49(9).
    """

    name = "kalman"
    continuous = False

    def __init__(self, options: KalmanSmootherOptions) -> None:
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker, also where no marker is observed during the gap. See `Predictor.predict`."""
        options = self.options
        hidden = scene.without(marker, start, stop)
        prediction = Prediction.empty(start, stop)
        near = np.asarray(hidden.neighbours[marker], int)[: options.neighbours]
        chosen, joint = jointly_observed(
            hidden, marker, near, min_share=options.min_joint_share, min_frames=options.min_training_frames
        )
        context = max(2, round(options.context_s * scene.rate))
        window = np.arange(max(start - 1 - context, 0), min(stop + 1 + context, len(scene.positions)))
        body = np.array([marker, *chosen])
        observed = hidden.positions[np.ix_(window, body)]
        if len(chosen) < 2 or np.isnan(observed).all():
            return prediction
        system = self._learn(hidden, body, joint, max(1, (stop - start) // 2))
        inside = np.flatnonzero((window >= start - 1) & (window <= stop))
        states = system.smooth(observed)
        place = window[inside] - (start - 1)
        prediction.positions[place] = system.positions(states.mean[inside])[:, 0]
        covariance = system.position_covariance(states.covariance[inside], 0)
        prediction.error[place] = np.sqrt(np.trace(covariance, axis1=1, axis2=2) / 3)
        return prediction

    def _learn(self, scene: Scene, body: np.ndarray, joint: np.ndarray, lag: int) -> LinearDynamics:
        """The system of a body, from the frames that show it: its pose space, and how states change over a lag."""
        options = self.options
        training = evenly_spaced(joint, options.max_training_frames)
        poses = scene.positions[np.ix_(training, body)]
        space, noise = self._pose_space(poses)
        # The residuals of the marker itself are too small in sample: its noise is that of poses left out.
        stretches = training // (2 * lag)
        noise[0] = max(noise[0], _left_out_error(poses, stretches, rank=space.basis.shape[1], folds=options.folds))
        trajectory = np.full((len(scene.positions), 3 + space.basis.shape[1]), np.nan)
        trajectory[joint] = space.states(scene.positions[np.ix_(joint, body)])
        variance = np.maximum(np.nanvar(trajectory, axis=0), options.min_noise_mm**2)
        velocity = np.nan_to_num(_mean_square(np.diff(trajectory, axis=0)), nan=1.0)
        least = options.min_noise_mm**2 / scene.rate**3
        return constant_velocity_model(
            space.loading(),
            space.shape.reshape(-1, 3) + space.place,
            observation_noise=noise,
            acceleration=np.maximum(_acceleration(trajectory, lag), least),
            position_variance=DIFFUSE * variance,
            velocity_variance=np.maximum(DIFFUSE * velocity, least),
        )

    def _pose_space(self, poses: np.ndarray) -> tuple[_PoseSpace, np.ndarray]:
        """The pose space of poses (n, k, 3), and the variance (k,) of a coordinate that it leaves to each marker."""
        options = self.options
        places = poses.mean(axis=1)
        shapes = (poses - places[:, None]).reshape(len(poses), -1)
        shape = shapes.mean(axis=0)
        sizes, vectors = np.linalg.eigh(np.cov(shapes, rowvar=False))
        sizes, vectors = np.maximum(sizes[::-1], 0.0), vectors[:, ::-1]
        count = int(np.searchsorted(np.cumsum(sizes), options.explained_variance * sizes.sum())) + 1
        basis = vectors[:, : min(count, options.max_components, len(sizes))]
        rest = (shapes - shape) - (shapes - shape) @ basis @ basis.T
        noise = np.maximum((rest**2).mean(axis=0).reshape(-1, 3).mean(axis=1), options.min_noise_mm**2)
        return _PoseSpace(places.mean(axis=0), shape, basis), noise


def _acceleration(trajectory: np.ndarray, lag: int) -> np.ndarray:
    """Variance of the velocity (columns,) that comes in per frame, from the misfit of bridging two lags; 0 if unknown.

    For white acceleration it would not depend on the lag. Motion is not white, and this lag is the one that matters.
    """
    variance = np.full(trajectory.shape[1], np.nan)
    while np.isnan(variance).any() and lag >= 1:
        # In the middle of n frames between known states the variance is the acceleration's times n^3 / 192.
        variance = 192 * _mean_square(_bridging_misfit(trajectory, lag)) / (2 * lag) ** 3
        lag //= 2
    known: np.ndarray = np.nan_to_num(variance)
    return known


def _bridging_misfit(trajectory: np.ndarray, lag: int) -> np.ndarray:
    """By how much the smoothest curve, given position and velocity at both ends of two lags, misses their middle."""
    reach = -(-lag // 8)
    frames = max(len(trajectory) - 2 * (lag + reach), 0)
    before, first, middle, last, after = (
        trajectory[place : place + frames] for place in (0, reach, reach + lag, reach + 2 * lag, 2 * (reach + lag))
    )
    slowing = (first - before) / reach - (after - last) / reach
    misfit: np.ndarray = middle - (first + last) / 2 - lag / 4 * slowing
    return misfit


def _left_out_error(poses: np.ndarray, stretches: np.ndarray, *, rank: int, folds: int) -> float:
    """Mean square error of a coordinate of the first marker, predicted from the others in stretches left out.

    stretches: (n,), the number of the stretch to which each pose belongs; one in `folds` is left out in turn.
    """
    place = poses[:, 1:].mean(axis=1)
    shapes = (poses - place[:, None]).reshape(len(poses), -1)
    square = []
    for fold in range(folds):
        left = stretches % folds == fold
        if left.any() and np.count_nonzero(~left) > rank:
            incomplete = shapes[left].copy()
            incomplete[:, :3] = np.nan
            square.append((conditional_mean(shapes[~left], incomplete, rank)[:, :3] - shapes[left, :3]) ** 2)
    return float(np.concatenate(square).mean()) if square else 0.0


def _mean_square(values: np.ndarray) -> np.ndarray:
    """Mean square (columns,) of the rows without NaN; NaN where there is none."""
    known = values[~np.isnan(values).any(axis=1)]
    if len(known) == 0:
        return np.full(values.shape[1], np.nan)
    mean: np.ndarray = (known**2).mean(axis=0)
    return mean
