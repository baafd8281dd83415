"""Naive twins of markermend.prediction."""

from itertools import pairwise

import numpy as np


def feed_forward(parameters, sizes, row):
    """What one network of tanh layers says to one row: each unit sums its inputs one by one."""
    given, at = list(row), 0
    for layer, (inputs, outputs) in enumerate(pairwise(sizes), 1):
        offsets = at + inputs * outputs
        total = [
            sum(given[i] * parameters[at + i * outputs + o] for i in range(inputs)) + parameters[offsets + o]
            for o in range(outputs)
        ]
        given = [np.tanh(one) for one in total] if layer < len(sizes) - 1 else total
        at = offsets + outputs
    return given


def pooled_ridge(own, own_weights, pooled, pooled_weights, recording, *, ridge, pool_weight):
    """Intercept and coefficients of weighted least squares with a free offset for the own rows and each pooled recording.

    own, pooled: rows of inputs and, in the last three columns, the target. The penalty is one more row of data for each input.
    """
    offsets = [np.concatenate([np.ones(len(own)), np.zeros(len(pooled))])]
    offsets += [np.concatenate([np.zeros(len(own)), recording == number]) for number in np.unique(recording)]
    rows = np.concatenate([own, pooled])
    scale = pool_weight * own_weights.sum() / pooled_weights.sum()
    root = np.sqrt(np.concatenate([own_weights, scale * pooled_weights]))[:, None]
    design = root * np.concatenate([np.stack(offsets, axis=1), rows[:, :-3]], axis=1)
    penalty = np.sqrt(ridge * (1 + pool_weight) * own_weights.sum()) * np.eye(design.shape[1])[len(offsets) :]
    targets = np.concatenate([root * rows[:, -3:], np.zeros((len(penalty), 3))])
    found = np.linalg.lstsq(np.concatenate([design, penalty]), targets, rcond=None)[0]
    return np.concatenate([found[:1], found[len(offsets) :]])


def kernel_regression(inputs, target, at, *, scales, linear, amplitude):
    """Gaussian process regression with a free intercept, a linear and a Matern 3/2 kernel, entry by entry; noise of variance 1."""

    def covariance(a, b):
        distance = np.sqrt(3 * np.sum((scales * (a - b)) ** 2))
        return 1e7 + linear * np.dot(a, b) + amplitude * (1 + distance) * np.exp(-distance)

    between = np.array([[covariance(a, b) for b in inputs] for a in inputs]) + np.eye(len(inputs))
    across = np.array([[covariance(a, b) for b in inputs] for a in at])
    return across @ np.linalg.solve(between, target)
