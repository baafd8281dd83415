"""Contaminated markers that stand still, and the truth about them as masks: what tests of contamination share."""

import numpy as np

from markermend.core import events
from markermend.simulation.artifact_models import Recipe, integers, normal, poisson

FRAMES, MARKERS = 13000, [f"M{m}" for m in range(6)]


def still(frames=FRAMES):
    """Markers that stand still, 100 mm apart."""
    return np.zeros((frames, 6, 3)) + np.arange(6)[:, None] * 100.0


def paper(amplitude=5.0, mean_length=50.0):
    bulk = Recipe(normal(amplitude, 0.4 * amplitude), poisson(mean_length), 1)
    return {"peaks": Recipe(bulk.amplitude, integers(1, 5), 1), "noise": bulk, "steps": bulk, "slow": bulk}


def masks(contamination, frames):
    found = contamination.events
    return {kind: events.mask(found[kind], frames, contamination.markers) for kind in found}
