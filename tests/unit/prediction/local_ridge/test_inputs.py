"""Choice of anchors and inputs: each frame once, anchors that span a frame, and enough frames to train on."""

from dataclasses import replace

import numpy as np

from markermend.core.poses import Pool
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.prediction.local_ridge.inputs import InputSelection
from support.fillings import rigid_body, scene

OPTIONS = replace(LocalRidgeOptions(), anchors=3, inputs=5)


def assign(positions, marker=0, frames=None, options=OPTIONS):
    """The assignments of a marker; all frames if none are named."""
    seen = scene(positions)
    rows = np.arange(len(positions)) if frames is None else frames
    return seen, list(InputSelection(options).assignments(seen, marker, rows))


def test_each_frame_is_predicted_once_from_inputs_that_are_observed():
    positions = rigid_body(frames=300, markers=8)
    positions[20:40, 1] = np.nan
    positions[30:50, 2] = np.nan
    seen, found = assign(positions)
    assert np.array_equal(np.sort(np.concatenate([each.rows for each in found])), np.arange(300))
    for each in found:
        needed = [*each.data.anchors, *each.data.inputs[each.used]]
        assert seen.present[np.ix_(each.rows, needed)].all() and 0 not in needed


def test_training_frames_show_the_marker_and_all_its_inputs():
    positions = rigid_body(frames=300, markers=8)
    positions[20:40, 0] = np.nan
    seen, found = assign(positions, frames=np.arange(20, 40))
    for each in found:
        assert seen.present[np.ix_(each.data.training, [0, *each.data.inputs])].all()
        assert each.data.local.shape == (len(each.data.training), 3 * len(each.data.inputs) + 3)
        assert np.allclose(np.median(each.data.local, axis=0), 0, atol=1e-9)


def test_anchors_on_a_line_are_widened_by_further_ones():
    body = rigid_body(frames=200, markers=8)
    body[:, 2] = (body[:, 1] + body[:, 3]) / 2
    seen = replace(scene(body), neighbours=[np.array([1, 2, 3, 4, 5, 6, 7])] + [np.zeros(0, int)] * 7)
    narrow, wide = (
        next(InputSelection(replace(OPTIONS, min_anchor_extent_mm=extent)).assignments(seen, 0, np.arange(200)))
        for extent in (0.0, 15.0)
    )
    assert narrow.data.anchors.tolist() == [1, 2, 3]
    assert wide.data.anchors.tolist()[:4] == [1, 2, 3, 4]


def test_a_neighbour_that_is_often_missing_comes_last():
    body = rigid_body(frames=200, markers=8)
    body[50:150, 1] = np.nan
    seen = replace(scene(body), neighbours=[np.array([1, 2, 3, 4, 5, 6, 7])] + [np.zeros(0, int)] * 7)
    (found,) = InputSelection(OPTIONS).assignments(seen, 0, np.arange(60, 80))
    assert found.data.anchors.tolist() == [2, 3, 4]


def test_two_neighbours_or_too_few_frames_give_nothing():
    assert assign(rigid_body(frames=200, markers=3))[1] == []
    assert assign(rigid_body(frames=OPTIONS.min_training_frames - 1, markers=6))[1] == []


def test_other_recordings_make_up_for_too_few_frames():
    """The marker is seen in 20 frames of this recording: too few, unless another one shows it with the same neighbours."""
    body, elsewhere = rigid_body(frames=120, markers=8), rigid_body(frames=80, markers=8, seed=1)
    body[20:, 0] = np.nan
    seen, alone = assign(body, frames=np.arange(20, 60))
    assert not alone

    def pooled(positions):
        pool = Pool(positions, np.zeros(len(positions), int), ("other",))
        return list(InputSelection(OPTIONS).assignments(replace(seen, pool=pool), 0, np.arange(20, 60)))

    (found,) = pooled(elsewhere)
    assert found.data.training.tolist() == list(range(20)) and len(found.data.pooled.local) == 80
    assert not pooled(elsewhere[:50])


def test_recordings_that_show_the_markers_too_briefly_do_not_make_up_for_it():
    """Twenty recordings have four rows each, fewer than are learned from: together they must not count as enough."""
    body, elsewhere = rigid_body(frames=120, markers=8), rigid_body(frames=80, markers=8, seed=1)
    body[20:, 0] = np.nan
    for rows, count in ((4, 0), (5, 1)):
        pool = Pool(elsewhere, np.arange(80) // rows, tuple(map(str, range(80 // rows))))
        found = InputSelection(OPTIONS).assignments(replace(scene(body), pool=pool), 0, np.arange(20, 60))
        assert len(list(found)) == count


def test_on_a_trial_training_data_are_those_of_the_whole_scene_and_what_it_hides_is_named():
    whole = scene(rigid_body(frames=300, markers=8))
    positions = whole.positions.copy()
    positions[20:40, 0] = positions[25:45, 2] = np.nan
    trial, selection = replace(whole, positions=positions, whole=whole), InputSelection(OPTIONS)
    (entire,) = selection.assignments(whole, 0, np.arange(60, 80))
    (found,) = selection.assignments(trial, 0, np.arange(60, 80))
    assert entire.hidden is None and found.data is entire.data
    assert 2 in found.data.inputs
    assert found.data.training[found.hidden].tolist() == list(range(20, 45))


def test_a_trial_that_leaves_too_few_frames_predicts_nothing():
    whole = scene(rigid_body(frames=100, markers=8))
    positions = whole.positions.copy()
    positions[30:71, 0] = np.nan
    trial = replace(whole, positions=positions, whole=whole)
    assert not list(InputSelection(OPTIONS).assignments(trial, 0, np.arange(30, 71)))
