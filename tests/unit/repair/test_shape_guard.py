"""A repair must bring the distances to the steadiest neighbours nearer to what they should be."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.reasons import Cause
from markermend.options.repair import ShapeGuardOptions
from markermend.prediction.scene import Scene
from markermend.repair.shape_guard import ShapeGuard
from support.repairs import MARKER, RIDGE, START, STOP, body, neighbours_of, usual_shape

OPTIONS = ShapeGuardOptions(mates=5)


@pytest.fixture(scope="module")
def recording():
    """A chain of rigid segments with a little noise."""
    return body()


def guard_of(recording, **changes):
    """The guard of a recording without the finding."""
    m = recording.markers.index(MARKER)
    positions = recording.positions.copy()
    positions[START:STOP, m] = np.nan
    scene = Scene(positions, recording.rate, neighbours_of(recording), shape=usual_shape(recording.positions))
    return ShapeGuard(replace(scene, **changes), OPTIONS, RIDGE, recording.markers), m


def test_a_repair_that_restores_the_distances_stands(recording):
    guard, m = guard_of(recording)
    true = recording.positions[START:STOP, m]
    assert guard.objection(m, START, true + 5.0, true) is None
    assert guard.why_kept(m, START, true + 5.0) is None


def test_a_repair_of_what_is_usual_is_objected_to(recording):
    guard, m = guard_of(recording)
    true = recording.positions[START:STOP, m]
    reason = guard.objection(m, START, true, true + 5.0)
    assert reason.cause is Cause.AGAINST_SHAPE and "(2" in reason.text and "measured" in reason.text
    assert guard.objection(m, START, true, true).cause is Cause.AGAINST_SHAPE
    assert guard.why_kept(m, START, true).startswith("the distances to its neighbours are usual (")


def test_the_right_one_of_two_levels_is_clearly_wrong_by_the_usual_distances_only(recording):
    guard, m = guard_of(recording)
    true = recording.positions[START:STOP, m]
    assert guard.objection_to_level(m, START, true + 5.0, true) is None
    assert guard.objection_to_level(m, START, true, true) is None
    assert guard.objection_to_level(m, START, true, true + 30.0).cause is Cause.AGAINST_SHAPE
    unknown = replace(guard, scene=replace(guard.scene, shape=None))
    assert unknown.objection_to_level(m, START, true, true + 30.0) is None


def test_a_mate_that_is_itself_off_does_not_decide(recording):
    guard, m = guard_of(recording)
    positions = guard.scene.positions.copy()
    positions[START:STOP, recording.markers.index("2a")] += 300.0
    guard = replace(guard, scene=replace(guard.scene, positions=positions))
    true = recording.positions[START:STOP, m]
    assert guard.objection(m, START, true + 5.0, true) is None
    assert guard.objection(m, START, true, true + 5.0) is not None


def test_a_mate_that_moves_along_does_not_decide(recording):
    """A repair of a short artifact stands though one of the steadiest mates is displaced with the marker."""
    guard, m = guard_of(recording)
    first, stop = START, START + 4
    positions, true = guard.scene.positions.copy(), recording.positions[first:stop, m]
    moved = guard.distances.expected(m, first, stop).mates[0]
    positions[first:stop, moved] += 5.0
    guard = replace(guard, scene=replace(guard.scene, positions=positions))
    assert guard.objection(m, first, true + 5.0, true) is None
    strict = replace(guard, options=replace(OPTIONS, clear_gain=1e9))
    assert strict.objection(m, first, true + 5.0, true) is None


def test_a_repair_beside_the_distances_is_objected_to(recording):
    """It brings most distances nearer, but by less than it changes them."""
    guard, m = guard_of(recording)
    strict = replace(guard, options=replace(OPTIONS, clear_gain=1e9))
    true = recording.positions[START:STOP, m]
    along, across = np.array([3.0, 0.0, 0.0]), np.array([0.0, 3.0, 0.0])
    assert strict.objection(m, START, true + along, true + 0.97 * across) is not None
    assert strict.objection(m, START, true + along, true + 0.02 * across) is None


def test_where_too_few_distances_are_steadier_than_the_repair_is_large_it_stands(recording):
    guard, m = guard_of(recording)
    far = [i for i, name in enumerate(recording.markers) if name[0] in "04"]
    shape = guard.scene.shape
    unknown = np.full_like(shape.deviation, np.nan)
    unknown[m, far] = shape.deviation[m, far]
    soft = replace(guard, scene=replace(guard.scene, shape=replace(shape, deviation=unknown)))
    true, first = recording.positions[START:STOP, m], 15
    assert soft.objection(m, START + first, true[first:25], true[first:25] + 4.0) is None
    assert guard.objection(m, START + first, true[first:25], true[first:25] + 4.0) is not None


def test_a_rare_pose_is_no_objection(recording):
    """The distances before and after say what is right, whatever is usual."""
    guard, m = guard_of(recording)
    true, shape = recording.positions[START : START + 4, m], guard.scene.shape
    measured = true + np.array([12.0, 0.0, 0.0])
    distance = shape.distance.copy()
    mates = guard.distances.expected(m, START, START + 4).mates
    distance[m, mates] = np.linalg.norm(measured[0] - recording.positions[START, mates], axis=1)
    guard = replace(guard, scene=replace(guard.scene, shape=replace(shape, distance=distance)))
    assert guard.objection(m, START, measured, true) is None


def test_without_mates_or_shape_nothing_is_objected_to(recording):
    true = recording.positions[START:STOP, recording.markers.index(MARKER)]
    for changes in ({"shape": None}, {"positions": np.full_like(recording.positions, np.nan)}):
        guard, m = guard_of(recording, **changes)
        assert guard.objection(m, START, true, true + 50.0) is None and guard.why_kept(m, START, true) is None


def test_missing_samples_and_mates_do_not_count(recording):
    guard, m = guard_of(recording)
    measured = recording.positions[START:STOP, m] + 5.0
    measured[:10] = np.nan
    assert guard.objection(m, START, measured, recording.positions[START:STOP, m]) is None
    measured[:] = np.nan
    assert guard.objection(m, START, measured, recording.positions[START:STOP, m]) is None


def shaken(recording, true):
    """A wobble of 8 Hz and 4 mm."""
    time = np.arange(len(true)) / recording.rate
    return true + 4.0 * np.sin(2 * np.pi * 8.0 * time)[:, None] * np.array([0.6, 0.64, 0.48])


def test_a_repair_that_takes_shaking_out_of_vague_distances_stands(recording):
    guard, m = guard_of(recording)
    vague = replace(guard, options=replace(OPTIONS, min_deviation_mm=1.5, min_gain_share=1.0, min_gain=10.0))
    true = recording.positions[START:STOP, m]
    measured = shaken(recording, true)
    assert vague.objection(m, START, measured, true) is None
    assert vague.objection(m, START, true, measured) is not None
    for strict in ({"max_shaking_left": 0.0}, {"max_shaking_mm": 1.0}):
        guard = replace(vague, options=replace(vague.options, **strict))
        assert guard.objection(m, START, measured, true) is not None


def test_a_repair_that_shifts_a_marker_takes_no_shaking_away(recording):
    guard, m = guard_of(recording)
    vague = replace(guard, options=replace(OPTIONS, min_deviation_mm=1.5, min_gain_share=1.0, min_gain=10.0))
    true = recording.positions[START:STOP, m]
    assert vague.objection(m, START, shaken(recording, true), true + 4.0) is not None


def test_distances_to_mates_that_are_hardly_seen_do_not_say_that_a_marker_shakes_less(recording):
    """Of five mates four are seen in one frame each; the marker shakes as much as before."""
    guard, m = guard_of(recording)
    vague = replace(OPTIONS, min_deviation_mm=1.5, min_gain_share=1.0, min_gain=10.0)
    true = recording.positions[START:STOP, m]
    measured = shaken(recording, true)
    mates = guard.distances.expected(m, START, STOP).mates
    positions = guard.scene.positions.copy()
    for frame, mate in enumerate(mates[1:]):
        positions[START : START + frame, mate] = np.nan
        positions[START + frame + 1 : STOP, mate] = np.nan
    guard = replace(guard, options=vague, scene=replace(guard.scene, positions=positions))
    assert guard.objection(m, START, measured, 2 * true - measured) is not None
