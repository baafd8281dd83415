"""Interpolation in time: a short gap is bridged from the marker's own trajectory on either side."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from markermend.numerics.interpolation import cubic_spline
from markermend.prediction.interface import Prediction
from markermend.prediction.scene import Scene

KINDS = ("linear", "spline", "pchip", "makima")
"""Straight line, cubic spline (not-a-knot), monotone piecewise cubic, modified Akima."""


class Interpolation:
    """Interpolation of one kind as a predictor; it states no error.

    Parameters
    ----------
    kind : str
        One of KINDS; also the name of the predictor.
    knots : int
        Largest number of observed samples used on either side.

    Raises
    ------
    ValueError
        If the kind is unknown.
    """

    continuous = True

    def __init__(self, kind: str, *, knots: int) -> None:
        if kind not in KINDS:
            raise ValueError(f"unknown interpolation {kind!r}: one of {', '.join(KINDS)}")
        self.name = kind
        self.knots = knots

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Interpolate between both sides of the gap; NaN if the marker is missing on one side. See `Predictor.predict`."""
        prediction = Prediction.empty(start, stop)
        frames = np.arange(start - 1, stop + 1)
        known = np.flatnonzero(scene.present[:, marker])
        before, after = known[known < start][-self.knots :], known[known >= stop][: self.knots]
        if len(before) and len(after):
            knots = np.concatenate([before, after])
            between = (frames >= before[-1]) & (frames <= after[0])
            curve = _curve(self.name, knots / scene.rate, scene.positions[knots, marker])
            prediction.positions[between] = curve(frames[between] / scene.rate)
        return prediction


def _curve(kind: str, times: np.ndarray, values: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """The curve of a kind through values (n, 3) at n >= 2 times, a function of times."""
    if kind == "linear":
        return lambda at: np.stack([np.interp(at, times, axis) for axis in values.T], axis=1)
    if kind == "spline":
        return lambda at: cubic_spline(times, values, at)
    from scipy.interpolate import Akima1DInterpolator, PchipInterpolator  # 0.3 s to import, which splines do without

    curve: Callable[[np.ndarray], np.ndarray] = (
        PchipInterpolator(times, values) if kind == "pchip" else Akima1DInterpolator(times, values, method="makima")
    )
    return curve
