"""Rigid alignment of markers: the pose of a few anchors, in whose frame the other markers of a segment hardly move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

NEWTON_STEPS = 40
"""Largest number of Newton steps to a root; one to four are usual."""

MIN_DISTINCT = 1e-3
"""Product of the sums of two singular values each, from which on rotations are as accurate as by decompositions."""

_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])


@dataclass(frozen=True, eq=False)
class LocalFrames:
    """Frames of reference on a body, one at each of n frames of a recording.

    Attributes
    ----------
    axes : np.ndarray
        Rotations (n, 3, 3): their columns are the local axes in laboratory coordinates.
    origin : np.ndarray
        Origins (n, 3), mm, in the laboratory.
    """

    axes: np.ndarray
    origin: np.ndarray

    def local(self, points: np.ndarray) -> np.ndarray:
        """Express laboratory positions in the local frames.

        Parameters
        ----------
        points : np.ndarray
            Positions in the laboratory, (n, 3) or (n, k, 3), mm.

        Returns
        -------
        np.ndarray
            Local positions of the same shape, mm.
        """
        local: np.ndarray
        if points.ndim == 2:
            local = np.einsum("ni,nij->nj", points - self.origin, self.axes)
        else:
            local = (points - self.origin[:, None]) @ self.axes
        return local

    def laboratory(self, local: np.ndarray) -> np.ndarray:
        """Express local positions in the laboratory.

        Parameters
        ----------
        local : np.ndarray
            Local positions (n, 3), mm.

        Returns
        -------
        np.ndarray
            Positions (n, 3) in the laboratory, mm.
        """
        positions: np.ndarray = np.einsum("nj,nij->ni", local, self.axes) + self.origin
        return positions


def align(points: np.ndarray, template: np.ndarray) -> LocalFrames:
    """Fit a rigid template to points in all frames at once (the orthogonal Procrustes problem without reflections).

    Parameters
    ----------
    points : np.ndarray
        Points (n, k, 3), mm, without NaN.
    template : np.ndarray
        Template (k, 3), mm, centred.

    Returns
    -------
    LocalFrames
        The frames in which the points are nearest to the template; their origins are the means of the points.

    References
    ----------
    Kabsch (1976), Acta Crystallographica A 32(5).
    """
    # Coordinates first: each operation runs through whole columns of frames.
    columns = np.ascontiguousarray(points.transpose(1, 2, 0))
    origin = columns.mean(axis=0)
    products = template.T @ (columns - origin).reshape(len(template), -1)
    rotations = _nearest(products.reshape(3, 3, -1).swapaxes(0, 1))
    return LocalFrames(np.ascontiguousarray(rotations.transpose(2, 0, 1)), np.ascontiguousarray(origin.T))


def nearest_rotations(matrices: np.ndarray) -> np.ndarray:
    """Find the rotations nearest to matrices.

    Parameters
    ----------
    matrices : np.ndarray
        Matrices (n, 3, 3) of any rank, without NaN.

    Returns
    -------
    np.ndarray
        Rotations (n, 3, 3) that maximise the trace of their transposes times the matrices.
    """
    return np.ascontiguousarray(_nearest(matrices.transpose(1, 2, 0)).transpose(2, 0, 1))


def _nearest(matrices: np.ndarray) -> np.ndarray:
    """The rotations (3, 3, n) nearest to matrices (3, 3, n), from the sum of their singular values (that of the smallest has the sign of
    the determinant).

    The sum is the largest root of a polynomial of the fourth degree, found by Newton's method; the rotation is an expression in
    it and the matrix. This takes a small part of the time of singular value decompositions, which remain for the few matrices
    of nearly rank 1. See Markley (1993), "Attitude determination using vector observations: a fast optimal matrix algorithm",
    J. Astronaut. Sci. 41(2).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        scaled = matrices / np.sqrt(np.einsum("ijn,ijn->n", matrices, matrices))
        cofactors = (
            scaled[_NEXT][:, _NEXT] * scaled[_LAST][:, _LAST] - scaled[_NEXT][:, _LAST] * scaled[_LAST][:, _NEXT]
        )
        determinant = (scaled[0] * cofactors[0]).sum(axis=0)
        square = np.einsum("ijn,ijn->n", cofactors, cofactors)
        # The root where the smallest singular value is 0; the polynomial is convex from there on.
        root = np.sqrt(1 + 2 * np.sqrt(square))
        for _ in range(NEWTON_STEPS):
            above = root**2 - 1
            step = (above**2 - 8 * determinant * root - 4 * square) / (4 * (above * root - 2 * determinant))
            root = root - step
            if not (np.abs(step) > 1e-12).any():
                break
        half = (root**2 - 1) / 2
        product = np.einsum("kin,kjn->ijn", scaled, scaled)
        # Of singular values a, b, c: (a + b) (b + c) (c + a).
        distinct = half * root - determinant
        numerator = (half + 1) * scaled + root * cofactors - np.einsum("ikn,kjn->ijn", scaled, product)
        rotations: np.ndarray = numerator / distinct
    degenerate = ~((distinct > MIN_DISTINCT) & (square > MIN_DISTINCT**2))
    if degenerate.any():
        exact = _by_singular_values(matrices[..., degenerate].transpose(2, 0, 1))
        rotations[..., degenerate] = exact.transpose(1, 2, 0)
    return rotations


def _by_singular_values(matrices: np.ndarray) -> np.ndarray:
    """The rotations (n, 3, 3) nearest to matrices (n, 3, 3) of any rank, by singular value decompositions (Kabsch)."""
    left, _, right = np.linalg.svd(matrices)
    flip = np.where(np.linalg.det(left @ right) < 0, -1.0, 1.0)
    left[:, :, 2] *= flip[:, None]
    rotations: np.ndarray = left @ right
    return rotations


def mean_shape(points: np.ndarray) -> np.ndarray:
    """Estimate the typical shape of points by two rounds of alignment to the frame of the most typical distances.

    Parameters
    ----------
    points : np.ndarray
        Points (frames, k, 3), mm, without NaN.

    Returns
    -------
    np.ndarray
        Shape (k, 3), mm, centred: the median of the aligned frames, which outliers hardly move.
    """
    centred = points - points.mean(axis=1, keepdims=True)
    first, second = np.triu_indices(points.shape[1], 1)
    between = points[:, first] - points[:, second]
    distances = np.sqrt(np.einsum("npi,npi->np", between, between))
    typical = int(np.argmin(np.abs(distances - np.median(distances, axis=0)).sum(axis=1)))
    shape: np.ndarray = centred[typical]
    for _ in range(2):
        median = np.median(centred @ align(points, shape).axes, axis=0)
        shape = median - median.mean(axis=0)
    return shape


def width(shape: np.ndarray) -> float:
    """Measure how far a shape extends across its longest axis.

    Parameters
    ----------
    shape : np.ndarray
        Points (k, 3), mm.

    Returns
    -------
    float
        Second largest root-mean-square extent, mm: near 0 where the points lie on one line.
    """
    return float(np.linalg.svd(shape - shape.mean(axis=0), compute_uv=False)[1] / np.sqrt(len(shape)))
