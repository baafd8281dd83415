"""Naive twins of markermend.filling."""

import numpy as np
from scipy.interpolate import CubicHermiteSpline


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


def neighbour_motion(scene, gap, start, length, neighbours):
    """Median over neighbours of the rms distance from Hermite's curve in a stretch, marker by marker and point by point."""
    present = scene.present
    if gap.start < 2 or gap.stop > len(present) - 2:
        return np.nan
    near = [m for m in scene.neighbours[gap.marker] if all(present[f, m] for f in range(gap.start - 2, gap.stop + 2))]
    distances = []
    for marker in near[:neighbours]:
        path = [scene.positions[min(max(start + k, 0), len(present) - 1), marker] for k in range(-2, length + 2)]
        if np.isnan([path[0], path[1], path[-2], path[-1]]).any():
            continue
        ends, slopes = [path[1], path[-2]], [path[1] - path[0], path[-1] - path[-2]]
        curve, squares = CubicHermiteSpline([-1, length], ends, slopes), []
        for quarter in (1, 2, 3):
            offset = round((length + 1) * quarter / 4) - 1
            squares.append(((path[offset + 2] - curve(offset)) ** 2).sum())
        distances.append(np.sqrt(np.mean(squares)))
    known = [distance for distance in distances if not np.isnan(distance)]
    return np.median(known) if known else np.nan
