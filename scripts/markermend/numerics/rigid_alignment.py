"""Rigid frames on the body: the pose of a few steady markers, in whose coordinates the others hardly move."""

from __future__ import annotations

import numpy as np


def align(points: np.ndarray, template: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Fit a rigid template to points (Kabsch), all frames at once.

    points: (frames, k, 3), complete. template: (k, 3), centred. Returns rotation (frames, 3, 3) and origin (frames, 3):
    a laboratory position x has the local coordinates (x - origin) @ rotation.
    """
    origin = points.mean(axis=1)
    return nearest_rotations(np.einsum("nki,kj->nij", points - origin[:, None], template)), origin


def nearest_rotations(matrices: np.ndarray) -> np.ndarray:
    """The rotations (n, 3, 3) nearest to matrices (n, 3, 3), as unit quaternions; source: Horn 1987.

    The quaternion is the eigenvector of a symmetric 4 x 4 matrix without trace; its eigenvalue, the largest root of the
    characteristic polynomial, is found by Newton's method from above, and the vector is a column of the adjugate: a
    tenth of the time of singular values, which are left with those few matrices that are nearly of rank 1.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = np.moveaxis(
            matrices / np.linalg.norm(matrices, axis=(1, 2), keepdims=True), 0, -1
        )
        upper = [xx + yy + zz, zy - yz, xz - zx, yx - xy, xx - yy - zz, xy + yx, xz + zx, yy - xx - zz, yz + zy]
        key = np.stack([*upper, zz - xx - yy], axis=-1)[:, [0, 1, 2, 3, 1, 4, 5, 6, 2, 5, 7, 8, 3, 6, 8, 9]]
        key = key.reshape(-1, 4, 4)
        square = key @ key
        # Coefficients of the polynomial by Newton's identities: the powers of its roots sum to 0, 4, ...
        linear = -(square * key).sum(axis=(1, 2)) / 3
        constant = 2 - (square**2).sum(axis=(1, 2)) / 4
        root = np.full(len(matrices), np.sqrt(3.0))
        for _ in range(40):
            step = (((root**2 - 2) * root + linear) * root + constant) / (4 * root**3 - 4 * root + linear)
            root = root - step
            if not (np.abs(step) > 1e-12).any():
                break
    r = root[:, None, None]
    adjugate = square @ key + r * square + (r**2 - 2) * key + (r**3 - 2 * r + linear[:, None, None]) * np.eye(4)
    diagonal = np.diagonal(adjugate, axis1=1, axis2=2)
    quaternion = np.take_along_axis(adjugate, np.argmax(diagonal, axis=1)[:, None, None], axis=2)[..., 0]
    hard = ~(diagonal.sum(axis=1) > 1e-3)
    rotations = _from_quaternions(quaternion)
    if hard.any():
        rotations[hard] = _by_singular_values(matrices[hard])
    return rotations


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
    """The rotations (n, 3, 3) nearest to matrices (n, 3, 3) of any rank (Kabsch)."""
    left, _, right = np.linalg.svd(matrices)
    flip = np.where(np.linalg.det(left @ right) < 0, -1.0, 1.0)
    left[:, :, 2] *= flip[:, None]
    return left @ right


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
