"""Markers of which some are under each other's labels over known stretches."""

import numpy as np

from markermend.prediction.scene import Scene

NEAR = [np.delete(np.arange(6), m) for m in range(6)]


def scene(*spans, seed=0, frames=120):
    """Six markers that move together, of which the first two are exchanged over some spans."""
    rng = np.random.default_rng(seed)
    walk = np.cumsum(rng.normal(0, 1, (frames, 1, 3)), axis=0)
    positions = rng.uniform(-200, 200, (6, 3)) + walk + rng.normal(0, 0.2, (frames, 6, 3))
    for start, stop in spans:
        positions[start:stop, [0, 1]] = positions[start:stop, [1, 0]]
    return Scene(positions, 100.0, NEAR)


def moving(seed, frames=30, markers=6):
    """Markers on smooth trajectories, and where some of them are exchanged in a cycle."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames)[:, None, None] / 10
    positions = rng.uniform(-90, 90, (markers, 3)) + rng.uniform(-5, 5, (markers, 3)) * t
    size = int(rng.integers(3, markers))
    cycle = rng.permutation(markers)[:size]
    recorded = positions.copy()
    recorded[15:, np.roll(cycle, -1)] = positions[15:, cycle]
    return recorded + rng.normal(0, 0.5, recorded.shape), cycle.tolist()
