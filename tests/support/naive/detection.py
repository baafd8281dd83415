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
