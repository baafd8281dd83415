"""Exchanges of labels of which nothing says which part of the recording is right.

A marker is nearer to some markers than its counterpart is, and the counterpart nearer to others. Where that is the other way round
in about half of a recording, the two were exchanged at some time; which of the two states is right no shape can say that was
learnt from them both. Markers that are exchanged together keep their distances to each other. The same holds for exchanges of any
markers that the usual distances would explain, but that last about as long as the labels as recorded.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from markermend.core.events import Event
from markermend.core.labels import undo_exchanges
from markermend.detection.labelling.groups import counterparts_by_side, counterparts_by_subject
from markermend.numerics import graphs
from markermend.numerics.intervals import runs
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.scene import Scene


def open_exchanges(
    scene: Scene, found: Sequence[Event], *, markers: Sequence[str], options: LabelsOptions
) -> list[str]:
    """Warn of markers whose labels may have been exchanged in about half of a recording.

    Parameters
    ----------
    scene : Scene
        What is observed.
    found : Sequence[Event]
        The exchanges that were found; what they explain is not open.
    markers : Sequence[str]
        Names of the markers.
    options : LabelsOptions
        How clear the distances must be.

    Returns
    -------
    list[str]
        A sentence for each stretch, with the names of the markers.
    """
    positions = undo_exchanges(scene.positions, [event for event in found if event.partner], markers)
    warnings = []
    for counterpart in (counterparts_by_side(markers), counterparts_by_subject(markers)):
        for pairs, relations, against in _turning_groups(positions, counterpart, options):
            names = ", ".join(f"{markers[a]} and {markers[b]}" for a, b in pairs)
            if against:
                names = f"{names} or else {', '.join(markers[m] for m in against)}"
            warnings += [
                f"{names} may be exchanged {_when(start, stop, scene)}: nothing says which of the two is right"
                for start, stop in _rarer_state(_differences(positions, relations))
            ]
    return list(dict.fromkeys(warnings))


def undecided_exchanges(undecided: Sequence[Event], *, warned: Sequence[str], scene: Scene) -> list[str]:
    """Warn of exchanges that the usual shape would explain, if it were known which part of the recording is right.

    Parameters
    ----------
    undecided : Sequence[Event]
        The exchanges.
    warned : Sequence[str]
        Other warnings: exchanges of markers that they name are not repeated.
    scene : Scene
        What is observed.

    Returns
    -------
    list[str]
        A sentence for each stretch, with the names of the markers.
    """
    named = {word for text in warned for word in re.split(r"[ ,]+", text)}
    together: dict[tuple[int, int], list[str]] = {}
    for event in undecided:
        together.setdefault((event.start, event.stop), []).append(event.marker)
    return [
        f"{', '.join(own[:-1])} and {own[-1]} may be exchanged {_when(start, stop, scene)}: nothing says which part is right"
        for (start, stop), own in sorted(together.items())
        if len(own) > 1 and named.isdisjoint(own)
    ]


def without_open(found: Sequence[Event], sudden: Sequence[Event], observed: np.ndarray, limit: float) -> list[Event]:
    """Leave out the exchanges by level that last about as long as the labels as recorded.

    Parameters
    ----------
    found : Sequence[Event]
        All exchanges.
    sudden : Sequence[Event]
        Those that were seen from one frame to the next, which have evidence of their own.
    observed : np.ndarray
        In which frames any marker is observed, bool (frames,).
    limit : float
        Largest share of these that may be exchanged.

    Returns
    -------
    list[Event]
        The others.
    """
    share, seen = _shares(found, observed), {event.markers for event in sudden}
    return [event for event in found if event.markers in seen or share[event.markers] <= limit]


def long_exchanges(found: Sequence[Event], *, scene: Scene, limit: float) -> list[str]:
    """Warn of exchanges that are undone although they last about as long as the labels as recorded.

    Parameters
    ----------
    found : Sequence[Event]
        The findings.
    scene : Scene
        What is observed.
    limit : float
        Share of the recording from which they do, if its usual shape is known from it alone.

    Returns
    -------
    list[str]
        A sentence for each stretch, with the names of the markers.
    """
    exchanges = [event for event in found if event.partner]
    share = _shares(exchanges, np.asarray(scene.present.any(axis=1)))
    together: dict[tuple[int, int], list[str]] = {}
    for event in exchanges:
        if share[event.markers] > limit and scene.shape is not None and scene.shape.recordings == 1:
            together.setdefault((event.start, event.stop), []).append(event.marker)
    return [
        f"{', '.join(own[:-1])} and {own[-1]} are exchanged {_when(start, stop, scene)}, or else in the rest of the recording: "
        "the labels there are taken for the right ones"
        for (start, stop), own in sorted(together.items())
    ]


def _shares(exchanges: Sequence[Event], observed: np.ndarray) -> dict[tuple[str, ...], float]:
    """For how large a share of the frames in which any marker is observed, bool (frames,), each two labels are exchanged."""
    frames: dict[tuple[str, ...], int] = {}
    for event in exchanges:
        frames[event.markers] = frames.get(event.markers, 0) + int(np.count_nonzero(observed[event.start : event.stop]))
    usable = max(1, int(np.count_nonzero(observed)))
    return {markers: count / usable for markers, count in frames.items()}


def _turning_groups(
    positions: np.ndarray, counterpart: Mapping[int, int], options: LabelsOptions
) -> Iterator[tuple[list[tuple[int, int]], np.ndarray, list[int]]]:
    """Pairs that are exchanged together in a part of the time, and the (pair, anchor) triples (n, 3) that show it.

    Last come the other markers of these triples, if it may be them that are exchanged.
    """
    every = np.arange(positions.shape[1])
    pairs = [(m, other) for m, other in sorted(counterpart.items()) if m < other]
    triples = np.array([(a, b, c) for a, b in pairs for c in every.tolist() if c not in (a, b)], int).reshape(-1, 3)
    step = max(1, len(positions) // options.open_frames)
    turning, steady = _states(positions[step // 2 :: step], triples, options)
    if not turning.any():
        return
    node = np.array([min(m, counterpart.get(m, m)) for m in every.tolist()])
    ends = node[triples[steady, 0]], node[triples[steady, 2]]
    joined = list(zip(ends[0].tolist(), ends[1].tolist(), strict=True))
    group = graphs.components(graphs.adjacency(joined, len(every)))[node]
    ends = group[triples[:, 0]], group[triples[:, 2]]
    largest = np.bincount(group).argmax()
    while True:
        # The group that turns against most is exchanged rather than those that it turns against.
        against = np.bincount(
            np.concatenate([end[turning & (ends[0] != ends[1])] for end in ends]), minlength=group.max() + 1
        )
        against[largest] = 0
        own = against.argmax()
        if against[own] < options.shape.min_anchors:
            return
        shown = turning & ((ends[0] == own) != (ends[1] == own))
        members = [pair for pair in pairs if group[pair[0]] == own]
        others = np.unique(triples[shown])
        if members:
            small = largest not in group[others]
            yield members, triples[shown], others[group[others] != own].tolist() if small else []
        turning = turning & ~shown


def _states(positions: np.ndarray, triples: np.ndarray, options: LabelsOptions) -> tuple[np.ndarray, np.ndarray]:
    """Which anchors of (pair, anchor) triples are nearer to now the one, now the other of a pair, and which always to the same."""
    difference = _differences(positions, triples)
    count = (~np.isnan(difference)).sum(axis=0)
    size, spread = _moments(np.abs(difference), count)
    _, spread_of_sum = _moments(_differences(positions, triples, sign=1), count)
    clear = (size >= options.min_open_mm) & (np.maximum(spread, spread_of_sum) <= options.max_open_spread * size)
    clear &= 2 * count >= len(positions)
    positive = (np.nan_to_num(difference) > 0).sum(axis=0) / np.maximum(count, 1)
    rarer = np.minimum(positive, 1 - positive)
    return clear & (rarer >= options.min_open_share), clear & (rarer < options.min_open_share)


def _rarer_state(difference: np.ndarray) -> list[tuple[int, int]]:
    """The stretches of frames in the rarer of two states, by differences that change their sign together (frames, n)."""
    known = np.flatnonzero(~np.isnan(difference).all(axis=1))
    most_known = np.argmax((~np.isnan(difference)).sum(axis=1))
    sign = np.nan_to_num(np.sign(difference[known]) * np.sign(difference[most_known]))
    exchanged = sign.sum(axis=1) < 0
    if 2 * np.count_nonzero(exchanged) > len(exchanged):
        exchanged = ~exchanged
    ends = np.concatenate([[0], known[1:], [len(difference)]])
    return [(int(ends[start]), int(ends[stop])) for start, stop in runs(exchanged)]


def _differences(positions: np.ndarray, triples: np.ndarray, *, sign: int = -1) -> np.ndarray:
    """Distance of the first marker of each triple to the third, plus sign times that of the second (frames, n), mm."""
    first, second = (np.linalg.norm(positions[:, triples[:, k]] - positions[:, triples[:, 2]], axis=2) for k in (0, 1))
    difference: np.ndarray = first + sign * second
    return difference


def _moments(values: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Means and standard deviations over the first axis of what is known."""
    mean = np.nansum(values, axis=0) / np.maximum(count, 1)
    return mean, np.sqrt(np.nansum((values - mean) ** 2, axis=0) / np.maximum(count, 1))


def _when(start: int, stop: int, scene: Scene) -> str:
    """A stretch in words."""
    first, last = (f"{frame / scene.rate:.1f} s (frame {frame})" for frame in (start, stop))
    if stop == len(scene.positions):
        return f"from {first} to the end"
    return f"from {first} to {last}" if start else f"up to {last}"
