"""Level shifts by definition: every set of level shifts without a common edge, one by one."""

from itertools import combinations, pairwise

import numpy as np


def probabilities(log_ratios):
    """The probability of each stretch to be displaced, from the likelihoods (edges, edges) of level shifts."""
    possible = [(k, j) for k, j in zip(*np.nonzero(np.isfinite(log_ratios)), strict=True)]
    total, displaced = 0.0, np.zeros(len(log_ratios) - 1)
    for count in range(len(log_ratios) // 2 + 1):
        for chosen in combinations(possible, count):
            ordered = sorted(chosen)
            if all(before[1] < after[0] for before, after in pairwise(ordered)):
                likelihood = np.exp(sum(log_ratios[pair] for pair in chosen))
                total += likelihood
                for k, j in chosen:
                    displaced[k:j] += likelihood
    return displaced / total


def distances_at_similar_poses(scene, marker, frames, excluded, options):
    """Distances to the neighbours predicted from the most similar poses, and their standard deviations, frame by frame."""
    around = scene.neighbours[marker][: options.neighbours]
    positions = scene.positions

    def pose(frame):
        return {
            (i, j): np.linalg.norm(positions[frame, i] - positions[frame, j]) for i in around for j in around if i < j
        }

    def apart(one, other):
        known = [(one[pair] - other[pair]) ** 2 for pair in one if not np.isnan(one[pair] - other[pair])]
        return np.sqrt(np.mean(known)) if known else np.inf

    step = round(options.sampling_interval_s * scene.rate)
    times = [t for t in range(0, len(positions), step) if not excluded[0] <= t < excluded[1]]
    times = [t for t in times if not np.isnan(positions[t, marker]).any()]
    mean, deviation = np.full((2, len(frames), len(around)), np.nan)
    for row, frame in enumerate(frames):
        nearest = sorted((apart(pose(frame), pose(t)), t) for t in times)[: options.poses]
        for column, neighbour in enumerate(around):
            known = [
                (1 / (options.pose_tolerance_mm**2 + (options.distance_slope * far) ** 2), far, distance)
                for far, t in nearest
                if not np.isnan(distance := np.linalg.norm(positions[t, marker] - positions[t, neighbour]))
            ]
            weight, far, distance = np.array(known).T
            weight /= weight.sum()
            mean[row, column] = weight @ distance
            variance = weight @ (distance - mean[row, column]) ** 2
            deviation[row, column] = np.sqrt(variance + (options.distance_slope * weight @ far) ** 2)
    return mean, deviation
