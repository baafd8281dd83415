"""Rigid frames on the body: the pose of a few steady markers, in whose coordinates the others hardly move."""

from __future__ import annotations

import numpy as np


def align(points: np.ndarray, template: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Fit a rigid template to points (Kabsch), all frames at once.

    points: (frames, k, 3), complete. template: (k, 3), centred. Returns rotation (frames, 3, 3) and origin (frames, 3):
    a laboratory position x has the local coordinates (x - origin) @ rotation.
    """
    origin = points.mean(axis=1)
    cross = np.einsum("nki,kj->nij", points - origin[:, None], template)
    left, _, right = np.linalg.svd(cross)
    flip = np.where(np.linalg.det(left @ right) < 0, -1.0, 1.0)
    left[:, :, 2] *= flip[:, None]
    return left @ right, origin


def mean_shape(points: np.ndarray) -> np.ndarray:
    """The centred typical shape (k, 3) of points (frames, k, 3), complete: two rounds of alignment from one frame."""
    centred = points - points.mean(axis=1, keepdims=True)
    size = np.linalg.norm(points[:, :, None] - points[:, None], axis=3).reshape(len(points), -1)
    typical = int(np.argmin(np.abs(size - np.median(size, axis=0)).sum(axis=1)))
    shape = centred[typical]
    for _ in range(2):
        rotation, _ = align(points, shape)
        shape = np.median(centred @ rotation, axis=0)
        shape = shape - shape.mean(axis=0)
    return shape


def width(shape: np.ndarray) -> float:
    """The second largest root-mean-square extent of a shape (k, 3), mm: near 0 where the points lie on one line."""
    return float(np.linalg.svd(shape - shape.mean(axis=0), compute_uv=False)[1] / np.sqrt(len(shape)))
