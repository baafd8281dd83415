"""Synthetic subjects for the tests: rigid segments that hang on each other and move, with known segments and tree."""

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.core.recording import Recording

RATE = 100.0
TREE = (None, 0, 1, 2, 3)  # a chain: the middle segment is the root of least eccentricity


def subject(seed, *, tree=TREE, frames=1500, markers=4, prefix="", length=300.0, away=(0.0, 0.0, 0.0)):
    """Build a body whose segment s is jointed to the far end of segment tree[s].

    Names are {prefix}{s}{a, b, ...}; the last marker of a segment sits beside the joint of its first child, the last
    but one beside that of its second child, and so on; an only child is jointed on the segment's axis.
    Returns names, positions (frames, markers, 3), and the segment of each marker.
    """
    rng = np.random.default_rng(seed)
    seconds = np.arange(frames) / RATE
    turns, origins, positions, names, owners = [], [], [], [], []
    for s, parent in enumerate(tree):
        frequency, phase = rng.uniform(0.2, 0.9, 3), rng.uniform(0, 2 * np.pi, 3)
        angles = rng.uniform(1.0, 1.3, 3) * np.sin(2 * np.pi * frequency * seconds[:, None] + phase)
        own = Rotation.from_euler("xyz", angles + rng.uniform(-1, 1, 3))
        if parent is None:
            walk = np.stack((300 * np.sin(0.5 * seconds), 200 * np.cos(0.3 * seconds), 900 + 0 * seconds), axis=1)
            turns.append(own)
            origins.append(walk + away)
        else:
            turns.append(turns[parent] * own)
            origins.append(origins[parent] + turns[parent].apply(joints(tree, parent, length)[s]))
        local = np.column_stack((rng.uniform(-50, 50, (markers, 2)), rng.uniform(0.2, 0.7, markers) * length))
        for k, joint in enumerate(joints(tree, s, length).values()):
            local[-1 - k] = joint + np.array((40, 40, -0.15 * length))
        for m in range(markers):
            positions.append(origins[s] + turns[s].apply(local[m]))
            names.append(f"{prefix}{s}{'abcdefgh'[m]}")
            owners.append(s)
    return names, np.stack(positions, axis=1), owners


def joints(tree, segment, length):
    """Where in a segment its children are jointed, by child."""
    children = [s for s, parent in enumerate(tree) if parent == segment]
    wide = 200.0 if len(children) > 1 else 0.0
    turn = 2 * np.pi * np.arange(len(children)) / max(len(children), 1)
    return {s: np.array((wide * np.cos(a), wide * np.sin(a), length)) for s, a in zip(children, turn, strict=True)}


def recording(names, positions, *, name="walk", rate=RATE, **facts):
    """Make a recording of named trajectories."""
    return Recording(tuple(names), np.array(positions), rate, facts={"recording": name, **facts})


def adjusted_rand_index(a, b):
    """Agreement of two labellings, 1 if equal up to names, about 0 by chance (Hubert & Arabie 1985)."""

    def pairs(counts):
        return sum(n * (n - 1) / 2 for n in counts)

    both = pairs([sum(x == (i, j) for x in zip(a, b, strict=True)) for i in set(a) for j in set(b)])
    first, second = pairs([list(a).count(i) for i in set(a)]), pairs([list(b).count(j) for j in set(b)])
    chance = first * second / pairs([len(a)])
    best = (first + second) / 2
    return 1.0 if best == chance else (both - chance) / (best - chance)


def labels(mesh, names):
    """The segment of each named marker, -1 for none."""
    return [next((s for s, segment in enumerate(mesh.segments) if name in segment.markers), -1) for name in names]
