"""Complete a tensor of frames, markers and axes by Tucker decompositions of given ranks; needs tensorly and numpy, not markermend.

Reads: an .npz file with tensor (frames, markers, 3), known (bool, of the same shape), ranks (n, 2) of frames and of markers, and
iterations. Missing entries of the tensor hold start values. Writes: another, with completed (n, frames, markers, 3), for each rank.

    PYTHON_WITH_TENSORLY benchmarks/support/tucker_completion.py tensor.npz completed.npz

The decomposition of the complete frames gives components of markers and axes. The scores of each incomplete frame on these are their
conditional means given its known entries, with the variances that the scores have and the noise that the decomposition leaves; its
missing entries follow from the scores. The decomposition of all frames then gives the next components, and so on.
"""

import sys

import numpy as np
from tensorly import tucker_to_tensor
from tensorly.decomposition import tucker

SWEEPS = 3
"""Sweeps of the higher-order orthogonal iteration at each decomposition."""


def main() -> None:
    read, write = sys.argv[1:]
    with np.load(read) as given:
        tensor, known, ranks, iterations = (given[name] for name in ("tensor", "known", "ranks", "iterations"))
    np.savez(write, completed=np.array([complete(tensor, known, rank, int(iterations)) for rank in ranks]))


def complete(tensor: np.ndarray, known: np.ndarray, rank: np.ndarray, iterations: int) -> np.ndarray:
    """The tensor with its missing entries replaced, at one rank of frames and markers."""
    tensor, flat = tensor.copy(), known.reshape(len(known), -1)
    patterns, pattern_of = np.unique(flat, axis=0, return_inverse=True)
    whole = flat.all(axis=1)
    learned = tensor[whole] if np.count_nonzero(whole) > rank[0] else tensor
    for _ in range(iterations):
        basis, noise = decompose(learned, rank)
        for number, seen in enumerate(patterns):
            rows = np.flatnonzero(pattern_of.ravel() == number)
            if seen.all() or not seen.any():
                continue
            values, own = tensor[rows].reshape(len(rows), -1), basis[:, seen]
            scores = np.linalg.solve(own @ own.T + noise * np.eye(len(basis)), own @ values[:, seen].T)
            values[:, ~seen] = scores.T @ basis[:, ~seen]
            tensor[rows] = values.reshape(len(rows), *tensor.shape[1:])
        learned = tensor
    return tensor


def decompose(tensor: np.ndarray, rank: np.ndarray) -> tuple[np.ndarray, float]:
    """The components (rank of frames, markers * 3) of a Tucker decomposition for scores of unit variance, and the variance of the noise."""
    frames, markers = (int(own) for own in rank)
    core, factors = tucker(tensor, [frames, markers, 3], n_iter_max=SWEEPS, random_state=0)
    noise = float(np.mean((tensor - tucker_to_tensor((core, factors))) ** 2))
    components = tucker_to_tensor((core, [np.eye(frames), *factors[1:]])) / np.sqrt(len(tensor))
    return components.reshape(frames, -1), noise


if __name__ == "__main__":
    main()
