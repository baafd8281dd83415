"""Polynomial least squares (skurowski2022 3.3.2): each coordinate from powers of the relatives' coordinates."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.prediction.lagged_regression.predictor import LaggedRegression, Learned, Task

RANK = 1e-10
"""Directions of the design weaker than this part of the strongest are left out: lags and powers are nearly dependent."""


class Polynomial(LaggedRegression):
    """The predictor P of order `powers` and context `lags`, without the marker's own past; states no error."""

    name = "polynomial"

    def learn(self, tasks: Sequence[Task]) -> list[Learned]:
        """See LaggedRegression."""
        return [self._fit(task) for task in tasks]

    def _fit(self, task: Task) -> Learned:
        """Ordinary least squares on one, the coordinates and their powers (skurowski2022 eq 3, 9)."""
        middle = task.rows.mean(axis=0)
        scale = np.maximum(task.rows.std(axis=0), 1e-3)
        powers = self.options.max_power

        def design(rows: np.ndarray) -> np.ndarray:
            # Powers of standardized coordinates span what those of the coordinates do, without the rounding.
            return np.concatenate([np.ones((len(rows), 1)), *raised((rows - middle) / scale, powers)], axis=1)

        centre = task.target.mean(axis=0)
        whole = np.concatenate([design(task.rows), task.target - centre], axis=1)
        _, triangle = np.linalg.qr(whole)  # the same least squares with as many rows as columns
        beta = np.linalg.lstsq(triangle[:, :-3], triangle[:, -3:], rcond=RANK)[0]
        return Learned(lambda rows: design(rows) @ beta + centre, np.nan)


def raised(rows: np.ndarray, powers: int) -> list[np.ndarray]:
    """The first to the highest power of rows."""
    out = [rows]
    for _ in range(1, powers):
        out.append(out[-1] * rows)
    return out
