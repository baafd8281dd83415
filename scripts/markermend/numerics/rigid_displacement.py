"""Rigid displacement of a whole scene: where the points of one moment stand after all of them were moved together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.rigid_alignment import nearest_rotations

MIN_POINTS = 3
"""Points that fix a rigid displacement, at least."""

MIN_ROTATION_GAIN = 20.0
"""F ratio of the square sum that a rotation explains beyond a translation, at least: motion makes it look like one."""

COMMON_MOTION = 8.0
"""So many points say as much as one that moves independently."""

TINY_MM = 1e-6
"""Smallest residual that counts."""

OUTLIER_FACTOR = 3.0
"""Points further off than this many times the median distance do not count in the second fit."""


@dataclass(frozen=True, eq=False)
class RigidDisplacement:
    """A rotation about a point, and a translation.

    Attributes
    ----------
    rotation : np.ndarray
        Rotation (3, 3).
    before, after : np.ndarray
        A point (3,) and where it is displaced to, mm.
    residual_mm : float
        Root mean square distance per axis of the points from where they are displaced to, mm.
    points : int
        Number of points that it was fitted to.
    extent_mm : float
        Root mean square distance of these points from their mean, mm; 0 for a translation.
    """

    rotation: np.ndarray
    before: np.ndarray
    after: np.ndarray
    residual_mm: float
    points: int
    extent_mm: float

    def displace(self, positions: np.ndarray) -> np.ndarray:
        """Displace points.

        Parameters
        ----------
        positions : np.ndarray
            Points (..., 3), mm.

        Returns
        -------
        np.ndarray
            The points after the displacement.
        """
        displaced: np.ndarray = (positions - self.before) @ self.rotation.T + self.after
        return displaced

    def undo(self, positions: np.ndarray) -> np.ndarray:
        """Move displaced points back.

        Parameters
        ----------
        positions : np.ndarray
            Points (..., 3) after the displacement, mm.

        Returns
        -------
        np.ndarray
            The points before it.
        """
        moved: np.ndarray = (positions - self.after) @ self.rotation + self.before
        return moved

    def error_at(self, positions: np.ndarray) -> np.ndarray:
        """State the error of displaced points that are moved back.

        Parameters
        ----------
        positions : np.ndarray
            Points (..., 3) after the displacement, mm.

        Returns
        -------
        np.ndarray
            Standard deviation (...) per axis, mm: that of a mean, and for a rotation of the distance from its centre, too.
            The points count as fewer than they are, since their motion is common to many.
        """
        distance = np.linalg.norm(positions - self.after, axis=-1)
        leverage = (distance / self.extent_mm) ** 2 if self.extent_mm else np.zeros_like(distance)
        error: np.ndarray = self.residual_mm * np.sqrt(COMMON_MOTION / self.points * (1 + leverage))
        return error


def fit_displacement(points: np.ndarray, displaced: np.ndarray) -> RigidDisplacement | None:
    """Fit a rigid displacement to points before and after it.

    Parameters
    ----------
    points, displaced : np.ndarray
        Points (k, 3) before and after, mm; pairs with NaN do not count.

    Returns
    -------
    RigidDisplacement or None
        The displacement of least squares, without points that do not fit, and without a rotation that explains little; None
        where fewer than three points are known.

    References
    ----------
    Kabsch (1976), Acta Crystallographica A 32(5).
    """
    known = ~np.isnan(points + displaced).any(axis=1)
    if known.sum() < MIN_POINTS:
        return None
    first, second = points[known], displaced[known]
    distance = np.linalg.norm(_least_squares(first, second).displace(first) - second, axis=1)
    near = distance <= OUTLIER_FACTOR * np.median(distance)
    if near.sum() >= MIN_POINTS:
        first, second = first[near], second[near]
    moved, turned = _least_squares(first, second, turns=False), _least_squares(first, second)
    gain = (moved.residual_mm / max(turned.residual_mm, TINY_MM)) ** 2 - 1
    return turned if gain * len(first) >= MIN_ROTATION_GAIN else moved


def _least_squares(points: np.ndarray, displaced: np.ndarray, *, turns: bool = True) -> RigidDisplacement:
    """The displacement of least squares, of at least three points without NaN."""
    before, after = points.mean(axis=0), displaced.mean(axis=0)
    rotation = np.eye(3)
    if turns:
        rotation = nearest_rotations((displaced - after).T[None] @ (points - before)[None])[0]
    distances = (points - before) @ rotation.T + after - displaced
    residual = float(np.sqrt((distances**2).sum() / max(1, distances.size - (6 if turns else 3))))
    extent = float(np.sqrt(((displaced - after) ** 2).sum(axis=1).mean())) if turns else 0.0
    return RigidDisplacement(rotation, before, after, residual, len(points), extent)
