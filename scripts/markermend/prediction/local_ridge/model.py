"""Ridge regression in a local frame: training data, coefficients with robust weights, residuals left out by blocks."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from markermend.numerics.rigid_alignment import LocalFrames, align
from markermend.numerics.robust import MAD_TO_STD

REWEIGHTINGS = 2
"""Rounds of the robust weights."""


@dataclass(frozen=True, eq=False)
class LocalInputs:
    """Inputs of a regression at n frames, and the local frames that they are expressed in.

    Attributes
    ----------
    values : np.ndarray
        Local coordinates (n, 3 u) of u inputs, mm, about their typical values.
    frames : LocalFrames
        The local frames.
    """

    values: np.ndarray
    frames: LocalFrames


@dataclass(frozen=True, eq=False)
class TrainingSet:
    """A marker's training data in one local frame of anchors.

    Attributes
    ----------
    anchors, inputs : np.ndarray
        Indices of the markers that carry the frame (a,), and of the k inputs.
    template : np.ndarray
        Mean shape of the anchors (a, 3), mm.
    centre : np.ndarray
        Typical local coordinates (3 k + 3,), mm, of the inputs and, last, of the marker itself.
    local : np.ndarray
        Local coordinates (n, 3 k + 3), mm, about the centre.
    weights : np.ndarray
        Weights of the training frames (n,), between 0 and 1.
    training : np.ndarray
        Training frames (n,), ascending.
    """

    anchors: np.ndarray
    inputs: np.ndarray
    template: np.ndarray
    centre: np.ndarray
    local: np.ndarray
    weights: np.ndarray
    training: np.ndarray

    @property
    def target(self) -> np.ndarray:
        """Local coordinates of the marker (n, 3), mm, about its typical place."""
        return self.local[:, -3:]

    def design(self, used: np.ndarray) -> np.ndarray:
        """Select the columns of some inputs.

        Parameters
        ----------
        used : np.ndarray
            Which of the inputs are used, bool (k,).

        Returns
        -------
        np.ndarray
            Local coordinates (n, 3 u), mm.
        """
        columns: np.ndarray = self.local[:, np.flatnonzero(np.repeat(used, 3))]
        return columns

    def inputs_at(self, positions: np.ndarray, used: np.ndarray, rows: np.ndarray) -> LocalInputs:
        """Express the inputs in the local frame.

        Parameters
        ----------
        positions : np.ndarray
            Positions (frames, markers, 3), mm.
        used : np.ndarray
            Which of the inputs are used, bool (k,).
        rows : np.ndarray
            Frames (m,) that show the anchors and the used inputs.

        Returns
        -------
        LocalInputs
            The inputs at these frames.
        """
        frames = align(positions[np.ix_(rows, self.anchors)], self.template)
        columns = np.flatnonzero(np.repeat(used, 3))
        local = frames.local(positions[np.ix_(rows, self.inputs[used])]).reshape(len(rows), -1)
        return LocalInputs(local - self.centre[columns], frames)


class Regression(Protocol):
    """A regression of a marker's local position on those of the used inputs, trained on a TrainingSet."""

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """Predict the local position of the marker.

        Parameters
        ----------
        inputs : np.ndarray
            Local coordinates (n, 3 u) of the used inputs, mm, about their typical values.

        Returns
        -------
        np.ndarray
            Local positions (n, 3), mm.
        """
        ...

    def left_out(self, block: np.ndarray) -> np.ndarray:
        """Compute the residual of each training frame under a regression trained without its block.

        Parameters
        ----------
        block : np.ndarray
            Block of each training frame (n,), ascending numbers.

        Returns
        -------
        np.ndarray
            Residuals (n, 3), mm; NaN if there is one block only, as nothing is left to train on.
        """
        ...


@dataclass(frozen=True, eq=False)
class RidgeRegression:
    """A weighted ridge regression with an unpenalised intercept.

    Attributes
    ----------
    data : TrainingSet
        The training data.
    used : np.ndarray
        Which of the inputs are used, bool (k,).
    ridge : float
        Penalty, mm^2: the variance of the noise on an input.
    coefficients : np.ndarray
        Intercept and coefficients (1 + 3 u, 3).
    """

    data: TrainingSet
    used: np.ndarray
    ridge: float
    coefficients: np.ndarray

    @classmethod
    def fit(cls, data: TrainingSet, used: np.ndarray, ridge: float) -> RidgeRegression:
        """Train the regression.

        Parameters
        ----------
        data : TrainingSet
            The training data.
        used : np.ndarray
            Which of the inputs are used, bool (k,).
        ridge : float
            Penalty, mm^2.

        Returns
        -------
        RidgeRegression
            The regression.
        """
        return cls(data, used, ridge, ridge_coefficients(data.design(used), data.target, data.weights, ridge))

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """Predict the local position of the marker. See `Regression.predict`."""
        local: np.ndarray = with_intercept(inputs) @ self.coefficients + self.data.centre[-3:]
        return local

    def left_out(self, block: np.ndarray) -> np.ndarray:
        """Compute residuals left out by blocks, from sums over all blocks less those over one. See `Regression.left_out`."""
        full, target, weights = with_intercept(self.data.design(self.used)), self.data.target, self.data.weights
        weighted = full * weights[:, None]
        starts = np.flatnonzero(np.diff(block, prepend=block[0] - 1))
        parts = [slice(*edges) for edges in itertools.pairwise([*starts.tolist(), len(block)])]
        if len(parts) < 2:
            return np.full(target.shape, np.nan)
        gram = np.stack([weighted[part].T @ full[part] for part in parts])
        cross = np.stack([weighted[part].T @ target[part] for part in parts])
        total = np.array([weights[part].sum() for part in parts])
        beta = _solve(gram.sum(axis=0) - gram, cross.sum(axis=0) - cross, total.sum() - total, self.ridge)
        return np.concatenate([target[part] - full[part] @ own for part, own in zip(parts, beta, strict=True)])


def ridge_coefficients(design: np.ndarray, target: np.ndarray, weights: np.ndarray, ridge: float) -> np.ndarray:
    """Solve a weighted ridge regression with an unpenalised intercept.

    Parameters
    ----------
    design : np.ndarray
        Inputs (n, columns).
    target : np.ndarray
        Targets (n, targets).
    weights : np.ndarray
        Weights of the rows (n,).
    ridge : float
        Penalty per unit of weight, squared unit of the inputs.

    Returns
    -------
    np.ndarray
        Intercept and coefficients (1 + columns, targets).

    References
    ----------
    Hoerl & Kennard (1970), Technometrics 12(1).
    """
    full = with_intercept(design)
    weighted = full * weights[:, None]
    return _solve(weighted.T @ full, weighted.T @ target, weights.sum(), ridge)


def with_intercept(inputs: np.ndarray) -> np.ndarray:
    """Put a column of ones before inputs.

    Parameters
    ----------
    inputs : np.ndarray
        Inputs (n, columns).

    Returns
    -------
    np.ndarray
        Design (n, 1 + columns).
    """
    return np.concatenate([np.ones((len(inputs), 1)), inputs], axis=1)


def _solve(gram: np.ndarray, cross: np.ndarray, total: np.ndarray, ridge: float) -> np.ndarray:
    """Coefficients from weighted sums (..., columns, columns) and (..., columns, targets) of total weight (...)."""
    penalty = np.full(gram.shape[-1], float(ridge))
    penalty[0] = 0.0  # the intercept
    return np.linalg.solve(gram + np.eye(len(penalty)) * penalty * np.asarray(total)[..., None, None], cross)


def robust_weights(local: np.ndarray, *, ridge: float, sigmas: float) -> np.ndarray:
    """Compute weights that keep artifacts out of the training, by iteratively reweighted least squares.

    Parameters
    ----------
    local : np.ndarray
        Local coordinates (n, 3 k + 3), mm: of the inputs and, last, of the marker itself.
    ridge : float
        Penalty of the regression, mm^2.
    sigmas : float
        Residuals beyond this many robust standard deviations lose weight.

    Returns
    -------
    np.ndarray
        Weights (n,): 1 within the limit, beyond it the squared ratio of limit and residual.
    """
    weights = np.ones(len(local))
    design, target = local[:, :-3], local[:, -3:]
    full = with_intercept(design)
    for _ in range(REWEIGHTINGS):
        residual = np.linalg.norm(target - full @ ridge_coefficients(design, target, weights, ridge), axis=1)
        sigma = MAD_TO_STD * np.median(residual) + 1e-9
        weights = np.minimum(1.0, (sigmas * sigma / np.maximum(residual, 1e-9)) ** 2)
    return weights
