"""Candidates: which members predict a gap, and what the time constraint makes of their predictions."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from markermend.filling.candidates import predict_candidates
from markermend.filling.gap import Gap
from markermend.prediction.interface import Prediction
from support.fillings import ensemble_options, predictor, rigid_body, scene
from support.naive.numerics import symmetric_smoothing

GAP = Gap(2, 100, 120)


@dataclass
class Fixed:
    """Predicts one position throughout, or nothing in the first frames."""

    name: str
    value: float
    continuous: bool = True
    missing: int = 0
    asked: list = field(default_factory=list)

    def predict(self, scene, marker, start, stop):
        self.asked.append((start, stop))
        positions = np.full((stop - start + 2, 3), self.value)
        positions[: self.missing + 1 if self.missing else 0] = np.nan
        return Prediction(positions, np.full(len(positions), 1.0))


@pytest.fixture
def seen():
    positions = rigid_body()
    positions[GAP.samples] = np.nan
    return scene(positions)


def candidates(members, seen, gap=GAP, **changed):
    options = ensemble_options(**{"max_gap_s_of_member": {}, "fallback_members": (), **changed})
    return predict_candidates(members, seen, gap, options=options)


def test_members_predict_in_their_order(seen):
    found = candidates([Fixed("a", 1.0), Fixed("b", 2.0)], seen)
    assert found.positions.shape == (2, 20, 3) and found.errors.shape == (2, 20)
    assert (found.positions[0] == 1).all() and (found.positions[1] == 2).all() and (found.errors == 1).all()


def test_members_that_are_not_continuous_meet_the_borders(seen):
    found = candidates([Fixed("a", 1.0, continuous=False)], seen).positions[0]
    before, after = seen.positions[99, 2], seen.positions[120, 2]
    for n in range(20):
        assert np.allclose(found[n], before + (n + 1) / 21 * (after - before))


def test_a_member_predicts_no_longer_gaps_than_it_may(seen):
    short = Fixed("a", 1.0)
    assert np.isfinite(candidates([short], seen, max_gap_s_of_member={"a": 0.2}).positions).all()
    assert np.isnan(candidates([short], seen, max_gap_s_of_member={"a": 0.19}).positions).all()
    assert len(short.asked) == 1


@pytest.mark.parametrize(
    ("others", "asked"),
    [
        ([Fixed("b", 2.0)], 0),
        ([Fixed("b", 2.0, missing=3)], 1),
        ([Fixed("spline", 2.0)], 1),
        ([], 1),
        ([Fixed("b", 2.0, missing=3), Fixed("c", 2.0)], 0),
    ],
)
def test_a_fallback_predicts_only_where_no_other_predicts_all_from_neighbours(others, asked, seen):
    last = Fixed("a", 1.0)
    candidates([last, *others], seen, fallback_members=("a",))
    assert len(last.asked) == asked


def test_without_the_time_constraint_predictions_stay_as_they_are(seen):
    found = candidates([Fixed("a", 1.0, continuous=False)], seen, time_constraint="off").positions[0]
    assert (found == 1).all()


@pytest.mark.parametrize("name", ["local_quadratic", "local_grnn"])
def test_the_ramp_is_subtracted_in_the_local_frame_of_members_that_have_one(name, seen):
    member = predictor(name)
    found = candidates([member, Fixed("b", 1.0, continuous=False)], seen, time_constraint="local").positions
    assert np.array_equal(found[0], member.predict_continuous(seen, 2, 100, 120).positions[1:-1])
    assert np.allclose(found[1], candidates([Fixed("b", 1.0, continuous=False)], seen).positions[0])


def test_several_members_are_smoothed_each_and_one_alone_is_not(seen):
    @dataclass
    class Rough(Fixed):
        def predict(self, scene, marker, start, stop):
            shape = stop - start + 2, 3
            return Prediction(np.random.default_rng(3).normal(size=shape), np.ones(shape[0]))

    rough = Rough("a", 1.0)
    raw = rough.predict(seen, 2, 100, 120).positions
    alone = candidates([rough], seen, member_smoothing_s=0.07).positions[0]
    together = candidates([rough, Fixed("b", 1.0)], seen, member_smoothing_s=0.07).positions[0]
    assert np.array_equal(alone, raw[1:-1])
    assert np.allclose(together, symmetric_smoothing(raw, 7)[1:-1])
