"""Faults of the position of one marker: displaced for a time or for good, replaced by a ghost or by a program's filling."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from markermend.simulation.drift_shapes import Shape
from markermend.simulation.fault_site import Site
from markermend.simulation.faults import Fault, Generator

RIGID_MATES, RIGID_MM = 3, 3.0
"""A marker is on a rigid segment where its distances to so many others vary by less than so many mm."""

SENTINEL = 9999.0
"""Number that some programs write for a missing coordinate."""

VISIBLE_MM = 5.0
"""A filling that stays nearer to the truth than this is no fault."""

ATTEMPTS = 50
"""Places that are tried for a filling."""


def displaced(form: str, shape: Shape) -> Generator:
    """Make a generator of displacements of one marker in the laboratory.

    Parameters
    ----------
    form : str
        Name of the shape.
    shape : Shape
        Draws the displacement.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        change = shape(site)
        start, m = site.place(len(change))
        stop = start + len(change)
        return Fault(form, (m,), start, stop, (site.positions[start:stop, m] + change)[:, None])

    return generate


def knocked(*, rigid: bool, settling: bool) -> Generator:
    """Make a generator of markers that are knocked to a new place on the body, 10-40 mm away.

    Parameters
    ----------
    rigid : bool
        Whether only markers on rigid segments are.
    settling : bool
        Whether the marker swings into its new place over 4-12 frames, instead of being there at once.

    Returns
    -------
    Generator
        The generator.
    """

    def onset(site: Site) -> np.ndarray:
        if not settling:
            return np.ones(1)
        length = int(site.rng.integers(4, 13))
        time = np.linspace(1 / length, 1.0, length)
        return np.asarray(1 - (1 - time) ** 4 * np.cos(3 * np.pi * time))

    return _lasting("settling" if settling else "at once", onset, size_mm=(10.0, 40.0), rigid=rigid)


def creeping(*, rigid: bool, stepwise: bool) -> Generator:
    """Make a generator of markers that creep to a new place on the body, 8-25 mm away, over 1-3 s.

    Parameters
    ----------
    rigid : bool
        Whether only markers on rigid segments do.
    stepwise : bool
        Whether they stick and slip in 3-6 steps of 2-8 frames, instead of moving evenly.

    Returns
    -------
    Generator
        The generator.
    """

    def onset(site: Site) -> np.ndarray:
        length = site.duration(1.0, 3.0)
        if not stepwise:
            return np.linspace(1 / length, 1.0, length)
        count = int(site.rng.integers(3, 7))
        centres, widths = site.rng.uniform(0, length, count), site.rng.uniform(2, 8, count)
        parts = 1 / (1 + np.exp(-4 * (np.arange(length)[:, None] - centres) / widths))
        shares = site.rng.dirichlet(np.full(count, 3.0))
        total: np.ndarray = parts @ shares
        return np.asarray(total / total[-1])

    return _lasting("stepwise" if stepwise else "evenly", onset, size_mm=(8.0, 25.0), rigid=rigid)


def sentinel(*, axes: int) -> Generator:
    """Make a generator of coordinates that hold the number 9999 for 1-30 frames.

    Parameters
    ----------
    axes : int
        How many coordinates do.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length = int(site.rng.integers(1, 31))
        start, m = site.place(length)
        samples = site.positions[start : start + length, m].copy()
        samples[:, site.rng.choice(3, axes, replace=False)] = SENTINEL
        return Fault(f"{axes} coordinates", (m,), start, start + length, samples[:, None])

    return generate


def still_ghost(low_mm: float, high_mm: float) -> Generator:
    """Make a generator of ghosts that stand still beside the path of a marker for 1-30 frames.

    Parameters
    ----------
    low_mm, high_mm : float
        Bounds of their distance from the marker when they appear, mm.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length = int(site.rng.integers(1, 31))
        start, m = site.place(length)
        spot = site.positions[start, m] + site.rng.uniform(low_mm, high_mm) * site.direction()
        samples = spot + site.rng.normal(0.0, 0.3, (length, 3))
        return Fault("standing still", (m,), start, start + length, samples[:, None])

    return generate


def filled_by_program(*, cubic: bool) -> Generator:
    """Make a generator of gaps of 0.15-0.6 s that a program filled, with an error of 5 mm or more.

    Parameters
    ----------
    cubic : bool
        Whether it filled them with the cubic that continues the velocities on either side, instead of a straight line.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        for _ in range(ATTEMPTS):
            length = site.duration(0.15, 0.6)
            start, m = site.place(length)
            path = site.positions[start - 2 : start + length + 2, m]
            time, ends = np.arange(length + 4), [1, length + 2]
            if cubic:
                samples = CubicHermiteSpline(ends, path[ends], [path[1] - path[0], path[-1] - path[-2]])(time)
            else:
                samples = path[1] + (time[:, None] - 1) / (length + 1) * (path[-2] - path[1])
            if np.linalg.norm(samples - path, axis=1)[2:-2].max() >= VISIBLE_MM:
                form = "cubic" if cubic else "straight line"
                return Fault(form, (m,), start, start + length, samples[2:-2, None])
        raise ValueError("the recording moves too little for a filling to be wrong")

    return generate


def _lasting(form: str, onset: Shape, *, size_mm: tuple[float, float], rigid: bool) -> Generator:
    """A generator of displacements fixed to the body: an onset (n,) from 0 to 1, then constant, mostly to the end."""

    def generate(site: Site) -> Fault:
        rise = onset(site)
        among = site.geometry.rigid(RIGID_MATES, RIGID_MM) if rigid else None
        to_end = site.rng.random() < 0.7
        longest = max(site.frames // 4, len(rise) + 1)
        length = int(site.rng.integers(longest, max(longest + 1, site.frames * 2 // 3)))
        start, m = site.place(length, among=among, at="stop" if to_end else "anywhere")
        size = np.concatenate([rise, np.ones(max(0, length - len(rise)))])[:length]
        change = size[:, None] * site.rng.uniform(*size_mm) * site.direction()
        samples = site.positions[start : start + length, m] + site.geometry.turned(change, m, start)
        name = f"{form}, {'to the end' if to_end else 'and back'}"
        return Fault(name, (m,), start, start + length, samples[:, None])

    return generate
