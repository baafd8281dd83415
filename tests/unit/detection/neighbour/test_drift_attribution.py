"""Attribution of drifts: by distances on a rigid segment, and which neighbours are observed intermittently."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.core.events import Event
from markermend.detection.neighbour.drift_attribution import DriftAttribution
from markermend.detection.neighbour.drift_scores import DriftScorer
from markermend.prediction.scene import Scene
from support.signals import RIDGE, options_of

SCORER = DriftScorer(100.0, options_of("slow", "default"))


def triangle(length, direction):
    return 10 * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))[:, None] * direction


@pytest.mark.parametrize("culprit", range(5))
def test_on_a_rigid_segment_the_distances_decide_whose_it_is(culprit):
    rng = np.random.default_rng(6)
    rotation = Rotation.from_rotvec(np.cumsum(rng.normal(0, 0.02, (400, 3)), axis=0)).as_matrix()
    rigid = np.einsum("tij,mj->tmi", rotation, rng.normal(0, 80, (5, 3)))
    loose = rigid.mean(axis=1, keepdims=True) + np.cumsum(rng.normal(0, 2, (400, 4, 3)), axis=0)
    positions = np.concatenate([rigid, loose], axis=1)
    positions[200:250, culprit] += triangle(50, [0.3, 0.2, -0.1])
    scene = Scene(positions, 100.0, [np.delete(np.arange(9), m) for m in range(9)])
    attribution = DriftAttribution(scene, None, SCORER, RIDGE)  # the scores do not matter
    event = Event("culprit", 200, 250, 1.0, "xyz")
    for other in set(range(9)) - {culprit}:
        assert attribution.distances_change_more(culprit, other, event)
        assert not attribution.distances_change_more(other, culprit, event)


@pytest.mark.parametrize(("stop", "intermittent"), [(118, [1]), (160, [])])
def test_what_is_brief_depends_on_how_long_the_event_is(stop, intermittent):
    positions = np.zeros((300, 3, 3))
    positions[108:112, 1] = np.nan
    scene = Scene(positions, 100.0, [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])])
    attribution = DriftAttribution(scene, None, SCORER, RIDGE)
    assert attribution.intermittent_neighbours(0, Event("a", 100, stop, 2.0, "xyz")).tolist() == intermittent
