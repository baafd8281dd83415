"""Exchanges of labels in cycles by brute force: all orders of all sets of markers."""

from itertools import combinations, pairwise, permutations

import numpy as np


def cycle_changes(positions, sudden, *, ratio, floor_mm):
    """Frames at which markers go on under the next label of a cycle, each sample at its nearest continuation."""
    found = []
    for t in range(2, len(positions)):
        who = [m for m in range(positions.shape[1]) if sudden[t, m] and np.isfinite(positions[t - 2 : t + 1, m]).all()]

        def gap(m, label, t=t):
            """How far the continuation of a marker, moving on or staying, is from the sample under a label."""
            ahead = 2 * positions[t - 1, m] - positions[t - 2, m]
            return min(np.linalg.norm(start - positions[t, label]) for start in (ahead, positions[t - 1, m]))

        for size in range(3, len(who) + 1):
            for chosen in combinations(who, size):
                for rest in permutations(chosen[1:]):
                    cycle = (chosen[0], *rest)
                    steps = [*pairwise(cycle), (cycle[-1], cycle[0])]
                    nearest = all(gap(m, label) == min(gap(m, other) for other in who) for m, label in steps)
                    jump = min(gap(m, m) for m in cycle)
                    remaining = max(gap(m, label) for m, label in steps)
                    if nearest and jump >= floor_mm and remaining <= ratio * jump:
                        found.append((t, cycle))
    return found


def labels_after(markers, cycles):
    """Under which label each marker is after each change, by moving names between slots one at a time."""
    slots = {label: label for label in markers}  # label: marker
    out = [tuple({m: label for label, m in slots.items()}[m] for m in markers)]
    for cycle in cycles:
        moved = dict(slots)
        for label, onward in [*pairwise(cycle), (cycle[-1], cycle[0])]:
            moved[onward] = slots[label]
        slots = moved
        out.append(tuple({m: label for label, m in slots.items()}[m] for m in markers))
    return out


def clearness(positions, markers, labels, others, start, stop):
    """How much better distances to others fit their medians with the labels than without, from -1 to 1."""
    recorded = exchanged = 0.0
    for m, label in zip(markers, labels, strict=True):
        for other in others:
            distance = [np.linalg.norm(a - b) for a, b in zip(positions[:, m], positions[:, other], strict=True)]
            known = [value for value in distance if value == value]
            low, usual, high = np.percentile(known, [16, 50, 84])
            weight = 1 / (1 + (high - low) ** 2)
            for frame in range(start, stop):
                own = np.linalg.norm(positions[frame, m] - positions[frame, other])
                its = np.linalg.norm(positions[frame, label] - positions[frame, other])
                recorded += weight * (own - usual) ** 2 if own == own else 0.0
                exchanged += weight * (its - usual) ** 2 if its == its else 0.0
    return (recorded - exchanged) / max(recorded + exchanged, 1e-9)
