"""Repair of located samples, each coordinate by itself: the generic methods of the artifact detection paper (skurowski2022, 4.1.2, E3).

Nothing chooses between the methods or refuses what they give, and samples that were not located are not changed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from markermend.detection.published.coordinatewise import bridge_claimed
from markermend.numerics import filters
from markermend.numerics.interpolation import interpolate_missing
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene

SLOPE_SAMPLES = 5
"""Samples over which the slopes beside located samples are taken, where other markers are predicted from them."""


def linear(positions: np.ndarray, located: np.ndarray) -> np.ndarray:
    """Interpolate straight lines between the samples that were not located.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The distorted trajectories, mm; NaN = missing.
    located : ndarray of bool, shape (frames, markers, 3)
        The samples to replace.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        The trajectories; at the ends of a recording the nearest sample stands in.
    """
    return _each_coordinate(positions, located, interpolate_missing)


def spline(positions: np.ndarray, located: np.ndarray) -> np.ndarray:
    """Interpolate cubic splines between the samples that were not located.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The distorted trajectories, mm; NaN = missing.
    located : ndarray of bool, shape (frames, markers, 3)
        The samples to replace.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        The trajectories; at the ends of a recording the nearest sample stands in.
    """

    def curve(rest: np.ndarray) -> np.ndarray:
        known = np.flatnonzero(~np.isnan(rest))
        out = interpolate_missing(rest)
        if len(known) > 1:
            inside = np.arange(known[0], known[-1] + 1)
            out[inside] = CubicSpline(known, rest[known])(inside)
        return out

    return _each_coordinate(positions, located, curve)


def savitzky_golay(positions: np.ndarray, located: np.ndarray, *, window: int, order: int) -> np.ndarray:
    """Smooth the distorted coordinates, and take the located samples from the smooth.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The distorted trajectories, mm; NaN = missing.
    located : ndarray of bool, shape (frames, markers, 3)
        The samples to replace.
    window : int
        Window of the filter, samples.
    order : int
        Order of its polynomials.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        The trajectories.
    """
    out = positions.copy()
    for place in _affected(located):
        signal, chosen = positions[:, *place], located[:, *place]
        smooth = signal - filters.high_pass(signal, window, order)
        out[chosen, *place] = smooth[chosen]
    return out


def network(scene: Scene, located: np.ndarray, predictor: ResidualSource) -> np.ndarray:
    """Predict the located samples with the replicated network.

    Parameters
    ----------
    scene : Scene
        The distorted trajectories, with the neighbours of each marker.
    located : ndarray of bool, shape (frames, markers, 3)
        The samples to replace. A network that learns this recording is not trained on them; where they are inputs, cubic curves stand in
        for them.
    predictor : ResidualSource
        The network; see published_detectors.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        The trajectories; what cannot be predicted is left.
    """
    hidden = np.where(located.any(axis=2, keepdims=True), np.nan, scene.positions)
    bridged = bridge_claimed(scene.positions, located, SLOPE_SAMPLES)
    bridged = np.where(np.isnan(bridged), linear(scene.positions, located), bridged)
    whole = replace(scene, positions=bridged, measured=replace(scene, positions=hidden))
    markers = np.flatnonzero(located.any(axis=(0, 2)))
    predicted = bridged - predictor.residuals(whole, markers)
    return np.where(located & ~np.isnan(predicted), predicted, scene.positions)


def _affected(located: np.ndarray) -> list[tuple[int, int]]:
    """Marker and axis of each coordinate with located samples."""
    return [(int(marker), int(axis)) for marker, axis in np.argwhere(located.any(axis=0))]


def _each_coordinate(
    positions: np.ndarray, located: np.ndarray, interpolate: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """Replace located samples by interpolation between the others of the same coordinate (frames,), NaN = to replace."""
    out = positions.copy()
    for place in _affected(located):
        chosen = located[:, *place] & ~np.isnan(positions[:, *place])
        rest = np.where(chosen, np.nan, positions[:, *place])
        if not np.isnan(rest).all():
            out[chosen, *place] = interpolate(rest)[chosen]
    return out
