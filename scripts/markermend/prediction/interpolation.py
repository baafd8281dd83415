"""Interpolation in time: a marker's own course on either side carries it across the gap. For short gaps only."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from markermend.prediction.scene import Prediction, Scene

KINDS = ("linear", "spline", "pchip", "makima")
"""Straight line, cubic spline (not-a-knot), monotone piecewise cubic, modified Akima."""


class Interpolation:
    """One kind of interpolation as a predictor; states no error."""

    continuous = True

    def __init__(self, kind: str, *, knots: int) -> None:
        """kind: one of KINDS. knots: most observed samples used on either side."""
        if kind not in KINDS:
            raise ValueError(f"unknown interpolation {kind!r}: one of {', '.join(KINDS)}")
        self.name = kind
        self.knots = knots

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. NaN throughout where the marker is not seen on both sides."""
        frames = np.arange(start - 1, stop + 1)
        positions = np.full((len(frames), 3), np.nan)
        known = np.flatnonzero(scene.present[:, marker])
        before, after = known[known < start][-self.knots :], known[known >= stop][: self.knots]
        if len(before) and len(after):
            knots = np.concatenate([before, after])
            between = (frames >= before[-1]) & (frames <= after[0])
            curve = _curve(self.name, knots / scene.rate, scene.positions[knots, marker])
            positions[between] = curve(frames[between] / scene.rate)
        return Prediction(positions, np.full(len(frames), np.nan))


def _curve(kind: str, times: np.ndarray, values: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """The curve of a kind through values (n, 3) at n >= 2 times."""
    if kind == "linear":
        return lambda wanted: np.stack([np.interp(wanted, times, axis) for axis in values.T], axis=1)
    from scipy.interpolate import Akima1DInterpolator, CubicSpline, PchipInterpolator

    if kind == "spline":
        return CubicSpline(times, values)
    if kind == "pchip":
        return PchipInterpolator(times, values)
    return Akima1DInterpolator(times, values, method="makima")
