"""Distances to references: their densities, and what follows for positions."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.filling.distance_likelihood import DistanceModel, pma_likelihood
from markermend.numerics.kernel_density import kernel_density
from markermend.options.filling import DistanceOptions
from markermend.prediction.marker_selection import reference_markers
from support.fillings import scene


def options(**changed):
    return replace(DistanceOptions(), **changed)


@pytest.fixture
def body(walker):
    return walker.recording.positions[:300]


def test_the_steadiest_markers_are_the_references(body):
    own = options(references=2, spacing_references=4)
    ranked, _ = reference_markers(scene(body), 9, max_frames=own.max_frames, min_frames=own.min_frames)
    model = DistanceModel.estimate(scene(body), 9, own)
    assert model.references.tolist() == ranked[:4].tolist()
    for reference, density in zip(model.references, model.densities, strict=True):
        usual = np.median(np.linalg.norm(body[:, 9] - body[:, reference], axis=1))
        assert density.quantiles((0.5,))[0] == pytest.approx(usual, rel=0.01)


def test_the_truth_is_likelier_than_positions_off_it(body):
    model = DistanceModel.estimate(scene(body), 9, options())
    likelihood = model.likelihood(np.stack([body[:, 9], body[:, 9] + 60]), body)
    assert (likelihood[0] > 1e3 * likelihood[1]).all()


def test_distant_positions_move_nearer_and_the_truth_hardly_moves(body):
    model = DistanceModel.estimate(scene(body), 9, options(spacing_rounds=5))
    off = [np.linalg.norm(model.constrain(body[:, 9] + by, body) - body[:, 9], axis=1) for by in (0, 60)]
    assert off[0].mean() < 1
    assert off[1].mean() < 0.9 * np.sqrt(3) * 60
    unbound = DistanceModel.estimate(scene(body), 9, options())
    assert np.array_equal(unbound.constrain(body[:, 9] + 60, body), body[:, 9] + 60)


def test_without_references_nothing_is_judged(body):
    alone = body.copy()
    alone[40:, 9] = np.nan
    model = DistanceModel.estimate(scene(alone), 9, options(spacing_rounds=5))
    assert len(model.references) == 0
    assert (model.likelihood(body[None, :, 9] + 60, body) == 1).all()
    assert np.array_equal(model.constrain(body[:, 9] + 60, body), body[:, 9] + 60)


@pytest.fixture
def distances():
    return [np.random.default_rng(8).normal(100 + 40 * j, 3 + j, 300) for j in range(3)]


def test_smoothing_is_a_moving_average_and_the_floor_holds(distances):
    densities = [kernel_density(sample, max_samples=1000) for sample in distances]
    references = np.zeros((9, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    positions = np.zeros((1, 9, 3))
    positions[0, 4] = 1e5
    single = pma_likelihood(positions, references, densities, window=1, floor=1e-200)[0]
    smooth = pma_likelihood(positions, references, densities, window=3, floor=1e-200)[0]
    assert single[4] == 1e-200
    assert smooth[4] == pytest.approx((single[3] + single[4] + single[5]) / 3)
    assert smooth[0] == pytest.approx((single[0] + single[1]) / 2)


def test_a_reference_that_is_not_seen_does_not_count(distances):
    densities = [kernel_density(sample, max_samples=1000) for sample in distances]
    references = np.zeros((5, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    references[2, 1] = np.nan
    positions = np.random.default_rng(8).normal(0, 2, (2, 5, 3))
    found = pma_likelihood(positions, references, densities, window=1, floor=0.0)
    without = pma_likelihood(positions, references[:, [0, 2]], [densities[0], densities[2]], window=1, floor=0.0)
    assert np.allclose(found[:, 2], without[:, 2])
