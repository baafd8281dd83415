"""Pseudo-gaps: where they lie, what is hidden in them, and what they share."""

from dataclasses import replace

import numpy as np

from markermend.filling.gap import Gap
from markermend.filling.pseudo_gaps import pseudo_gaps
from support.fillings import scene


def test_pseudo_gaps_miss_what_the_gap_misses(walker):
    positions = walker.recording.positions[:500].copy()
    positions[200:240, 7] = np.nan
    positions[210:230, 8] = np.nan
    seen = scene(positions)
    trials = pseudo_gaps(seen, Gap(7, 200, 240), count=5, hidden_share=0.2, neighbours=3)
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
    trials = pseudo_gaps(scene(positions), Gap(7, 0, 380), count=3, hidden_share=0.2, neighbours=3)
    assert [trial.gap.stop - trial.gap.start for trial in trials] == 3 * [2 * 118 // 3]
    for trial in trials:
        missed = np.isnan(trial.scene.positions[trial.gap.start : trial.gap.stop, 8, 0])
        assert np.array_equal(missed, np.arange(78) < 39)
    positions[2:, 7] = np.nan
    assert pseudo_gaps(scene(positions), Gap(7, 2, 500), count=3, hidden_share=0.2, neighbours=3) == []


def test_in_pseudo_gaps_filled_neighbours_are_as_wrong_as_they_may_be(walker):
    positions = walker.recording.positions[:500].copy()
    positions[200:240, 7] = np.nan
    inherited_std = np.zeros(positions.shape[:2])
    inherited_std[200:240, 8] = np.hanning(40) * 10
    seen = replace(scene(positions), inherited_std=inherited_std, measured=scene(positions))
    trials = pseudo_gaps(seen, Gap(7, 200, 240), count=40, hidden_share=0.2, neighbours=3)
    moved = np.stack([(t.scene.positions - positions)[t.gap.start : t.gap.stop] for t in trials])
    others = np.delete(moved, [7, 8], axis=2)
    assert np.array_equal(others, np.zeros_like(others))
    directions = moved[:, :, 8].sum(axis=1) / inherited_std[200:240, 8].sum()
    assert np.allclose(moved[:, :, 8], directions[:, None] * inherited_std[200:240, 8, None])
    assert 0.8 < directions.std() < 1.2
    again = pseudo_gaps(seen, Gap(7, 200, 240), count=40, hidden_share=0.2, neighbours=3)
    assert np.array_equal(again[3].scene.positions, trials[3].scene.positions, equal_nan=True)
    assert all(trial.scene.inherited_std is None and trial.scene.measured is None for trial in trials)


def test_trials_share_a_scene_only_while_they_leave_enough_to_learn_from(walker):
    seen = scene(walker.recording.positions[:500])
    for share, scenes in ((0.9, 2), (0.2, 3), (0.0, 6)):
        trials = pseudo_gaps(seen, Gap(7, 200, 240), count=6, hidden_share=share, neighbours=3)
        shared = {id(trial.scene): trial.scene for trial in trials}
        assert len(shared) == scenes
        assert [trial.gap.start for trial in trials] == sorted(trial.gap.start for trial in trials)
        for each in shared.values():
            own = [trial for trial in trials if trial.scene is each]
            assert np.count_nonzero(~each.present[:, 7]) == 40 * len(own)
            assert share == 0 or 40 * len(own) <= share * 500
