"""Soft bone lengths: the least energy, its curvature, and where a marker goes; the predictor on a body."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from markermend.filling.constraints import constrain_time
from markermend.prediction.scene import Scene
from markermend.prediction.state_space.bolero import Bolero
from markermend.prediction.state_space.bone_lengths import BoneLengths, Bones, steady_bones
from support.fillings import predictor, rigid_body, scene
from unit.prediction.state_space.test_linear_dynamics import draw, small_system


def bent(seed=4, frames=6):
    """A small system, its positions with holes, and bones that do not quite agree with it."""
    system = small_system(seed)
    observed = draw(system, frames, seed=seed)
    whole = observed.copy()
    observed[2:5, 0] = np.nan
    observed[3, 1] = np.nan
    pairs = np.array([(0, 1), (0, 2), (0, 3), (1, 4)])
    length = np.linalg.norm(whole[:, pairs[:, 0]] - whole[:, pairs[:, 1]], axis=2).mean(axis=0)
    return system, observed, Bones(pairs, length, np.array([0.1, 0.2, 0.1, 0.3])), np.arange(1, 6)


def residuals(system, observed, bones, rows, vector):
    """The energy's terms, written down one by one: half their squares sum to it, up to a constant."""
    size = len(system.start)
    states = vector[: len(observed) * size].reshape(-1, size)
    positions = observed.copy()
    positions[np.isnan(observed)] = vector[len(observed) * size :]
    terms = [states[0] / np.sqrt(system.start)]
    root = np.linalg.cholesky(np.linalg.inv(system.drive)).T
    terms += [root @ (after - system.transition @ state) for state, after in pairwise(states)]
    terms.append(((positions - system.positions(states)) / np.sqrt(system.noise)[:, None]).reshape(-1))
    for t in rows:
        for (a, b), length, deviation in zip(bones.pairs, bones.length, bones.deviation, strict=True):
            if np.isnan(observed[t, [a, b]]).any():
                apart = np.linalg.norm(positions[t, a] - positions[t, b])
                terms.append([(apart - length) / deviation])
    return np.concatenate(terms)


def test_settling_finds_the_least_energy_and_its_curvature():
    from scipy.optimize import least_squares

    system, observed, bones, rows = bent()
    states = system.smooth(observed).mean
    guess = np.concatenate([states.reshape(-1), system.positions(states)[np.isnan(observed)]])
    best = least_squares(lambda v: residuals(system, observed, bones, rows, v), guess, xtol=1e-12, ftol=1e-12)
    lengths = BoneLengths(system, observed, bones, rows)
    found, positions = lengths.settle(states, iterations=100, tolerance=1e-9)
    vector = np.concatenate([found.reshape(-1), positions[np.isnan(observed[rows])]])
    assert np.allclose(vector, best.x, atol=1e-5)
    both = [
        lengths.energy(states, np.where(lengths.missing[..., None], system.positions(states)[rows], observed[rows]))
    ]
    both.append(lengths.energy(found, positions))
    squares = [0.5 * (residuals(system, observed, bones, rows, v) ** 2).sum() for v in (guess, best.x)]
    assert np.isclose(both[1] - both[0], squares[1] - squares[0]) and both[1] < both[0] - 1e-3
    covariance = np.linalg.inv(best.jac.T @ best.jac)
    here = len(states) * states.shape[1]  # the missing coordinates of marker 0 at frame 2 come first
    assert np.allclose(lengths.covariance(positions, 0)[1], covariance[here : here + 3, here : here + 3], atol=1e-4)


def test_the_energy_never_rises_even_from_far_away():
    system, observed, bones, rows = bent(seed=6)
    lengths = BoneLengths(system, observed, replace(bones, deviation=bones.deviation / 50), rows)
    states = system.smooth(observed).mean + 3.0
    energies = []
    for steps in range(12):
        energies.append(lengths.energy(*lengths.settle(states, iterations=steps, tolerance=0.0)))
    assert (np.diff(energies) <= 1e-9).all() and energies[-1] < 0.5 * energies[0] + 0.5 * min(0.0, energies[0])


def test_bones_carry_a_marker_whose_course_tells_nothing_onto_its_spheres():
    """A marker that moves on its own is placed by its distances to three others, on the side where it was."""
    rng = np.random.default_rng(7)
    frames = 60
    still = np.array([[0, 0, 0], [100.0, 0, 0], [0, 100, 0]])
    angle = np.linspace(0, 2 * np.pi, frames)
    base = 40 * np.stack([np.sin(angle), np.cos(2 * angle), np.sin(3 * angle)], axis=1)
    whole = np.concatenate([np.tile([30.0, 30, 80], (frames, 1, 1)), np.tile(still, (frames, 1, 1))], axis=1)
    whole += base[:, None]
    others = np.delete(np.arange(4), 0)
    body = Scene(whole, 100.0, [np.delete(np.arange(4), m) for m in range(4)])
    bones = steady_bones(body, np.arange(4), np.array([0]), count=3, frames=50, minimum_frames=10)
    assert np.allclose(bones.length, np.linalg.norm(still[bones.pairs[:, 1] - 1] - [30, 30, 80], axis=1))
    # The marker's place is three states of its own, which drift; the others are known without it.
    own = small_system(size=3, markers=4)
    loading = np.zeros((4, 3, 3))
    loading[0] = np.eye(3)
    drift = replace(
        own,
        start=np.full(3, 1e4),
        transition=np.eye(3),
        drive=25.0 * np.eye(3),
        loading=loading,
        middle=np.zeros((4, 3)),
        noise=np.full(4, 1.0),
    )
    observed = whole + rng.normal(size=whole.shape) * 0.1
    observed[20:45, 0] = np.nan
    rows = np.arange(20, 45)
    states = drift.smooth(observed).mean
    lost = np.linalg.norm(states[rows] - whole[rows, 0], axis=1)
    lengths = BoneLengths(drift, observed, bones.scaled(1.0, 0.5), rows)
    _, positions = lengths.settle(states, iterations=30, tolerance=1e-6)
    assert lost.max() > 20
    assert np.linalg.norm(positions[:, 0] - whole[rows, 0], axis=1).max() < 2
    assert np.array_equal(positions[:, others], observed[rows][:, others])


def mean_error(found, positions, marker, start, stop):
    course = constrain_time(found.positions, positions[[start - 1, stop], marker])[1:-1]
    return np.linalg.norm(course - positions[start:stop, marker], axis=1).mean()


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


def test_too_little_to_learn_from_tells_nothing():
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
