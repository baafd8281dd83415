"""Linear dynamical systems with missing observations, learned by expectation maximisation (DynaMMo, Li et al. 2009).

A hidden state moves linearly from frame to frame, and the markers are observed from it through noise::

    z[t+1] = F z[t] + w,    x[t] = G z[t] + c + v

Only observed coordinates enter, so nothing has to be made up for the others, and the likelihood never falls.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics import block_tridiagonal
from markermend.numerics.interpolation import interpolate_missing


@dataclass(frozen=True)
class States:
    """The posterior of the states.

    Attributes
    ----------
    mean : np.ndarray
        Means (n, d).
    covariance : np.ndarray
        Covariances (n, d, d).
    lag_one_covariance : np.ndarray
        Covariances (n - 1, d, d) of each state with the one before it.
    log_likelihood : float
        Log-likelihood of the observations.
    """

    mean: np.ndarray
    covariance: np.ndarray
    lag_one_covariance: np.ndarray
    log_likelihood: float


@dataclass(frozen=True)
class LinearDynamics:
    """A linear dynamical system of d dimensions, observed at the markers.

    Attributes
    ----------
    initial_variance : np.ndarray
        Variances (d,) of the first state about zero.
    transition : np.ndarray
        Transition matrix F (d, d).
    process_noise : np.ndarray
        Covariance (d, d) of w.
    loading : np.ndarray
        Observation matrix G (markers, 3, d).
    offset : np.ndarray
        Positions c (markers, 3) at state zero.
    observation_noise : np.ndarray
        Variances (markers,) of each coordinate of v.
    """

    initial_variance: np.ndarray
    transition: np.ndarray
    process_noise: np.ndarray
    loading: np.ndarray
    offset: np.ndarray
    observation_noise: np.ndarray

    def posterior_system(self, observed: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Assemble the block-tridiagonal system whose solution is the posterior mean of the states.

        Parameters
        ----------
        observed : np.ndarray
            Positions (n, markers, 3), NaN = missing.

        Returns
        -------
        diagonal : np.ndarray
            Diagonal blocks (n, d, d) of the posterior precision.
        below : np.ndarray
            Its blocks below the diagonal, (n - 1, d, d).
        right : np.ndarray
            Right side (n, d).
        """
        frames, markers, _ = observed.shape
        size = len(self.transition)
        present = ~np.isnan(observed).any(axis=2)
        information = self.loading.transpose(0, 2, 1) @ self.loading / self.observation_noise[:, None, None]
        diagonal = (present.astype(float) @ information.reshape(markers, -1)).reshape(frames, size, size)
        deviation = np.where(present[..., None], observed - self.offset, 0.0) / self.observation_noise[:, None]
        right = deviation.reshape(frames, -1) @ self.loading.reshape(-1, size)
        inverse = np.linalg.inv(self.process_noise)
        coupling = inverse @ self.transition
        diagonal[0] += np.diag(1 / self.initial_variance)
        diagonal[1:] += inverse
        diagonal[:-1] += self.transition.T @ coupling
        return diagonal, np.broadcast_to(-coupling, (frames - 1, size, size)), right

    def smooth(self, observed: np.ndarray) -> States:
        """Compute the posterior of the states.

        Parameters
        ----------
        observed : np.ndarray
            Positions (n, markers, 3), NaN = missing.

        Returns
        -------
        States
            Posterior of the n states.
        """
        diagonal, below, right = self.posterior_system(observed)
        solved = block_tridiagonal.solve(diagonal, below, right)
        present = ~np.isnan(observed).any(axis=2)
        deviation = np.where(present[..., None], observed - self.offset, 0.0)
        minus_twice = (
            3 * (present.sum(axis=0) * np.log(2 * np.pi * self.observation_noise)).sum()
            + ((deviation**2).sum(axis=(0, 2)) / self.observation_noise).sum()
            - (right * solved.solution).sum()
            + np.log(self.initial_variance).sum()
            + (len(observed) - 1) * np.linalg.slogdet(self.process_noise)[1]
            + solved.log_determinant
        )
        return States(solved.solution, solved.inverse_diagonal, solved.inverse_below, float(-minus_twice / 2))

    def positions(self, states: np.ndarray) -> np.ndarray:
        """Compute the positions expected at states.

        Parameters
        ----------
        states : np.ndarray
            States (n, d).

        Returns
        -------
        np.ndarray
            Expected positions (n, markers, 3).
        """
        expected: np.ndarray = np.tensordot(states, self.loading, axes=(1, 2)) + self.offset
        return expected

    def position_covariance(self, covariance: np.ndarray, marker: int) -> np.ndarray:
        """Compute the covariance of a marker's position.

        Parameters
        ----------
        covariance : np.ndarray
            Covariances (n, d, d) of the states.
        marker : int
            Index of the marker.

        Returns
        -------
        np.ndarray
            Covariances (n, 3, 3), observation noise included.
        """
        loading = self.loading[marker]
        spread: np.ndarray = loading @ covariance @ loading.T + self.observation_noise[marker] * np.eye(3)
        return spread


def fit_linear_dynamics(
    observed: np.ndarray, *, dimensions: int, lag: int, iterations: int, tolerance: float, floor: float
) -> tuple[LinearDynamics, np.ndarray]:
    """Learn a linear dynamical system by expectation maximisation with an exact E-step.

    Parameters
    ----------
    observed : np.ndarray
        Positions (n, markers, 3), NaN = missing, in units in which they have a spread of about 1; every marker is
        observed somewhere.
    dimensions : int
        Dimensions of the state, at most.
    lag : int
        The first guess of the states consists of the principal components of frames together with those this many frames
        later. With 0 it contains no velocities, and expectation maximisation hardly finds them.
    iterations : int
        Largest number of iterations.
    tolerance : float
        The iteration ends when the log-likelihood rises by less than this per observed number.
    floor : float
        Least variance of observation and process noise.

    Returns
    -------
    system : LinearDynamics
        The learned system.
    log_likelihood : np.ndarray
        Log-likelihood after each iteration; it never falls, as every M-step is optimal within these bounds.

    References
    ----------
    Li, McCann, Pollard & Faloutsos (2009), "DynaMMo: mining and summarization of coevolving sequences with missing
    values", KDD.
    """
    states = _first_guess(observed, dimensions=dimensions, lag=lag, floor=floor)
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
    """Find the likeliest system given the posterior of the states: the M-step in closed form.

    Parameters
    ----------
    observed : np.ndarray
        Positions (n, markers, 3), NaN = missing.
    states : States
        Posterior of the states.
    floor : float
        Least variance of observation and process noise.

    Returns
    -------
    LinearDynamics
        The system; the first state has unit variances.
    """
    frames = len(observed)
    square = states.covariance + states.mean[:, :, None] * states.mean[:, None, :]
    onward = (states.lag_one_covariance + states.mean[1:, :, None] * states.mean[:-1, None, :]).sum(axis=0)
    transition = np.linalg.solve(square[:-1].sum(axis=0), onward.T).T
    process_noise = (square[1:].sum(axis=0) - transition @ onward.T) / (frames - 1)
    sizes, vectors = np.linalg.eigh((process_noise + process_noise.T) / 2)
    process_noise = vectors * np.maximum(sizes, floor) @ vectors.T
    loading, noise = _maximise_observation(observed, states, floor)
    initial = np.ones(states.mean.shape[1])
    return LinearDynamics(initial, transition, process_noise, loading[..., :-1], loading[..., -1], noise)


def _maximise_observation(observed: np.ndarray, states: States, floor: float) -> tuple[np.ndarray, np.ndarray]:
    """Observation matrices (markers, 3, d + 1), with the offset last, and noise variances (markers,)."""
    frames, markers, _ = observed.shape
    size = states.mean.shape[1]
    # A further state that is always 1 carries the offset.
    mean = np.concatenate([states.mean, np.ones((frames, 1))], axis=1)
    moments = mean[:, :, None] * mean[:, None, :]
    moments[:, :size, :size] += states.covariance
    present = ~np.isnan(observed).any(axis=2)
    known = np.where(present[..., None], observed, 0.0)
    moments = (present.T.astype(float) @ moments.reshape(frames, -1)).reshape(markers, size + 1, size + 1)
    products = np.tensordot(known, mean, axes=(0, 0))
    loading = np.linalg.solve(moments, products.transpose(0, 2, 1)).transpose(0, 2, 1)
    rest = (known**2).sum(axis=(0, 2)) - (loading * products).sum(axis=(1, 2))
    return loading, np.maximum(rest / (3 * present.sum(axis=0)), floor)


def _first_guess(observed: np.ndarray, *, dimensions: int, lag: int, floor: float) -> States:
    """States of unit variance, treated as known exactly, after linear interpolation of missing samples."""
    columns = [interpolate_missing(column) for column in observed.reshape(len(observed), -1).T]
    matrix = np.stack(columns, axis=1)
    later = matrix[np.minimum(np.arange(len(matrix)) + lag, len(matrix) - 1)]
    both = np.concatenate([matrix, later], axis=1)
    vectors, sizes, _ = np.linalg.svd(both - both.mean(axis=0), full_matrices=False)
    above_floor = int(np.count_nonzero(sizes**2 > floor * len(matrix)))
    mean = vectors[:, : max(1, min(dimensions, above_floor))] * np.sqrt(len(matrix))
    frames, size = mean.shape
    return States(mean, np.zeros((frames, size, size)), np.zeros((frames - 1, size, size)), -np.inf)
