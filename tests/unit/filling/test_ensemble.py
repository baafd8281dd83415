"""The ensemble: who gets the weight, what is stated, and when a fallback is asked."""

import numpy as np
import pytest

from markermend.filling.ensemble import Ensemble
from markermend.filling.gap import Gap
from support.fillings import ensemble, predictor, rigid_body, scene


def test_the_better_member_gets_the_weight(walker):
    seen = scene(walker.recording.positions)
    both = ensemble(["local_ridge", "spline"], longest_s={})
    long = both.fill(seen, Gap(7, 400, 600), both.evaluate(seen, Gap(7, 400, 600)))
    assert long.weights["local_ridge"] > 0.9
    equal = ensemble(["local_ridge", "spline"], weights="equal", longest_s={})
    halves = equal.fill(seen, Gap(7, 400, 420), equal.evaluate(seen, Gap(7, 400, 420)))
    assert halves.weights == pytest.approx({"local_ridge": 0.5, "spline": 0.5})
    single = [predictor(name).predict(seen, 7, 400, 420).positions[1:-1] for name in ("local_ridge", "spline")]
    assert np.allclose(halves.positions, np.mean(single, axis=0))


@pytest.mark.parametrize("weights", ["error", "pma", "both", "equal"])
def test_every_kind_of_weights_fills_well(walker, weights):
    positions = walker.recording.positions
    seen = scene(positions)
    own = ensemble(weights=weights)
    found = own.fill(seen, Gap(9, 500, 560), own.evaluate(seen, Gap(9, 500, 560)))
    assert np.linalg.norm(found.positions - positions[500:560, 9], axis=1).mean() < 10
    assert (found.deviation > 0).all()
    assert sum(found.weights.values()) == pytest.approx(1)


def test_what_pseudo_gaps_miss_is_judged_without_themselves(walker):
    seen, own = scene(walker.recording.positions), ensemble(["local_ridge", "spline"], prior=2)
    weights = own.evaluate(seen, Gap(9, 500, 520))
    assert len(weights.standardized_errors) == own.options.pseudo_gaps
    assert all(len(part) == 20 for part in weights.standardized_errors)
    # One pseudo-gap tells nothing about itself: it is judged by what is believed before.
    alone = ensemble(["local_ridge"], prior=2, pseudo_gaps=1).evaluate(seen, Gap(9, 500, 520))
    (square,) = [(part**2).mean() / 3 for part in alone.standardized_errors]
    assert alone.deviation_scale == pytest.approx(np.sqrt((2 + square) / 3))


def test_a_fallback_is_asked_only_where_no_other_can_tell(walker):
    positions = walker.recording.positions[:800].copy()
    near = [int(other) for other in scene(positions).neighbours[7]]
    names = ["local_ridge", "linear_regression"]
    last, alike = (ensemble(names, fallback=each) for each in (["linear_regression"], []))
    alone = scene(positions)
    usual = last.fill(alone, Gap(7, 300, 330), last.evaluate(alone, Gap(7, 300, 330)))
    assert list(usual.weights) == ["local_ridge"]
    assert len(alike.fill(alone, Gap(7, 300, 330), alike.evaluate(alone, Gap(7, 300, 330))).weights) == 2
    positions[300:330, near[2:]] = np.nan
    few = scene(positions)
    found = last.fill(few, Gap(7, 300, 330), last.evaluate(few, Gap(7, 300, 330)))
    assert list(found.weights) == ["linear_regression"]
    assert np.isfinite(found.deviation).all()


def test_gaps_of_many_sorts_are_judged_as_those_most_alike(walker):
    positions = walker.recording.positions[:400].copy()
    near = [int(other) for other in scene(positions).neighbours[7]]
    places = [(40 + 30 * k, near[: k + 1]) for k in range(6)]
    for start, lost in places:
        positions[start : start + 10, [7, *lost]] = np.nan
    seen, own, known = scene(positions), ensemble(["spline"], most_sorts=4), []
    for start, lost in places[:4]:
        known.append(own.kind(seen, Gap(7, start, start + 10), known))
        assert known[-1].absent == set(lost)
    assert own.kind(seen, Gap(7, places[5][0], places[5][0] + 10), known) == known[3]
    assert own.kind(seen, Gap(7, places[1][0], places[1][0] + 10), known) == known[1]
    assert own.kind(seen, Gap(8, 40, 50), known).marker == 8


def test_a_rigid_body_is_filled_exactly():
    positions = rigid_body()
    seen, own = scene(positions), ensemble()
    found = own.fill(seen, Gap(2, 100, 150), own.evaluate(seen, Gap(2, 100, 150)))
    assert np.linalg.norm(found.positions - positions[100:150, 2], axis=1).max() < 0.1


def test_wrong_settings_are_refused():
    with pytest.raises(ValueError, match="unknown weights"):
        ensemble(weights="best")
    own = ensemble(["spline"])
    with pytest.raises(ValueError, match="differ"):
        Ensemble([predictor("spline")], [predictor("linear")], own.options)
