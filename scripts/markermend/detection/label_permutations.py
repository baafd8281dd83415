"""Swapped labels of three and more markers: from one frame to the next, each stands where the next in the ring was.

As with pairs (see swaps), nothing is learned but distances: at the frame every marker of the ring goes on under another
label, and between such frames the distances to other markers tell which labels are right.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from markermend.prediction.scene import Scene

Ring = tuple[int, ...]
"""Marker indices, the lowest first: what was under each label goes on under the next, and at the end under the first."""


def turns(positions: np.ndarray, sudden: np.ndarray, *, ratio: float, floor_mm: float) -> list[tuple[int, Ring, float]]:
    """Frames at which labels change in rings of three or more, with the ring and a score in units of the threshold.

    positions: (frames, markers, 3), mm, NaN = missing. sudden: bool (frames, markers), where a marker's velocity
    breaks. ratio: what is left of the jumps once the ring is undone is at most this part of the least of them.
    floor_mm: each jump is at least so large.
    """
    found = []
    for t in np.flatnonzero(sudden.sum(axis=1) >= 3):
        who = np.flatnonzero(sudden[t] & ~np.isnan(positions[max(t - 2, 0) : t + 1]).any(axis=(0, 2)))
        if len(who) < 3 or t < 2:
            continue
        before, last = positions[t - 2 : t, who]
        # A marker goes on, or stays: where a swap lasts for a frame, what came before tells nothing of its velocity.
        far = np.minimum(*(_apart(expected, positions[t, who]) for expected in (2 * last - before, last)))
        for ring in _cycles(np.argmin(far, axis=1)):
            own = np.array(ring)
            least, left = far[own, own].min(), far[own, np.roll(own, -1)].max()
            if least >= floor_mm and left <= ratio * least:
                members = who[own].tolist()
                first = members.index(min(members))
                score = float(ratio * least / max(left, 1e-3 * least))
                found.append((int(t), tuple(members[first:] + members[:first]), score))
    return found


def _apart(some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Distances of points (n, 3) from others (m, 3): (n, m)."""
    far: np.ndarray = np.linalg.norm(some[:, None] - others, axis=2)
    return far


def _cycles(following: np.ndarray) -> list[list[int]]:
    """The cycles of at least three of a map from indices to indices, each told once."""
    found, seen = [], np.zeros(len(following), bool)
    for start in range(len(following)):
        path = [start]
        while not seen[path[-1]] and following[path[-1]] not in path:
            path.append(int(following[path[-1]]))
        closing = int(following[path[-1]])
        cycle = path[path.index(closing) :] if closing in path and not seen[path].any() else []
        seen[path] = True
        if len(cycle) >= 3:
            found.append(cycle)
    return found


def vote(scene: Scene, members: np.ndarray, under: np.ndarray, start: int, stop: int, *, near: int) -> float:
    """How clearly the distances to other markers say that the members are under the labels `under`, from -1 to 1.

    members, under: (k,), marker indices, the same set. The others are the `near` first neighbours of each; distances
    over [start, stop) are compared with their medians over the recording, steady ones counting most.
    """
    around = dict.fromkeys(n for m in members for n in np.asarray(scene.neighbours[m], int)[:near].tolist())
    others = np.array([n for n in around if n not in members], int)

    def distances(who: np.ndarray, rows: slice) -> np.ndarray:
        apart: np.ndarray = np.linalg.norm(
            scene.positions[rows, who, None] - scene.positions[rows, None, others], axis=3
        )
        return apart

    everything = distances(members, slice(None))
    known = ~np.isnan(everything).all(axis=0)
    low, usual, high = np.full((3, *known.shape), np.nan)
    low[known], usual[known], high[known] = np.nanpercentile(everything[:, known], [16, 50, 84], axis=0)
    weight, rows = 1 / (1 + (high - low) ** 2), slice(start, stop)
    labelled, moved = (np.nansum(weight * (distances(who, rows) - usual) ** 2) for who in (members, under))
    return float((labelled - moved) / max(labelled + moved, 1e-9))


def swapped(
    scene: Scene, sudden: np.ndarray, *, ratio: float, floor_mm: float, near: int, trust: float
) -> list[tuple[int, int, dict[int, int], float]]:
    """The intervals over which labels are swapped in a ring: start, stop, the label that each member is under, score.

    scene: positions (frames, markers, 3), mm, NaN = missing. sudden, ratio, floor_mm: see turns. near: see vote, which
    must be at least the trust. Of all pieces between the turns, the one whose labels are right is that which makes the
    votes of the others largest.
    """
    together: dict[Ring, list[tuple[int, Ring, float]]] = {}
    for turn in turns(scene.positions, sudden, ratio=ratio, floor_mm=floor_mm):
        together.setdefault(tuple(sorted(turn[1])), []).append(turn)
    found = []
    for ring, own in together.items():
        members = np.array(ring)
        pieces = list(itertools.pairwise([0, *(t for t, _, _ in own), len(scene.positions)]))
        best: list[tuple[np.ndarray, float]] = []
        for labels in _arrangements(ring, [turn for _, turn, _ in own]):
            votes = [
                vote(scene, members, under, *piece, near=near) if (under != members).any() else 0.0
                for under, piece in zip(labels, pieces, strict=True)
            ]
            told = list(zip(labels, votes, strict=True))
            if not best or _weight(told, pieces) > _weight(best, pieces):
                best = told
        for (start, stop), (under, clearness) in zip(pieces, best, strict=True):
            if clearness >= trust:
                score = min(score for t, _, score in own if t in (start, stop))
                found.append((start, stop, dict(zip(ring, under.tolist(), strict=True)), score))
    return found


def _arrangements(ring: Ring, turned: Sequence[Ring]) -> list[list[np.ndarray]]:
    """For each piece between turns, if its labels are right: the labels that the ring's members are under in each piece."""
    labels = [dict(zip(ring, ring, strict=True))]
    for turn in turned:
        onward = dict(zip(turn, turn[1:] + turn[:1], strict=True))
        labels.append({member: onward[label] for member, label in labels[-1].items()})
    out = []
    for right in labels:
        who = {label: member for member, label in right.items()}
        out.append([np.array([own[who[member]] for member in ring]) for own in labels])
    return out


def _weight(told: Sequence[tuple[np.ndarray, float]], pieces: Sequence[tuple[int, int]]) -> float:
    """Sum of votes over all frames; where it is equal, fewer frames should be swapped."""
    frames = [stop - start for start, stop in pieces]
    return sum(n * clearness for n, (_, clearness) in zip(frames, told, strict=True))
