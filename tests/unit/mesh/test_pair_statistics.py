"""Statistics of marker pairs: against naive twins, pooled over recordings, independent of the axes."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.mesh import pair_statistics
from support.bodies import recording, subject


@pytest.fixture
def gappy():
    names, positions, _ = subject(3, frames=300, tree=(None, 0))
    rng = np.random.default_rng(4)
    positions += rng.normal(0, 2, positions.shape)
    positions[rng.random(positions.shape[:2]) < 0.3] = np.nan
    positions[20:, 5] = np.nan
    return names, positions


def naive_distances(positions, valid_frames):
    """Median and (P95 - P5) / 3.29 of each pair's distance, one pair at a time."""
    markers = positions.shape[1]
    median, deviation = np.full((2, markers, markers), np.nan)
    for i in range(markers):
        for j in range(markers):
            distances = [
                np.linalg.norm(frame[i] - frame[j]) for frame in positions if not np.isnan(frame[[i, j]]).any()
            ]
            if i != j and len(distances) >= valid_frames:
                low, middle, high = np.percentile(distances, (5, 50, 95))
                median[i, j], deviation[i, j] = middle, (high - low) / 3.2897072539029444
    return median, deviation


def naive_coherence(positions):
    """Correlation of the displacements of each pair over the steps that both have, each axis about its own mean."""
    steps = np.diff(positions, axis=0)
    markers = positions.shape[1]
    coherence = np.full((markers, markers), np.nan)
    for i in range(markers):
        for j in range(markers):
            joint = [t for t in range(len(steps)) if not np.isnan(steps[t, [i, j]]).any()]
            a, b = steps[joint, i] - steps[joint, i].mean(axis=0), steps[joint, j] - steps[joint, j].mean(axis=0)
            coherence[i, j] = (a * b).sum() / np.sqrt((a * a).sum() * (b * b).sum())
    return coherence


def test_distance_statistics_equal_the_naive_twin(gappy):
    _, positions = gappy
    before = positions.copy()
    found = pair_statistics.distance_statistics(positions, valid_frames=60)
    for fast, slow in zip(found, naive_distances(positions, 60), strict=True):
        np.testing.assert_allclose(fast, slow, rtol=1e-12)
    assert np.isnan(found[0][5]).all()
    np.testing.assert_array_equal(positions, before)


def test_coherence_equals_the_naive_twin(gappy):
    _, positions = gappy
    positions = np.delete(positions, 5, axis=1)
    products, squares = pair_statistics.displacement_moments(positions)
    np.testing.assert_allclose(products / np.sqrt(squares * squares.T), naive_coherence(positions), atol=1e-12)


def test_coherence_does_not_depend_on_the_laboratory_axes(gappy):
    names, positions = gappy
    turn = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    drifting = positions + np.arange(len(positions))[:, None, None] * np.array([3.0, -1.0, 0.0])
    one, other = (
        pair_statistics.pair_statistics([recording(names, p)], frames=2500, valid_frames=60, markers=names)
        for p in (drifting, drifting @ turn)
    )
    np.testing.assert_allclose(one.coherence, other.coherence, atol=2e-6)


def test_deviations_of_several_recordings_are_pooled_as_root_mean_square():
    names, positions, _ = subject(6, frames=400, tree=(None, 0))
    second = recording(names[2:], positions[200:, 2:], name="b")
    first = recording(names, positions[:200], name="a")
    pooled = pair_statistics.pair_statistics([second, first], frames=2500, valid_frames=60, markers=names)
    parts = [pair_statistics.distance_statistics(p, valid_frames=60)[1] for p in (positions[:200], positions[200:])]
    expected = np.sqrt((parts[0] ** 2 + parts[1] ** 2) / 2)
    expected[:2] = parts[0][:2]
    expected[:, :2] = parts[0][:, :2]
    np.fill_diagonal(expected, 0)
    np.testing.assert_allclose(pooled.deviation, expected, atol=1e-9)
    assert pooled.valid.tolist() == [200, 200] + [400] * 6
    assert pooled.seconds == 4.0


def test_frozen_markers_have_no_coherence_and_pairs_never_seen_together_are_unknown():
    positions = np.zeros((200, 3, 3)) + np.arange(3)[None, :, None] * 100.0
    positions[:100, 2] = positions[100:, 1] = np.nan
    found = pair_statistics.pair_statistics([recording("abc", positions)], frames=500, valid_frames=60, markers="abc")
    assert np.isnan(found.coherence[0, 1])
    assert found.deviation[0, 1] == 0
    assert np.isnan(found.distance[1, 2])
    assert np.isnan(found.attachment_costs(found.dissimilarity(300.0))[1, 2])


def test_cost_and_dissimilarity_are_those_defined(gappy):
    names, positions = gappy
    keep = [0, 1, 2, 6]
    names, positions = [names[m] for m in keep], positions[:, keep]
    found = pair_statistics.pair_statistics([recording(names, positions)], frames=500, valid_frames=60, markers=names)
    median, deviation = np.nan_to_num(naive_distances(positions, 60))
    near = found.dissimilarity(250.0)
    np.testing.assert_allclose(near, deviation * median / 250.0, atol=1e-6)
    np.testing.assert_allclose(found.attachment_costs(near), near * (2 - naive_coherence(positions)), atol=1e-4)


@pytest.mark.parametrize(("frames", "kept"), [(100, 100), (101, 101), (7, 7), (1000, 1000), (2500, 1000)])
def test_thinning_keeps_the_duration_and_spreads_the_frames(frames, kept):
    whole = recording(["a"], np.arange(3000.0).reshape(1000, 1, 3))
    thinned = pair_statistics.thin(whole, frames=frames)
    assert thinned.frames == kept
    assert thinned.frames / thinned.rate == pytest.approx(10.0)
    steps = np.diff(thinned.positions[:, 0, 0]) / 3
    assert steps.max() - steps.min() <= 1


def test_half_of_the_percentile_range_counts_artifacts_little():
    rng = np.random.default_rng(8)
    positions = np.zeros((2000, 2, 3))
    positions[:, 1, 0] = 300 + rng.normal(0, 2, 2000)
    clean = pair_statistics.distance_statistics(positions, valid_frames=60)[1][0, 1]
    positions[100:150, 1, 0] += 400
    spoilt = pair_statistics.distance_statistics(positions, valid_frames=60)[1][0, 1]
    assert clean == pytest.approx(2, rel=0.1)
    assert spoilt == pytest.approx(2, rel=0.25)
    assert np.std(positions[:, 1, 0]) > 50


@pytest.mark.parametrize("known", [(1, 2, 7, 20), (20, 20), (3, 3, 3)])
def test_percentiles_equal_those_of_numpy(known):
    values = np.random.default_rng(9).normal(0, 1, (len(known), 20))
    for row, count in zip(values, known, strict=True):
        row[np.random.default_rng(count).permutation(20)[count:]] = np.nan
    shares = (0.0, 0.05, 0.5, 1.0)
    found = pair_statistics.percentiles(values, np.array(known, int), shares)
    assert found == pytest.approx(np.nanpercentile(values, [100 * share for share in shares], axis=1))


def test_a_recording_without_a_name_has_an_empty_one():
    assert pair_statistics.recording_name(recording("a", np.zeros((5, 1, 3)), name="walk")) == "walk"
    assert pair_statistics.recording_name(replace(recording("a", np.zeros((5, 1, 3))), facts={})) == ""
