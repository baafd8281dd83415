"""Soft bone lengths: the least energy, its curvature, and where a marker goes."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from markermend.prediction.scene import Scene
from markermend.prediction.state_space.bone_lengths import Bones, select_bones
from markermend.prediction.state_space.constrained_smoother import BoneConstrainedSmoother
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
    size = len(system.initial_variance)
    states = vector[: len(observed) * size].reshape(-1, size)
    positions = observed.copy()
    positions[np.isnan(observed)] = vector[len(observed) * size :]
    terms = [states[0] / np.sqrt(system.initial_variance)]
    root = np.linalg.cholesky(np.linalg.inv(system.process_noise)).T
    terms += [root @ (after - system.transition @ state) for state, after in pairwise(states)]
    terms.append(((positions - system.positions(states)) / np.sqrt(system.observation_noise)[:, None]).reshape(-1))
    for t in rows:
        for (a, b), length, deviation in zip(bones.pairs, bones.length, bones.deviation, strict=True):
            if np.isnan(observed[t, [a, b]]).any():
                apart = np.linalg.norm(positions[t, a] - positions[t, b])
                terms.append([(apart - length) / deviation])
    return np.concatenate(terms)


def test_the_minimum_and_its_curvature_are_found():
    from scipy.optimize import least_squares

    system, observed, bones, rows = bent()
    states = system.smooth(observed).mean
    guess = np.concatenate([states.reshape(-1), system.positions(states)[np.isnan(observed)]])
    best = least_squares(lambda v: residuals(system, observed, bones, rows, v), guess, xtol=1e-12, ftol=1e-12)
    lengths = BoneConstrainedSmoother(system, observed, bones, rows)
    found, positions = lengths.minimise(states, iterations=100, tolerance=1e-9)
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
    lengths = BoneConstrainedSmoother(system, observed, replace(bones, deviation=bones.deviation / 50), rows)
    states = system.smooth(observed).mean + 3.0
    energies = []
    for steps in range(12):
        energies.append(lengths.energy(*lengths.minimise(states, iterations=steps, tolerance=0.0)))
    assert (np.diff(energies) <= 1e-9).all() and energies[-1] < 0.5 * energies[0] + 0.5 * min(0.0, energies[0])


def test_bones_constrain_a_marker_without_other_information_to_its_spheres():
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
    bones = select_bones(body, np.arange(4), np.array([0]), count=3, max_frames=50, min_frames=10)
    assert np.allclose(bones.length, np.linalg.norm(still[bones.pairs[:, 1] - 1] - [30, 30, 80], axis=1))
    # The marker's place is three states of its own, which drift; the others are known without it.
    own = small_system(size=3, markers=4)
    loading = np.zeros((4, 3, 3))
    loading[0] = np.eye(3)
    drift = replace(
        own,
        initial_variance=np.full(3, 1e4),
        transition=np.eye(3),
        process_noise=25.0 * np.eye(3),
        loading=loading,
        offset=np.zeros((4, 3)),
        observation_noise=np.full(4, 1.0),
    )
    observed = whole + rng.normal(size=whole.shape) * 0.1
    observed[20:45, 0] = np.nan
    rows = np.arange(20, 45)
    states = drift.smooth(observed).mean
    lost = np.linalg.norm(states[rows] - whole[rows, 0], axis=1)
    lengths = BoneConstrainedSmoother(drift, observed, bones.rescaled(1.0, 0.5), rows)
    _, positions = lengths.minimise(states, iterations=30, tolerance=1e-6)
    assert lost.max() > 20
    assert np.linalg.norm(positions[:, 0] - whole[rows, 0], axis=1).max() < 2
    assert np.array_equal(positions[:, others], observed[rows][:, others])
