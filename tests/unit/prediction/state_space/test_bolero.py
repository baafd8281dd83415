"""The linear dynamical system with bone lengths as a predictor, on bodies."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.filling.constraints import constrain_time
from markermend.prediction.scene import Scene
from markermend.prediction.state_space.bolero import Bolero
from support.fillings import predictor, rigid_body, scene


def mean_error(found, positions, marker, start, stop):
    trajectory = constrain_time(found.positions, positions[[start - 1, stop], marker])[1:-1]
    return np.linalg.norm(trajectory - positions[start:stop, marker], axis=1).mean()


def test_bones_help_on_a_body(walker):
    positions = walker.recording.positions[:600]
    without = Bolero(replace(predictor("bolero").options, bones=0))
    seen = scene(positions)
    errors = []
    for marker in (5, 12, 20):
        for start in (150, 350):
            pair = [method.predict(seen, marker, start, start + 60) for method in (predictor("bolero"), without)]
            assert all(np.isfinite(found.positions).all() and (found.error > 0).all() for found in pair)
            errors.append([mean_error(found, positions, marker, start, start + 60) for found in pair])
    bone, alone = np.mean(errors, axis=0)
    assert bone < 0.9 * alone and bone < 25


@pytest.mark.parametrize("bones", [0, 3])
def test_a_blackout_has_a_finite_answer(bones, walker):
    positions = walker.recording.positions[:800].copy()
    seen = scene(positions)
    positions[300:340] = np.nan
    hidden = Scene(positions, 100.0, seen.neighbours)
    found = Bolero(replace(predictor("bolero").options, bones=bones)).predict(hidden, 9, 300, 340)
    assert np.isfinite(found.positions).all() and np.isfinite(found.error).all()
    assert found.error[20] > found.error[0]
    assert mean_error(found, walker.recording.positions, 9, 300, 340) < 100


def test_units_do_not_matter():
    positions = rigid_body(frames=300)
    positions += np.random.default_rng(8).normal(size=positions.shape)
    positions[140:150, 2] = np.nan
    near = scene(positions).neighbours
    found, small = (predictor("bolero").predict(Scene(positions * u, 100.0, near), 0, 120, 160) for u in (1.0, 1e-3))
    assert np.allclose(small.positions * 1e3, found.positions, atol=1e-4)
    assert np.allclose(small.error * 1e3, found.error, rtol=1e-4)


def test_too_few_training_frames_give_no_prediction():
    positions = rigid_body(frames=200)
    near = scene(positions).neighbours
    least = predictor("bolero").options.min_training_frames
    gapped = positions.copy()
    gapped[least // 2 : -(least // 2 - 1), 0] = np.nan
    found = predictor("bolero").predict(Scene(gapped, 100.0, near), 0, 60, 80)
    assert np.isnan(found.positions).all() and np.isnan(found.error).all()
    alone = Scene(positions, 100.0, [np.zeros(0, int)] * len(near))
    assert np.isnan(predictor("bolero").predict(alone, 0, 60, 80).positions).all()


def test_samples_in_the_gap_are_not_looked_at_and_windows_are_learned_once():
    positions = rigid_body(frames=400)
    near = scene(positions).neighbours
    member = predictor("bolero")
    spoiled = positions.copy()
    spoiled[100:130, 0] += 500
    expected = member.predict(scene(positions), 0, 100, 130)
    given = spoiled.copy()
    found = member.predict(Scene(spoiled, 100.0, near), 0, 100, 130)
    assert np.array_equal(found.positions, expected.positions) and np.array_equal(spoiled, given)
    gapped = positions.copy()
    gapped[100:130, 0] = gapped[180:200, 0] = np.nan
    hidden = Scene(gapped, 100.0, near)
    learned = []
    member._learn = lambda *given: learned.append(given) or Bolero._learn(member, *given)
    member.predict(hidden, 0, 100, 130)
    member.predict(hidden, 0, 180, 200)
    assert len(learned) == 1


@pytest.mark.parametrize(("start", "stop"), [(0, 20), (280, 300)])
def test_gaps_at_the_ends_leave_the_border_outside_open(start, stop):
    positions = rigid_body()
    found = predictor("bolero").predict(scene(positions), 0, start, stop)
    outside = 0 if start == 0 else -1
    inside = slice(1, None) if start == 0 else slice(None, -1)
    assert np.isnan(found.positions[outside]).all() and np.isnan(found.error[outside])
    assert np.linalg.norm(found.positions[inside] - positions[max(start - 1, 0) : stop + 1, 0], axis=1).max() < 20
