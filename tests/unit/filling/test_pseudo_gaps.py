"""Pseudo-gaps: where they lie, what is hidden in them, and what they share."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from markermend.filling.gap import Gap
from markermend.filling.pseudo_gaps import pseudo_gaps, scene_count, trial_length
from support.fillings import ensemble_options, rigid_body, scene
from support.naive.filling import neighbour_motion


def wanted(count, *, hidden_share=0.2, neighbours=3):
    return ensemble_options(
        pseudo_gaps=count,
        max_hidden_share=hidden_share,
        compared_neighbours=neighbours,
    )


def naive_starts(seen, gap, length, options):
    """First frames of the pseudo-gaps of a gap, tried one by one, one in each of `count` equal parts."""
    present, frames, count = seen.present, len(seen.positions), options.pseudo_gaps
    starts = [
        first
        for first in range(1, frames - length)
        if all(present[frame, gap.marker] for frame in range(first - 1, first + length + 1))
    ]
    near = [int(other) for other in seen.neighbours[gap.marker][: options.compared_neighbours]]
    there = [other for other in near if all(present[frame, other] for frame in range(gap.start, gap.stop))]
    equal = [
        first
        for first in starts
        if all(present[frame, other] for other in there for frame in range(first, first + length))
    ]
    starts = equal if len(equal) >= count else starts
    drawn = np.random.default_rng([gap.marker, gap.start, gap.stop]).random(count)
    return sorted({starts[int((part + drawn[part]) / count * len(starts))] for part in range(count)})


def naive_stride(starts, distance, max_per_scene):
    """The least number of scenes, tried one after the other: in each every pair is far enough apart, and not too many."""
    for scenes in range(1, len(starts) + 1):
        groups = [starts[first::scenes] for first in range(scenes)]
        apart = all(b - a >= distance for group in groups for a, b in pairwise(group))
        if scenes == len(starts) or (apart and max(map(len, groups)) <= max_per_scene):
            return scenes
    return 0


@pytest.mark.parametrize("seed", range(6))
def test_pseudo_gaps_equal_the_naive_twin(seed):
    rng = np.random.default_rng(seed)
    positions = rigid_body(frames=260, markers=6, seed=seed)
    for marker in range(6):
        for start in rng.integers(0, 250, 2):
            positions[start : start + rng.integers(1, 12), marker] = np.nan
    start = int(rng.integers(0, 200)) * (seed > 0)
    gap = Gap(2, start, start + int(rng.integers(5, 25)))
    positions[gap.samples] = np.nan
    seen, share = scene(positions), 0.5
    options = wanted(5, hidden_share=share)
    found = pseudo_gaps(seen, gap, options)
    length = trial_length(seen.present[:, 2], gap.length)
    starts = naive_starts(seen, gap, length, options)
    assert [trial.gap for trial in found] == [Gap(2, first, first + length) for first in starts]
    beyond = max(length, 100) if gap.start == 0 else 0
    max_per_scene = int(share * seen.present[:, 2].sum() / (length + beyond))
    scenes = naive_stride(starts, 2 * (length + beyond), max_per_scene)
    for k, trial in enumerate(found):
        together = starts[k % scenes :: scenes]
        expected = positions.copy()
        for first in together:
            for n in range(length):
                row = int(np.linspace(gap.start, gap.stop - 1, length)[n])
                for marker in range(6):
                    if np.isnan(positions[row, marker, 0]):
                        expected[first + n, marker] = np.nan
            expected[max(first - beyond, 0) : first + length, 2] = np.nan
        assert np.array_equal(trial.scene.positions, expected, equal_nan=True)
        assert np.array_equal(trial.truth, positions[trial.gap.samples])
        motion = neighbour_motion(seen, gap, starts[k], length, options.motion_neighbours)
        assert trial.motion == pytest.approx(motion, nan_ok=True)


@pytest.mark.parametrize("seed", range(5))
def test_the_number_of_scenes_equals_the_naive_twin(seed):
    rng = np.random.default_rng(seed)
    starts = np.unique(rng.integers(0, 300, 9))
    for distance in (1, 10, 60, 1000):
        for max_per_scene in (0, 1, 2, 4, 9):
            assert scene_count(starts, distance=distance, max_per_scene=max_per_scene) == naive_stride(
                starts.tolist(), distance, max_per_scene
            )


def test_pseudo_gaps_miss_what_the_gap_misses(walker):
    positions = walker.recording.positions[:500].copy()
    positions[200:240, 7] = np.nan
    positions[210:230, 8] = np.nan
    seen = scene(positions)
    trials = pseudo_gaps(seen, Gap(7, 200, 240), wanted(5))
    assert len(trials) == 5
    for trial in trials:
        assert trial.gap.stop - trial.gap.start == 40
        assert np.isnan(trial.scene.positions[trial.gap.start : trial.gap.stop, 7]).all()
        assert np.isnan(trial.scene.positions[trial.gap.start + 10 : trial.gap.start + 30, 8]).all()
        assert np.isfinite(trial.scene.positions[[trial.gap.start - 1, trial.gap.stop], 7]).all()
        assert np.array_equal(trial.truth, positions[trial.gap.start : trial.gap.stop, 7])
    assert np.isfinite(seen.positions[:200]).all()


def test_where_there_is_no_room_pseudo_gaps_are_shorter(walker):
    positions = walker.recording.positions[:500].copy()
    positions[:380, 7] = np.nan
    positions[:190, 8] = np.nan
    trials = pseudo_gaps(scene(positions), Gap(7, 0, 380), wanted(3))
    assert [trial.gap.stop - trial.gap.start for trial in trials] == 3 * [2 * 118 // 3]
    for trial in trials:
        missed = np.isnan(trial.scene.positions[trial.gap.start : trial.gap.stop, 8, 0])
        assert np.array_equal(missed, np.arange(78) < 39)
    positions[2:, 7] = np.nan
    assert pseudo_gaps(scene(positions), Gap(7, 2, 500), wanted(3)) == []


def test_in_pseudo_gaps_filled_neighbours_are_as_wrong_as_they_may_be(walker):
    positions = walker.recording.positions[:500].copy()
    positions[200:240, 7] = np.nan
    inherited_std = np.zeros(positions.shape[:2])
    inherited_std[200:240, 8] = np.hanning(40) * 10
    seen = replace(scene(positions), inherited_std=inherited_std, measured=scene(positions))
    trials = pseudo_gaps(seen, Gap(7, 200, 240), wanted(40))
    moved = np.stack([(t.scene.positions - positions)[t.gap.start : t.gap.stop] for t in trials])
    others = np.delete(moved, [7, 8], axis=2)
    assert np.array_equal(others, np.zeros_like(others))
    directions = moved[:, :, 8].sum(axis=1) / inherited_std[200:240, 8].sum()
    assert np.allclose(moved[:, :, 8], directions[:, None] * inherited_std[200:240, 8, None])
    assert 0.8 < directions.std() < 1.2
    again = pseudo_gaps(seen, Gap(7, 200, 240), wanted(40))
    assert np.array_equal(again[3].scene.positions, trials[3].scene.positions, equal_nan=True)
    assert all(trial.scene.inherited_std is None and trial.scene.measured is None for trial in trials)


def test_trials_share_a_scene_only_while_they_leave_enough_to_learn_from(walker):
    seen = scene(walker.recording.positions[:500])
    for share, scenes in ((0.9, 2), (0.2, 3), (0.0, 6)):
        trials = pseudo_gaps(seen, Gap(7, 200, 240), wanted(6, hidden_share=share))
        shared = {id(trial.scene): trial.scene for trial in trials}
        assert len(shared) == scenes
        assert [trial.gap.start for trial in trials] == sorted(trial.gap.start for trial in trials)
        for each in shared.values():
            own = [trial for trial in trials if trial.scene is each]
            assert np.count_nonzero(~each.present[:, 7]) == 40 * len(own)
            assert share == 0 or 40 * len(own) <= share * 500


def test_pseudo_gaps_keep_from_jumps_where_there_is_room(walker):
    positions = walker.recording.positions[:400].copy()
    positions[200:203, 7] = np.nan
    near = np.zeros(positions.shape[:2], bool)
    near[100:300, 7] = True
    trials = pseudo_gaps(replace(scene(positions), near_jumps=near), Gap(7, 200, 203), wanted(20))
    assert not any(near[trial.gap.start : trial.gap.stop, 7].any() for trial in trials)
    near[:, 7] = True
    everywhere = replace(scene(positions), near_jumps=near)
    assert pseudo_gaps(everywhere, Gap(7, 200, 203), wanted(5))
