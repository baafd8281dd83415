"""The ridge regression of a marker on its neighbours, which also learns from the subject's other recordings.

Own and pooled rows add up in the weighted sums of products from which the coefficients follow. How much the pooled rows
weigh is chosen by the residuals of stretches of the own recording that are left out in turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.local_ridge.pooled_rows import about_mean
from markermend.prediction.local_ridge.ridge import penalties, solve, with_intercept


class Features(Protocol):
    """Functions of the inputs that a regression uses beside the inputs themselves.

    Attributes
    ----------
    penalty : float
        Penalty of their coefficients per unit of weight, mm^2.
    """

    @property
    def penalty(self) -> float:
        """See the attributes."""
        ...

    def values(self, inputs: np.ndarray) -> np.ndarray:
        """Evaluate the features.

        Parameters
        ----------
        inputs : np.ndarray
            Local coordinates (n, 3 u) of the used inputs, mm, about their typical values.

        Returns
        -------
        np.ndarray
            Values (n, features).
        """
        ...


@dataclass(frozen=True)
class Pooling:
    """How a regression learns from other recordings.

    Attributes
    ----------
    weights : sequence of float
        Weights of all pooled rows together that are tried, in units of the weight of all training frames.
    blocks : int
        Stretches of the own recording that are left out in turn to choose among them.
    min_frames : int
        Training frames from which a regression may leave the pooled rows out.
    """

    weights: Sequence[float]
    blocks: int
    min_frames: int = 0

    def candidates(self, data: TrainingSet) -> list[float]:
        """List the weights to try for training data.

        Parameters
        ----------
        data : TrainingSet
            The training data, with pooled rows.

        Returns
        -------
        list of float
            Those by which a pooled row counts no more than a frame of the recording. Left-out stretches are longer than most
            gaps, so that poses which they do not show seem to matter more than they do.
        """
        rows = 0 if data.pooled is None else len(data.pooled.local)
        largest = rows / (data.training[-1] + 1 - data.training[0])
        few = len(data.training) < self.min_frames
        found = [weight for weight in self.weights if weight <= largest and not (few and weight == 0)]
        return found or [min(1.0, largest) if few else 0.0]


@dataclass(frozen=True, eq=False)
class RidgeRegression:
    """A weighted ridge regression with an unpenalised intercept.

    Attributes
    ----------
    data : TrainingSet
        The training data.
    used : np.ndarray
        Which of the inputs are used, bool (k,).
    features : Features | None
        Functions of the inputs that it uses besides; None for none.
    columns : np.ndarray
        Intercept, inputs and features of the training frames (n, c).
    penalty : np.ndarray
        Penalties of the columns (c,), mm^2.
    pool_weight : float
        Weight of all pooled rows together, in units of the weight of all training frames.
    pooled : _Products | None
        Mean products of the pooled rows; None where they have no weight.
    coefficients : np.ndarray
        Coefficients of the columns (c, 3).
    """

    data: TrainingSet
    used: np.ndarray
    features: Features | None
    columns: np.ndarray
    penalty: np.ndarray
    pool_weight: float
    pooled: _Products | None
    coefficients: np.ndarray

    @classmethod
    def fit(
        cls,
        data: TrainingSet,
        used: np.ndarray,
        ridge: float,
        pooling: Pooling | None = None,
        features: Features | None = None,
    ) -> RidgeRegression:
        """Train the regression.

        Parameters
        ----------
        data : TrainingSet
            The training data.
        used : np.ndarray
            Which of the inputs are used, bool (k,).
        ridge : float
            Penalty of the inputs, mm^2: the variance of the noise on an input.
        pooling : Pooling, optional
            How it learns from the pooled rows of the training data; not at all by default.
        features : Features, optional
            Functions of the inputs that it uses besides.

        Returns
        -------
        RidgeRegression
            The regression.
        """
        inputs, penalty = data.design(used), penalties(3 * int(used.sum()), ridge)
        weight = 0.0 if pooling is None else _pool_weight(data, used, penalty, pooling)
        columns = _columns(inputs, features)
        if features is not None:
            penalty = np.append(penalty, np.full(columns.shape[1] - len(penalty), features.penalty))
        own = _Products.by_block(data, columns, np.zeros(len(columns), int)).sum()
        pooled = _pooled_products(data, used, features) if weight > 0 else None
        return cls(data, used, features, columns, penalty, weight, pooled, own.coefficients(penalty, pooled, weight))

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """Predict the local position of the marker. See `Regression.predict`."""
        local: np.ndarray = _columns(inputs, self.features) @ self.coefficients + self.data.centre[-3:]
        return local

    def left_out(self, block: np.ndarray) -> np.ndarray:
        """Compute residuals left out by blocks, from sums over all blocks less those over one. See `Regression.left_out`."""
        target, starts = self.data.target, _starts(block)
        if len(starts) < 2:
            return np.full(target.shape, np.nan)
        rest = _Products.by_block(self.data, self.columns, block).others()
        beta = rest.coefficients(self.penalty, self.pooled, self.pool_weight)
        parts = zip(np.split(self.columns, starts[1:]), np.split(target, starts[1:]), beta, strict=True)
        return np.concatenate([own - columns @ coefficients for columns, own, coefficients in parts])


@dataclass(frozen=True, eq=False)
class _Products:
    """Weighted sums of products: of the columns (..., c, c), of these and the target (..., c, 3), and of the target's
    square (...); and the sum of the weights (...)."""

    gram: np.ndarray
    cross: np.ndarray
    square: np.ndarray
    total: np.ndarray

    @classmethod
    def by_block(cls, data: TrainingSet, columns: np.ndarray, block: np.ndarray) -> _Products:
        """The sums over each block of the training frames."""
        cuts = _starts(block)[1:]
        full, weights = np.split(columns, cuts), np.split(data.weights, cuts)
        target = np.split(data.target, cuts)
        weighted = [(rows * own[:, None]).T for rows, own in zip(full, weights, strict=True)]
        return cls(
            np.stack([left @ rows for left, rows in zip(weighted, full, strict=True)]),
            np.stack([left @ rows for left, rows in zip(weighted, target, strict=True)]),
            np.array([(own[:, None] * rows**2).sum() for own, rows in zip(weights, target, strict=True)]),
            np.array([own.sum() for own in weights]),
        )

    def sum(self) -> _Products:
        """The sums over all blocks."""
        return _Products(*(each.sum(axis=0) for each in vars(self).values()))

    def others(self) -> _Products:
        """For each block the sums over all others."""
        return _Products(*(each.sum(axis=0) - each for each in vars(self).values()))

    def coefficients(self, penalty: np.ndarray, pooled: _Products | None = None, weight: float = 0.0) -> np.ndarray:
        """Coefficients (..., c, 3) with pooled rows of a weight in units of that of these."""
        gram, cross, total = self.gram, self.cross, self.total
        if pooled is not None and weight > 0:
            scale = (weight * total / pooled.total)[..., None, None]
            gram, cross, total = gram + scale * pooled.gram, cross + scale * pooled.cross, (1 + weight) * total
        return solve(gram, cross, total, penalty)

    def square_error(self, coefficients: np.ndarray) -> float:
        """Weighted sum of the squared errors of coefficients (..., c, 3)."""
        explained = (coefficients * (2 * self.cross - self.gram @ coefficients)).sum(axis=(-2, -1))
        return float((self.square - explained).sum())


def _pool_weight(data: TrainingSet, used: np.ndarray, penalty: np.ndarray, pooling: Pooling) -> float:
    """Weight of the pooled rows at which the regression on the inputs alone errs least on stretches left out."""
    weights, pooled = pooling.candidates(data), _pooled_products(data, used, None)
    if pooled is None or len(weights) == 1:
        return 0.0 if pooled is None else weights[0]
    own = _Products.by_block(data, with_intercept(data.design(used)), _stretches(data.training, pooling.blocks))
    rest = own.others()
    errors = [own.square_error(rest.coefficients(penalty, pooled, weight)) for weight in weights]
    return weights[int(np.argmin(errors))]


def _columns(inputs: np.ndarray, features: Features | None) -> np.ndarray:
    """Intercept, inputs and features (n, c)."""
    columns = with_intercept(inputs)
    return columns if features is None else np.concatenate([columns, features.values(inputs)], axis=1)


def _pooled_products(data: TrainingSet, used: np.ndarray, features: Features | None) -> _Products | None:
    """Mean products of the pooled rows, which have no intercept."""
    pooled = data.pooled
    if pooled is None:
        return None
    chosen, products = np.flatnonzero(np.repeat(used, 3)), pooled.products
    target = np.arange(len(products) - 3, len(products))
    if features is None:
        products = products[np.ix_([*chosen, *target], [*chosen, *target])]
    else:
        inputs = pooled.local[:, chosen]
        # A feature is a function of the pose itself, not of its difference from the usual pose of its recording.
        values = features.values(pooled.about(data.centre)[:, chosen])
        extra = about_mean(values, pooled.weights, pooled.recording)
        rows = np.concatenate([inputs, extra, pooled.local[:, target]], axis=1)
        products = (rows * pooled.weights[:, None]).T @ rows / pooled.weights.sum()
    products = np.pad(products, ((1, 0), (1, 0)))
    return _Products(products[:-3, :-3], products[:-3, -3:], np.trace(products[-3:, -3:]), np.ones(()))


def _starts(block: np.ndarray) -> np.ndarray:
    """First place of each block, given the ascending numbers of the blocks (n,)."""
    return np.flatnonzero(np.diff(block, prepend=block[0] - 1))


def _stretches(frames: np.ndarray, count: int) -> np.ndarray:
    """Number of the equal stretch of the recording in which each frame (n,) lies, ascending."""
    numbers: np.ndarray = (frames - frames[0]) * count // (frames[-1] + 1 - frames[0])
    return numbers
