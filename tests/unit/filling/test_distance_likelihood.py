"""Distances to references: their densities, and what follows for positions."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.filling.distance_likelihood import DistanceModel, pma_likelihood
from markermend.numerics.kernel_density import kernel_density
from markermend.options.filling import DistanceOptions
from markermend.prediction.marker_selection import reference_markers
from support.fillings import scene
from support.naive.numerics import symmetric_smoothing


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


def test_references_that_are_seen_take_the_place_of_missing_ones(body):
    own = options(references=2, spacing_references=2, reference_choice="seen")
    model = DistanceModel.estimate(scene(body), 9, own)
    hidden = body[100:130].copy()
    hidden[5:9, model.references[0]] = np.nan
    used, densities = model._used(hidden, 2)
    assert used.tolist() == model.references[1:3].tolist()
    assert [id(each) for each in densities] == [id(each) for each in model.densities[1:3]]
    likelihood = model.likelihood(body[None, 100:130, 9], hidden)
    expected = pma_likelihood(
        body[None, 100:130, 9], hidden[:, used], densities, window=round(own.smoothing_s * 100), floor=1e-200
    )
    assert np.array_equal(likelihood, expected)
    assert (model.likelihood(body[None, 100:130, 9], np.full_like(hidden, np.nan)) == 1).all()


def test_the_last_reference_holds_exactly(body):
    shown = scene(body)
    for order, place in (("steadiest_first", -1), ("steadiest_last", 0)):
        model = DistanceModel.estimate(shown, 9, options(spacing_rounds=1, spacing_order=order))
        placed = model.constrain(body[:, 9] + 60, body)
        distance = np.linalg.norm(placed - body[:, model.references[place]], axis=1)
        low, high = model.densities[place].quantiles((0.01, 0.99))
        assert (distance > low - 1e-6).all() and (distance < high + 1e-6).all()


def test_likelihoods_may_be_smoothed_by_a_median_first(body):
    own = options(smoothing_filter="median_mean")
    model = DistanceModel.estimate(scene(body), 9, own)
    rough = body[None, :, 9] + np.random.default_rng(4).normal(0, 3, (2, len(body), 3))
    single = replace(model, options=replace(own, smoothing_s=0)).likelihood(rough, body)
    assert np.allclose(model.likelihood(rough, body), symmetric_smoothing(single.T, 7).T)


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
