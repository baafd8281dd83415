"""Regression in a frame on the body: training data, ridge coefficients with robust weights, residuals left out."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from markermend.numerics.rigid_alignment import align


@dataclass(frozen=True, eq=False)
class RidgeModel:
    """A marker's training data in one frame of anchors.

    anchors, inputs: marker indices. template: (anchors, 3), mm. centre: (3 k + 3,), the typical local coordinates of
    the k inputs and the target. local: (training, 3 k + 3), about it. weights, training: weight and frame of each.
    """

    anchors: np.ndarray
    inputs: np.ndarray
    template: np.ndarray
    centre: np.ndarray
    local: np.ndarray
    weights: np.ndarray
    training: np.ndarray

    def coefficients(self, used: np.ndarray, ridge: float) -> np.ndarray:
        """Coefficients (1 + 3 u, 3) on the inputs marked in `used` (k,)."""
        columns = np.flatnonzero(np.repeat(used, 3))
        return ridge_regression(self.local[:, columns], self.local[:, -3:], self.weights, ridge)

    def left_out(self, used: np.ndarray, ridge: float, block: np.ndarray) -> np.ndarray:
        """Residual (training, 3) of each training frame under the model trained without its block.

        block: (training,), ascending. One block alone leaves nothing to train on: then all are NaN.
        """
        columns = np.flatnonzero(np.repeat(used, 3))
        full = np.concatenate([np.ones((len(self.local), 1)), self.local[:, columns]], axis=1)
        target = self.local[:, -3:]
        weighted = full * self.weights[:, None]
        starts = np.flatnonzero(np.diff(block, prepend=block[0] - 1))
        parts = [slice(*edges) for edges in itertools.pairwise([*starts.tolist(), len(block)])]
        if len(parts) < 2:
            return np.full(target.shape, np.nan)
        # Sums over all blocks less those over one are the sums without it.
        gram = np.stack([weighted[part].T @ full[part] for part in parts])
        cross = np.stack([weighted[part].T @ target[part] for part in parts])
        total = np.array([self.weights[part].sum() for part in parts])
        beta = _solve(gram.sum(axis=0) - gram, cross.sum(axis=0) - cross, total.sum() - total, ridge)
        return np.concatenate([target[part] - full[part] @ own for part, own in zip(parts, beta, strict=True)])


def ridge_regression(design: np.ndarray, target: np.ndarray, weights: np.ndarray, ridge: float) -> np.ndarray:
    """Weighted ridge regression with an unpenalised intercept: coefficients (1 + columns, targets)."""
    full = np.concatenate([np.ones((len(design), 1)), design], axis=1)
    weighted = full * weights[:, None]
    return _solve(weighted.T @ full, weighted.T @ target, weights.sum(), ridge)


def _solve(gram: np.ndarray, cross: np.ndarray, total: np.ndarray, ridge: float) -> np.ndarray:
    """Coefficients from weighted sums (..., columns, columns) and (..., columns, targets) of total weight (...)."""
    penalty = np.full(gram.shape[-1], float(ridge))
    penalty[0] = 0.0  # the intercept
    return np.linalg.solve(gram + np.eye(len(penalty)) * penalty * np.asarray(total)[..., None, None], cross)


def robust_weights(local: np.ndarray, *, ridge: float, sigmas: float) -> np.ndarray:
    """Weights (training,) that keep artifacts out of the training: 1 inside `sigmas`, falling to 0 beyond."""
    weights = np.ones(len(local))
    design = np.concatenate([np.ones((len(local), 1)), local[:, :-3]], axis=1)
    for _ in range(2):
        residual = np.linalg.norm(
            local[:, -3:] - design @ ridge_regression(local[:, :-3], local[:, -3:], weights, ridge), axis=1
        )
        sigma = 1.4826 * np.median(residual) + 1e-9
        weights = np.minimum(1.0, (sigmas * sigma / np.maximum(residual, 1e-9)) ** 2)
    return weights


def inputs_at(
    model: RidgeModel, positions: np.ndarray, used: np.ndarray, rows: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Local inputs (n, 3 u) at rows, about their centre, with the rotation and origin that lead to the laboratory."""
    rotation, origin = align(positions[np.ix_(rows, model.anchors)], model.template)
    points = positions[np.ix_(rows, model.inputs[used])] - origin[:, None]
    columns = np.flatnonzero(np.repeat(used, 3))
    local = np.einsum("nki,nij->nkj", points, rotation).reshape(len(rows), -1) - model.centre[columns]
    return local, rotation, origin


def response(model: RidgeModel, beta: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """Local prediction (n, 3) by the coefficients from local inputs (n, 3 u)."""
    return np.concatenate([np.ones((len(inputs), 1)), inputs], axis=1) @ beta + model.centre[-3:]
