"""Scaled conjugate gradient (Moller 1993) for many independent problems that advance together.

The first axis of every array counts the problems. A problem that has converged is no longer evaluated.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Objective = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Maps parameters (b, n) and the indices of their problems (b,), ascending, to values (b,) and gradients (b, n)."""

HeldOutLoss = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Maps the same arguments to losses (b,) on held-out data."""

INITIAL_SCALE = 1e-6
"""First value of the scale that keeps the curvature positive; it adapts within a few steps."""

ROUNDING = 1e-15
"""A step whose expected decrease is below this part of the value is lost in rounding: the problem has converged."""


@dataclass(frozen=True)
class DescentOptions:
    """When to stop, and how curvature is measured.

    Attributes
    ----------
    iterations : int
        Largest number of iterations.
    gradient_tolerance : float
        A problem has converged when no component of its gradient is larger.
    probe : float
        Length of the step along the direction over which the change of the gradient gives the curvature (Moller's
        sigma).
    patience : int
        Iterations without a better held-out loss after which the best parameters so far are returned.
    """

    iterations: int
    gradient_tolerance: float
    probe: float
    patience: int


@dataclass(frozen=True)
class Minimum:
    """The best point that each problem reached.

    Attributes
    ----------
    parameters : np.ndarray
        Parameters (problems, n).
    values : np.ndarray
        Objective there (problems,), or the held-out loss if one was given.
    iterations : np.ndarray
        Number of iterations of each problem (problems,).
    """

    parameters: np.ndarray
    values: np.ndarray
    iterations: np.ndarray


class _Descent:
    """The state of all problems: parameters, negative gradients, conjugate directions, and curvatures along these."""

    def __init__(self, objective: Objective, start: np.ndarray, probe: float) -> None:
        self.objective, self.probe = objective, probe
        self.parameters = np.array(start, float)
        self.value, gradient = objective(self.parameters, np.arange(len(start)))
        self.downhill = -gradient
        self.direction = self.downhill.copy()
        self.scale = np.full(len(start), INITIAL_SCALE)
        self.curvature = np.zeros(len(start))
        self.succeeded = np.ones(len(start), bool)
        self.exhausted = np.zeros(len(start), bool)

    def step(self, active: np.ndarray, *, restart: bool) -> None:
        """Advance the active problems (indices, ascending) by one iteration: Moller 1993, steps 2 to 8."""
        direction = self.direction[active]
        square = np.einsum("bn,bn->b", direction, direction)
        self._measure_curvature(active, square)
        scale = self.scale[active]
        delta = self.curvature[active] + scale * square
        scale = np.where(delta <= 0, 2 * (scale - delta / square), scale)
        delta = self.curvature[active] + scale * square
        slope = np.einsum("bn,bn->b", direction, self.downhill[active])
        reached = self.parameters[active] + (slope / delta)[:, None] * direction
        value, gradient = self.objective(reached, active)
        self.exhausted[active] = slope**2 / delta <= ROUNDING * np.abs(self.value[active])
        # Actual over predicted decrease: 1 if the objective is quadratic, below 0 if it rises.
        comparison = 2 * delta * (self.value[active] - value) / slope**2
        good = self.succeeded[active] = comparison >= 0
        self.parameters[active[good]], self.value[active[good]] = reached[good], value[good]
        self._turn(active[good], -gradient[good], slope[good], restart=restart)
        increase = np.where(np.isfinite(comparison), delta * (1 - comparison), 4 * delta) / square
        raised = np.where(comparison >= 0.25, scale, scale + increase)
        self.scale[active] = np.where(comparison >= 0.75, scale / 4, raised)

    def _measure_curvature(self, active: np.ndarray, square: np.ndarray) -> None:
        """Curvature along new directions, from gradients at two points (step 2); after a failed step it stays."""
        new = active[self.succeeded[active]]
        if len(new) == 0:
            return
        probe = self.probe / np.sqrt(square[self.succeeded[active]])
        _, ahead = self.objective(self.parameters[new] + probe[:, None] * self.direction[new], new)
        self.curvature[new] = np.einsum("bn,bn->b", self.direction[new], ahead + self.downhill[new]) / probe

    def _turn(self, problems: np.ndarray, downhill: np.ndarray, slope: np.ndarray, *, restart: bool) -> None:
        """New conjugate directions (step 7); steepest descent at a restart, or where they would lead uphill."""
        change = np.einsum("bn,bn->b", downhill, downhill - self.downhill[problems])
        conjugate = downhill + (change / slope)[:, None] * self.direction[problems]
        steepest = restart | (np.einsum("bn,bn->b", conjugate, downhill) <= 0)
        self.direction[problems] = np.where(steepest[:, None], downhill, conjugate)
        self.downhill[problems] = downhill


def minimise(
    objective: Objective, start: np.ndarray, *, options: DescentOptions, held_out: HeldOutLoss | None = None
) -> Minimum:
    """Minimise many functions at once by scaled conjugate gradient.

    The result of a problem does not depend on the others.

    Parameters
    ----------
    objective : Objective
        Values and gradients; finite at the start.
    start : np.ndarray
        First parameters (problems, n).
    options : DescentOptions
        When to stop.
    held_out : HeldOutLoss | None
        Loss on held-out data, for early stopping; without it, problems end when they converge.

    Returns
    -------
    Minimum
        The best point of each problem, by the held-out loss if there is one.

    Raises
    ------
    ValueError
        If the objective is not finite at the start.

    References
    ----------
    Moller (1993), "A scaled conjugate gradient algorithm for fast supervised learning", Neural Networks 6(4).
    """
    descent = _Descent(objective, start, options.probe)
    if not np.isfinite(descent.value).all():
        raise ValueError("the objective is not finite where the descent starts")
    everyone = np.arange(len(start))
    iterations, best_iteration = np.zeros(len(start), int), np.zeros(len(start), int)
    best = descent.parameters.copy()
    best_value = descent.value.copy() if held_out is None else held_out(descent.parameters, everyone)
    active = everyone
    for iteration in range(options.iterations):
        steep = np.abs(descent.downhill[active]).max(axis=1) > options.gradient_tolerance
        active = active[steep & ~descent.exhausted[active]]
        if held_out is not None:
            active = active[iterations[active] - best_iteration[active] < options.patience]
        if len(active) == 0:
            break
        descent.step(active, restart=(iteration + 1) % start.shape[1] == 0)
        iterations[active] += 1
        value = descent.value[active] if held_out is None else held_out(descent.parameters[active], active)
        improved = value < best_value[active]
        better = active[improved]
        best[better], best_iteration[better] = descent.parameters[better], iterations[better]
        best_value[better] = value[improved]
    return Minimum(best, best_value, iterations)
