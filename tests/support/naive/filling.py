"""Naive twins of markermend.filling."""

import numpy as np


def expected_error(stated, typical, weights, member, n):
    """The error of one member of an ensemble in one frame, where need be from its errors on pseudo-gaps."""
    if not np.isnan(stated[member, n]):
        return stated[member, n]
    usual = typical / np.sqrt(3)
    members = range(len(stated))
    both = [k for k in members if not np.isnan(stated[k, n] + usual[k]) and weights[k, n] > 0]
    ratio = 1.0
    if both:
        ratio = sum(weights[k, n] * stated[k, n] for k in both) / sum(weights[k, n] * usual[k] for k in both)
    if not np.isnan(usual[member]):
        return usual[member] * ratio
    known = [k for k in members if not (np.isnan(stated[k, n]) and np.isnan(typical[k]))]
    return max((expected_error(stated, typical, weights, k, n) for k in known), default=np.nan)


def weighted_average(positions, errors, typical, weights, least):
    """Weighted mean of predictions (members, n, 3) and its standard deviation, one frame and one member at a time.

    weights: (members, n). Returns the mean (n, 3), the deviation (n,) and the mean weight of each member.
    """
    members, frames, _ = positions.shape
    complete = [k for k in range(members) if not np.isnan(positions[k]).any()]
    mean, deviation, used = np.full((frames, 3), np.nan), np.full(frames, np.nan), np.zeros((members, frames))
    for n in range(frames):
        there = complete or [k for k in range(members) if not np.isnan(positions[k, n]).any()]
        total = sum(weights[k, n] for k in there)
        for k in there:
            used[k, n] = weights[k, n] / total if total > 0 else 1 / len(there)
        if not there:
            continue
        mean[n] = sum(used[k, n] * positions[k, n] for k in there)
        variance = 0.0
        for k in there:
            own = max(expected_error(errors, typical, used, k, n), least)
            apart = sum((positions[k, n, axis] - mean[n, axis]) ** 2 for axis in range(3)) / 3
            variance += used[k, n] * (own**2 + apart) if used[k, n] > 0 else 0.0
        deviation[n] = np.sqrt(variance)
    return mean, deviation, used.mean(axis=1)


def share_out(frames, total):
    """Deal poses out one by one, to the recording with the fewest so far that has frames left; the last by length and name wins ties."""
    shares = dict.fromkeys(sorted(frames), 0)
    for _ in range(total):
        open_ones = [name for name in shares if shares[name] < frames[name]]
        if open_ones:
            shares[min(open_ones, key=lambda name: (shares[name], -frames[name], [-ord(c) for c in name]))] += 1
    return shares
