"""The averaging: frame by frame against a naive twin, for every kind of weights."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.filling.averaging import Averaging
from markermend.filling.candidates import Candidates
from markermend.filling.member_weights import MemberWeights
from support.fillings import DEFAULTS, ensemble_options, rigid_body, scene
from support.naive.filling import weighted_average


def averaging(weights="error", *, spacing_rounds=0):
    distances = replace(DEFAULTS.ensemble.distances, spacing_rounds=spacing_rounds)
    return Averaging(ensemble_options(weights=weights, distances=distances))


def candidates(rng, truth, members=5):
    """Predictions with errors of their own: some are not stated, some samples are not predicted."""
    positions = truth + rng.uniform(0.1, 3, (members, 1, 1)) * rng.normal(0, 1, (members, *truth.shape))
    errors = rng.uniform(0.2, 3, (members, len(truth)))
    errors[rng.random(errors.shape) < 0.3] = np.nan
    positions[rng.random(errors.shape) < 0.2] = np.nan
    return Candidates(positions, errors)


@pytest.mark.parametrize("weights", ["error", "pma", "both", "equal"])
@pytest.mark.parametrize("complete", [(), (1, 3)], ids=["gaps in all", "two complete"])
def test_the_average_equals_the_naive_twin(weights, complete):
    rng = np.random.default_rng(len(complete))
    positions = rigid_body() + rng.normal(0, 0.5, (300, 6, 3))
    seen, own = scene(positions), averaging(weights)
    observed = seen.positions[100:130]
    found = candidates(rng, observed[:, 2])
    for k in complete:
        found.positions[k] = observed[:, 2] + rng.normal(0, 1, (30, 3))
    members = MemberWeights(np.array([1.0, 2.0, np.nan, 0.5, 1.5]), np.array([0.5, 0.2, 0.0, 1.0, 0.3]))
    distances = own.distance_model(seen, 2)
    frames = np.repeat(members.weights[:, None], 30, axis=1)
    if weights in ("pma", "both"):
        frames = frames * distances.likelihood(found.positions, observed)
    average = own.average(found, members, distances, observed)
    mean, deviation, shares = weighted_average(
        found.positions, found.errors, members.typical_errors, frames, own.options.min_error_mm
    )
    assert np.allclose(average.positions, mean, equal_nan=True)
    known = ~np.isnan(deviation)
    assert known.sum() > 20 and average.deviation[known] == pytest.approx(deviation[known])
    assert average.weights == pytest.approx(shares)


def test_errors_on_pseudo_gaps_count_only_where_the_options_say_so():
    errors = np.array([[[4.0, 16.0], [1, 1]]])
    for weights, expected in (("error", [1, 0.125]), ("both", [1, 0.125]), ("pma", [1, 1]), ("equal", [1, 1])):
        found = averaging(weights).weigh(errors, np.ones(2))
        assert found.weights.tolist() == expected
        assert found.typical_errors.tolist() == [2, 4]
    grown = averaging().weigh(errors, np.array([1.0, 0.25]))
    assert grown.typical_errors.tolist() == [2, 1] and grown.weights.tolist() == [0.125, 1]


@pytest.mark.parametrize(
    ("weights", "rounds", "used"), [("error", 0, False), ("equal", 0, False), ("error", 1, True), ("both", 0, True)]
)
def test_distances_are_modelled_only_where_they_are_used_and_once_for_a_scene(weights, rounds, used):
    own, seen = averaging(weights, spacing_rounds=rounds), scene(rigid_body())
    model = own.distance_model(seen, 2)
    assert (model is not None) == used
    assert own.distance_model(seen, 2) is model


def test_the_spacing_constraint_moves_the_mean():
    own, seen = averaging(spacing_rounds=5), scene(rigid_body())
    observed = seen.positions[100:130]
    off = Candidates(observed[None, :, 2] + 60.0, np.ones((1, 30)))
    average = own.average(off, MemberWeights(np.ones(1), np.ones(1)), own.distance_model(seen, 2), observed)
    assert (np.linalg.norm(average.positions - observed[:, 2], axis=1) < 0.9 * np.sqrt(3) * 60).all()
