"""Faults of labels: a label on what is not its marker, on a reflection, on another marker, or on a marker on the floor."""

from __future__ import annotations

import numpy as np

from markermend.simulation.exchanged_labels import rings
from markermend.simulation.fault_site import Site
from markermend.simulation.faults import Fault, Generator

GRAVITY = 9810.0
"""In mm/s^2."""

GAP_S = (0.03, 0.3)
"""Bounds of the duration of a gap beside a foreign stretch, s."""

GHOST_MM = (300.0, 1500.0)
"""Bounds of the distance of a reflection from its marker, mm."""


def still_reflection(*, unsteady: bool) -> Generator:
    """Make a generator of labels on a still reflection for 0.3-3 s between two gaps.

    Parameters
    ----------
    unsteady : bool
        Whether the reflection drifts by some millimetres and is not seen in every frame.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        before, after, length = site.duration(*GAP_S), site.duration(*GAP_S), site.duration(0.3, 3.0)
        start, m = site.place(before + length + after)
        spot = site.positions[start + before + length // 2, m] + site.rng.uniform(*GHOST_MM) * site.direction()
        samples = spot + site.rng.normal(0.0, 0.4 if unsteady else 0.15, (before + length + after, 3))
        if unsteady:
            samples += np.linspace(-0.5, 0.5, len(samples))[:, None] * site.rng.uniform(0.0, 5.0) * site.direction()
            samples[before:-after][site.rng.random(length) < 0.03] = np.nan
        samples[:before] = samples[-after:] = np.nan
        form = "unsteady" if unsteady else "steady"
        return Fault(form, (m,), start, start + len(samples), samples[:, None])

    return generate


def on_another_marker(*, gaps: bool) -> Generator:
    """Make a generator of labels on the trajectory of another marker, which has no label meanwhile, for 0.2-2 s.

    Parameters
    ----------
    gaps : bool
        Whether the label's own marker is lost before and after, for different times, instead of changing at once.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length = site.duration(0.2, 2.0)
        start, (own, other) = site.place_group(rings(site, 2), length)
        samples = np.full((length, 2, 3), np.nan)
        samples[:, 0] = site.positions[start : start + length, other]
        if gaps:
            before, after = (min(site.duration(*GAP_S), length // 3) for _ in range(2))
            samples[:before] = np.nan
            samples[length - after :] = np.nan
        return Fault("with gaps" if gaps else "at once", (own, other), start, start + length, samples)

    return generate


def on_one_spot(*, noise_mm: float) -> Generator:
    """Make a generator of two labels on one marker for 0.1-1 s.

    Parameters
    ----------
    noise_mm : float
        Standard deviation of what they differ by along each axis, mm.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length = site.duration(0.1, 1.0)
        start, (own, other) = site.place_group(rings(site, 2), length)
        samples = site.positions[start : start + length, other] + site.rng.normal(0.0, 1.0, (length, 3)) * noise_mm
        return Fault("nearly" if noise_mm else "exactly", (own,), start, start + length, samples[:, None])

    return generate


def fallen(*, unseen: bool) -> Generator:
    """Make a generator of markers that fall off and lie on the floor to the end.

    Parameters
    ----------
    unseen : bool
        Whether the fall itself is a gap, after which the marker lies up to 500 mm aside and rolls to a halt.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length = int(site.rng.uniform(0.2, 0.7) * site.frames)
        start, m = site.place(length, at="stop")
        samples = np.repeat(site.positions[start : start + 1, m], length, axis=0)
        time, height = np.arange(length) / site.rate, samples[0, site.geometry.vertical] - site.geometry.floor
        aside = site.direction() * (500.0 if unseen else 100.0)
        aside[site.geometry.vertical] = 0.0
        down = np.sqrt(2 * max(height, 0.0) / GRAVITY)
        rolling = np.clip((time - down) / 0.5, 0.0, 1.0)
        along = 1 - (1 - rolling) ** 2 if unseen else np.minimum(time / max(down, 1 / site.rate), 1.0)
        samples += along[:, None] * aside
        samples[:, site.geometry.vertical] -= np.minimum(GRAVITY / 2 * time**2, max(height, 0.0))
        samples += site.rng.normal(0.0, 0.1, samples.shape)
        if unseen:
            samples[time < down] = np.nan
        return Fault("unseen" if unseen else "seen", (m,), start, start + length, samples[:, None])

    return generate
