"""Descriptors of recordings that may explain how hard their gaps are to fill (skurowski2021, section 3.3 and Table 2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import rankdata

BIN_MM = 10.0
"""Width of the bins of the entropy. The paper names no estimator. Its values exceed log2 of the number of frames, so they are no
entropy of positions in space, but the sum over three coordinates is possible; of plain widths, 1 cm comes nearest to the values
printed for recordings of the same kind."""

EIGENPOSES = 5
"""Number of the largest eigenvalues that complexity leaves out."""


@dataclass(frozen=True)
class SequenceDescriptors:
    """Descriptors of a recording, the columns of Table 2.

    Attributes
    ----------
    entropy : float
        Entropy of a marker in bits: see `entropy`.
    deviation : float
        Mean standard deviation of a coordinate in mm.
    velocity, acceleration, jerk : float
        Mean magnitudes of the derivatives of a marker's position in m/s, m/s² and m/s³.
    monotonicity : float
        Mean absolute rank correlation of a coordinate with time.
    signed_monotonicity : float
        The same with signs, as eq 13 is printed. The printed values, 0.3 to 0.7, suggest absolute ones.
    complexity : float
        Share of the variance beyond the five largest eigenposes.
    """

    entropy: float
    deviation: float
    velocity: float
    acceleration: float
    jerk: float
    monotonicity: float
    signed_monotonicity: float
    complexity: float


def describe_sequence(positions: np.ndarray, rate: float) -> SequenceDescriptors:
    """Compute the descriptors of a recording.

    Each is a mean over markers or coordinates of what is measured of them; those that are never measured are left out.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm; NaN = missing.
    rate : float
        Sampling rate, Hz.

    Returns
    -------
    SequenceDescriptors
        The descriptors; NaN where nothing is measured for long enough.

    References
    ----------
    skurowski2021, section 3.3 and Table 2.
    """
    rho = rank_correlations(positions)
    velocity, acceleration, jerk = (derivative_magnitude(positions, rate, order) for order in (1, 2, 3))
    return SequenceDescriptors(
        entropy=entropy(positions),
        deviation=float(_mean(_deviations(_columns(positions)))),
        velocity=velocity,
        acceleration=acceleration,
        jerk=jerk,
        monotonicity=float(_mean(np.abs(rho))),
        signed_monotonicity=float(_mean(rho)),
        complexity=complexity(positions),
    )


def entropy(positions: np.ndarray, *, bin_mm: float = BIN_MM) -> float:
    """Compute the entropy of a marker: the sum of those of its coordinates, averaged over the markers.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm; NaN = missing.
    bin_mm : float
        Width of the bins of the histogram, mm; their edges are multiples of it.

    Returns
    -------
    float
        Entropy in bits.
    """
    markers = positions.shape[1]
    columns = _columns(positions)
    seen = ~np.isnan(columns)
    _, bins = np.unique(np.floor(columns[seen] / bin_mm), return_inverse=True)
    column = np.nonzero(seen)[1]
    width = int(bins.max(initial=0)) + 1
    cells, counts = np.unique(column * width + bins, return_counts=True)
    total = seen.sum(axis=0)
    share = counts / total[cells // width]
    bits = np.bincount(cells // width, -share * np.log2(share), minlength=3 * markers)
    return float(_mean(np.where(total > 0, bits, np.nan).reshape(markers, 3).sum(axis=1)))


def derivative_magnitude(positions: np.ndarray, rate: float, order: int) -> float:
    """Compute the mean magnitude of a derivative of a marker's position, from differences of adjacent frames.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm; NaN = missing.
    rate : float
        Sampling rate, Hz.
    order : int
        Order of the derivative: 1 for velocity, 2 for acceleration, 3 for jerk.

    Returns
    -------
    float
        Magnitude in m/s to the power of the order.
    """
    magnitude = np.linalg.norm(np.diff(positions, order, axis=0), axis=2) * rate**order / 1000
    return float(_mean(_mean(magnitude)))


def rank_correlations(positions: np.ndarray) -> np.ndarray:
    """Correlate the ranks of each coordinate with time (Spearman).

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm; NaN = missing.

    Returns
    -------
    ndarray of float, shape (3 * markers,)
        Correlations; NaN of coordinates that are constant or not measured in two frames.

    References
    ----------
    skurowski2021, eq 13.
    """
    columns = _columns(positions)
    seen = ~np.isnan(columns)
    ranks = rankdata(columns, axis=0, nan_policy="omit")
    time = np.where(seen, np.cumsum(seen, axis=0), np.nan)
    products = (ranks - _mean(ranks)) * (time - _mean(time))
    scale = _deviations(ranks) * _deviations(time)
    correlations: np.ndarray = _mean(products) / np.where(scale > 0, scale, np.nan)
    return correlations


def complexity(positions: np.ndarray, *, eigenposes: int = EIGENPOSES) -> float:
    """Compute the share of the variance of poses that the largest eigenposes do not explain.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm; NaN = missing. Frames in which a marker is missing that is measured in others are left out.
    eigenposes : int
        Number of eigenposes.

    Returns
    -------
    float
        Share, 0 to 1; NaN if nothing varies.

    References
    ----------
    skurowski2021, eq 14.
    """
    columns = _columns(positions)
    columns = columns[:, ~np.isnan(columns).all(axis=0)]
    poses = columns[~np.isnan(columns).any(axis=1)]
    if not poses.size:
        return np.nan
    variances = np.linalg.svd(poses - poses.mean(axis=0), compute_uv=False) ** 2
    return float(variances[eigenposes:].sum() / variances.sum()) if variances.any() else np.nan


def _columns(positions: np.ndarray) -> np.ndarray:
    """Coordinates as columns (frames, 3 * markers)."""
    return positions.reshape(len(positions), 3 * positions.shape[1])


def _mean(values: np.ndarray) -> np.ndarray:
    """Mean over the first axis of what is not NaN; NaN of nothing."""
    seen = ~np.isnan(values)
    count = seen.sum(axis=0)
    mean: np.ndarray = np.where(seen, values, 0).sum(axis=0) / np.where(count > 0, count, np.nan)
    return mean


def _deviations(columns: np.ndarray) -> np.ndarray:
    """Standard deviations over the first axis of what is not NaN."""
    deviations: np.ndarray = np.sqrt(_mean((columns - _mean(columns)) ** 2))
    return deviations
