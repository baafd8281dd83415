"""Rigid alignment of markers: the pose of a few anchors, in whose frame the other markers of a segment hardly move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

NEWTON_STEPS = 40
"""Largest number of Newton steps to an eigenvalue; a handful is usual."""


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
    origin = points.mean(axis=1)
    return LocalFrames(nearest_rotations((points - origin[:, None]).swapaxes(1, 2) @ template), origin)


def nearest_rotations(matrices: np.ndarray) -> np.ndarray:
    """Find the rotations nearest to matrices, by unit quaternions.

    The quaternion is the dominant eigenvector of a symmetric, traceless 4 x 4 matrix. Its eigenvalue, the largest root
    of the characteristic polynomial, is found by Newton's method from above, and the eigenvector is a column of the
    adjugate. This takes a tenth of the time of singular value decompositions, which remain for the few matrices of
    nearly rank 1.

    Parameters
    ----------
    matrices : np.ndarray
        Matrices (n, 3, 3) of any rank, without NaN.

    Returns
    -------
    np.ndarray
        Rotations (n, 3, 3) that maximise the trace of their transposes times the matrices.

    References
    ----------
    Horn (1987), "Closed-form solution of absolute orientation using unit quaternions", J. Opt. Soc. Am. A 4(4).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        key = _quaternion_matrices(matrices / np.linalg.norm(matrices, axis=(1, 2), keepdims=True))
        square = key @ key
        # Coefficients of the polynomial by Newton's identities: the powers of its roots sum to 0, 4, ...
        linear = -(square * key).sum(axis=(1, 2)) / 3
        constant = 2 - (square**2).sum(axis=(1, 2)) / 4
        root = np.full(len(matrices), np.sqrt(3.0))
        for _ in range(NEWTON_STEPS):
            step = (((root**2 - 2) * root + linear) * root + constant) / (4 * root**3 - 4 * root + linear)
            root = root - step
            if not (np.abs(step) > 1e-12).any():
                break
    r = root[:, None, None]
    adjugate = square @ key + r * square + (r**2 - 2) * key + (r**3 - 2 * r + linear[:, None, None]) * np.eye(4)
    diagonal = np.diagonal(adjugate, axis1=1, axis2=2)
    quaternion = np.take_along_axis(adjugate, np.argmax(diagonal, axis=1)[:, None, None], axis=2)[..., 0]
    degenerate = ~(diagonal.sum(axis=1) > 1e-3)
    rotations = _from_quaternions(quaternion)
    if degenerate.any():
        rotations[degenerate] = _by_singular_values(matrices[degenerate])
    return rotations


def _quaternion_matrices(matrices: np.ndarray) -> np.ndarray:
    """Horn's symmetric matrices (n, 4, 4), whose dominant eigenvectors are the quaternions of matrices (n, 3, 3)."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = np.moveaxis(matrices, 0, -1)
    upper = [xx + yy + zz, zy - yz, xz - zx, yx - xy, xx - yy - zz, xy + yx, xz + zx, yy - xx - zz, yz + zy]
    key = np.stack([*upper, zz - xx - yy], axis=-1)[:, [0, 1, 2, 3, 1, 4, 5, 6, 2, 5, 7, 8, 3, 6, 8, 9]]
    return key.reshape(-1, 4, 4)


def _from_quaternions(quaternions: np.ndarray) -> np.ndarray:
    """Rotation matrices (n, 3, 3) of quaternions (n, 4), scalar first, of any length."""
    with np.errstate(divide="ignore", invalid="ignore"):
        w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=1)


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
    distances = np.linalg.norm(points[:, :, None] - points[:, None], axis=3).reshape(len(points), -1)
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
