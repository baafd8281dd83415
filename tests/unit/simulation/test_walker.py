"""The synthetic walker: a body of the right size, moving as people do, seen as cameras see it."""

import numpy as np
import pytest
from scipy.spatial.distance import pdist

from markermend.numerics.intervals import runs
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import kind, make_body
from support.walkers import marker, person, speed


def test_a_seed_is_a_recording():
    one, two, other = person(1), person(1), person(2)
    assert np.array_equal(one.recording.positions, two.recording.positions)
    assert not np.array_equal(one.recording.positions, other.recording.positions)


def test_the_motion_does_not_depend_on_the_rate():
    fast, slow = person(1, rate=200.0), person(1, rate=100.0)
    assert fast.bouts == slow.bouts
    assert np.abs(fast.rigid[::2] - slow.rigid).max() < 5


def test_a_body_can_be_recorded_more_than_once():
    body = make_body(rng=np.random.default_rng(3))
    one, two = (
        walk(
            body=body,
            duration=3.0,
            rate=100.0,
            activities=["walk"],
            errors=MeasurementErrors(noise=0.0, soft_tissue=0.0),
            rng=rng,
        )
        for rng in np.random.default_rng(4).spawn(2)
    )
    head = [one.segments.index("head"), *range(one.segments.index("head") + 1, one.segments.index("head") + 4)]
    np.testing.assert_allclose(pdist(one.rigid[0, head]), pdist(two.rigid[-1, head]))
    assert not np.allclose(one.rigid, two.rigid)


def test_segments_and_tree(walker):
    names = walker.recording.markers
    assert len(names) == len(set(names)) == len(walker.segments) >= 39
    assert len(set(walker.segments)) == len(walker.tree) == 15
    assert {"LFHD", "C7", "LASI", "RSHO", "LKNE", "RTOE", "LFIN"} <= set(names)
    assert [name for name, parent in walker.tree.items() if parent is None] == ["pelvis"]
    assert walker.tree["left_foot"] == "left_shank"
    assert all(walker.segments.count(segment) >= 3 for segment in walker.tree)


@pytest.mark.parametrize("soft_tissue", [0.0, 1.0])
def test_segments_are_rigid_up_to_soft_tissue_and_noise(soft_tissue):
    walker = person(5, soft_tissue=soft_tissue)
    segments = np.array(walker.segments)
    for segment in walker.tree:
        bones = walker.rigid[:, segments == segment]
        seen = walker.recording.positions[:, segments == segment]
        still = np.array([pdist(frame) for frame in bones[::50]])
        moving = np.array([pdist(frame) for frame in seen[::10]])
        assert np.ptp(still, axis=0).max() < 1e-9
        spread = moving.std(axis=0)
        assert spread.min() > 0.1
        assert spread.max() < (0.5 if soft_tissue == 0 else 8.0)


def test_soft_tissue_is_a_few_mm_and_least_on_the_head():
    walker = person(6, noise=0.0)
    moved = np.linalg.norm(walker.recording.positions - walker.rigid, axis=2)
    segments = np.array([kind(segment) for segment in walker.segments])
    assert 2 < np.percentile(moved[:, segments == "thigh"], 99) < 15
    assert np.percentile(moved[:, segments == "head"], 99) < 1.0
    assert moved.max() < 25


def test_noise_is_as_asked():
    noisy, clean = person(7, noise=0.4), person(7, noise=0.0)
    difference = noisy.recording.positions - clean.recording.positions
    assert difference.std() == pytest.approx(0.4, rel=0.01)
    assert np.abs((difference[1:] * difference[:-1]).mean()) < 0.001


@pytest.mark.parametrize("seed", range(4))
def test_feet_stand_on_the_ground(seed):
    walker = person(seed, duration=16.0)
    heels = np.stack([marker(walker, side + "HEE") for side in "LR"], axis=1)
    toes = np.stack([marker(walker, side + "TOE") for side in "LR"], axis=1)
    lowest = np.minimum(heels, toes)[:, :, 2].min(axis=1)
    assert lowest.min() > -15
    assert lowest.max() < 75
    walking = next(bout for bout in walker.bouts if bout[0] == "walk")
    rows = slice(round((walking[1] + 1) * 100), round((walking[2] - 1) * 100))
    standing = np.minimum(speed(walker, "LTOE"), speed(walker, "RTOE"))[rows]
    assert np.median(standing) < 0.25
    assert sum(1 for _ in runs(speed(walker, "LTOE")[rows] > 2)) >= 2
