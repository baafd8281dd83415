"""Statistics of the residuals of single markers, for the tests of what is found in them."""

import numpy as np

from markermend.detection.peaks import PeakDetector
from markermend.detection.steps import StepDetector
from markermend.prediction.scene import Scene
from support.signals import options_of

PEAKS, STEPS = options_of("peaks", "default"), options_of("steps", "default")


def alone(positions, rate):
    """A scene of one marker (frames, 3) without neighbours."""
    return Scene(positions[:, None], rate, [np.zeros(0, int)])


def peak_statistics(residual, positions, rate, options=PEAKS):
    """The statistics by which peaks of one marker (frames, 3) are found."""
    return PeakDetector(alone(positions, rate), ["A"], options).measure(residual[:, None])


def step_statistics(residual, positions, rate, options=STEPS):
    """The statistics by which steps of one marker (frames, 3) are found."""
    scene = alone(positions, rate)
    return StepDetector(scene, ["A"], options, missing=~scene.present).measure(residual[:, None])


def rough(frames, seed):
    """A residual (frames, 3) of independent noise of 0.05 mm."""
    return np.random.default_rng(seed).normal(0, 0.05, (frames, 3))
