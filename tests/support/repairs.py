"""What the tests of repair share: a body whose truth is known, damage to it, and the repair with small options."""

from dataclasses import replace

import numpy as np

from markermend.core.decisions import Decision
from markermend.core.shape import Shape
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.options.repair import RepairOptions, RepairRadiusOptions, SeparationOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.interpolation import Interpolation
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.repair.repair import repair_scene
from support import bodies
from support.treated import treated

RIDGE = LocalRidgeOptions(
    anchors=3,
    inputs=8,
    min_anchor_extent_mm=5,
    ridge_mm2=1,
    max_training_frames=1000,
    min_training_frames=60,
    outlier_sigmas=6,
    correlation_times_s=(0.05, 0.2, 1),
    max_lag_s=1,
    border_s=0.15,
    max_leverage=20.0,
)
METHODS = {
    "labels": ["exchange"],
    "peaks": ["spline"],
    "noise": ["local_ridge"],
    "steps": ["separate_step", "local_ridge"],
    "slow": ["local_ridge"],
}
SEPARATION = SeparationOptions(
    local_ridge_changes=({}, {"inputs": 6}),
    amplitudes_mm=(3, 10, 30),
    roughness_mm=(0.1, 1),
    likelihood_power=0.3,
)
RADIUS = RepairRadiusOptions(inner=1.8, outer=2.8)
MARKER, START, STOP = "2b", 600, 640
PREDICTORS = [Interpolation("spline", knots=10), Interpolation("linear", knots=10), LocalRidge(RIDGE)]


def body():
    """Segments in a chain, measured with a little noise."""
    names, positions, _ = bodies.subject(8, frames=1500, markers=4)
    rng = np.random.default_rng(3)
    return bodies.recording(names, positions + rng.normal(0, 0.05, positions.shape))


def neighbours_of(recording):
    """The others of the same segment, then of the next ones: names carry the segment's number."""
    segments = np.array([int(name[0]) for name in recording.markers])
    return [
        np.array([j for j in np.argsort(abs(segments - segments[m]), kind="stable") if j != m])
        for m in range(len(segments))
    ]


def usual_shape(positions):
    """Median distance of each pair, and how much it varies."""
    distance = np.linalg.norm(positions[:, :, None] - positions[:, None], axis=3)
    usual = np.nanmedian(distance, axis=0)
    return Shape(usual, 1.4826 * np.nanmedian(np.abs(distance - usual), axis=0), np.nanstd(distance, axis=0))


def mend(recording, found, *, extra=None, decisions=(), near=None, shape=None, **changes):
    options = RepairOptions(
        methods=METHODS,
        max_altered_share=0.3,
        hidden_stretches=5,
        separation=SEPARATION,
        radius=RADIUS,
    )
    near = neighbours_of(recording) if near is None else near
    return treated(
        repair_scene(
            recording,
            Scene(recording.positions, recording.rate, near, shape=shape),
            found=found,
            predictors={predictor.name: predictor for predictor in [*PREDICTORS, *([extra] if extra else [])]},
            options=replace(options, **changes),
            decisions=decisions,
        )
    )


def distorted(clean, offsets, start=START, stop=STOP, marker=MARKER):
    positions = clean.positions.copy()
    positions[start:stop, clean.markers.index(marker)] += offsets
    return bodies.recording(clean.markers, positions)


def error(clean, result, start=START, stop=STOP, marker=MARKER):
    m = clean.markers.index(marker)
    return np.linalg.norm(result.positions[start:stop, m] - clean.positions[start:stop, m], axis=1)


def decide(verb, value="", note="", marker=MARKER, start=START, stop=STOP):
    return Decision(marker, start, stop, verb, value, note)


class Vague:
    """A predictor that is off by some mm along x and states a standard deviation."""

    continuous = True

    def __init__(self, recording, name="vague", off=12.0, deviation=10.0):
        self.positions, self.name, self.off, self.deviation = recording.positions, name, off, deviation

    def predict(self, scene, marker, start, stop):
        positions = self.positions[start - 1 : stop + 1, marker] + [self.off, 0, 0]
        return Prediction(positions, np.full(stop - start + 2, self.deviation))
