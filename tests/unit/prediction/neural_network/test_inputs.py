"""Inputs of networks: their choice, positions now and before, completion, and sequences of frames."""

from dataclasses import replace

import numpy as np

from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.prediction.neural_network.inputs import choose_inputs, complete_inputs, features, sequences
from support.fillings import neighbours, rigid_body, scene


def test_inputs_are_positions_now_and_a_frame_ago():
    positions = np.arange(4 * 2 * 3, dtype=float).reshape(4, 2, 3) ** 2
    columns, middle = features(positions, np.array([0, 2]), centred=False)
    assert not middle.any()
    assert columns[1].tolist() == [*positions[2, 0], *positions[1, 0], *positions[2, 1], *positions[1, 1]]
    assert columns[0].tolist() == [*positions[0, 0], *positions[0, 0], *positions[0, 1], *positions[0, 1]]
    columns, middle = features(positions, np.array([0, 2]), centred=True)
    assert np.allclose(middle[1], positions[2].mean(axis=0))
    assert np.allclose(columns[1, 3:6], positions[1, 0] - middle[1])


def test_missing_inputs_are_predicted_from_enough_others():
    truth = rigid_body(frames=300, markers=5)
    gapped = truth.copy()
    gapped[100:120, 0] = np.nan
    gapped[110:130, 1:3] = np.nan
    examples = truth[~np.isnan(gapped).any(axis=(1, 2))]
    found = complete_inputs(gapped, examples, minimum=3)
    assert np.isnan(found[110:120, :3]).all()
    found[110:120] = truth[110:120]
    assert np.isfinite(found).all()
    assert np.abs(found[100:110] - truth[100:110]).max() < 0.01
    assert np.array_equal(found[200:], truth[200:])


def test_sequences_are_whole_even_and_about_as_many_frames_as_wanted():
    seen = np.ones(1000, bool)
    seen[[300, 305]] = False
    pieces = sequences(seen, longest=100, frames=10_000)
    assert np.array_equal(np.concatenate(pieces), np.flatnonzero(seen))
    assert all((np.diff(piece) == 1).all() and len(piece) <= 100 for piece in pieces)
    fewer = sequences(seen, longest=100, frames=400)
    assert 300 <= sum(map(len, fewer)) <= 500
    assert fewer[0][0] == 0 and fewer[-1][-1] == 999


def test_segment_mates_are_the_first_inputs(walker):
    person = walker.recording.positions[:400, :12]
    seen = scene(person)
    related = replace(seen, segment_mates=[np.array([11, 9]) for _ in range(12)])
    few = replace(NeuralNetworkOptions(), inputs=4)
    there = np.ones(12, bool)
    near = neighbours(person)[3]
    assert choose_inputs(related, 3, there, few).tolist() == [11, 9, *near[~np.isin(near, (9, 11))][:2]]
    assert choose_inputs(seen, 3, there, few).tolist() == near[:4].tolist()


def test_without_a_limit_all_segment_mates_are_inputs_and_nothing_else(walker):
    person = walker.recording.positions[:400, :12]
    related = replace(scene(person), segment_mates=[np.array([11, 9, 1, 2, 0, 7, 8]) for _ in range(12)])
    published = replace(NeuralNetworkOptions(), inputs=None)
    assert choose_inputs(related, 3, np.ones(12, bool), published).tolist() == [11, 9, 1, 2, 0, 7, 8]
