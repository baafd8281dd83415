"""Kalman smoother in a low-dimensional space of poses: carries the whole body across blackouts (Burke & Lasenby 2016).

The state is where the body is and which pose it has, principal components of the shape, with their velocities.
"""

from __future__ import annotations

import numpy as np

from markermend.numerics.low_rank import conditional_mean
from markermend.options.prediction import KalmanSmootherOptions
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Prediction, Scene
from markermend.prediction.state_space.linear_dynamics import LinearDynamics


def steady_motion(
    loading: np.ndarray,
    middle: np.ndarray,
    *,
    noise: np.ndarray,
    drive: np.ndarray,
    start: np.ndarray,
    start_velocity: np.ndarray,
) -> LinearDynamics:
    """A system of d states that keep their velocities but for white acceleration, in units of frames.

    loading: (markers, 3, d), position of each marker per unit of state. middle, noise: as in LinearDynamics. drive:
    (d,), variance of the velocity that comes in per frame. start, start_velocity: (d,), variances of the first state
    about zero. The velocities follow the states, so that the system has 2 d dimensions.
    """
    each = np.eye(len(drive))
    return LinearDynamics(
        start=np.concatenate([start, start_velocity]),
        transition=np.kron([[1, 1], [0, 1]], each),
        drive=np.kron([[1 / 3, 1 / 2], [1 / 2, 1]], drive * each),
        loading=np.concatenate([loading, np.zeros_like(loading)], axis=2),
        middle=middle,
        noise=noise,
    )


class KalmanSmoother:
    """The low-dimensional Kalman smoother as a predictor; states the smoother's own error."""

    name = "kalman"
    continuous = False

    def __init__(self, options: KalmanSmootherOptions) -> None:
        """Keep the options."""
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Needs no marker during the gap, but some beside it."""
        options = self.options
        hidden = scene.without(marker, start, stop)
        positions, error = np.full((stop - start + 2, 3), np.nan), np.full(stop - start + 2, np.nan)
        near = np.asarray(hidden.neighbours[marker], int)[: options.neighbours]
        chosen, joint = jointly_observed(
            hidden, marker, near, share=options.min_joint_share, minimum_frames=options.min_training_frames
        )
        context = max(2, round(options.context_s * scene.rate))
        window = np.arange(max(start - 1 - context, 0), min(stop + 1 + context, len(scene.positions)))
        body = np.array([marker, *chosen])
        observed = hidden.positions[np.ix_(window, body)]
        if len(chosen) < 2 or np.isnan(observed).all():
            return Prediction(positions, error)
        system = self._learn(hidden, body, joint, max(1, (stop - start) // 2))
        asked = np.flatnonzero((window >= start - 1) & (window <= stop))
        states = system.smooth(observed)
        place = window[asked] - (start - 1)
        positions[place] = system.positions(states.mean[asked])[:, 0]
        spread = system.spread(states.covariance[asked], 0)
        error[place] = np.sqrt(np.trace(spread, axis1=1, axis2=2) / 3)
        return Prediction(positions, error)

    def _learn(self, scene: Scene, body: np.ndarray, joint: np.ndarray, lag: int) -> LinearDynamics:
        """Components of the shape, and how fast they change over the lag (frames), from frames that show the body."""
        options = self.options
        training = evenly_spaced(joint, options.max_training_frames)
        poses = scene.positions[np.ix_(training, body)]
        place = poses.mean(axis=1)
        shapes = (poses - place[:, None]).reshape(len(poses), -1)
        shape = shapes.mean(axis=0)
        sizes, vectors = np.linalg.eigh(np.cov(shapes, rowvar=False))
        sizes, vectors = np.maximum(sizes[::-1], 0.0), vectors[:, ::-1]
        count = int(np.searchsorted(np.cumsum(sizes), options.explained_variance * sizes.sum())) + 1
        basis = vectors[:, : min(count, options.max_components, len(sizes))]
        rest = (shapes - shape) - (shapes - shape) @ basis @ basis.T
        noise = np.maximum((rest**2).mean(axis=0).reshape(-1, 3).mean(axis=1), options.min_noise_mm**2)
        # What the pose does not tell of the marker; its residuals in sample are much too small.
        stretches = training // (2 * lag)
        noise[0] = max(noise[0], _left_out(poses, stretches, rank=basis.shape[1], folds=options.folds))
        translation = np.tile(np.eye(3), (len(body), 1))
        loading = np.concatenate([translation, basis], axis=1).reshape(len(body), 3, -1)
        middle = shape.reshape(-1, 3) + place.mean(axis=0)
        # The course of the state over all joint frames, NaN elsewhere, tells how much it bends over the lag.
        course = np.full((len(scene.positions), loading.shape[2]), np.nan)
        every = scene.positions[np.ix_(joint, body)]
        middles = every.mean(axis=1)
        course[joint, :3] = middles - place.mean(axis=0)
        course[joint, 3:] = ((every - middles[:, None]).reshape(len(joint), -1) - shape) @ basis
        typical = np.maximum(np.nanvar(course, axis=0), options.min_noise_mm**2)
        pace = np.nan_to_num(_mean_square(np.diff(course, axis=0)), nan=1.0)
        least = options.min_noise_mm**2 / scene.rate**3
        return steady_motion(
            loading,
            middle,
            noise=noise,
            drive=np.maximum(_drive(course, lag), least),
            start=10 * typical,
            start_velocity=np.maximum(10 * pace, least),
        )


def _drive(course: np.ndarray, lag: int) -> np.ndarray:
    """Variance of the velocity (columns,) that comes in per frame, from what bridging two lags misses; zero if unknown.

    White acceleration alone would tell the same at every lag. Motion is not like that, and it is this lag that matters.
    """
    drive = np.full(course.shape[1], np.nan)
    while np.isnan(drive).any() and lag >= 1:
        # In the middle of n frames between known states the variance is drive times n^3 / 192.
        drive = 192 * _mean_square(_bridging_misfit(course, lag)) / (2 * lag) ** 3
        lag //= 2
    return np.nan_to_num(drive)


def _bridging_misfit(course: np.ndarray, lag: int) -> np.ndarray:
    """By how much the smoothest course, given position and velocity at both ends of two lags, misses their middle."""
    reach = -(-lag // 8)
    frames = max(len(course) - 2 * (lag + reach), 0)
    before, first, middle, last, after = (
        course[place : place + frames] for place in (0, reach, reach + lag, reach + 2 * lag, 2 * (reach + lag))
    )
    slower = (first - before) / reach - (after - last) / reach
    return middle - (first + last) / 2 - lag / 4 * slower


def _left_out(poses: np.ndarray, stretches: np.ndarray, *, rank: int, folds: int) -> float:
    """Mean square error of a coordinate of the first marker, told from the others by other stretches of frames.

    stretches: (n,), the number of the stretch to which each pose belongs; one in `folds` is left out in turn.
    """
    place = poses[:, 1:].mean(axis=1)
    shapes = (poses - place[:, None]).reshape(len(poses), -1)
    square = []
    for turn in range(folds):
        left = stretches % folds == turn
        if left.any() and np.count_nonzero(~left) > rank:
            holed = shapes[left].copy()
            holed[:, :3] = np.nan
            square.append((conditional_mean(shapes[~left], holed, rank)[:, :3] - shapes[left, :3]) ** 2)
    return float(np.concatenate(square).mean()) if square else 0.0


def _mean_square(values: np.ndarray) -> np.ndarray:
    """Mean square (columns,) of the rows without NaN; NaN where there is none."""
    known = values[~np.isnan(values).any(axis=1)]
    return (known**2).mean(axis=0) if len(known) else np.full(values.shape[1], np.nan)
