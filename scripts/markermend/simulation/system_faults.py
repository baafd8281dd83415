"""Faults of the whole system or of several markers at once: repeated frames, a camera that is hit, segments that slip."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.simulation.fault_site import Site
from markermend.simulation.faults import Fault, Generator

SEGMENT_MM = 5.0
"""Markers of one segment keep their distances within this standard deviation, mm."""

SEGMENT_MARKERS = (3, 8)
"""Fewest and most markers that slip together."""


def repeated_frames(*, alternate: bool) -> Generator:
    """Make a generator of frames that all markers repeat.

    Parameters
    ----------
    alternate : bool
        Whether every second frame of 0.2-1 s repeats the one before it, instead of one frame being held for 2-20.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length = 2 * site.duration(0.1, 0.5) if alternate else int(site.rng.integers(2, 21))
        start = site.place_all(length)
        source = start + np.arange(length) // 2 * 2 if alternate else np.full(length, start - 1)
        true, repeated = site.positions[start : start + length], site.positions[source]
        samples = np.where(np.isnan(repeated), true, np.where(np.isnan(true), true, repeated))
        form = "every second frame" if alternate else "held"
        return _of_all(site, form, start, samples)

    return generate


def camera_hit(*, turned: bool) -> Generator:
    """Make a generator of jumps of all markers, for 0.1-1 s or to the end of the recording.

    Parameters
    ----------
    turned : bool
        Whether the scene turns by 0.3-1.5 degrees about its middle, too, and rings for some frames, instead of only moving
        by 5-30 mm.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        to_end = site.rng.random() < 0.4
        length = int(site.rng.uniform(0.15, 0.45) * site.frames) if to_end else site.duration(0.1, 1.0)
        start = site.place_all(length, at="stop" if to_end else "anywhere")
        true = site.positions[start : start + length]
        moved = true + site.rng.uniform(5.0, 30.0) * site.direction()
        if turned:
            middle = np.nanmean(site.positions, axis=(0, 1))
            angle = np.radians(site.rng.uniform(0.3, 1.5))
            moved = (moved - middle) @ Rotation.from_rotvec(angle * site.direction()).as_matrix().T + middle
            time = np.arange(length)
            ringing = 1 + 0.4 * np.exp(-time / 2) * np.cos(np.pi * time)
            moved = true + ringing[:, None, None] * (moved - true)
        form = f"{'turned' if turned else 'moved'}, {'to the end' if to_end else 'for a time'}"
        return _of_all(site, form, start, moved)

    return generate


def segment_slip(*, rounded: bool) -> Generator:
    """Make a generator of markers of a segment that are displaced together, by 10-30 mm for 2-6 frames.

    Parameters
    ----------
    rounded : bool
        Whether they leave and return gradually and turn by up to 5 degrees, instead of moving alike at once.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length = int(site.rng.integers(2, 7))
        groups = [group for m in range(len(site.markers)) if (group := _segment(site, m))]
        start, group = site.place_group(groups, length)
        size = np.sin(np.pi * (np.arange(length) + 1) / (length + 1)) if rounded else np.ones(length)
        true = site.positions[start : start + length, group]
        change = np.broadcast_to(site.rng.uniform(10.0, 30.0) * site.direction(), true.shape)
        if rounded:
            around = true - true.mean(axis=1, keepdims=True)
            turn = Rotation.from_rotvec(np.radians(site.rng.uniform(0.0, 5.0)) * site.direction()).as_matrix()
            change = change + around @ turn.T - around
            size = size / size.max()
        form = "rounded" if rounded else "at once"
        return Fault(form, tuple(group), start, start + length, true + size[:, None, None] * change)

    return generate


def _segment(site: Site, marker: int) -> list[int]:
    """A marker and those that keep their distance to it best, no more than slip together; empty where there are too few."""
    steady = [int(m) for m in site.geometry.steadiest(marker) if site.geometry.deviations[marker, m] < SEGMENT_MM]
    fewest, most = SEGMENT_MARKERS
    return [marker, *steady[: most - 1]] if len(steady) >= fewest - 1 else []


def _of_all(site: Site, form: str, start: int, samples: np.ndarray) -> Fault:
    """A fault of all markers."""
    return Fault(form, tuple(range(len(site.markers))), start, start + len(samples), samples)
