"""Concurrent gaps filled by several published methods: single models and averages of them, with and without the constraints.

The averages share the predictions of the models. What comes out is what filling with a preset of config/presets gives for each
method by itself, without its pseudo-gaps: these calibrate the stated error, and neither the weights nor the positions depend on them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from markermend.evaluation.pma2018.methods import Method
from markermend.filling.averaging import Averaging
from markermend.filling.candidates import predict_candidates
from markermend.filling.distance_likelihood import DistanceModel
from markermend.filling.ensemble import Filling
from markermend.filling.gap import Gap
from markermend.filling.growing_scene import GrowingScene
from markermend.filling.mixture import weighted_mean
from markermend.numerics.intervals import samples
from markermend.numerics.symmetric_smoothing import smooth_symmetrically
from markermend.options.filling import FillOptions
from markermend.prediction.registry import members
from markermend.prediction.scene import Scene


def fill_by_methods(
    scene: Scene, gaps: Sequence[Gap], methods: Sequence[Method], options: FillOptions
) -> dict[Method, dict[Gap, np.ndarray]]:
    """Fill gaps with each method.

    Parameters
    ----------
    scene : Scene
        The recording, in which the gaps are missing.
    gaps : sequence of Gap
        The gaps, one at most of each marker, in the order in which they are filled.
    methods : sequence of Method
        The methods.
    options : FillOptions
        Options of a published preset: weights by likelihood.

    Returns
    -------
    dict of Method to dict of Gap to ndarray, shape (n, 3)
        Positions, mm; NaN in gaps that a method cannot fill.

    References
    ----------
    tits2018, eq 16-27.
    """
    if not options.reuse_filled:
        return _fill_each(scene, gaps, methods, options)
    return {method: _fill_in_turn(scene, gaps, method, options) for method in methods}


def _fill_in_turn(scene: Scene, gaps: Sequence[Gap], method: Method, options: FillOptions) -> dict[Gap, np.ndarray]:
    """Positions by gap; a marker that was filled is a reference for those that are filled after it."""
    filled: dict[Gap, np.ndarray] = {}
    growing = GrowingScene(scene)
    for gap in gaps:
        filled |= _fill_each(growing.current(), [gap], [method], options)[method]
        if not np.isnan(filled[gap]).any():
            growing.add(gap, Filling(filled[gap], np.zeros(gap.length), {}))
    window = samples(options.smoothing_s, scene.rate, odd=True)
    positions = growing.current().positions
    smoothed = {gap: smooth_symmetrically(positions[:, gap.marker], window)[gap.start : gap.stop] for gap in filled}
    return smoothed if window > 1 else filled


def _fill_each(
    scene: Scene, gaps: Sequence[Gap], methods: Sequence[Method], options: FillOptions
) -> dict[Method, dict[Gap, np.ndarray]]:
    """Positions by method and gap, each gap filled from what is measured in the scene."""
    averaging = Averaging(options.ensemble)
    filled: dict[Method, dict[Gap, np.ndarray]] = {method: {} for method in methods}
    for gap in gaps:
        distances = averaging.distance_model(scene, gap.marker)
        if distances is None:
            raise ValueError("published methods are weighted by likelihood: ensemble.weights is pma in their presets")
        for constrained in {method.constrained: None for method in methods}:
            own = [method for method in methods if method.constrained is constrained]
            for method, positions in _average(scene, gap, own, options, distances):
                filled[method][gap] = positions
    return filled


def _average(
    scene: Scene, gap: Gap, methods: Sequence[Method], options: FillOptions, distances: DistanceModel
) -> Iterator[tuple[Method, np.ndarray]]:
    """Positions by each of several methods that are all constrained, or all not."""
    constrained = methods[0].constrained
    names = list(dict.fromkeys(name for method in methods for name in method.models))
    ensemble = options.ensemble if constrained else replace(options.ensemble, time_constraint="off")
    predicted = predict_candidates(members(names, options.predictors), scene, gap, options=ensemble).positions
    observed = scene.positions[gap.start : gap.stop]
    likelihood = distances.likelihood(predicted, observed)
    for method in methods:
        rows = [names.index(name) for name in method.models]
        mean, _ = weighted_mean(predicted[rows], likelihood[rows])
        yield method, distances.constrain(mean, observed) if constrained else mean
