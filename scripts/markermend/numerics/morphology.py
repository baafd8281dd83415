"""Grey-scale morphology of one signal with flat structuring elements that never reach across a gap.

A signal is a float vector with NaN where nothing was measured; sizes are odd numbers of samples (skurowski2022 eq
13-17).
"""

from __future__ import annotations

import numpy as np

from markermend.numerics.filters import per_run


def erosion(signal: np.ndarray, size: int) -> np.ndarray:
    """Take the minimum of a signal under a flat structuring element.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    size : int
        Size of the element, odd, samples.

    Returns
    -------
    np.ndarray
        Eroded signal (frames,); NaN where the signal is NaN.

    References
    ----------
    skurowski2022 eq 13, read as the minimum.
    """
    from scipy import ndimage  # slow to import

    return per_run(lambda run: ndimage.minimum_filter1d(run, size, mode="constant", cval=np.inf), signal)


def dilation(signal: np.ndarray, size: int) -> np.ndarray:
    """Take the maximum of a signal under a flat structuring element.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    size : int
        Size of the element, odd, samples.

    Returns
    -------
    np.ndarray
        Dilated signal (frames,); NaN where the signal is NaN.

    References
    ----------
    skurowski2022 eq 14, read as the maximum.
    """
    from scipy import ndimage  # slow to import

    return per_run(lambda run: ndimage.maximum_filter1d(run, size, mode="constant", cval=-np.inf), signal)


def opening(signal: np.ndarray, size: int) -> np.ndarray:
    """Erode, then dilate a signal: remove peaks narrower than the element.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    size : int
        Size of the element, odd, samples.

    Returns
    -------
    np.ndarray
        Opened signal (frames,), nowhere above the signal; NaN where it is NaN.

    References
    ----------
    skurowski2022 eq 15.
    """
    return dilation(erosion(signal, size), size)


def closing(signal: np.ndarray, size: int) -> np.ndarray:
    """Dilate, then erode a signal: fill valleys narrower than the element.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    size : int
        Size of the element, odd, samples.

    Returns
    -------
    np.ndarray
        Closed signal (frames,), nowhere below the signal; NaN where it is NaN.

    References
    ----------
    skurowski2022 eq 16.
    """
    return erosion(dilation(signal, size), size)


def top_hat(signal: np.ndarray, size: int) -> np.ndarray:
    """Subtract the opening from a signal: keep only peaks narrower than the element.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    size : int
        Size of the element, odd, samples.

    Returns
    -------
    np.ndarray
        White top-hat (frames,), at least 0; NaN where the signal is NaN.

    References
    ----------
    skurowski2022 eq 17.
    """
    residue: np.ndarray = signal - opening(signal, size)
    return residue
