"""Kalman smoother in a low-dimensional space of poses: carries the whole body across blackouts (Burke & Lasenby 2016).

The state is where the body is and which pose it has, principal components of the shape, with their velocities. All frames
of a window are solved for at once: the posterior of a linear Gaussian chain is one banded system of equations, whose
solution is what the Kalman filter and the backward smoother (Rauch, Tung & Striebel) find frame by frame.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.predictors import Prediction, Scene
from markermend.predictors.references import companions, thinned


@dataclass(frozen=True)
class KalmanOptions:
    """Settings of the low-dimensional Kalman smoother.

    neighbours: most markers beside the one with the gap. frames: most training frames. minimum_frames: fewer joint frames
    than this and nothing is predicted. share: a marker is left out if with it fewer than this share of the training
    frames would remain. explained: share of the shape's variance that sets the number of components. components: at
    most so many. noise_mm: least deviation of a marker from the pose. context_s: how far the window reaches beyond the
    gap, s. knots: the stated error is found at so many frames and interpolated.
    """

    neighbours: int
    frames: int
    minimum_frames: int
    share: float
    explained: float
    components: int
    noise_mm: float
    context_s: float
    knots: int


@dataclass(frozen=True)
class Chain:
    """A chain of poses with constant velocity, seen through noise.

    loading: (markers, 3, d), position of each marker per unit of state, mm. middle: (markers, 3). noise: (markers,),
    variance of each coordinate. drive: (d,), variance of the velocity that comes in per frame. start, start_velocity:
    (d,), variances of the first state about zero.
    """

    loading: np.ndarray
    middle: np.ndarray
    noise: np.ndarray
    drive: np.ndarray
    start: np.ndarray
    start_velocity: np.ndarray

    def smooth(self, observed: np.ndarray, marker: int, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Posterior mean (n, 3) of a marker at all n frames, and its variance (wanted, 3) at the wanted ones.

        observed: (n, markers, 3), mm, NaN = missing.
        """
        from scipy.linalg import cho_solve_banded, cholesky_banded  # 0.1 s to import, and only blackouts need it

        frames, size = len(observed), len(self.drive)
        present = ~np.isnan(observed).any(axis=2)
        factor = cholesky_banded(self._precision(present), lower=True)
        deviation = np.where(present[..., None], observed - self.middle, 0.0) / self.noise[:, None]
        right = np.zeros((frames, 2, size))
        right[:, 0] = np.einsum("nmk,mkd->nd", deviation, self.loading)
        # The variance of a marker's coordinate is a quadratic form in the inverse: solve for its unit loads.
        load = np.zeros((frames, 2, size, len(wanted), 3))
        load[wanted, 0, :, np.arange(len(wanted))] = self.loading[marker].T
        sides = np.concatenate([right.reshape(-1, 1), load.reshape(frames * 2 * size, -1)], axis=1)
        solved = cho_solve_banded((factor, True), sides)
        state = solved[:, 0].reshape(frames, 2, size)[:, 0]
        variance = (sides[:, 1:] * solved[:, 1:]).sum(axis=0).reshape(len(wanted), 3)
        return state @ self.loading[marker].T + self.middle[marker], variance + self.noise[marker]

    def _precision(self, present: np.ndarray) -> np.ndarray:
        """Lower band of the posterior precision; unknowns in order of frame, position before velocity, dimension."""
        frames, size = len(present), len(self.drive)
        band = np.zeros((3 * size + 1, frames, 2, size))
        each = np.einsum("mki,mkj->mij", self.loading, self.loading) / self.noise[:, None, None]
        information = np.einsum("nm,mij->nij", present.astype(float), each)
        for offset in range(size):
            band[offset, :, 0, : size - offset] = np.diagonal(information, -offset, axis1=1, axis2=2)
        # Constant velocity driven by white acceleration, in units of frames: the inverse covariance of one step.
        inverse = np.array([[12.0, -6.0], [-6.0, 4.0]])
        step = np.array([[1.0, 1.0], [0.0, 1.0]])
        before, across = step.T @ inverse @ step, -inverse @ step
        for row in range(2):
            band[0, 1:, row] += inverse[row, row] / self.drive
            band[0, :-1, row] += before[row, row] / self.drive
            for column in range(2):
                band[(2 + row - column) * size, :-1, column] += across[row, column] / self.drive
        band[size, 1:, 0] += inverse[1, 0] / self.drive
        band[size, :-1, 0] += before[1, 0] / self.drive
        band[0, 0, 0] += 1 / self.start
        band[0, 0, 1] += 1 / self.start_velocity
        return band.reshape(3 * size + 1, -1)


class KalmanSmoother:
    """The low-dimensional Kalman smoother as a predictor; states the smoother's own error."""

    name = "kalman"
    continuous = False

    def __init__(self, options: KalmanOptions) -> None:
        """Keep the settings."""
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Needs no marker during the gap, but some beside it."""
        options = self.options
        hidden = scene if not scene.present[start:stop, marker].any() else scene.hiding(marker, start, stop)
        positions, error = np.full((stop - start + 2, 3), np.nan), np.full(stop - start + 2, np.nan)
        near = np.asarray(hidden.neighbours[marker], int)[: options.neighbours]
        chosen, joint = companions(hidden, marker, near, share=options.share, minimum_frames=options.minimum_frames)
        context = max(2, round(options.context_s * scene.rate))
        window = np.arange(max(start - 1 - context, 0), min(stop + 1 + context, len(scene.positions)))
        body = np.array([marker, *chosen])
        observed = hidden.positions[np.ix_(window, body)]
        if len(chosen) < 2 or np.isnan(observed).all():
            return Prediction(positions, error)
        chain = self._learn(hidden, body, joint, max(1, (stop - start) // 2))
        asked = np.flatnonzero((window >= start - 1) & (window <= stop))
        knots = thinned(np.arange(len(asked)), options.knots)
        mean, variance = chain.smooth(observed, 0, asked[knots])
        place = window[asked] - (start - 1)
        positions[place] = mean[asked]
        error[place] = np.sqrt(np.interp(np.arange(len(asked)), knots, variance.mean(axis=1)))
        return Prediction(positions, error)

    def _learn(self, scene: Scene, body: np.ndarray, joint: np.ndarray, lag: int) -> Chain:
        """Components of the shape, and how fast they change over the lag (frames), from frames that show the body."""
        options = self.options
        training = thinned(joint, options.frames)
        poses = scene.positions[np.ix_(training, body)]
        place = poses.mean(axis=1)
        shapes = (poses - place[:, None]).reshape(len(poses), -1)
        shape = shapes.mean(axis=0)
        sizes, vectors = np.linalg.eigh(np.cov(shapes, rowvar=False))
        sizes, vectors = np.maximum(sizes[::-1], 0.0), vectors[:, ::-1]
        count = int(np.searchsorted(np.cumsum(sizes), options.explained * sizes.sum())) + 1
        basis = vectors[:, : min(count, options.components, len(sizes))]
        rest = (shapes - shape) - (shapes - shape) @ basis @ basis.T
        noise = np.maximum((rest**2).mean(axis=0).reshape(-1, 3).mean(axis=1), options.noise_mm**2)
        translation = np.tile(np.eye(3), (len(body), 1))
        loading = np.concatenate([translation, basis], axis=1).reshape(len(body), 3, -1)
        middle = shape.reshape(-1, 3) + place.mean(axis=0)
        # The course of the state over all joint frames, NaN elsewhere, tells how much it bends over the lag.
        course = np.full((len(scene.positions), loading.shape[2]), np.nan)
        every = scene.positions[np.ix_(joint, body)]
        middles = every.mean(axis=1)
        course[joint, :3] = middles - place.mean(axis=0)
        course[joint, 3:] = ((every - middles[:, None]).reshape(len(joint), -1) - shape) @ basis
        drive = np.full(course.shape[1], np.nan)
        while np.isnan(drive).any() and lag >= 1:
            drive = _mean_square(course[2 * lag :] - 2 * course[lag:-lag] + course[: -2 * lag]) * 1.5 / lag**3
            lag //= 2
        typical = np.maximum(np.nanvar(course, axis=0), options.noise_mm**2)
        pace = np.nan_to_num(_mean_square(np.diff(course, axis=0)), nan=1.0)
        least = options.noise_mm**2 / scene.rate**3
        return Chain(
            loading,
            middle,
            noise,
            drive=np.maximum(np.nan_to_num(drive), least),
            start=10 * typical,
            start_velocity=np.maximum(10 * pace, least),
        )


def _mean_square(values: np.ndarray) -> np.ndarray:
    """Mean square (columns,) of the rows without NaN; NaN where there is none."""
    known = values[~np.isnan(values).any(axis=1)]
    return (known**2).mean(axis=0) if len(known) else np.full(values.shape[1], np.nan)
