"""Shapes over time of sudden displacements of one marker: dips, flicker, one wrong line of sight, ghosts that follow it.

Of each kind there are two shapes, so that what is chosen on one can be judged on the other.
"""

from __future__ import annotations

import numpy as np

from markermend.simulation.fault_site import Site


def plateau_with_ramps(site: Site) -> np.ndarray:
    """Draw a dip of 5-30 mm: straight ramps of 1-3 frames, and 2-15 frames between them.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    down, up = site.rng.integers(1, 4, 2)
    size = np.concatenate(
        [
            np.arange(1, down + 1) / (down + 1),
            np.ones(site.rng.integers(2, 16)),
            np.arange(up, 0, -1) / (up + 1),
        ]
    )
    return site.along(size * site.rng.uniform(5.0, 30.0))


def sagging_dip(site: Site) -> np.ndarray:
    """Draw a dip of 5-30 mm whose ramps are rounded and whose bottom rises or sinks by a quarter.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    down, up = site.rng.integers(1, 4, 2)
    bottom = 1 + np.linspace(0.0, site.rng.uniform(-0.25, 0.25), site.rng.integers(2, 16))
    round_down = (1 - np.cos(np.pi * np.arange(1, down + 1) / (down + 1))) / 2
    round_up = (1 + np.cos(np.pi * np.arange(1, up + 1) / (up + 1))) / 2
    return site.along(np.concatenate([round_down, bottom, bottom[-1] * round_up]) * site.rng.uniform(5.0, 30.0))


def random_telegraph(site: Site) -> np.ndarray:
    """Draw flicker between two levels 5-20 mm apart, with exponential dwell times of 3 frames on average, for 0.3-2 s.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    changes = site.rng.random(site.duration(0.3, 2.0)) < 1 / 3
    return site.along((1 + np.cumsum(changes)) % 2 * site.rng.uniform(5.0, 20.0))


def alternating_blocks(site: Site) -> np.ndarray:
    """Draw flicker between two levels 5-20 mm apart: blocks of 4-15 frames, the displaced ones uneven by a tenth.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    length, size = site.duration(0.3, 2.0), site.rng.uniform(5.0, 20.0)
    levels: list[float] = []
    while len(levels) < length:
        displaced, back = site.rng.integers(4, 16, 2)
        levels += [size * site.rng.uniform(0.9, 1.1)] * displaced + [0.0] * back
    return site.along(np.array(levels[:length]))


def constant_offset(site: Site) -> np.ndarray:
    """Draw a displacement of 10-25 mm along one direction of the laboratory for 0.2-1.5 s.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    return site.along(np.full(site.duration(0.2, 1.5), site.rng.uniform(10.0, 25.0)))


def uneven_offset(site: Site) -> np.ndarray:
    """Draw a displacement of 10-25 mm along one direction for 0.2-1.5 s, which changes by a fifth and is noisy along it.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    length = site.duration(0.2, 1.5)
    size = site.rng.uniform(10.0, 25.0) * np.linspace(1.0, site.rng.uniform(0.8, 1.2), length)
    return site.along(size + site.rng.normal(0.0, 0.5, length))


def half_sine(site: Site) -> np.ndarray:
    """Draw a peak of 6-14 mm: half a sine of 1-5 frames.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    length = int(site.rng.integers(1, 6))
    sizes = np.sin(np.pi * (np.arange(length) + 0.5) / length)
    return site.along(site.rng.uniform(6.0, 14.0) * sizes / sizes.max())


def uneven_peak(site: Site) -> np.ndarray:
    """Draw a peak of 6-14 mm: 1-5 frames off by different amounts.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    sizes = site.rng.uniform(0.5, 1.0, int(site.rng.integers(1, 6)))
    return site.along(site.rng.uniform(6.0, 14.0) * sizes / sizes.max())


def constant_jump(site: Site) -> np.ndarray:
    """Draw a ghost that follows the marker 30-150 mm beside it for 1-30 frames.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    return site.along(np.full(site.rng.integers(1, 31), site.rng.uniform(30.0, 150.0)))


def distant_jump(site: Site) -> np.ndarray:
    """Draw a ghost that follows the marker 1-5 m beside it for 1-30 frames.

    Parameters
    ----------
    site : Site
        Gives frame rate and randomness.

    Returns
    -------
    ndarray of float, shape (n, 3)
        The displacement in mm.
    """
    return site.along(np.full(site.rng.integers(1, 31), site.rng.uniform(1000.0, 5000.0)))
