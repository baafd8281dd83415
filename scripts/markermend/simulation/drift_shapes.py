"""Shapes over time of slow drifts of one marker that return."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from markermend.simulation.fault_site import Site

Shape = Callable[[Site], np.ndarray]
"""Draws a displacement, (n, 3) in mm."""


def raised_cosine(low_s: float, high_s: float, size_mm: float) -> Shape:
    """Make a shape of drift: one period of a raised cosine.

    Parameters
    ----------
    low_s, high_s : float
        Bounds of its duration, s.
    size_mm : float
        Its maximum, mm.

    Returns
    -------
    Shape
        The shape.
    """

    def draw(site: Site) -> np.ndarray:
        length = site.duration(low_s, high_s)
        return site.along(size_mm * np.sin(np.pi * (np.arange(length) + 0.5) / length) ** 2)

    return draw


def skewed_bump(low_s: float, high_s: float, size_mm: float) -> Shape:
    """Make a shape of drift: a rise and a fall of different duration, straight but rounded, which turn by up to 45 degrees.

    Parameters
    ----------
    low_s, high_s : float
        Bounds of its duration, s.
    size_mm : float
        Its maximum, mm.

    Returns
    -------
    Shape
        The shape.
    """

    def draw(site: Site) -> np.ndarray:
        length = site.duration(low_s, high_s)
        time, top = (np.arange(length) + 0.5) / length, site.rng.uniform(0.3, 0.7)
        linear = np.minimum(time / top, (1 - time) / (1 - top))
        size = np.minimum(linear, 0.5 * linear + 0.45)
        first, second = site.direction(), site.direction()
        aside = second - first * (second @ first)
        angle = np.radians(45) * site.rng.uniform(0.0, 1.0) * time
        turning = np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * aside / np.linalg.norm(aside)
        return np.asarray(size_mm * (size / size.max())[:, None] * turning)

    return draw
