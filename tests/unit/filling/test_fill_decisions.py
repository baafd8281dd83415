"""A person's decisions in filling: no limit holds against them, and no other gap changes by them."""

import numpy as np
import pytest

from markermend.core.decisions import EVER, Decision
from markermend.core.recording import MISSING
from markermend.filling.fill import fill_gaps
from support.fillings import ensemble, fill_options, neighbours, restored

MARKER, OTHER = 7, 12
GAP = (MARKER, 200, 240)
QUICK = ["local_ridge", "spline"]


@pytest.fixture(scope="module")
def person(walker):
    """Six seconds of the walker: positions, names, neighbours."""
    positions = walker.recording.positions[:600]
    return positions, walker.recording.markers, neighbours(positions)


def gapped(person, *gaps, **facts):
    damaged = person[0].copy()
    for marker, start, stop in gaps:
        damaged[start:stop, marker] = np.nan
    return restored(damaged, markers=person[1], **facts)


def fill(person, recording, decisions=(), alone=(), **changed):
    return fill_gaps(
        recording,
        person[2],
        ensemble=ensemble(QUICK),
        options=fill_options(**changed),
        decisions=decisions,
        alone={name: ensemble([name], longest_s={}) for name in alone},
    )


def decide(person, verb, value="", marker=MARKER, start=205, stop=206):
    return Decision(person[1][marker], start, stop, verb, value, "why")


@pytest.mark.parametrize(
    "limits",
    [
        {"max_gap_s": 0.1},
        {"max_error_mm": 0.001},
        {"max_altered_share": 0.00001},
        {"seen_share": 0.99},
        {"border_s": 2.5},
    ],
    ids=str,
)
def test_a_gap_that_a_person_accepts_is_filled_whatever_the_limits(person, limits):
    recording = gapped(person, GAP)
    assert fill(person, recording, **limits).facts["gaps_left"]
    result = fill(person, recording, [decide(person, "accept", "gap")], **limits)
    assert result.facts["gaps_left"] == []
    assert result.facts["fills"][0]["decisions"] == ["accept gap (why)"]
    assert np.linalg.norm((result.positions - person[0])[recording.missing], axis=1).max() < 30
    assert (result.error[recording.missing] > 0).all()


@pytest.mark.parametrize("verb", ["reject gap", "method leave", "protect"])
def test_a_gap_that_a_person_leaves_stays_open(person, verb):
    recording = gapped(person, GAP)
    result = fill(person, recording, [decide(person, *verb.split())])
    assert np.array_equal(result.positions, recording.positions, equal_nan=True)
    (left,) = result.facts["gaps_left"]
    assert (left["reason"], left["decisions"]) == (f"a person decided: {verb} (why)", [f"{verb} (why)"])


def test_a_gap_is_filled_by_the_persons_method_alone_even_where_it_is_no_member(person):
    recording = gapped(person, (MARKER, 200, 280))
    for method in ("spline", "linear_regression"):
        result = fill(person, recording, [decide(person, "method", method)], alone=[method])
        (entry,) = result.facts["fills"]
        assert (entry["method"], entry["weights"], entry["decisions"]) == (
            method,
            {method: 1.0},
            [f"method {method} (why)"],
        )


def test_a_method_of_repair_says_nothing_about_gaps(person):
    recording = gapped(person, GAP)
    plain, result = fill(person, recording), fill(person, recording, [decide(person, "method", "savitzky_golay")])
    assert np.array_equal(plain.positions, result.positions) and plain.facts == result.facts


@pytest.mark.parametrize("verb", ["accept gap", "method spline"])
def test_no_other_gap_changes_by_a_decision_to_fill(person, verb):
    recording = gapped(person, GAP, (OTHER, 210, 260), (MARKER, 400, 430))
    options = {"max_gap_s_of": {person[1][MARKER]: 0.35}}
    plain = fill(person, recording, **options)
    result = fill(person, recording, [decide(person, *verb.split())], alone=["spline"], **options)
    assert len(plain.facts["fills"]) == 2 and len(result.facts["fills"]) == 3
    others = np.ones(recording.missing.shape, bool)
    others[GAP[1] : GAP[2], MARKER] = False
    for one, other in ((plain.positions, result.positions), (plain.error, result.error)):
        assert np.array_equal(one[others], other[others], equal_nan=True)


@pytest.mark.parametrize(
    ("gap", "facts", "options"),
    [((MARKER, 0, 600), {}, {}), (GAP, {"kind": "static"}, {}), (GAP, {}, {"protect": ["*"]})],
    ids=["never seen", "static", "protected by a setting"],
)
def test_what_no_person_can_change(person, gap, facts, options):
    recording = gapped(person, gap, **facts)
    result = fill(person, recording, [decide(person, "accept", "gap")], **options)
    assert (result.origin[gap[1] : gap[2], MARKER] == MISSING).all() and not result.facts["fills"]


def test_decisions_on_other_markers_and_frames_change_nothing(person):
    recording = gapped(person, GAP, (OTHER, 210, 260))
    decided = [
        Decision("nobody", -EVER, EVER, "accept", "gap"),
        decide(person, "reject", "gap", start=0, stop=200),
        decide(person, "method", "leave", start=240, stop=600),
        decide(person, "reject"),
    ]
    plain, result = fill(person, recording), fill(person, recording, decided)
    assert np.array_equal(plain.positions, result.positions) and plain.facts == result.facts
