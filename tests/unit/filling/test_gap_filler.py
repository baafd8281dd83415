"""The gap filler: what a filling is an input for, and which are refused after calibration."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from markermend.core.reasons import Cause
from markermend.filling.ensemble import Ensemble
from markermend.filling.error_limits import ErrorLimits
from markermend.filling.gap import Gap
from markermend.filling.gap_filler import GapFiller
from markermend.filling.growing_scene import GrowingScene
from markermend.prediction.interface import Prediction
from support.fillings import ensemble_options, fill_options, rigid_body, scene

FIRST, SECOND, OTHER = Gap(1, 100, 110), Gap(1, 150, 160), Gap(4, 100, 110)
NO_LIMITS = ErrorLimits()
STRETCH = Gap(1, 100, 121)


@dataclass
class Recorder:
    """Predicts the origin with a stated error, by marker, and records the scenes in which it is asked."""

    errors: dict
    name: str = "recorder"
    continuous: bool = True
    scenes: list = field(default_factory=list)

    def predict(self, scene, marker, start, stop):
        self.scenes.append((marker, start, scene.present.copy()))
        n = stop - start + 2
        return Prediction(np.zeros((n, 3)), np.full(n, self.errors.get(marker, 1.0)))


def filled(
    errors=None,
    *,
    name="recorder",
    limits=NO_LIMITS,
    reuse=True,
    again=True,
    gaps=(FIRST, SECOND, OTHER),
    trials=0,
    pieces=(),
    kinds=12,
):
    member = Recorder(errors or {}, name)
    # Without pseudo-gaps the prior radii stand.
    ensemble = Ensemble([member], ensemble_options(pseudo_gaps=trials, max_gap_s_of_member={}, max_gap_kinds=kinds))
    positions = rigid_body()
    for gap in gaps:
        positions[gap.samples] = np.nan
    for frame, place in pieces:
        positions[frame, 1] = place
    growing = GrowingScene(scene(positions))
    filler = GapFiller(
        ensemble, limits=limits, options=fill_options(reuse_filled=reuse, fill_again=again, piece_tolerance=1.0)
    )
    return filler.fill(growing, gaps, dict.fromkeys(gaps, STRETCH) if pieces else {}), member, growing


def test_gaps_of_a_marker_see_none_of_them_filled_and_those_of_others():
    result, member, _ = filled()
    seen = {(marker, start): present for marker, start, present in member.scenes}
    assert not seen[1, 100][SECOND.samples].any() and not seen[1, 150][FIRST.samples].any()
    assert seen[4, 100][FIRST.samples].all() and seen[4, 100][SECOND.samples].all()
    assert list(result.accepted) == [FIRST, SECOND, OTHER] and not result.refused


@pytest.mark.parametrize(
    "changed",
    [
        {"reuse": False},
        {"name": "spline"},
        {"limits": ErrorLimits(1.0), "errors": {1: 2.0}},
        {"limits": ErrorLimits(None, 4.0), "errors": {1: 2.0}},
    ],
    ids=str,
)
def test_fillings_that_are_no_inputs(changed):
    _, member, growing = filled(**changed)
    assert not member.scenes[-1][2][FIRST.samples].any()
    assert not growing.current().present[FIRST.samples].any()


def test_too_uncertain_fillings_are_refused_with_the_limit():
    result, _, _ = filled({1: 2.0, 4: 0.5}, limits=ErrorLimits(1.0))
    assert list(result.accepted) == [OTHER] and list(result.refused) == [FIRST, SECOND]
    reason = result.refused[FIRST]
    assert (reason.cause, reason.limit.setting, reason.limit.value) == (Cause.UNCERTAIN, "fill.max_error_mm", 1.0)
    assert reason.limit.actual == pytest.approx(2.0 * result.radii[0])
    assert reason.text == f"expected error {reason.limit.actual:.3g} mm (fill.max_error_mm: 1)"


def test_what_cannot_be_filled_says_so():
    result, _, _ = filled({1: np.nan})
    assert list(result.accepted) == [OTHER]
    assert result.refused[FIRST].text == "the expected error of a filling is unknown"


def test_an_input_may_turn_out_too_uncertain_once_the_radii_are_calibrated():
    # The scale of the only gap's kind comes from its own pseudo-gaps, the radii from how these differ.
    result, _, growing = filled(trials=2, gaps=(FIRST,))
    deviation = result.accepted[FIRST].deviation.max()
    prior = ensemble_options().radius.inner
    assert result.radii[0] > prior
    limit = deviation * (prior + result.radii[0]) / 2
    result, _, growing = filled(trials=2, gaps=(FIRST,), limits=ErrorLimits(limit))
    assert list(result.refused) == [FIRST] and not result.accepted
    assert growing.current().present[FIRST.samples].all()


@pytest.mark.parametrize(("place", "widened"), [(3.0, False), (3.5, True)])
def test_a_short_piece_away_from_its_prediction_is_not_used(place, widened):
    """The piece lies at frame 110 between two gaps; the member predicts the origin with a standard deviation of 1 mm."""
    gaps = Gap(1, 100, 110), Gap(1, 111, 121)
    result, member, _ = filled(gaps=gaps, pieces=[(110, (place, 0, 0))])
    asked = [(start, bool(present[110, 1])) for _, start, present in member.scenes]
    assert asked == [(100, False), *([(100, False)] * 2 if widened else [(100, True), (111, True)])]
    assert [len(filling.positions) for filling in result.accepted.values()] == [10, 10]


def test_gaps_of_which_neighbours_were_filled_later_are_filled_again_with_the_same_expected_error():
    result, member, growing = filled({1: 2.0})
    assert [(marker, start) for marker, start, _ in member.scenes] == [(1, 100), (1, 150), (4, 100), (1, 100)]
    first, again = member.scenes[0][2], member.scenes[-1][2]
    assert not first[OTHER.samples].any() and again[OTHER.samples].all()
    assert not again[FIRST.samples].any() and not again[SECOND.samples].any()
    assert result.accepted[FIRST].deviation == pytest.approx(np.full(10, 2.0))
    assert growing.current().present.all()


def test_a_gap_whose_neighbours_were_all_seen_is_not_filled_again_where_another_kind_stands_in_for_its_own():
    _, member, _ = filled(kinds=1)
    assert [(marker, start) for marker, start, _ in member.scenes] == [(1, 100), (1, 150), (4, 100), (1, 100)]


@pytest.mark.parametrize("changed", [{"reuse": False}, {"again": False}], ids=str)
def test_without_filled_inputs_or_where_it_is_not_wanted_nothing_is_filled_again(changed):
    _, member, _ = filled(**changed)
    assert [(marker, start) for marker, start, _ in member.scenes] == [(1, 100), (1, 150), (4, 100)]
