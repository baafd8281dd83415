"""Published methods that share predictions: each gives what filling with the preset gives for it alone."""

from dataclasses import replace

import numpy as np
import pytest
import yaml

from markermend.core.recording import MEASURED, MISSING, Restored
from markermend.evaluation.pma2018.fillings import fill_by_methods
from markermend.evaluation.pma2018.methods import Method
from markermend.filling.fill import fill_scene
from markermend.filling.fill_ensembles import make_ensembles
from markermend.filling.gap import Gap
from markermend.options.config import read_config
from markermend.prediction.scene import Scene
from support.paths import PROJECT

MODELS = ("linear_regression", "local_quadratic", "local_grnn", "weighted_pca")

METHODS = (
    Method("local_grnn", ("local_grnn",)),
    Method("weighted_pca", ("weighted_pca",)),
    Method("average", MODELS),
    Method("average_unconstrained", MODELS, constrained=False),
)


def options(preset):
    return read_config(yaml.safe_load((PROJECT / f"config/presets/{preset}.yaml").read_text(encoding="utf-8")))["fill"]


def filled_alone(positions, neighbours, gaps, method, fill):
    """Filling with the preset, with the models of one method as its members."""
    averaging = fill.ensemble
    if not method.constrained:
        distances = replace(averaging.distances, spacing_rounds=0)
        averaging = replace(averaging, time_constraint="off", distances=distances)
    fill = replace(fill, members=method.models, ensemble=averaging, min_seen_share=0.0)
    missing = np.isnan(positions).any(axis=2)
    error, origin = np.where(missing, np.nan, 0.0), np.where(missing, MISSING, MEASURED).astype(np.uint8)
    names = tuple(f"M{number}" for number in range(positions.shape[1]))
    restored = Restored(names, positions, 100.0, origin=origin, error=error, error95=error)
    found = fill_scene(restored, Scene(positions, 100.0, neighbours), make_ensembles(fill), fill).recording.positions
    return {gap: found[gap.samples] for gap in gaps}


@pytest.mark.parametrize("preset", ["published_pma_text", "published_pma_code"])
def test_each_method_fills_as_the_preset_does_for_it_alone(walker, preset):
    positions = walker.recording.positions[100:400, :14].copy()
    gaps = [Gap(2, 120, 170), Gap(5, 120, 170), Gap(9, 140, 190)]
    for gap in gaps:
        positions[gap.samples] = np.nan
    markers = np.arange(positions.shape[1])
    neighbours = [np.delete(markers, marker) for marker in markers]
    fill = options(preset)
    found = fill_by_methods(Scene(positions, 100.0, neighbours), gaps, METHODS, fill)
    assert list(found) == list(METHODS)
    for method in METHODS:
        alone = filled_alone(positions, neighbours, gaps, method, fill)
        for gap in gaps:
            assert np.isfinite(alone[gap]).all(), (method, gap)
            np.testing.assert_allclose(found[method][gap], alone[gap], atol=1e-9)
    both = [found[method][gaps[0]] for method in METHODS[2:]]
    assert np.abs(both[0] - both[1]).max() > 0.1


def test_a_marker_without_references_is_not_filled():
    positions = np.random.default_rng(1).normal(0, 100, (200, 3, 3))
    gaps = [Gap(0, 50, 80), Gap(1, 50, 80)]
    for gap in gaps:
        positions[gap.samples] = np.nan
    scene = Scene(positions, 100.0, [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])])
    method = Method("local_grnn", ("local_grnn",))
    found = fill_by_methods(scene, gaps, [method], options("published_pma_text"))[method]
    assert all(np.isnan(found[gap]).all() for gap in gaps)


def test_other_weights_than_the_published_ones_are_refused(walker):
    scene = Scene(walker.recording.positions[:100, :5], 100.0, [np.delete(np.arange(5), marker) for marker in range(5)])
    with pytest.raises(ValueError, match="weighted by likelihood"):
        fill_by_methods(scene, [Gap(0, 40, 50)], METHODS[:1], read_config({})["fill"])
