"""Faults of measurement in copies of clean recordings: what the file shows instead of the truth."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.simulation.fault_site import Site


@dataclass(frozen=True, eq=False)
class Fault:
    """One fault.

    Attributes
    ----------
    form : str
        In which form of its kind it was drawn.
    markers : tuple of int
        The markers that it alters.
    start, stop : int
        Half-open interval of rows.
    samples : ndarray of float, shape (stop - start, markers, 3)
        What the file shows in mm; NaN where a marker is missing.
    partners : tuple of int
        Where labels are exchanged: for each marker that under whose label its samples are.
    kind : str
        Name of its kind.
    """

    form: str
    markers: tuple[int, ...]
    start: int
    stop: int
    samples: np.ndarray
    partners: tuple[int, ...] = ()
    kind: str = ""


Generator = Callable[[Site], Fault]
"""Draws a fault where there is room for it; raises ValueError where there is none."""


@dataclass(frozen=True, eq=False)
class FaultyCopy:
    """A copy of a recording with faults.

    Attributes
    ----------
    clean, positions : ndarray of float, shape (frames, markers, 3)
        The truth and what the copy shows, mm; NaN = missing.
    faults : tuple of Fault
        The faults, no two of which share a marker at a time.
    """

    clean: np.ndarray
    positions: np.ndarray
    faults: tuple[Fault, ...]

    def damaged(self, fault: Fault) -> np.ndarray:
        """Find the samples that a fault made wrong.

        Parameters
        ----------
        fault : Fault
            One of the copy's faults.

        Returns
        -------
        ndarray of bool, shape (frames, markers)
            True where the copy shows a position that is not the true one.
        """
        out = np.zeros(self.clean.shape[:2], bool)
        true = self.clean[fault.start : fault.stop, list(fault.markers)]
        seen = ~np.isnan(fault.samples).any(axis=2)
        out[fault.start : fault.stop, list(fault.markers)] = seen & (fault.samples != true).any(axis=2)
        return out


def contaminate(site: Site, generators: Mapping[str, Sequence[Generator]], *, count: int) -> FaultyCopy:
    """Put faults of some kinds into a copy of a recording.

    Parameters
    ----------
    site : Site
        The recording; the stretches of the faults are taken from it.
    generators : mapping of str to sequence of Generator
        For each kind what draws its faults, in turn.
    count : int
        How many of each kind; fewer where there is no room for more.

    Returns
    -------
    FaultyCopy
        The copy and its faults.
    """
    positions, faults = site.positions.copy(), []
    drawn = [(kind, forms[number % len(forms)]) for number in range(count) for kind, forms in generators.items()]
    for kind, generate in drawn:
        try:
            fault = replace(generate(site), kind=kind)
        except ValueError:
            continue
        positions[fault.start : fault.stop, list(fault.markers)] = fault.samples
        site.take(fault.markers, fault.start, fault.stop)
        faults.append(fault)
    return FaultyCopy(site.positions, positions, tuple(faults))
