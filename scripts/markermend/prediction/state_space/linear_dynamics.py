"""Linear dynamical systems with missing observations, learned by expectation maximisation (DynaMMo, Li et al. 2009).

A hidden state moves linearly from frame to frame, and the markers are seen from it through noise: z[t+1] = F z[t] + w,
x[t] = G z[t] + c + v. Only coordinates that were observed enter, so nothing needs to be made up for the others, and the
likelihood never falls.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics import block_tridiagonal
from markermend.numerics.interpolation import interpolate_missing


@dataclass(frozen=True)
class States:
    """The posterior of the states: mean (n, d), covariance (n, d, d), and cross (n - 1, d, d) of each with the one before.

    log_likelihood: of what was observed.
    """

    mean: np.ndarray
    covariance: np.ndarray
    cross: np.ndarray
    log_likelihood: float


@dataclass(frozen=True)
class LinearDynamics:
    """A linear dynamical system of d dimensions, seen at the markers.

    start: (d,), variances of the first state about zero. transition: F, (d, d). drive: covariance of w, (d, d).
    loading: G, (markers, 3, d). middle: c, (markers, 3). noise: (markers,), variance of each coordinate of v.
    """

    start: np.ndarray
    transition: np.ndarray
    drive: np.ndarray
    loading: np.ndarray
    middle: np.ndarray
    noise: np.ndarray

    def system(self, observed: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The posterior of the states given positions (n, markers, 3), NaN = missing, as a block-tridiagonal system.

        Returns its diagonal (n, d, d), the blocks below (n - 1, d, d) and the right side (n, d).
        """
        frames, markers, _ = observed.shape
        size = len(self.transition)
        present = ~np.isnan(observed).any(axis=2)
        each = self.loading.transpose(0, 2, 1) @ self.loading / self.noise[:, None, None]
        diagonal = (present.astype(float) @ each.reshape(markers, -1)).reshape(frames, size, size)
        deviation = np.where(present[..., None], observed - self.middle, 0.0) / self.noise[:, None]
        right = deviation.reshape(frames, -1) @ self.loading.reshape(-1, size)
        inverse = np.linalg.inv(self.drive)
        onward = inverse @ self.transition
        diagonal[0] += np.diag(1 / self.start)
        diagonal[1:] += inverse
        diagonal[:-1] += self.transition.T @ onward
        return diagonal, np.broadcast_to(-onward, (frames - 1, size, size)), right

    def smooth(self, observed: np.ndarray) -> States:
        """The states' posterior given positions (n, markers, 3), NaN = missing."""
        diagonal, below, right = self.system(observed)
        solved = block_tridiagonal.solve(diagonal, below, right)
        present = ~np.isnan(observed).any(axis=2)
        deviation = np.where(present[..., None], observed - self.middle, 0.0)
        twice = (
            3 * (present.sum(axis=0) * np.log(2 * np.pi * self.noise)).sum()
            + ((deviation**2).sum(axis=(0, 2)) / self.noise).sum()
            - (right * solved.solution).sum()
            + np.log(self.start).sum()
            + (len(observed) - 1) * np.linalg.slogdet(self.drive)[1]
            + solved.log_determinant
        )
        return States(solved.solution, solved.inverse_diagonal, solved.inverse_below, float(-twice / 2))

    def positions(self, states: np.ndarray) -> np.ndarray:
        """Where the markers are expected (n, markers, 3) at states (n, d)."""
        return np.tensordot(states, self.loading, axes=(1, 2)) + self.middle

    def spread(self, covariance: np.ndarray, marker: int) -> np.ndarray:
        """Covariance (n, 3, 3) of a marker where the states have the covariance (n, d, d)."""
        loading = self.loading[marker]
        return loading @ covariance @ loading.T + self.noise[marker] * np.eye(3)


def learn(
    observed: np.ndarray, *, hidden: int, lag: int, iterations: int, tolerance: float, floor: float
) -> tuple[LinearDynamics, np.ndarray]:
    """Learn a linear dynamical system; source: DynaMMo (Li, McCann, Pollard & Faloutsos 2009), with an exact E-step.

    observed: (n, markers, 3), NaN = missing, in units in which it has a spread of about 1; every marker seen somewhere.
    hidden: dimensions of the state, at most. lag: the first guess is the principal components of frames together with
    those so many frames later, after straight lines over what is missing; with 0 it knows no velocities, and
    expectation maximisation hardly finds them. iterations: at most so many; ends when the log-likelihood rises by less
    than `tolerance` per observed number. floor: least variance of noise and drive. Returns the system and the
    log-likelihood after each step, which never falls: also within these bounds, every M-step is the best there is.
    """
    states = _first_guess(observed, hidden=hidden, lag=lag, floor=floor)
    count = np.count_nonzero(~np.isnan(observed))
    likelihood: list[float] = []
    for _ in range(iterations):
        system = maximise(observed, states, floor=floor)
        states = system.smooth(observed)
        likelihood.append(states.log_likelihood)
        if len(likelihood) > 1 and likelihood[-1] - likelihood[-2] < tolerance * count:
            break
    return system, np.array(likelihood)


def maximise(observed: np.ndarray, states: States, *, floor: float) -> LinearDynamics:
    """The likeliest system, of variances not under the floor, given the states' posterior: the M-step in closed form."""
    frames, markers, _ = observed.shape
    size = states.mean.shape[1]
    square = states.covariance + states.mean[:, :, None] * states.mean[:, None, :]
    onward = (states.cross + states.mean[1:, :, None] * states.mean[:-1, None, :]).sum(axis=0)
    transition = np.linalg.solve(square[:-1].sum(axis=0), onward.T).T
    drive = (square[1:].sum(axis=0) - transition @ onward.T) / (frames - 1)
    sizes, vectors = np.linalg.eigh((drive + drive.T) / 2)
    drive = vectors * np.maximum(sizes, floor) @ vectors.T
    # A further state that is always 1 carries the middle.
    mean = np.concatenate([states.mean, np.ones((frames, 1))], axis=1)
    moments = mean[:, :, None] * mean[:, None, :]
    moments[:, :size, :size] += states.covariance
    present = ~np.isnan(observed).any(axis=2)
    known = np.where(present[..., None], observed, 0.0)
    moments = (present.T.astype(float) @ moments.reshape(frames, -1)).reshape(markers, size + 1, size + 1)
    products = np.tensordot(known, mean, axes=(0, 0))
    loading = np.linalg.solve(moments, products.transpose(0, 2, 1)).transpose(0, 2, 1)
    rest = (known**2).sum(axis=(0, 2)) - (loading * products).sum(axis=(1, 2))
    noise = np.maximum(rest / (3 * present.sum(axis=0)), floor)
    return LinearDynamics(np.ones(size), transition, drive, loading[..., :-1], loading[..., -1], noise)


def _first_guess(observed: np.ndarray, *, hidden: int, lag: int, floor: float) -> States:
    """States of unit variance, taken to be known exactly."""
    columns = [interpolate_missing(column) for column in observed.reshape(len(observed), -1).T]
    matrix = np.stack(columns, axis=1)
    later = matrix[np.minimum(np.arange(len(matrix)) + lag, len(matrix) - 1)]
    both = np.concatenate([matrix, later], axis=1)
    vectors, sizes, _ = np.linalg.svd(both - both.mean(axis=0), full_matrices=False)
    real = int(np.count_nonzero(sizes**2 > floor * len(matrix)))
    mean = vectors[:, : max(1, min(hidden, real))] * np.sqrt(len(matrix))
    frames, size = mean.shape
    return States(mean, np.zeros((frames, size, size)), np.zeros((frames - 1, size, size)), -np.inf)
