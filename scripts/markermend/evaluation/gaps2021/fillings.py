"""How each method of the experiment fills the gaps of runs (skurowski2021, sections 3.1 and 3.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from markermend.core.mesh import Mesh
from markermend.core.recording import MEASURED, MISSING, Recording, Restored
from markermend.evaluation.gaps2021.drawn import Run
from markermend.evaluation.gaps2021.methods import DEFAULT
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.filling.fill import fill_gaps
from markermend.options.filling import FillOptions
from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.interface import Predictor, Trainable
from markermend.prediction.neural_network.architecture import learnable_parameters
from markermend.prediction.neural_network.inputs import choose_inputs
from markermend.prediction.neural_network.predictor import KINDS
from markermend.prediction.registry import members
from markermend.prediction.scene import Scene

UNLIMITED = FillOptions(max_gap_s=None, max_error_mm=None, max_error95_mm=None, max_altered_share=1, fill_ends=True)
"""The default options of filling, but that every gap is filled."""

COLUMNS_PER_INPUT = 6
"""Inputs of a network for each marker: its position now and one frame before."""


def fill_runs(runs: Sequence[Run], mesh: Mesh, method: str, options: Gaps2021Options) -> Iterator[np.ndarray]:
    """Fill the gaps of runs by one method; the networks of all runs train side by side.

    Parameters
    ----------
    runs : sequence of Run
        Runs of one recording.
    mesh : Mesh
        The mesh of its subject.
    method : str
        One of methods.METHODS.
    options : Gaps2021Options
        Options of the methods.

    Yields
    ------
    ndarray of float, shape (frames, markers, 3)
        The positions of the next run, mm; NaN = not filled.
    """
    if method == DEFAULT:
        for run in runs:
            yield fill_gaps(_restored(run.hidden), mesh, options=UNLIMITED).recording.positions
        return
    predictor = _predictor(method, options)
    scenes = [Scene.of(run.hidden, mesh) for run in runs]
    places = [_places(run) for run in runs]
    if isinstance(predictor, Trainable):
        predictor.train([(scene, m) for scene, own in zip(scenes, places, strict=True) for m, _, _ in own])
    for scene, own in zip(scenes, places, strict=True):
        positions = scene.positions.copy()
        for m, start, stop in own:
            predicted = predictor.predict(scene, m, start, stop).positions
            positions[start:stop, m] = predicted[1:-1]  # the borders of the gap are predicted, too
        yield positions


def count_parameters(run: Run, mesh: Mesh, method: str, options: Gaps2021Options) -> list[float]:
    """Count the parameters that the network of each gap learns.

    Parameters
    ----------
    run : Run
        The run.
    mesh : Mesh
        The mesh of its subject.
    method : str
        One of methods.METHODS.
    options : Gaps2021Options
        Options of the networks.

    Returns
    -------
    list of float
        A number for each gap; NaN for methods that are no networks.
    """
    kind = KINDS.get(method)
    if kind is None:
        return [np.nan] * len(run.gaps)
    scene = Scene.of(run.hidden, mesh)
    inputs = [
        choose_inputs(scene, m, np.logical_and.reduce(scene.present[start:stop], axis=0), options.networks)
        for m, start, stop in _places(run)
    ]
    return [float(learnable_parameters(kind, COLUMNS_PER_INPUT * len(own), options.networks)) for own in inputs]


def _predictor(method: str, options: Gaps2021Options) -> Predictor:
    """A method that is a predictor of this program."""
    default = PredictorOptions()
    chosen = replace(
        default,
        interpolation=replace(default.interpolation, knots=options.knots),
        neural_networks=options.networks,
        msvd=options.low_rank,
    )
    return members([method], chosen)[0]


def _places(run: Run) -> list[tuple[int, int, int]]:
    """Marker, start and stop of each gap."""
    index = {marker: m for m, marker in enumerate(run.hidden.markers)}
    return [(index[gap.marker], gap.start, gap.stop) for gap in run.gaps]


def _restored(recording: Recording) -> Restored:
    """A recording as repair hands it on: nothing repaired."""
    missing = recording.missing
    error = np.where(missing, np.nan, 0.0)
    origin = np.where(missing, MISSING, MEASURED).astype(np.uint8)
    return Restored(**vars(recording), origin=origin, error=error, error95=error)
