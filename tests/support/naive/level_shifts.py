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
