"""Faults of labels: markers of one subject under each other's labels, from one frame to the next or across gaps that they share."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations

import numpy as np

from markermend.simulation.fault_site import Site
from markermend.simulation.faults import Fault, Generator

NEAR_MM = 400.0
"""Labels of markers nearer to each other than this are exchanged."""

LIMB = (4, 8)
"""Fewest and most markers of a limb that are exchanged with those of the other side."""

LIMB_MM = 800.0
"""Markers of one limb are nearer to its end than this."""

GAP_S = (0.04, 0.4)
"""Bounds of the duration of a gap at an exchange, s."""


def from_frame_to_frame(*, markers: int) -> Generator:
    """Make a generator of exchanges for 1-300 frames, from one frame to the next.

    Parameters
    ----------
    markers : int
        How many markers change places in a ring.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        longest = min(300, site.frames // 3)
        length = round(float(np.exp(site.rng.uniform(0.0, np.log(longest)))))
        start, ring = site.place_group(rings(site, markers), length)
        none, end = np.zeros((markers, 2), int), np.full((markers, 2), length)
        return relabelled(site, f"ring of {markers}", np.roll(ring, -1), ring, start, (none, end))

    return generate


def across_gap(*, markers: int, staggered: bool, until: str) -> Generator:
    """Make a generator of exchanges that begin in a gap that the markers share.

    Parameters
    ----------
    markers : int
        How many markers change places in a ring.
    staggered : bool
        Whether they are lost and seen again at different moments.
    until : str
        "next gap", "later gap" (they share another gap before), or "end" of the recording, after more than half of it.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        first, again = _losses(site, markers, staggered), _losses(site, markers, staggered)
        if until == "end":
            length = int(site.rng.uniform(0.3, 0.85) * site.frames)
            again = np.full((markers, 2), length)
        else:
            length = first.max() + site.duration(0.3, 2.0) + again.max()
            again += length - again.max()
        start, ring = site.place_group(rings(site, markers), length, at="stop" if until == "end" else "anywhere")
        form = f"ring of {markers}, {'staggered, ' if staggered else ''}until {until}"
        fault = relabelled(site, form, np.roll(ring, -1), ring, start, (first, again))
        if until == "later gap":
            seen, lost = int(first.max()), int(again.min())
            middle = seen + max(1, round((lost - seen) * site.rng.uniform(0.2, 0.6)))
            fault.samples[middle : min(middle + site.duration(*GAP_S), lost - 1)] = np.nan
        return fault

    return generate


def limbs(*, across_gaps: bool) -> Generator:
    """Make a generator of exchanges of whole limbs left and right, for 0.3-3 s.

    Parameters
    ----------
    across_gaps : bool
        Whether all of their markers are missing for up to 0.4 s before, and after or to the end of the recording.

    Returns
    -------
    Generator
        The generator.
    """

    def generate(site: Site) -> Fault:
        length, to_end = site.duration(0.3, 3.0), across_gaps and site.rng.random() < 0.5
        groups = [pairs for pairs in (_limb(site, pair) for pair in site.geometry.sides) if len(pairs) >= LIMB[0]]
        flat = [[m for pair in pairs for m in pair] for pairs in groups]
        start, chosen = site.place_group(flat, length, at="stop" if to_end else "anywhere")
        partners = np.reshape(chosen, (-1, 2))[:, ::-1].ravel()
        first, again = np.zeros((len(chosen), 2), int), np.full((len(chosen), 2), length)
        if across_gaps:
            first[:, 1] = min(site.duration(*GAP_S), length // 3)
            again[:, 0] -= 0 if to_end else min(site.duration(*GAP_S), length // 3)
        form = "from frame to frame" if not across_gaps else "to the end" if to_end else "across gaps"
        return relabelled(site, form, partners, chosen, start, (first, again))

    return generate


def relabelled(
    site: Site,
    form: str,
    labels: Sequence[int] | np.ndarray,
    markers: Sequence[int] | np.ndarray,
    start: int,
    losses: tuple[np.ndarray, np.ndarray],
) -> Fault:
    """Show markers under other labels between two losses.

    Parameters
    ----------
    site : Site
        The recording.
    form : str
        See Fault.
    labels : sequence of int
        For each marker that whose label it gets.
    markers : sequence of int
        The markers.
    start : int
        First row of the fault.
    losses : tuple of ndarray of int, shape (markers, 2)
        When each marker is not seen, relative to `start`: half-open intervals, after the first of which it has the other
        label, and after the second its own. The first ones overlap, and so do the second ones.

    Returns
    -------
    Fault
        The fault, up to the end of the last loss.
    """
    lost, lost_again = losses
    order, length = [int(m) for m in markers], int(lost_again.max())
    samples = np.full((length, len(order), 3), np.nan)
    for k, m in enumerate(order):
        path, label = site.positions[start : start + length, m], order.index(int(labels[k]))
        samples[: lost[k, 0], k] = path[: lost[k, 0]]
        samples[lost_again[k, 1] :, k] = path[lost_again[k, 1] :]
        samples[lost[k, 1] : lost_again[k, 0], label] = path[lost[k, 1] : lost_again[k, 0]]
    return Fault(form, tuple(order), start, start + length, samples, tuple(int(label) for label in labels))


def rings(site: Site, markers: int) -> list[tuple[int, ...]]:
    """List rings of markers that are near to each other.

    Parameters
    ----------
    site : Site
        The recording.
    markers : int
        Markers in a ring.

    Returns
    -------
    list of tuple of int
        For each marker some rings that begin with it.
    """
    found = []
    for m in range(len(site.markers)):
        near = np.flatnonzero((site.geometry.distances[m] < NEAR_MM) & (np.arange(len(site.markers)) != m))
        near = site.rng.permutation(near)[:4].tolist()
        found += [(m, *others) for others in permutations(near, markers - 1)]
    return found


def _losses(site: Site, markers: int, staggered: bool) -> np.ndarray:
    """Half-open intervals (markers, 2) from 0 on in which each marker is lost; all of them overlap."""
    gap = site.duration(*GAP_S) + 1
    first, last = np.zeros(markers, int), np.full(markers, gap)
    if staggered:
        first, last = site.rng.integers(0, gap, markers), gap + site.rng.integers(0, gap, markers)
        first -= first.min()
    return np.stack([first, last], axis=1)


def _limb(site: Site, end: tuple[int, int]) -> list[tuple[int, int]]:
    """Left and right markers of the limb of which a pair is the end: those that keep their distance to it best."""
    left, right = end
    near = [pair for pair in site.geometry.sides if site.geometry.distances[left, pair[0]] < LIMB_MM or pair == end]
    cost = [
        site.geometry.deviations[left, a] + site.geometry.deviations[right, b] + 0.05 * site.geometry.distances[left, a]
        for a, b in near
    ]
    order = np.argsort(np.where([pair == end for pair in near], 0.0, np.nan_to_num(cost, nan=np.inf)), kind="stable")
    return [near[k] for k in order[: int(site.rng.integers(LIMB[0], LIMB[1] + 1))]]
