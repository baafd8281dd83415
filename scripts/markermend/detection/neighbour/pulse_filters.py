"""Matched filters of pulses, and what follows of a window from the samples outside of the pulse."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend.detection.neighbour.residual_windows import WindowFilters
from markermend.numerics.window_covariance import WindowCovariance


@dataclass(frozen=True, eq=False)
class PulseFilters(WindowFilters):
    """Matched filters of a half wave, whose misfit is that of the samples outside of it, whatever its shape.

    Attributes
    ----------
    inside : np.ndarray
        The samples of the half wave (c, length).
    """

    inside: np.ndarray

    @property
    def explained(self) -> np.ndarray:
        """What samples of any size in place of the half wave explain; see `WindowFilters.explained`."""
        across = self.precision[self.inside]
        block = self.precision[self.inside[:, :, None], self.inside[:, None]]
        forms: np.ndarray = across.swapaxes(1, 2) @ np.linalg.solve(block, across)
        return forms


@lru_cache(maxsize=512)
def pulse_filters(covariance: WindowCovariance, length: int, size: int, offsets: tuple[int, ...]) -> PulseFilters:
    """Make the matched filters of a half wave of sine.

    Parameters
    ----------
    covariance : WindowCovariance
        Covariance of the residual windows.
    length : int
        Samples of the half wave.
    size : int
        Samples in a window.
    offsets : tuple[int, ...]
        First sample of the half wave.

    Returns
    -------
    PulseFilters
        A filter for each offset.
    """
    precision = covariance.precision(size)
    wave = np.sin(np.pi * (np.arange(length) + 0.5) / length)
    inside = np.array(offsets)[:, None] + np.arange(length)
    across, block = precision[inside], precision[inside[:, :, None], inside[:, None]]
    information = wave @ block @ wave
    return PulseFilters(
        offsets=np.array(offsets),
        weights=wave @ across / information[:, None],
        deviation=information**-0.5,
        precision=precision,
        degrees_of_freedom=covariance.degrees_of_freedom(size) - length,
        inside=inside,
    )


@lru_cache(maxsize=512)
def innovation_map(covariance: WindowCovariance, length: int, size: int, offset: int) -> np.ndarray:
    """Make the map from a window to the deviation of some samples from what the others predict.

    Parameters
    ----------
    covariance : WindowCovariance
        Covariance of the residual windows.
    length : int
        How many samples.
    size : int
        Samples in a window.
    offset : int
        The first of them.

    Returns
    -------
    np.ndarray
        Matrix (length, size).
    """
    across = covariance.precision(size)[offset : offset + length]
    deviation: np.ndarray = np.linalg.solve(across[:, offset : offset + length], across)
    return deviation


@lru_cache(maxsize=512)
def whitened_changes(covariance: WindowCovariance, size: int, *, order: int) -> np.ndarray:
    """Make the map from a window to the amplitudes of changes of level or velocity at each place, each in standard deviations.

    Parameters
    ----------
    covariance : WindowCovariance
        Covariance of the residual windows.
    size : int
        Samples in a window.
    order : int
        0 for steps, changes of level; 1 for kinks, changes of velocity.

    Returns
    -------
    np.ndarray
        Matrix (size - 1 - order, size).
    """
    precision = covariance.precision(size)
    after = np.arange(size) - np.arange(1 + order, size)[:, None] + 1
    change = np.maximum(after, 0) ** order * (after > 0)
    across = change @ precision
    whitened: np.ndarray = across / np.sqrt(np.maximum((across * change).sum(axis=1), 1e-12))[:, None]
    return whitened


def misfit_of_change(window: np.ndarray, covariance: WindowCovariance, *, order: int) -> float:
    """Compute what the change of level or velocity which fits best leaves of a window.

    Parameters
    ----------
    window : np.ndarray
        The window (3, n), mm.
    covariance : WindowCovariance
        Covariance of the residual windows.
    order : int
        0 for steps, changes of level; 1 for kinks, changes of velocity.

    Returns
    -------
    float
        Root mean square, mm.
    """
    size = window.shape[1]
    whole = np.einsum("an,nm,am->", window, covariance.precision(size), window)
    explained = ((window @ whitened_changes(covariance, size, order=order).T) ** 2).sum(axis=0).max()
    return float(np.sqrt(max(whole - explained, 0) / (3 * (covariance.degrees_of_freedom(size) - 1))))
