"""Plain twins of the library's fast code: slow, obvious, and only for tests."""

from itertools import pairwise

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


def scaled_conjugate_gradient(value, gradient, start, *, iterations, rest, probe):
    """Scaled conjugate gradient for one function, in the steps and the names of Moller 1993."""
    w = np.array(start, float)
    r = p = -gradient(w)
    scale, raised, success, delta = 1e-6, 0.0, True, 0.0
    for k in range(1, iterations + 1):
        if np.abs(r).max() <= rest:
            break
        square = p @ p
        if success:
            sigma = probe / np.sqrt(square)
            delta = p @ ((gradient(w + sigma * p) - gradient(w)) / sigma)
        delta += (scale - raised) * square
        if delta <= 0:
            raised = 2 * (scale - delta / square)
            delta = -delta + scale * square
            scale = raised
        mu = p @ r
        alpha = mu / delta
        comparison = 2 * delta * (value(w) - value(w + alpha * p)) / mu**2
        if comparison >= 0:
            w = w + alpha * p
            new = -gradient(w)
            raised, success = 0.0, True
            turned = new + (new @ new - new @ r) / mu * p
            p = new if k % len(w) == 0 or turned @ new <= 0 else turned
            r = new
            if comparison >= 0.75:
                scale /= 4
        else:
            raised, success = scale, False
        if comparison < 0.25:
            scale += delta * (1 - comparison) / square
    return w


def feed_forward(parameters, sizes, row):
    """What one network of tanh layers says to one row: each unit sums its inputs one by one."""
    given, at = list(row), 0
    for layer, (inputs, outputs) in enumerate(pairwise(sizes), 1):
        offsets = at + inputs * outputs
        total = [
            sum(given[i] * parameters[at + i * outputs + o] for i in range(inputs)) + parameters[offsets + o]
            for o in range(outputs)
        ]
        given = [np.tanh(one) for one in total] if layer < len(sizes) - 1 else total
        at = offsets + outputs
    return given
