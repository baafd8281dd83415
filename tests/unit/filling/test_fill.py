"""What is filled and what stays open, with reasons; measured samples never change."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.recording import FILLED, MEASURED, MISSING, ORIGINS
from markermend.filling.fill import fill_gaps
from support.fillings import ensemble, fill_options, neighbours, restored, rigid_body

QUICK = ["local_ridge", "local_interpolation", "spline"]


def fill(recording, near, members=QUICK, settings=None, **changed):
    options = fill_options(**changed)
    return fill_gaps(recording, near, ensemble=ensemble(members, **(settings or {})), options=options)


@pytest.fixture(scope="module")
def person(walker):
    """Six seconds of the walker: positions, names, neighbours."""
    positions = walker.recording.positions[:600]
    return positions, walker.recording.markers, neighbours(positions)


@pytest.fixture(scope="module")
def torso(person):
    """The first twelve markers alone."""
    positions = person[0][:, :12]
    return positions, person[1][:12], neighbours(positions)


def gapped(person, *gaps):
    positions, markers, _ = person
    damaged = positions.copy()
    for marker, start, stop in gaps:
        damaged[start:stop, marker] = np.nan
    return restored(damaged, markers=markers)


def reasons(result):
    return {entry["marker"]: entry["reason"] for entry in result.facts["gaps_left"]}


def test_gaps_are_filled_and_nothing_else_changes(person):
    recording = gapped(person, (7, 200, 240), (12, 220, 300), (7, 400, 405))
    before = recording.positions.copy()
    result = fill(recording, person[2])
    assert np.array_equal(recording.positions, before, equal_nan=True)
    missing = recording.missing
    assert np.array_equal(result.positions[~missing], before[~missing])
    assert (result.origin[missing] == FILLED).all() and (result.origin[~missing] == MEASURED).all()
    assert (result.error[missing] > 0).all() and (result.error95[missing] > result.error[missing]).all()
    assert (result.error[~missing] == 0).all()
    assert np.linalg.norm((result.positions - person[0])[missing], axis=1).mean() < 10
    filled = [(entry["marker"], entry["start"], entry["stop"]) for entry in result.facts["fills"]]
    assert sorted(filled) == sorted((person[1][m], a, b) for m, a, b in ((7, 200, 240), (7, 400, 405), (12, 220, 300)))
    for entry in result.facts["fills"]:
        assert sum(entry["weights"].values()) == pytest.approx(1, abs=0.01)
    assert result.facts["gaps_left"] == []


def test_a_complete_recording_comes_back_as_it_was(person):
    result = fill(gapped(person), person[2])
    assert np.array_equal(result.positions, person[0])
    assert result.facts["fills"] == [] and result.facts["gaps_left"] == []


@pytest.mark.parametrize(
    ("gap", "changed", "reason"),
    [
        ((7, 100, 350), {}, "gap of 2.50 s, longest to fill 2 s"),
        ((7, 0, 20), {}, "at the recording's start"),
        ((7, 590, 600), {}, "at the recording's end"),
        ((7, 0, 600), {}, "never seen"),
        ((7, 50, 500), {}, "marker seen in 25% of the frames, 30% needed"),
        ((7, 200, 220), {"protect": ["?SI", "NECK", "*"]}, "protected marker"),
        ((7, 200, 220), {"max_error_mm": 0.01}, "expected error"),
        ((7, 1, 20), {"border_s": 0.05}, "not seen for 0.05 s on both sides"),
        ((7, 200, 220), {"max_altered_share": 0.0001}, "nothing filled: 0% of the recording would be altered"),
    ],
)
def test_what_stays_open_says_why(person, gap, changed, reason):
    recording = gapped(person, gap)
    result = fill(recording, person[2], **changed)
    assert reasons(result)[person[1][7]].startswith(reason)
    assert np.array_equal(result.positions, recording.positions, equal_nan=True)
    assert (result.origin[gap[1] : gap[2], 7] == MISSING).all()
    assert np.isnan(result.error[gap[1] : gap[2], 7]).all()


def test_a_marker_that_repair_took_away_was_seen(person):
    recording = gapped(person, (7, 0, 600))
    name = person[1][7]
    result = fill(replace(recording, facts={"repairs_left": [{"marker": name}]}), person[2])
    assert reasons(result) == {name: "nothing of it was left to learn from"}


def test_a_static_recording_is_not_touched(person):
    recording = gapped(person, (7, 200, 220))
    result = fill(replace(recording, facts={"kind": "static"}), person[2])
    assert reasons(result) == {person[1][7]: "static recording"}


def test_the_longest_gap_may_differ_by_marker(person):
    names = person[1]
    recording = gapped(person, (7, 200, 260), (12, 200, 260))
    result = fill(recording, person[2], max_gap_s=0.1, max_gap_s_of={names[7]: 1.0})
    assert [entry["marker"] for entry in result.facts["fills"]] == [names[7]]
    assert names[12] in reasons(result)
    assert not fill(recording, person[2], max_gap_s=None).facts["gaps_left"]


def test_ends_are_filled_on_request(person):
    recording = gapped(person, (7, 0, 30), (12, 570, 600))
    result = fill(recording, person[2], ends=True)
    assert len(result.facts["fills"]) == 2
    assert np.linalg.norm((result.positions - person[0])[recording.missing], axis=1).mean() < 25


def test_a_blackout_stays_open_unless_short_enough_to_interpolate(torso):
    everything = range(torso[0].shape[1])
    long = gapped(torso, *((m, 200, 290) for m in everything))
    result = fill(long, torso[2])
    assert len(result.facts["gaps_left"]) == len(everything)
    assert set(reasons(result).values()) == {"no method could fill it; fewest neighbours seen: 0"}
    short = gapped(torso, *((m, 200, 204) for m in everything))
    result = fill(short, torso[2])
    assert not result.facts["gaps_left"]
    assert {entry["method"] for entry in result.facts["fills"]} == {"spline"}
    assert np.linalg.norm((result.positions - torso[0])[200:204], axis=2).max() < 10


def test_twenty_concurrent_gaps_are_all_filled(person):
    rng = np.random.default_rng(3)
    recording = gapped(person, *((m, 250, 290) for m in rng.permutation(person[0].shape[1])[:20]))
    result = fill(recording, person[2])
    assert len(result.facts["fills"]) == 20
    assert np.linalg.norm((result.positions - person[0])[recording.missing], axis=1).mean() < 40


def test_no_marker_need_be_complete_and_reuse_is_optional(torso):
    everything = range(torso[0].shape[1])
    recording = gapped(torso, *((m, 20 + 10 * m, 32 + 10 * m) for m in everything))
    for reuse in (True, False):
        result = fill(recording, torso[2], settings={"pseudo_gaps": 2}, reuse=reuse)
        assert len(result.facts["fills"]) == len(everything)
        assert np.linalg.norm((result.positions - torso[0])[recording.missing], axis=1).mean() < 8


def test_eight_markers_are_enough():
    positions = rigid_body(frames=400, markers=8)
    damaged = positions.copy()
    damaged[100:160, 2] = np.nan
    damaged[130:200, 5] = np.nan
    result = fill(restored(damaged), neighbours(positions))
    assert np.abs(result.positions - positions).max() < 0.5


def test_repaired_samples_keep_their_origin(person):
    recording = gapped(person, (7, 200, 220))
    origin = recording.origin.copy()
    origin[100:110, 7] = ORIGINS.index("peak")
    result = fill(replace(recording, origin=origin), person[2])
    assert (result.origin[100:110, 7] == ORIGINS.index("peak")).all()


def test_the_result_is_the_same_every_time(person):
    recording = gapped(person, (7, 200, 240), (12, 220, 300))
    first, second = fill(recording, person[2]), fill(recording, person[2])
    assert np.array_equal(first.positions, second.positions)
    assert first.facts == second.facts
