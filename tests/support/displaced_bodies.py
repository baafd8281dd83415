"""A jointed body with soft tissue, on which a marker is displaced in the frame of its segment for good."""

import numpy as np

from markermend.core.shape import Shape
from markermend.mesh.usual_distances import recording_distances
from markermend.numerics.rigid_alignment import align
from markermend.prediction.scene import Scene
from support.bodies import RATE, subject
from support.signals import neighbours

FRAMES = 1500
NAMES, BODY, OWNERS = subject(3, frames=FRAMES, markers=6)


def onset(start, stop=FRAMES, length=1):
    """From 0 to 1 over some frames, and back at once."""
    values = np.clip((np.arange(FRAMES) - start + 1) / length, 0, 1)
    values[stop:] = 0
    return values


def displaced(name, course, vector=(12.0, -9.0, 8.0)):
    """The body, with soft tissue of 0.4 mm, and a marker displaced in its segment's frame."""
    rng = np.random.default_rng(0)
    positions = BODY + rng.normal(0, 0.4, BODY.shape)
    m = NAMES.index(name)
    mates = [o for o, owner in enumerate(OWNERS) if owner == OWNERS[m]]
    turns = align(BODY[:, mates], BODY[0, mates] - BODY[0, mates].mean(axis=0)).axes
    positions[:, m] += np.einsum("nij,j->ni", turns, np.array(vector)) * course[:, None]
    return positions


def scene(positions, usual=None):
    """The scene of a subject with the shape of its usual recordings, or of this one alone."""
    shown = positions if usual is None else usual
    shape = Shape(*recording_distances(shown, min_frames=20), 1 if usual is None else 3)
    return Scene(positions, RATE, neighbours(positions), shape=shape)
