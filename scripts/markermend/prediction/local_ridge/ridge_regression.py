"""The ridge regression of a marker on its neighbours, which also learns from the subject's other recordings.

Own and pooled rows add up in the weighted sums of products from which the coefficients follow. How much the pooled rows
weigh is chosen by the residuals of stretches of the own recording that are left out in turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.local_ridge.offsets import Offsets, about_mean
from markermend.prediction.local_ridge.products import Products, starts_of
from markermend.prediction.local_ridge.ridge import penalties, with_intercept
from markermend.prediction.marker_selection import evenly_spaced


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
        rows = 0 if data.pooled is None else data.pooled.poses
        largest = rows / (data.training[-1] + 1 - data.training[0])
        few = len(data.training) < self.min_frames
        found = [weight for weight in self.weights if weight <= largest and not (few and weight == 0)]
        return found or [min(1.0, largest) if few else 0.0]


@dataclass(frozen=True, eq=False)
class LinearFunction:
    """A local position that is linear in the inputs and in functions of them.

    Attributes
    ----------
    coefficients : np.ndarray
        Coefficients (c, 3) of the intercept, the inputs and the features.
    features : Features | None
        Functions of the inputs; None for none.
    centre : np.ndarray
        Typical local position (3,), mm, about which they predict.
    """

    coefficients: np.ndarray
    features: Features | None
    centre: np.ndarray

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """Predict the local position of the marker. See `PoseFunction.predict`."""
        local: np.ndarray = _columns(inputs, self.features) @ self.coefficients + self.centre
        return local


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
    pooled : Products | None
        Mean products of the pooled rows; None where they do not count.
    pool_weight : float
        Weight of all pooled rows together, in units of the weight of all training frames.
    offsets : Offsets
        Offsets of stretches of the training frames.
    own : Products
        Products of the training frames.
    """

    data: TrainingSet
    used: np.ndarray
    features: Features | None
    columns: np.ndarray
    penalty: np.ndarray
    pooled: Products | None
    pool_weight: float
    offsets: Offsets
    own: Products

    @cached_property
    def function(self) -> LinearFunction:
        """What was learned from all training frames."""
        return self._learned(self.own)

    @classmethod
    def fit(
        cls,
        data: TrainingSet,
        used: np.ndarray,
        ridge: float,
        pooling: Pooling | None = None,
        offsets: Offsets | None = None,
    ) -> RidgeRegression:
        """Train the regression on the inputs.

        Parameters
        ----------
        data : TrainingSet
            The training data.
        used : np.ndarray
            Which of the inputs are used, bool (k,).
        ridge : float
            Penalty, mm^2: the variance of the noise on an input.
        pooling : Pooling, optional
            How it learns from the pooled rows of the training data; not at all by default.
        offsets : Offsets, optional
            Offsets of stretches of the training frames; none by default.

        Returns
        -------
        RidgeRegression
            The regression.
        """
        columns, penalty = with_intercept(data.design(used)), penalties(3 * int(used.sum()), ridge)
        offsets = offsets or Offsets.none(len(columns))
        pooled = None if pooling is None else _pooled_products(data, used)
        weights = [0.0] if pooling is None or pooled is None else pooling.candidates(data)
        stretches = _stretches(data.training, 1 if pooling is None or len(weights) == 1 else pooling.blocks)
        own = Products.by_block(stretches, offsets.groups, columns, data.target, data.weights, offsets.group)
        weight = weights[0]
        if len(weights) > 1:
            rest, aimed = (each.about_means(offsets.share) for each in (own.others(), own))
            errors = [aimed.square_error(rest.coefficients(penalty, pooled, weight)) for weight in weights]
            weight = weights[int(np.argmin(errors))]
        pooled = pooled if weight > 0 else None
        return cls(data, used, None, columns, penalty, pooled, weight, offsets, own.sum())

    def extended(self, features: Features, *, max_pooled_rows: int) -> RidgeRegression:
        """Train the regression on the inputs and functions of them, with pooled rows of the same weight.

        Parameters
        ----------
        features : Features
            The functions.
        max_pooled_rows : int
            Number of pooled rows, at most; they are evenly spaced.

        Returns
        -------
        RidgeRegression
            The regression.
        """
        columns = _columns(self.data.design(self.used), features)
        extra = np.full(columns.shape[1] - len(self.penalty), features.penalty)
        penalty = np.append(self.penalty, extra)
        pooled = self.pooled and _extended_products(self.data, self.used, features, max_pooled_rows)
        data, offsets = self.data, self.offsets
        own = Products.of(columns, data.target, data.weights, offsets.group, groups=offsets.groups)
        return replace(self, features=features, columns=columns, penalty=penalty, pooled=pooled, own=own)

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """Predict the local position of the marker. See `PoseFunction.predict`."""
        return self.function.predict(inputs)

    def without(self, rows: np.ndarray) -> LinearFunction:
        """Train the function without some of the training frames. See `Regression.without`."""
        parts = [each[rows] for each in self._rows]
        return self._learned(self.own.less(Products.of(*parts, groups=self.offsets.groups)))

    @property
    def _rows(self) -> tuple[np.ndarray, ...]:
        """Columns, targets, weights and groups of the training frames."""
        return self.columns, self.data.target, self.data.weights, self.offsets.group

    def _learned(self, own: Products) -> LinearFunction:
        """What was learned from training frames of these products."""
        return LinearFunction(self._coefficients(own), self.features, self.data.centre[-3:])

    def _coefficients(self, own: Products) -> np.ndarray:
        """Coefficients (..., c, 3) from products of training frames."""
        return own.about_means(self.offsets.share).coefficients(self.penalty, self.pooled, self.pool_weight)

    def left_out(self, block: np.ndarray) -> np.ndarray:
        """Compute residuals left out by blocks, from sums over all blocks less those over one. See `Regression.left_out`."""
        target, starts = self.data.target, starts_of(block)
        if len(starts) < 2:
            return np.full(target.shape, np.nan)
        beta = self._coefficients(Products.by_block(block, self.offsets.groups, *self._rows).others())
        parts = zip(np.split(self.columns, starts[1:]), np.split(target, starts[1:]), beta, strict=True)
        return np.concatenate([own - columns @ coefficients for columns, own, coefficients in parts])


def _columns(inputs: np.ndarray, features: Features | None) -> np.ndarray:
    """Intercept, inputs and features (n, c)."""
    columns = with_intercept(inputs)
    return columns if features is None else np.concatenate([columns, features.values(inputs)], axis=1)


def _pooled_products(data: TrainingSet, used: np.ndarray) -> Products | None:
    """Mean products of the pooled rows, which have no intercept."""
    if data.pooled is None:
        return None
    products = data.pooled.products
    columns = [*np.flatnonzero(np.repeat(used, 3)), *range(len(products) - 3, len(products))]
    return _without_intercept(products[np.ix_(columns, columns)])


def _extended_products(data: TrainingSet, used: np.ndarray, features: Features, max_rows: int) -> Products | None:
    """Mean products of pooled rows with features."""
    pooled = data.pooled
    if pooled is None:
        return None
    taken, columns = evenly_spaced(np.arange(len(pooled.local)), max_rows), np.flatnonzero(np.repeat(used, 3))
    # A feature is a function of the pose itself, not of its difference from the usual pose of its recording.
    values = features.values(pooled.about(data.centre)[np.ix_(taken, columns)])
    local, weights = pooled.local[taken], pooled.weights[taken]
    rows = about_mean(
        np.concatenate([local[:, columns], values, local[:, -3:]], axis=1), weights, pooled.recording[taken]
    )
    return _without_intercept((rows * weights[:, None]).T @ rows / weights.sum())


def _without_intercept(products: np.ndarray) -> Products:
    """Products of columns and, last, the target, of total weight 1; those with the intercept are 0."""
    products = np.pad(products, ((1, 0), (1, 0)))
    none = np.zeros((0, len(products) - 3)), np.zeros((0, 3)), np.zeros(0)
    return Products(products[:-3, :-3], products[:-3, -3:], np.trace(products[-3:, -3:]), np.ones(()), *none)


def _stretches(frames: np.ndarray, count: int) -> np.ndarray:
    """Number of the equal stretch of the recording in which each frame (n,) lies, ascending."""
    numbers: np.ndarray = (frames - frames[0]) * count // (frames[-1] + 1 - frames[0])
    return numbers
