"""Plain twins of the library's fast code: slow, obvious, and only for tests."""

import numpy as np


def runs(signal):
    """Intervals of samples that are not NaN, found one sample at a time."""
    found, start = [], None
    for n in range(len(signal) + 1):
        missing = n == len(signal) or np.isnan(signal[n])
        if missing and start is not None:
            found.append((start, n))
            start = None
        elif not missing and start is None:
            start = n
    return found


def under_element(signal, size, best):
    """The least or greatest (`best`) value under a window, never beyond the sample's own valid run."""
    out = np.full(len(signal), np.nan)
    for start, stop in runs(signal):
        for n in range(start, stop):
            out[n] = best(signal[max(start, n - size // 2) : min(stop, n + size // 2 + 1)])
    return out


def moving_median(signal, window):
    """Median of a window, the run's first and last sample standing in beyond its ends."""
    out = np.full(len(signal), np.nan)
    for start, stop in runs(signal):
        for n in range(start, stop):
            around = [signal[min(max(k, start), stop - 1)] for k in range(n - window // 2, n + window // 2 + 1)]
            out[n] = np.median(around)
    return out


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
