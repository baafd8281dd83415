"""What the tests of repair share: a body whose truth is known, damage to it, and the repair with small settings."""

import numpy as np

from markermend.options.prediction import LocalRidgeOptions
from markermend.options.repair import RepairOptions
from markermend.prediction.interpolation import Interpolation
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.repair.repair import repair
from support import bodies
from support.treated import treated

RIDGE = LocalRidgeOptions(
    anchors=3,
    inputs=8,
    width_mm=5,
    ridge_mm2=1,
    frames=1000,
    minimum_frames=60,
    robust_sigmas=6,
    scales_s=(0.05, 0.2, 1),
    longest_s=1,
    border_s=0.15,
    novelty=20.0,
)
METHODS = {
    "labels": ["exchange"],
    "peaks": ["spline"],
    "noise": ["local_ridge"],
    "steps": ["separate_step", "local_ridge"],
    "slow": ["local_ridge"],
}
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


def mend(recording, found, *, extra=None, decisions=(), near=None, **changes):
    settings = {
        "methods": METHODS,
        "prefer": 1.25,
        "protect": [],
        "max_altered_share": 0.3,
        "max_repair_s": 2.0,
        "max_error_mm": 20.0,
        "savitzky_golay_order": 13,
        "savitzky_golay_s": 1.01,
        "trials": 5,
        "separation": {
            "ridges": [{}, {"inputs": 6}],
            "amplitudes_mm": [3, 10, 30],
            "roughness_mm": [0.1, 1],
            "border_s": 0.15,
            "margins": [0, 0.1],
            "trust": 0.3,
            "most_frames": 1000,
        },
        "radius": {"inner": 1.8, "outer": 2.8},
    }
    return treated(
        repair(
            recording,
            found=found,
            neighbours=neighbours_of(recording) if near is None else near,
            predictors={predictor.name: predictor for predictor in [*PREDICTORS, *([extra] if extra else [])]},
            options=RepairOptions(**{**settings, **changes}),
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
