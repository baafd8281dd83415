"""Naive twins of markermend.detection."""

import numpy as np


def derivative_pairs(change, at, shortest, longest, ratio):
    """Opposite changes taken nearest first, each once, nothing across a gap or another pair."""
    candidates = []
    for i, first in enumerate(at):
        for j in range(i + 1, len(at)):
            second = at[j]
            balance = abs(change[first] / change[second])
            if (
                shortest <= second - first <= longest
                and change[first] * change[second] < 0
                and ratio <= balance <= 1 / ratio
                and not np.isnan(change[first : second + 1]).any()
            ):
                candidates.append((second - first, first, i, j))
    pairs, used = [], set()
    for length, first, i, j in sorted(candidates):
        if not used & set(range(i, j + 1)):
            used |= set(range(i, j + 1))
            pairs.append((first, first + length))
    return sorted(pairs), [n for k, n in enumerate(at) if k not in used]


def thresholds(changes, over, scale, sigmas, floor):
    """The threshold of each coordinate, from the valid changes of all coordinates that share it, one by one."""
    out = np.zeros(changes.shape[1:])
    for m in range(changes.shape[1]):
        for axis in range(changes.shape[2]):
            pooled = [
                changes[n, other, of]
                for n in range(len(changes))
                for other in range(changes.shape[1])
                for of in range(changes.shape[2])
                if not np.isnan(changes[n, other, of])
                and (over == "recording" or (other == m and (over == "marker" or of == axis)))
            ]
            if scale == "mad":
                sigma = 1.4826 * np.median([abs(value - np.median(pooled)) for value in pooled])
            else:
                sigma = np.sqrt(sum((value - np.mean(pooled)) ** 2 for value in pooled) / len(pooled))
            out[m, axis] = max(sigmas * sigma, floor)
    return out


def peaks(change, level, longest, window, ratio, localisation, *, joined):
    """Samples of isolated peaks: sums, closing if joined, and opening over one window at a time, then the two ends of each peak."""
    n, half = len(change), window // 2
    sudden = [value if abs(value) > level else 0.0 for value in change]
    candidate = []
    for k in range(n):
        around = sudden[max(0, k - half) : k + half + 1]
        total, size = sum(around), sum(abs(value) for value in around)
        candidate.append(size > 0 and size > ratio * abs(total))

    def widened(values, best):
        return [best(values[max(0, k - half) : k + half + 1]) for k in range(n)]

    closed = widened(widened(candidate, max), min) if joined else candidate
    opened = widened(widened(closed, min), max)
    isolated = [one and not other for one, other in zip(closed, opened, strict=True)]
    mask = [False] * n
    k = 0
    while k < n:
        stop = k
        while stop < n and isolated[stop]:
            stop += 1
        if stop > k:
            reach = half if localisation == "window" else 0
            at = [j for j in range(max(0, k - reach), min(n, stop + reach)) if sudden[j]]
            for j in range(*_ends(sudden, at, longest, ratio, localisation)):
                mask[j] = True
        k = max(stop, k + 1)
    return mask


def _ends(sudden, at, longest, ratio, localisation):
    """First and last of the changes if they are opposite and near; or the largest and the largest near it that cancels it."""
    if not at:
        return 0, 0
    if localisation == "window":
        opposite = sudden[at[0]] * sudden[at[-1]] < 0
        return (at[0], at[-1]) if opposite and at[-1] - at[0] <= longest else (0, 0)
    largest = max(at, key=lambda j: abs(sudden[j]))
    size = abs(sudden[largest])
    others = [
        j
        for j in at
        if abs(j - largest) <= longest and abs(sudden[j]) + size > ratio * abs(sudden[j] + sudden[largest])
    ]
    if not others:
        return 0, 0
    other = max(others, key=lambda j: abs(sudden[j]))
    return min(largest, other), max(largest, other)


def naive_alternating_jumps(vector, score, *, max_dwell, options):
    """Frames of the runs of jumps of which each undoes the one before: chained jump by jump, from each size that is tried."""
    chains = []
    threshold = 1.0
    while threshold < score.max():
        chain = []
        for frame in range(len(score)):
            if score[frame] <= threshold:
                continue
            if chain:
                before, after = vector[chain[-1]], vector[frame]
                size = max(np.sqrt(sum(before**2)), np.sqrt(sum(after**2)))
                near = frame - chain[-1] <= max_dwell
                if not near or np.sqrt(sum((before + after) ** 2)) > options.max_mismatch * size:
                    chains.append(chain)
                    chain = []
            chain = [*chain, frame]
        chains.append(chain)
        threshold *= np.sqrt(2)
    kept = []
    for chain in sorted(chains, key=len, reverse=True):
        alone = all(chain[-1] < other[0] or other[-1] < chain[0] for other in kept)
        if len(chain) >= options.min_jumps and alone:
            kept.append(chain)
    return sorted(kept)
