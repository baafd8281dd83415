"""Shapes over time of markers that shake: wobble of 5-12 Hz, and jitter from frame to frame, two shapes of each."""

from __future__ import annotations

import numpy as np
from scipy.signal import butter, sosfiltfilt

from markermend.simulation.fault_site import Site


def swelling_sine(site: Site) -> np.ndarray:
    """Draw a wobble of 2-6 mm, a sine of 5-12 Hz that swells and fades, for 0.5-2 s.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    length = site.duration(0.5, 2.0)
    time = np.arange(length) / site.rate
    phase = site.rng.uniform(0.0, 2 * np.pi)
    wave = np.sin(2 * np.pi * site.rng.uniform(5.0, 12.0) * time + phase) * _taper(length, 0.2)
    return site.along(site.rng.uniform(2.0, 6.0) * wave)


def band_limited_noise(site: Site) -> np.ndarray:
    """Draw a wobble of 2-6 mm, noise between 5 and 12 Hz along all axes, for 0.5-2 s.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    length = site.duration(0.5, 2.0)
    band = butter(2, [5.0, 12.0], "bandpass", fs=site.rate, output="sos")
    noise = sosfiltfilt(band, site.rng.normal(0.0, 1.0, (length + 2 * round(site.rate), 3)), axis=0)
    noise = noise[round(site.rate) :][:length] * _taper(length, 0.1)[:, None]
    size = np.sqrt((noise**2).sum(axis=1).mean())
    return np.asarray(noise * site.rng.uniform(2.0, 6.0) / np.sqrt(2) / size)


def white_noise(site: Site) -> np.ndarray:
    """Draw jitter from frame to frame: normal, of 1.5-4 mm along each axis, for 0.3-2 s.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    return site.rng.normal(0.0, site.rng.uniform(1.5, 4.0), (site.duration(0.3, 2.0), 3))


def alternating_jumps(site: Site) -> np.ndarray:
    """Draw jitter from frame to frame: to and fro along one direction, by uneven amounts of 1.5-4 mm a frame on average.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    length = site.duration(0.3, 2.0)
    signs = np.where(np.arange(length) % 2, 1.0, -1.0) * np.where(site.rng.random(length) < 0.2, -1.0, 1.0)
    size = site.rng.uniform(1.5, 4.0) * np.sqrt(3) * site.rng.uniform(0.4, 1.6, length)
    return site.along(signs * size) + site.rng.normal(0.0, 0.2, (length, 3))


def _taper(length: int, share: float) -> np.ndarray:
    """Weights that rise from 0 to 1 and fall again, over a share of the length at either end."""
    ends = np.minimum(np.arange(length) + 0.5, np.arange(length)[::-1] + 0.5) / (share * length)
    return np.asarray(np.sin(np.pi / 2 * np.minimum(ends, 1.0)) ** 2)
