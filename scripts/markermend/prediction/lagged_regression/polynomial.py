"""Polynomial least squares (skurowski2022 3.3.2): each coordinate from powers of the inputs' coordinates."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.prediction.lagged_regression.predictor import LaggedRegression, Regression, TrainingSet

RELATIVE_CUTOFF = 1e-10
"""Singular values of the design below this part of the largest are zeroed: lags and powers are nearly dependent."""

MIN_DEVIATION_MM = 1e-3
"""Inputs that hardly vary are not blown up to unit variance."""


class Polynomial(LaggedRegression):
    """The polynomial predictor without the marker's own past; it states no error."""

    name = "polynomial"

    def fit(self, training: Sequence[TrainingSet]) -> list[Regression]:
        """Solve a least-squares problem per training set. See `LaggedRegression.fit`."""
        return [self._fit(own) for own in training]

    def _fit(self, training: TrainingSet) -> Regression:
        """Ordinary least squares on one, the coordinates and their powers (skurowski2022 eq 3, 9)."""
        mean = training.rows.mean(axis=0)
        scale = np.maximum(training.rows.std(axis=0), MIN_DEVIATION_MM)
        max_power = self.options.max_power

        def design(rows: np.ndarray) -> np.ndarray:
            # Powers of standardised coordinates span what those of the coordinates do, with less rounding.
            return np.concatenate([np.ones((len(rows), 1)), *powers((rows - mean) / scale, max_power)], axis=1)

        centre = training.target.mean(axis=0)
        augmented = np.concatenate([design(training.rows), training.target - centre], axis=1)
        _, triangle = np.linalg.qr(augmented)  # the same least squares with as many rows as columns
        beta = np.linalg.lstsq(triangle[:, :-3], triangle[:, -3:], rcond=RELATIVE_CUTOFF)[0]
        return Regression(lambda rows: design(rows) @ beta + centre, np.nan)


def powers(rows: np.ndarray, highest: int) -> list[np.ndarray]:
    """Raise rows to their first powers.

    Parameters
    ----------
    rows : np.ndarray
        Rows (n, k).
    highest : int
        Highest power.

    Returns
    -------
    list[np.ndarray]
        The first to the highest power, each (n, k).
    """
    out = [rows]
    for _ in range(1, highest):
        out.append(out[-1] * rows)
    return out
