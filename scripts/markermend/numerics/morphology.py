"""Grey-scale morphology of one signal with flat structuring elements; nothing is looked at across a gap (skurowski2022 eq 13-17)."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from markermend.numerics.filters import per_run


def erosion(signal: np.ndarray, size: int) -> np.ndarray:
    """Least value under a flat structuring element of odd size (skurowski2022 eq 13, read as the minimum)."""
    return per_run(lambda run: ndimage.minimum_filter1d(run, size, mode="constant", cval=np.inf), signal)


def dilation(signal: np.ndarray, size: int) -> np.ndarray:
    """Greatest value under a flat structuring element of odd size (skurowski2022 eq 14, read as the maximum)."""
    return per_run(lambda run: ndimage.maximum_filter1d(run, size, mode="constant", cval=-np.inf), signal)


def opening(signal: np.ndarray, size: int) -> np.ndarray:
    """Erosion, then dilation: removes what is narrower than the element (skurowski2022 eq 15)."""
    return dilation(erosion(signal, size), size)


def closing(signal: np.ndarray, size: int) -> np.ndarray:
    """Dilation, then erosion: fills what is narrower than the element (skurowski2022 eq 16)."""
    return erosion(dilation(signal, size), size)


def top_hat(signal: np.ndarray, size: int) -> np.ndarray:
    """Signal minus its opening: keeps what is narrower than the element (skurowski2022 eq 17)."""
    return signal - opening(signal, size)
