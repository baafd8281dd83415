"""Scaled conjugate gradient (Moller 1993), for many independent problems that advance together.

The first axis of every array counts the problems. A problem that has come to rest is no longer evaluated.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Objective = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""From parameters (b, n) and which problems they are of (b,), ascending: the values (b,) and the gradients (b, n)."""

Judge = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""From the same: values (b,) on what was held out."""

INITIAL_SCALE = 1e-6
"""What the scale that keeps the curvature positive begins with; it finds its own size within a few steps (Moller 1993)."""

EXHAUSTED = 1e-15
"""A step that promises less than this part of the value is lost in rounding: the problem is solved."""


@dataclass(frozen=True)
class DescentOptions:
    """When to stop, and how curvature is measured.

    iterations: at most. rest: largest component of a gradient at which a problem is solved. probe: length of the step
    along the direction over which the gradient's change tells the curvature (Moller's sigma). patience: iterations
    without a better held-out value, after which the best parameters so far are the result.
    """

    iterations: int
    rest: float
    probe: float
    patience: int


@dataclass(frozen=True)
class Minimum:
    """Where each problem came to: parameters (problems, n), values (problems,), iterations (problems,)."""

    parameters: np.ndarray
    values: np.ndarray
    iterations: np.ndarray


class _Descent:
    """The state of all problems: where they are, their downhill gradients, directions, and curvatures along these."""

    def __init__(self, objective: Objective, start: np.ndarray, probe: float) -> None:
        self.objective, self.probe = objective, probe
        self.parameters = np.array(start, float)
        self.value, gradient = objective(self.parameters, np.arange(len(start)))
        self.downhill = -gradient
        self.direction = self.downhill.copy()
        self.scale = np.full(len(start), INITIAL_SCALE)
        self.curvature = np.zeros(len(start))
        self.moved = np.ones(len(start), bool)
        self.exhausted = np.zeros(len(start), bool)

    def step(self, on: np.ndarray, *, restart: bool) -> None:
        """Advance the problems `on` (indices, ascending) by one iteration: Moller 1993, steps 2 to 8."""
        direction = self.direction[on]
        square = np.einsum("bn,bn->b", direction, direction)
        self._measure_curvature(on, square)
        scale = self.scale[on]
        delta = self.curvature[on] + scale * square
        bent = delta <= 0
        scale = np.where(bent, 2 * (scale - delta / square), scale)
        delta = self.curvature[on] + scale * square
        along = np.einsum("bn,bn->b", direction, self.downhill[on])
        reached = self.parameters[on] + (along / delta)[:, None] * direction
        value, gradient = self.objective(reached, on)
        self.exhausted[on] = along**2 / delta <= EXHAUSTED * np.abs(self.value[on])
        # How well a parabola foretold the value: 1 is exactly, below 0 it went uphill.
        fit = 2 * delta * (self.value[on] - value) / along**2
        good = self.moved[on] = fit >= 0
        self.parameters[on[good]], self.value[on[good]] = reached[good], value[good]
        self._turn(on[good], -gradient[good], along[good], restart=restart)
        stiffer = np.where(np.isfinite(fit), delta * (1 - fit), 4 * delta) / square
        self.scale[on] = np.where(fit >= 0.75, scale / 4, np.where(fit >= 0.25, scale, scale + stiffer))

    def _measure_curvature(self, on: np.ndarray, square: np.ndarray) -> None:
        """Curvature along new directions, from gradients at two points (step 2); an old direction keeps its own."""
        new = on[self.moved[on]]
        if len(new) == 0:
            return
        probe = self.probe / np.sqrt(square[self.moved[on]])
        _, ahead = self.objective(self.parameters[new] + probe[:, None] * self.direction[new], new)
        self.curvature[new] = np.einsum("bn,bn->b", self.direction[new], ahead + self.downhill[new]) / probe

    def _turn(self, on: np.ndarray, downhill: np.ndarray, along: np.ndarray, *, restart: bool) -> None:
        """New conjugate directions (step 7); straight downhill at a restart, or where they would lead uphill."""
        change = np.einsum("bn,bn->b", downhill, downhill - self.downhill[on])
        turned = downhill + (change / along)[:, None] * self.direction[on]
        straight = restart | (np.einsum("bn,bn->b", turned, downhill) <= 0)
        self.direction[on] = np.where(straight[:, None], downhill, turned)
        self.downhill[on] = downhill


def minimise(
    objective: Objective, start: np.ndarray, *, options: DescentOptions, held_out: Judge | None = None
) -> Minimum:
    """Minimise many functions at once by scaled conjugate gradient; source: Moller 1993, Neural Networks 6(4).

    objective: values and gradients, see Objective; finite at the start. start: (problems, n). held_out: what tells when
    to stop; without it, problems end at rest or with the iterations. Each problem goes its own way: the result does not
    depend on which others there are. Raises ValueError where the objective is not finite at the start.
    """
    descent = _Descent(objective, start, options.probe)
    if not np.isfinite(descent.value).all():
        raise ValueError("the objective is not finite where the descent starts")
    taken = np.zeros(len(start), int)
    every = np.arange(len(start))
    best = descent.parameters.copy()
    best_value = descent.value.copy() if held_out is None else held_out(descent.parameters, every)
    best_at = np.zeros(len(start), int)
    on = every
    for iteration in range(options.iterations):
        on = on[(np.abs(descent.downhill[on]).max(axis=1) > options.rest) & ~descent.exhausted[on]]
        if held_out is not None:
            on = on[taken[on] - best_at[on] < options.patience]
        if len(on) == 0:
            break
        descent.step(on, restart=(iteration + 1) % start.shape[1] == 0)
        taken[on] += 1
        value = descent.value[on] if held_out is None else held_out(descent.parameters[on], on)
        better = on[value < best_value[on]]
        best[better], best_at[better] = descent.parameters[better], taken[better]
        best_value[better] = value[value < best_value[on]]
    return Minimum(best, best_value, taken)
