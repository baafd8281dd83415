"""Measures of filled gaps and of recordings, sample by sample."""

import math
from collections import Counter
from itertools import pairwise

import numpy as np
from scipy.stats import spearmanr


def gap_error(estimate, truth, markers, gap):
    """Root mean square error of one gap (skurowski2021 eq 16)."""
    m = markers.index(gap.marker)
    squares = [
        (estimate[frame, m, axis] - truth[frame, m, axis]) ** 2
        for frame in range(gap.start, gap.stop)
        for axis in range(3)
    ]
    return math.sqrt(sum(squares) / len(squares))


def entropy(positions, bin_mm):
    """Entropy of a marker in bits: of each coordinate by counting, summed over three, averaged over markers."""
    found = []
    for m in range(positions.shape[1]):
        bits = 0.0
        for axis in range(3):
            values = [value for value in positions[:, m, axis] if not math.isnan(value)]
            for count in Counter(math.floor(value / bin_mm) for value in values).values():
                bits -= count / len(values) * math.log2(count / len(values))
        if values:
            found.append(bits)
    return sum(found) / len(found)


def derivative(positions, rate, order):
    """Mean magnitude of a derivative in m: differences of differences, where all their frames are measured."""
    found = []
    for m in range(positions.shape[1]):
        track, sizes = positions[:, m] / 1000, []
        for frame in range(len(track) - order):
            parts = [list(row) for row in track[frame : frame + order + 1]]
            while len(parts) > 1:
                parts = [[(b - a) * rate for a, b in zip(one, two, strict=True)] for one, two in pairwise(parts)]
            size = math.sqrt(sum(value**2 for value in parts[0]))
            if not math.isnan(size):
                sizes.append(size)
        if sizes:
            found.append(sum(sizes) / len(sizes))
    return sum(found) / len(found)


def rank_correlation(values):
    """Spearman's correlation of the measured values of a coordinate with their order."""
    known = values[~np.isnan(values)]
    return spearmanr(known, np.arange(len(known))).statistic


def complexity(positions, eigenposes):
    """Share of variance beyond the largest eigenvalues of the covariance of complete recordings."""
    values = np.sort(np.linalg.eigvalsh(np.cov(positions.reshape(len(positions), -1).T)))[::-1]
    return 1 - values[:eigenposes].sum() / values.sum()
