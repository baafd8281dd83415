"""Usual distances: against naive twins, and right where a recording, a stretch or a static trial is wrong."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.mesh.usual_distances import pool_distances, recording_distances, usual_distances, weighted_median
from support.bodies import recording, subject

OPTIONS = {"frames": 2500, "min_frames": 20, "static_weight": 1.5, "min_spread_mm": 2.0}


def exchanged(own, share):
    """The recording with two labels exchanged in the first part of it."""
    positions = own.positions.copy()
    stop = int(share * len(positions))
    positions[:stop, [0, 5]] = positions[:stop, [5, 0]]
    return replace(own, positions=positions)


@pytest.fixture
def walk():
    names, positions, _ = subject(3, frames=300, tree=(None, 0))
    return recording(names, positions + np.random.default_rng(4).normal(0, 1, positions.shape), name="walk")


def test_distances_of_a_recording_equal_the_naive_twin(walk):
    positions = walk.positions.copy()
    positions[np.random.default_rng(5).random(positions.shape[:2]) < 0.3] = np.nan
    positions[20:, 5] = np.nan
    found = recording_distances(positions, min_frames=20)
    for i in range(len(walk.markers)):
        for j in set(range(len(walk.markers))) - {i}:
            distances = np.linalg.norm(positions[:, i] - positions[:, j], axis=1)
            distances = distances[~np.isnan(distances)]
            if len(distances) < 20:
                assert np.isnan(found[:, i, j]).all()
                continue
            low, median, high = np.percentile(distances, (5, 50, 95))
            mad = 1.4826022185056018 * np.median(np.abs(distances - median))
            np.testing.assert_allclose(found[:, i, j], [median, mad, (high - low) / 3.2897072539029444], atol=1e-9)


def test_weighted_median_equals_the_naive_twin():
    rng = np.random.default_rng(1)
    values, weights = rng.normal(size=(9, 50)), rng.random((9, 50)) * (rng.random((9, 50)) > 0.3)
    weights[:, 3] = 0
    values[weights == 0] = np.nan
    expected = []
    for column, weight in zip(values.T, weights.T, strict=True):
        total, below = weight.sum(), 0.0
        for value, own in sorted((v, w) for v, w in zip(column, weight, strict=True) if w > 0):
            below += own
            if below >= total / 2:
                expected.append(value)
                break
        else:
            expected.append(np.nan)
    np.testing.assert_array_equal(weighted_median(values, weights), expected)


def test_the_order_of_recordings_does_not_matter(walk):
    others = [replace(exchanged(walk, share), facts={"recording": f"r{share}"}) for share in (0.2, 0.4)]
    one, other = ([walk, *others], [*others[::-1], walk])
    assert usual_distances(one, markers=walk.markers, **OPTIONS) == usual_distances(
        other, markers=walk.markers, **OPTIONS
    )


@pytest.mark.parametrize("kind", ["dynamic", "static"])
def test_another_recording_decides_where_labels_are_exchanged_in_most_of_one(walk, kind):
    right = usual_distances([walk], markers=walk.markers, **OPTIONS)
    wrong = exchanged(walk, 0.6)
    assert usual_distances([wrong], markers=walk.markers, **OPTIONS) != right
    other = replace(walk, facts={"recording": "other", "kind": kind})
    found = usual_distances([wrong, other], markers=walk.markers, **OPTIONS)
    first, mate = walk.markers[0], walk.markers[1]
    assert found[first][mate][0] == pytest.approx(right[first][mate][0], abs=0.5)


def test_static_recordings_do_not_make_distances_steady(walk):
    still = replace(
        walk, positions=np.repeat(walk.positions[:1], 100, axis=0), facts={"recording": "s", "kind": "static"}
    )
    alone = usual_distances([walk], markers=walk.markers, **OPTIONS)
    both = usual_distances([walk, still], markers=walk.markers, **OPTIONS)
    for first, others in alone.items():
        for second, (_, deviation, spread) in others.items():
            assert both[first][second][1] >= deviation - 0.01
            assert both[first][second][2] >= spread - 0.01


def test_differences_between_recordings_count_as_variation():
    pooled = np.array([[[100.0], [110.0], [120.0]], [[1.0], [1.0], [1.0]], [[1.0], [1.0], [1.0]]])
    usual = pool_distances(pooled, static=np.zeros(3, bool), static_weight=1.5, min_spread_mm=2.0)
    assert usual[0, 0] == 110.0
    assert usual[1, 0] == pytest.approx(np.hypot(1.0, 14.826022185056018))


def test_a_pair_that_is_never_seen_together_is_left_out(walk):
    positions = walk.positions.copy()
    positions[:150, 0] = positions[150:, 1] = np.nan
    found = usual_distances([replace(walk, positions=positions)], markers=walk.markers, **OPTIONS)
    assert walk.markers[1] not in found[walk.markers[0]]
    assert walk.markers[2] in found[walk.markers[0]]
