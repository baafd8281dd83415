"""What the tests of the lagged regressions share: a limb, scenes of it, and predictors that are briefly trained."""

from dataclasses import replace

import numpy as np

from markermend.prediction.scene import Scene
from support.fillings import predictor


def limb(frames=1500, markers=6, rate=100.0, seed=0):
    """Markers that swing together; marker 0 also depends on the square of another's place. (frames, markers, 3), mm."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames)[:, None] / rate
    path = np.stack([200 * np.sin(2.2 * t), 150 * np.sin(1.3 * t + 1), 80 * np.cos(3.1 * t)], axis=2)
    own = rng.uniform(0.8, 1.2, (markers, 3)) * path + rng.uniform(-300, 300, (markers, 3))
    own[:, 0, 0] += (own[:, 1, 0] - 100) ** 2 / 1000
    return own


def scene(positions, segment_mates=None, rate=100.0):
    others = [np.delete(np.arange(positions.shape[1]), m) for m in range(positions.shape[1])]
    return Scene(positions, rate, others, segment_mates=segment_mates)


def quick(name, **changed):
    """A lagged regression with default options, but few steps of training."""
    made = predictor(name)
    few = {"max_iterations": 150} if name == "replicated_network" else {}
    return type(made)(replace(made.options, **few, **changed))
