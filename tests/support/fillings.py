"""What the tests of predictors and filling share: the default options, scenes, and neighbours by steadiness."""

from dataclasses import replace

import numpy as np

from markermend.core.recording import MEASURED, MISSING, Restored
from markermend.filling.ensemble import Ensemble
from markermend.filling.fill import fill_scene
from markermend.filling.fill_ensembles import make_ensembles
from markermend.options.filling import FillOptions
from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.registry import members
from markermend.prediction.scene import Scene

DEFAULTS = FillOptions()


def predictor_options():
    """The default options of the predictors, but for small networks that are briefly trained."""
    small = replace(
        NeuralNetworkOptions(),
        epochs=30,
        pseudo_gap_epochs=10,
        recurrent_units=4,
        max_training_frames=150,
        max_sequence_s=0.1,
        context_s=0.2,
    )
    return PredictorOptions(neural_networks=small)


def predictor(name):
    """One predictor with default options."""
    return members([name], predictor_options())[0]


def ensemble_options(**changed):
    """The default options of the averaging, with some changed."""
    return replace(DEFAULTS.ensemble, **changed)


def ensemble(names=None, **changed):
    """The default ensemble, with other members or some options changed."""
    return Ensemble(members(names or DEFAULTS.members, predictor_options()), ensemble_options(**changed))


def fill_options(averaging=None, **changed):
    """The default options of filling, with some of them, or of the averaging, changed."""
    default = replace(DEFAULTS, predictors=predictor_options(), ensemble=ensemble_options(**(averaging or {})))
    return replace(default, **changed)


def fill(recording, near, *, decisions=(), repairs=(), **changed):
    """Fill a recording with given neighbours, with some options of filling or of the averaging changed."""
    options = fill_options(**changed)
    seen = Scene(recording.positions, recording.rate, near)
    return fill_scene(recording, seen, make_ensembles(options, decisions), options, decisions, repairs)


def neighbours(positions):
    """For each marker the others, those whose distance varies least first."""
    sample = positions[:: max(1, len(positions) // 500)]
    distance = np.linalg.norm(sample[:, :, None] - sample[:, None], axis=3)
    with np.errstate(invalid="ignore"):
        known = np.isfinite(distance).sum(axis=0) > 1
        spread = np.where(known, np.nanstd(np.where(known, distance, 0), axis=0), np.inf)
        spread = spread * np.where(known, np.nanmean(np.where(known, distance, 0), axis=0), 1)
    np.fill_diagonal(spread, np.inf)
    return [np.argsort(row, kind="stable")[: int(np.isfinite(row).sum())] for row in spread]


def scene(positions, rate=100.0):
    """A scene in which every marker has every other as a neighbour."""
    return Scene(positions, rate, neighbours(positions))


def restored(positions, *, markers=None, rate=100.0, **facts):
    """A recording as repair hands it on: nothing repaired."""
    missing = np.isnan(positions).any(axis=2)
    none = np.where(missing, np.nan, 0.0)
    origin = np.where(missing, MISSING, MEASURED).astype(np.uint8)
    names = markers or tuple(f"M{m}" for m in range(positions.shape[1]))
    return Restored(tuple(names), positions, rate, facts=facts, origin=origin, error=none, error95=none.copy())


def rigid_body(frames=300, markers=6, seed=1):
    """Markers of one tumbling rigid body: (frames, markers, 3), mm."""
    from scipy.spatial.transform import Rotation

    rng = np.random.default_rng(seed)
    seconds = np.arange(frames) / 100.0
    local = rng.uniform(-100, 100, (markers, 3))
    turns = Rotation.from_euler("xyz", np.stack([np.sin(seconds), 0.7 * seconds, np.cos(1.3 * seconds)], axis=1))
    path = np.stack([300 * np.sin(seconds), 500 * seconds, 900 + 0 * seconds], axis=1)
    return np.stack([turns.apply(point) for point in local], axis=1) + path[:, None]
