"""Distances to references: their densities, and what follows for positions."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.filling.distance_likelihood import DistanceModel
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
