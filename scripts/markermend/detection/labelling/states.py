"""Under which label each marker is recorded, frame by frame, and the exchanges of labels that this states."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from markermend.core.events import Event


def labelling(
    exchanges: Iterable[Event], shape: tuple[int, ...], markers: Sequence[str]
) -> tuple[np.ndarray, np.ndarray]:
    """State exchanges of labels frame by frame.

    Parameters
    ----------
    exchanges : Iterable[Event]
        Exchanges with their partners.
    shape : tuple[int, ...]
        Numbers of frames and markers.
    markers : Sequence[str]
        Names of the markers.

    Returns
    -------
    under : np.ndarray
        Under which label each marker is recorded, int (frames, markers).
    score : np.ndarray
        The evidence in units of the threshold (frames, markers), 0 without an exchange.
    """
    under, score = np.tile(np.arange(shape[1]), (shape[0], 1)), np.zeros(shape)
    place = {marker: m for m, marker in enumerate(markers)}
    for event in exchanges:
        if event.partner is not None:
            under[event.start : event.stop, place[event.marker]] = place[event.partner]
            score[event.start : event.stop, place[event.marker]] = event.score
    return under, score


def exchange_events(under: np.ndarray, score: np.ndarray, markers: Sequence[str]) -> list[Event]:
    """List the exchanges of labels.

    Parameters
    ----------
    under : np.ndarray
        Under which label each marker is recorded, int (frames, markers), a permutation in each frame.
    score : np.ndarray
        The evidence in units of the threshold (frames, markers).
    markers : Sequence[str]
        Names of the markers.

    Returns
    -------
    list[Event]
        Sorted; one event for each marker of a cycle, over the frames in which the whole cycle lasts.
    """
    changes = np.flatnonzero((under[1:] != under[:-1]).any(axis=1)) + 1
    lasting: dict[tuple[int, ...], list[tuple[int, int]]] = {}
    for start, stop in pairwise([0, *changes.tolist(), len(under)]):
        for cycle in cycles(under[start]):
            spans = lasting.setdefault(cycle, [])
            if spans and spans[-1][1] == start:
                start_of, _ = spans.pop()
                spans.append((start_of, stop))
            else:
                spans.append((start, stop))
    found = []
    for cycle, spans in lasting.items():
        for start, stop in spans:
            evidence = max(1.0, float(score[start:stop, list(cycle)].max()))
            found += [
                Event(markers[m], start, stop, evidence, "xyz", markers[label])
                for m, label in zip(cycle, [*cycle[1:], cycle[0]], strict=True)
            ]
    return sorted(found, key=lambda event: event.order)


def cycles(permutation: np.ndarray) -> list[tuple[int, ...]]:
    """List the cycles of a permutation.

    Parameters
    ----------
    permutation : np.ndarray
        The image of each index (n,).

    Returns
    -------
    list[tuple[int, ...]]
        Those of two and more indices: each index with its image after it, the smallest first.
    """
    found, seen = [], np.zeros(len(permutation), bool)
    for start in np.flatnonzero(permutation != np.arange(len(permutation))).tolist():
        cycle = []
        while not seen[start]:
            seen[start] = True
            cycle.append(start)
            start = int(permutation[start])
        if cycle:
            found.append(tuple(cycle))
    return found
