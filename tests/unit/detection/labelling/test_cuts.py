"""Minimum cuts: the least total of all sets, and a limb as a whole."""

from itertools import product

import numpy as np
import pytest

from markermend.core.shape import Shape
from markermend.detection.labelling.cuts import likeliest_exchange, minimum_cut
from markermend.detection.labelling.groups import counterparts_by_side
from markermend.mesh.usual_distances import recording_distances
from markermend.options.shape import ShapeOptions
from markermend.prediction.shape_evidence import ShapeEvidence


def total(single, joint, states):
    cost = sum(single[k, state] for k, state in enumerate(states))
    return cost + sum(joint[k, m, a, b] for k, a in enumerate(states) for m, b in enumerate(states) if k != m)


@pytest.mark.parametrize("seed", range(5))
def test_no_other_states_have_a_smaller_total(seed):
    rng = np.random.default_rng(seed)
    single, joint = rng.uniform(0, 3, (6, 2)), rng.uniform(0, 1, (6, 6, 2, 2))
    joint[:, :, 0, 1] += 1.0  # unlike states cost more
    joint[:, :, 1, 0] += 1.0
    joint[range(6), range(6)] = 0.0
    least = min(total(single, joint, states) for states in product((0, 1), repeat=6))
    assert total(single, joint, minimum_cut(single, joint).astype(int)) == pytest.approx(least, abs=0.05)


def test_states_stay_among_equals():
    assert not minimum_cut(np.zeros((3, 2)), np.zeros((3, 3, 2, 2))).any()


@pytest.mark.parametrize("limb", [("TIB", "ANK", "TOE"), ("ANK", "TOE"), ("FIN", "WRA")])
def test_the_markers_of_a_limb_that_are_exchanged(walker, limb):
    positions, markers = walker.recording.positions, walker.recording.markers
    shape = Shape(*recording_distances(positions[::5], min_frames=20))
    other = counterparts_by_side(markers)
    own = [m for m, name in enumerate(markers) if name[1:] in limb]
    exchanged = positions[300:400:10].copy()
    exchanged[:, own] = positions[300:400:10][:, [other[m] for m in own]]
    found = likeliest_exchange(ShapeEvidence(exchanged, shape, ShapeOptions(anchors=16)), other)
    assert found is not None
    assert found.markers == tuple(own)
    assert likeliest_exchange(ShapeEvidence(positions[300:400:10], shape, ShapeOptions(anchors=16)), other) is None
